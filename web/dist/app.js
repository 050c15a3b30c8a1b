var V=class extends Error{},Le=class{constructor(e,r){this.bytes=e;this.name=r;this.view=new DataView(e.buffer,e.byteOffset,e.byteLength)}at=0;view;get left(){return this.bytes.length-this.at}fail(e){throw new V(`${this.name}: ${e}`)}take(e){return e>this.left&&this.fail(`found ${this.left} bytes more, expected ${e}`),this.at+=e,this.at-e}u8(){return this.view.getUint8(this.take(1))}u32(){return this.view.getUint32(this.take(4),!0)}u16(){return this.view.getUint16(this.take(2),!0)}i32(){return this.view.getInt32(this.take(4),!0)}f64(){return this.view.getFloat64(this.take(8),!0)}f32(){let e=this.view.getFloat32(this.take(4),!0);return Number.isFinite(e)||this.fail("found a number that is not finite"),e}floats(e){let r=[];for(let i=0;i<e;++i)r.push(this.f32());return r}count(e){let r=this.u32();return r*e>this.left&&this.fail(`found ${r} elements in ${this.left} bytes`),r}text(){let e=this.count(1),r=this.take(e);return new TextDecoder().decode(this.bytes.subarray(r,r+e))}choice(e,r){let i=this.u8();return i>e&&this.fail(`found ${r} ${i}, expected 0 to ${e}`),i}size(e,r){let i=this.u32();return i>e&&this.fail(`found ${r} ${i}, expected at most ${e}`),i}planes(e,r){e*r>this.left&&this.fail(`found ${this.left} bytes, expected ${e*r}`);let i=this.take(e*r),n=new Uint8Array(e*r);for(let o=0;o<r;++o){let a=0;for(let s=0,l=o,c=i+o*e;s<e;++s,l+=r)a=a+this.bytes[c+s]&255,n[l]=a}return n}planesF32(e,r=1){let i=new Float32Array(this.planes(e,4*r).buffer);for(let n=0;n<i.length;++n)Number.isFinite(i[n])||this.fail("found a number that is not finite");return i}planesU32(e){return new Uint32Array(this.planes(e,4).buffer)}planesU16(e,r=1){return new Uint16Array(this.planes(e,2*r).buffer)}f32s(e){return 4*e>this.left&&this.fail(`found ${this.left} bytes, expected ${4*e}`),Float32Array.from(this.floats(e))}u32s(e){4*e>this.left&&this.fail(`found ${this.left} bytes, expected ${4*e}`);let r=this.take(4*e),i=new Uint32Array(e);for(let n=0;n<e;++n)i[n]=this.view.getUint32(r+4*n,!0);return i}end(){this.left>0&&this.fail(`found ${this.left} bytes more than expected`)}};function Y(t){let e=t>>10&31,r=t&1023,i=t&32768?-1:1;return e===0?i*r*2**-24:e===31?NaN:i*(1+r/1024)*2**(e-15)}var Bt=new Float32Array(1),bn=new Uint32Array(Bt.buffer);function Ct(t){if(!(t<65504))return 31743;if(t<2**-14)return Math.round(t*2**24);Bt[0]=t;let e=bn[0]-939524096,r=e>>>13,i=e&8191;return r+ +(i>4096||i===4096&&(r&1)>0)}var Pe=class{constructor(e,r){this.canvas=e;this.events=r;addEventListener("keydown",i=>this.key(i)),addEventListener("keyup",i=>this.down.delete(i.code)),addEventListener("blur",()=>this.reset()),e.addEventListener("pointerdown",i=>this.begin(i)),e.addEventListener("pointermove",i=>this.move(i)),e.addEventListener("pointerup",i=>this.end(i)),e.addEventListener("pointercancel",i=>this.fingers.delete(i.pointerId)),e.addEventListener("contextmenu",i=>i.preventDefault())}down=new Set;fingers=new Map;yaw=0;pitch=0;pressed=[];reset(){this.down.clear(),this.fingers.clear()}key(e){e.ctrlKey||e.altKey||e.metaKey||e.target instanceof Element&&e.target.closest("button, select, dialog, a")&&!/^Key[WASD]$/.test(e.code)||e.target instanceof HTMLSelectElement||(/^Arrow|^Space$/.test(e.code)&&e.preventDefault(),e.repeat||this.events.key(e.key.length===1?e.key.toLowerCase():e.key),this.down.add(e.code))}begin(e){if(e.button!==0)return;this.canvas.focus({preventScroll:!0});try{this.canvas.setPointerCapture(e.pointerId)}catch{}let r=e.pointerType==="touch"&&e.clientX<.5*innerWidth&&![...this.fingers.values()].some(i=>i.moves);this.fingers.set(e.pointerId,{x:e.clientX,y:e.clientY,startX:e.clientX,startY:e.clientY,begin:e.timeStamp,moves:r,far:!1})}move(e){let r=this.fingers.get(e.pointerId);if(!r){e.pointerType==="mouse"&&this.events.hover(...this.place(e));return}if(r.far||=Math.hypot(e.clientX-r.startX,e.clientY-r.startY)>12,!r.moves){let i=e.pointerType==="touch"?.006:.004;this.yaw+=(e.clientX-r.x)*i,this.pitch+=(e.clientY-r.y)*i}r.x=e.clientX,r.y=e.clientY}end(e){let r=this.fingers.get(e.pointerId);this.fingers.delete(e.pointerId),!(!r||r.far||e.timeStamp-r.begin>800)&&(e.pointerType!=="mouse"||e.detail>=2||this.doubled(e))&&this.events.go(...this.place(e))}lastClick=-1e9;doubled(e){let r=e.timeStamp-this.lastClick<400;return this.lastClick=e.timeStamp,r}place(e){let r=this.canvas.getBoundingClientRect();return[(e.clientX-r.left)/r.width,(e.clientY-r.top)/r.height]}get stick(){return[...this.fingers.values()].find(e=>e.moves&&e.far)}gamepad(e,r){let i=(navigator.getGamepads?.()??[]).find(a=>a?.connected);if(!i)return;let n=a=>{let s=i.axes[a]??0;return Math.abs(s)<.15?0:(s-Math.sign(s)*.15)/(1-.15)};e.right+=n(0),e.ahead-=n(1),e.yaw+=n(2)*2*r,e.pitch+=n(3)*2*r;let o=["g",void 0,"p",void 0,"Shift","c",void 0,void 0,"?","Home",void 0,void 0,"+","-"];e.fast||=!!i.buttons[4]?.pressed,i.buttons.forEach((a,s)=>{let l=o[s];a.pressed&&!this.pressed[s]&&l&&s!==4&&this.events.key(l),this.pressed[s]=a.pressed})}take(e){let r=o=>Number(this.down.has(o)),i={right:r("KeyD")-r("KeyA"),ahead:r("KeyW")-r("KeyS"),fast:!!(r("ShiftLeft")+r("ShiftRight")),yaw:-this.yaw+(r("ArrowRight")-r("ArrowLeft"))*1.5*e,pitch:-this.pitch+(r("ArrowDown")-r("ArrowUp"))*1.2*e};this.yaw=this.pitch=0;for(let o of this.fingers.values())!o.moves||!o.far||(i.right+=(o.x-o.startX)/60,i.ahead-=(o.y-o.startY)/60);this.gamepad(i,e);let n=o=>Math.min(Math.max(o,-1),1);return i.right=n(i.right),i.ahead=n(i.ahead),i}};var I=(t,e)=>[t[0]+e[0],t[1]+e[1],t[2]+e[2]],T=(t,e)=>[t[0]-e[0],t[1]-e[1],t[2]-e[2]],L=(t,e)=>[t[0]*e,t[1]*e,t[2]*e],D=(t,e)=>t[0]*e[0]+t[1]*e[1]+t[2]*e[2],O=(t,e)=>[t[1]*e[2]-t[2]*e[1],t[2]*e[0]-t[0]*e[2],t[0]*e[1]-t[1]*e[0]],j=t=>Math.hypot(t[0],t[1],t[2]),$=(t,e)=>{let r=j(t);return r>0&&Number.isFinite(r)?L(t,1/r):e};function Ut(){let t=new Float64Array(16);return t[0]=t[5]=t[10]=t[15]=1,t}function Q(t,e){let r=new Float64Array(16);for(let i=0;i<4;++i)for(let n=0;n<4;++n){let o=0;for(let a=0;a<4;++a)o+=t[4*a+n]*e[4*i+a];r[4*i+n]=o}return r}function ce(t,e){let r=[0,0,0,0];for(let i=0;i<4;++i)r[i]=t[i]*e[0]+t[4+i]*e[1]+t[8+i]*e[2]+t[12+i]*e[3];return r}var ee=(t,e)=>ce(t,[e[0],e[1],e[2],1]).slice(0,3);function It(t){let e=new Float64Array(16);for(let r=0;r<3;++r)for(let i=0;i<3;++i)e[4*i+r]=t[4*r+i];for(let r=0;r<3;++r)e[12+r]=-(t[4*r]*t[12]+t[4*r+1]*t[13]+t[4*r+2]*t[14]);return e[15]=1,e}function Ge(t,e){let r=Array.from({length:4},(i,n)=>[...Array.from({length:4},(o,a)=>t[4*n+a]),e[n]]);for(let i=0;i<4;++i){let n=i;for(let o=i+1;o<4;++o)Math.abs(r[o][i])>Math.abs(r[n][i])&&(n=o);[r[i],r[n]]=[r[n],r[i]];for(let o=0;o<4;++o){if(o===i)continue;let a=r[o][i]/r[i][i];for(let s=i;s<5;++s)r[o][s]-=a*r[i][s]}}return r.map((i,n)=>i[4]/i[n])}var he=()=>({lower:[1/0,1/0,1/0],upper:[-1/0,-1/0,-1/0]});function ne(t,e,r,i){t.lower[0]=Math.min(t.lower[0],e),t.lower[1]=Math.min(t.lower[1],r),t.lower[2]=Math.min(t.lower[2],i),t.upper[0]=Math.max(t.upper[0],e),t.upper[1]=Math.max(t.upper[1],r),t.upper[2]=Math.max(t.upper[2],i)}var ae=t=>L(I(t.lower,t.upper),.5),_e=t=>.5*j(T(t.upper,t.lower));function te(t,e){for(let r=0;r<6;++r){let i=r>>1,n=r&1?-1:1,o=t[15]+n*t[12+i];for(let a=0;a<3;++a){let s=t[4*a+3]+n*t[4*a+i];o+=s*(s>0?e.upper[a]:e.lower[a])}if(o<0)return!1}return!0}var Ot=`float luminance(vec3 rgb){return dot(rgb,vec3(0.2126,0.7152,0.0722));}
vec3 srgb_from_linear(vec3 linear){
vec3 low=12.92*linear;
vec3 high=1.055*pow(max(linear,vec3(0.0031308)),vec3(1.0 / 2.4))- 0.055;
return mix(high,low,vec3(lessThanEqual(linear,vec3(0.0031308))));
}
vec3 linear_from_srgb(vec3 shown){
vec3 low=shown / 12.92;
vec3 high=pow((max(shown,vec3(0.04045))+ 0.055)/ 1.055,vec3(2.4));
return mix(high,low,vec3(lessThanEqual(shown,vec3(0.04045))));
}
`;var $t=`#ifdef NO_DISTANCE
const int u_alpha_kind=0;
#else
uniform int u_alpha_kind;
#endif
uniform vec4 u_depth_row;
uniform float u_closest;
float inverse_distance(vec3 eye,vec3 point){
float away=u_alpha_kind==1 ? distance(eye,point): dot(u_depth_row,vec4(point,1.0));
return clamp(1.0 / max(away,1e-18),u_closest,1e18);
}
`;var Nt=`vec4 farther_average(vec4 light[4],vec4 weight,float reach){
float farthest=1e30;
for(int i=0;i < 4;++i){
if(light[i].a > 0.0 && weight[i] > 0.0)farthest=min(farthest,light[i].a);
}
vec4 sum=vec4(0.0);
float total=0.0;
for(int i=0;i < 4;++i){
if(light[i].a <=0.0 || light[i].a > reach*farthest)continue;
sum +=weight[i]*light[i];
total +=weight[i];
}
return total > 0.0 ? sum / total : vec4(0.0);
}
`;var Wt=`vec4 fullscreen_position(int vertex){
vec2 corner=vec2(float((vertex & 1)<< 2)- 1.0,float((vertex & 2)<< 1)- 1.0);
return vec4(corner,0.0,1.0);
}
`;var Ht=`vec2 kernel_row(float cos_theta,int rows){
float at=sqrt(clamp(cos_theta,0.0,1.0))*float(rows - 1);
float row=min(floor(at),float(max(rows - 2,0)));
return vec2(row,at - row);
}
vec4 kernel_tap(sampler2D taps,int tap,vec2 row){
vec4 below=texelFetch(taps,ivec2(tap,int(row.x)),0);
return row.y > 0.0 ? mix(below,texelFetch(taps,ivec2(tap,int(row.x)+ 1),0),row.y): below;
}
vec3 lobe_direction(vec3 mirror,vec3 across,vec3 along,vec2 u){
float q=0.25*dot(u,u);
return((1.0 - q)*mirror + u.x*across + u.y*along)/(1.0 + q);
}
`;var qt=`vec2 lightmap_uv(vec3 v){
return v.xy / v.z;
}
struct DetailBlock{
vec2 first;
float side;
};
DetailBlock detail_block(uint code){
return DetailBlock(vec2(code & 0x3fffu,code >> 14u & 0x3fffu),float(1u <<(code >> 28u)));
}
`;var Xt=`vec4 turned_lobe(vec4 m,float cosine,float sine){
return vec4(m.x*cosine + m.y*sine,m.y*cosine - m.x*sine,m.z,m.w*cosine + sine)/(cosine - m.w*sine);
}
vec4 mix_lobes(vec4 a,vec4 b,float share){
vec4 m=mix(a,b,share);
m.z=a.z*b.z /(b.z +(a.z - b.z)*share);
return m;
}
vec4 lobe_in_surface_frame(vec4 m,float cos_theta){
return turned_lobe(m,cos_theta,-sqrt(max(0.0,1.0 - cos_theta*cos_theta)));
}
float angle_over_sine(float c){
float high=-0.648626993 + c*(0.509054596 + c*(-0.323932017 + c*(0.135951283 - c*0.0266371514)));
return 1.57079558 + c*(-0.999903565 + c*(0.78329788 + c*high));
}
vec3 edge_vector(vec3 a,vec3 b){
vec3 normal=cross(a,b);
float sine2=dot(normal,normal),cosine=dot(a,b);
float inverse=inversesqrt(max(sine2 + cosine*cosine,1e-37));
float acute=inverse*angle_over_sine(min(abs(cosine)*inverse,1.0));
return normal*(cosine < 0.0 ? 3.14159265359*inversesqrt(max(sine2,1e-37))- acute : acute);
}
vec3 reflected_vector(vec4 inverse,vec3 v[4]){
vec3 w[4];
for(int i=0;i < 4;++i)
w[i]=vec3(inverse.x*v[i].x + inverse.y*v[i].z,inverse.z*v[i].y,inverse.w*v[i].x + v[i].z);
vec3 leaves=vec3(0.0),enters=vec3(0.0),sum=vec3(0.0);
for(int i=0;i < 4;++i){
vec3 a=w[i],b=w[i==3 ? 0 : i + 1];
bool a_above=a.z >=0.0,b_above=b.z >=0.0;
vec3 crossing=vec3(a.xy +(b.xy - a.xy)*(a_above==b_above ? 0.0 : a.z /(a.z - b.z)),0.0);
if(a_above && !b_above)leaves=crossing;
if(!a_above && b_above)enters=crossing;
vec3 part=edge_vector(a_above ? a : crossing,b_above ? b : crossing);
sum +=a_above || b_above ? part : vec3(0.0);
}
return -0.15915494309*(sum + edge_vector(leaves,enters));
}
float reflected_polygon(vec4 inverse,vec3 v[4]){return reflected_vector(inverse,v).z;}
vec3 from_lobe(vec4 inverse,vec3 w){
float determinant=inverse.x - inverse.y*inverse.w;
return vec3((w.x - inverse.y*w.z)/ determinant,w.y / inverse.z,(inverse.x*w.z - inverse.w*w.x)/ determinant);
}
float polygon_share(vec3 v[4],vec3 direction,float angle){
vec3 normal=cross(v[1] - v[0],v[2] - v[0]);
float facing=dot(normal,v[0]);
if(facing*dot(normal,direction)<=0.0)return 0.0;
float inside[4];
for(int i=0;i < 4;++i){
vec3 edge=cross(v[i],v[i==3 ? 0 : i + 1]);
float size=length(edge),side=dot(edge,direction)*(facing < 0.0 ? -1.0 : 1.0);
inside[i]=size > 0.0 ? clamp(side / max(size*angle,1e-30),-0.5,0.5): 0.5;
}
float share=max(inside[0] + inside[2],0.0)*max(inside[1] + inside[3],0.0);
if(v[3]==v[2] && angle > 0.0){
float way=length(v[0] + v[1] + v[2])/ 3.0;
share=min(share,0.5*abs(facing)/(way*way*way*angle*angle));
}
return facing > 0.0 ? -share : share;
}
`;var jt=`#include "lib/octahedral.glsl"
struct LitSurface{
vec3 position;
vec3 normal;
int id;
};
const int kNoSurface=1023;
uvec4 pack_surface(vec3 position,vec3 normal,int id){
uvec2 n=uvec2((0.5 + 0.5*octahedral_from_direction(normal))*2047.0 + 0.5);
return uvec4(floatBitsToUint(position),n.x | n.y << 11 | uint(id)<< 22);
}
LitSurface unpack_surface(uvec4 texel){
int id=int(texel.w >> 22);
vec2 p=vec2(texel.w & 2047u,texel.w >> 11 & 2047u)/ 1023.5 - 1.0;
vec3 n=vec3(p,1.0 - abs(p.x)- abs(p.y));
if(n.z < 0.0)n.xy=(1.0 - abs(p.yx))*vec2(p.x < 0.0 ? -1.0 : 1.0,p.y < 0.0 ? -1.0 : 1.0);
return LitSurface(uintBitsToFloat(texel.xyz),normalize(n),id==kNoSurface ? -1 : id);
}
`;var Kt=`vec3 mirrored(vec3 tilted,vec3 view,out vec3 normal,out float cos_theta){
float length2=dot(tilted,tilted);
normal=length2 > 0.0 ? tilted*inversesqrt(length2): vec3(0.0,0.0,1.0);
cos_theta=-dot(normal,view);
if(cos_theta < 0.0){
normal=normalize(normal +(cos_theta - 1e-4)*view);
cos_theta=0.0;
}
return normalize(reflect(view,normal));
}
float spread_of(vec3 mirror){return min(0.5*(length(dFdx(mirror))+ length(dFdy(mirror))),2.0);}
`;var Yt=`vec4 tangent_of_steps(vec3 n,vec3 step_a,vec3 step_b,vec2 uv_a,vec2 uv_b){
float turn=sign(uv_a.x*uv_b.y - uv_a.y*uv_b.x);
vec3 along_u=turn*(uv_b.y*step_a - uv_a.y*step_b);
vec3 along_v=turn*(uv_a.x*step_b - uv_b.x*step_a);
return vec4(along_u,dot(cross(n,along_u),along_v)> 0.0 ? -1.0 : 1.0);
}
vec3 tilted_normal(vec3 n,vec4 tangent,vec3 texel,float scale){
vec3 size=abs(tangent.xyz);
vec3 unit=tangent.xyz / max(max(size.x,max(size.y,size.z)),1e-30);
vec3 across=unit - dot(n,unit)*n;
float across_length=length(across);
if(!(across_length > 1e-6))return n;
vec3 t=across / across_length;
vec3 b=tangent.w*cross(n,t);
vec3 local=2.0*texel - 1.0;
vec3 tilted=scale*(local.x*t + local.y*b)+ max(local.z,0.0)*n;
float size2=dot(tilted,tilted);
return size2 > 1e-12 ? tilted / sqrt(size2): n;
}
float light_on(vec3 normal,vec3 g,float lamp,vec3 towards){
vec3 mirrored=normal - 2.0*dot(normal,g)*g;
return 1.0 - lamp + 2.0*(max(dot(towards,normal),0.0)+ max(dot(towards,mirrored),0.0));
}
float directional_ratio(vec3 d,vec3 n,vec3 g){
vec3 off=d - 0.5*g;
float h=0.5 - dot(d,g);
float lamp=clamp((sqrt(h*h + 3.0*dot(off,off))- h)/ 1.5,0.0,1.0);
vec3 towards=off + 0.5*lamp*g;
float untilted=light_on(g,g,lamp,towards);
return max(1.0 +(light_on(n,g,lamp,towards)- untilted)/ max(untilted,0.1),0.0);
}
`;var Qt=`vec2 octahedral_from_direction(vec3 d){
vec2 p=d.xy /(abs(d.x)+ abs(d.y)+ abs(d.z));
if(d.z >=0.0)return p;
return(1.0 - abs(p.yx))*vec2(p.x < 0.0 ? -1.0 : 1.0,p.y < 0.0 ? -1.0 : 1.0);
}
float octahedral_density(vec3 d,int size){return 0.5*float(size)*pow(abs(d.x)+ abs(d.y)+ abs(d.z),-1.5);}
vec2 pyramid_uv(vec2 p,int size,int level,vec2 image_size){
vec2 corner=level==0 ? vec2(0.0): vec2(float(size + 2),float(size -(size >>(level - 1))+ 2*(level - 1)));
return(corner + 1.0 +(0.5*p + 0.5)*float(size >> level))/ image_size;
}
vec3 pyramid_light(sampler2D light,int size,vec3 direction,float level){
vec2 p=octahedral_from_direction(direction),image_size=vec2(textureSize(light,0));
float at=clamp(level,0.0,log2(float(size)));
int low=int(at);
vec3 fine=textureLod(light,pyramid_uv(p,size,low,image_size),0.0).rgb;
if(at <=float(low))return fine;
return mix(fine,textureLod(light,pyramid_uv(p,size,low + 1,image_size),0.0).rgb,at - float(low));
}
`;var Zt=`vec3 reflectance_from_table(sampler2D tables,int row,int count,float cos_theta){
float at=sqrt(clamp(cos_theta,0.0,1.0))*float(count - 1);
int low=min(int(at),max(count - 2,0));
vec3 a=texelFetch(tables,ivec2(low,row),0).rgb;
vec3 b=texelFetch(tables,ivec2(min(low + 1,count - 1),row),0).rgb;
return mix(a,b,at - float(low));
}
`;var Jt=`const float kPi=3.14159265358979323846;
float max_channel(vec3 v){return max(v.r,max(v.g,v.b));}
vec3 diffuse_light(vec3 kd,vec3 reflectance,vec3 irradiance){
return kd*(1.0 - max_channel(reflectance))*irradiance / kPi;
}
vec3 ambient_reflection(vec3 reflectance,vec3 irradiance){return reflectance*irradiance / kPi;}
float view_cosine(vec3 tilted,vec3 normal,vec3 position,vec4 eye){
vec3 to_eye=eye.xyz - position*eye.w;
float length2=dot(tilted,tilted)*dot(to_eye,to_eye);
float side=dot(normal,to_eye)< 0.0 ? -1.0 : 1.0;
return length2 > 0.0 ? clamp(side*dot(tilted,to_eye)*inversesqrt(length2),0.0,1.0): 1.0;
}
`;var er=`#include "lib/octahedral.glsl"
const int kSurroundSteps=24;
const int kSurroundHalvings=4;
const float kSurroundThickness=0.5;
const float kSurroundBeside=4.0;
vec2 surround_distance(sampler2D inverse_distance,int size,vec3 direction){
vec2 uv=pyramid_uv(octahedral_from_direction(direction),size,0,vec2(textureSize(inverse_distance,0)));
ivec2 texel=ivec2(uv*vec2(textureSize(inverse_distance,0)));
return vec2(textureLod(inverse_distance,uv,0.0).r,texelFetch(inverse_distance,texel,0).r);
}
vec4 arc_point(vec3 side,vec3 direction,float h,float along,float angle){
return vec4(cos(angle)*direction + sin(angle)*side,1.0 / max(h*cos(angle)/ sin(angle)- along,1e-6*h));
}
vec4 march_surroundings(sampler2D inverse_distance,int size,vec2 range,vec3 origin,vec3 direction){
float along=dot(origin,direction);
vec3 nearest=origin - along*direction;
float h=length(nearest),from_centre=length(origin);
vec4 beside=vec4(0.0);
if(h > 1e-5*from_centre){
vec3 side=nearest / h;
float begin=atan(h,along);
if(from_centre*range.x < 1.0)begin=min(begin,asin(min(h*range.x,1.0)));
float end=asin(min(h*range.y,1.0));
int steps=clamp(int(ceil((begin - end)*0.5*float(size))),1,kSurroundSteps);
float before=begin;
vec3 way=cos(begin)*direction + sin(begin)*side;
bool in_front=surround_distance(inverse_distance,size,way).x*h <=sin(begin)*(1.0 + kSurroundThickness);
for(int i=1;i <=steps && begin > end;++i){
float at=mix(begin,end,float(i)/ float(steps));
way=cos(at)*direction + sin(at)*side;
bool behind=surround_distance(inverse_distance,size,way).x*h >=sin(at);
if(in_front && behind){
float low=before,high=at;
for(int k=0;k < kSurroundHalvings;++k){
float middle=0.5*(low + high);
way=cos(middle)*direction + sin(middle)*side;
if(surround_distance(inverse_distance,size,way).x*h >=sin(middle))high=middle;
else low=middle;
}
vec3 at_low=cos(low)*direction + sin(low)*side,at_high=cos(high)*direction + sin(high)*side;
float over=sin(low)- surround_distance(inverse_distance,size,at_low).x*h;
float under=surround_distance(inverse_distance,size,at_high).x*h - sin(high);
float hit=over + under > 0.0 ? mix(low,high,clamp(over /(over + under),0.0,1.0)): high;
vec4 met=arc_point(side,direction,h,along,hit);
float surface=surround_distance(inverse_distance,size,met.xyz).y*h;
if(abs(surface - sin(hit))<=kSurroundThickness*sin(hit))return met;
beside=arc_point(side,direction,h,along,min(low + kSurroundBeside / float(size),begin));
in_front=false;
}else if(!behind){
in_front=true;
}
before=at;
}
if(!in_front && beside.w > 0.0)return beside;
}
float w=surround_distance(inverse_distance,size,direction).y;
return vec4(direction,w > 0.0 ? 1.0 / max(1.0 / w - along,1e-3 / w): 0.0);
}
`;var tr=`vec3 taken_light(sampler2D change,usampler2D surfaces,vec2 at,vec3 p,vec3 n){
vec2 first=floor(at - 0.5),part=at - 0.5 - first;
ivec2 last=textureSize(change,0)- 1;
vec4 sum=vec4(0.0);
for(int i=0;i < 4;++i){
ivec2 step=ivec2(i & 1,i >> 1);
ivec2 texel=clamp(ivec2(first)+ step,ivec2(0),last);
vec2 near=mix(1.0 - part,part,vec2(step));
vec3 off=uintBitsToFloat(texelFetch(surfaces,texel,0).xyz)- p;
float out_of_plane=dot(off,n);
float same=max(1.0 - 8.0*out_of_plane*out_of_plane / max(dot(off,off),1e-20),1e-3);
sum +=near.x*near.y*same*vec4(texelFetch(change,texel,0).rgb,1.0);
}
return sum.rgb / max(sum.a,1e-20);
}
`;var rr=`const float kMostPlaces=8.0;
vec4 texture_along(sampler2D image,vec2 uv){
vec2 size=vec2(textureSize(image,0)),dx=dFdx(uv),dy=dFdy(uv);
float x=length(dx*size),y=length(dy*size);
vec2 longer=x > y ? dx : dy;
float most=max(x,y),places=floor(clamp(most / max(min(x,y),1e-6)+ 0.5,1.0,min(kMostPlaces,max(most,1.0))));
float level=log2(max(most / places,1e-6));
if(places < 1.5)return textureLod(image,uv,level);
vec4 sum=vec4(0.0);
for(float i=0.5;i < places;++i)sum +=textureLod(image,uv +(i / places - 0.5)*longer,level);
return sum / places;
}
`;var ir=`vec3 tonemap_none(vec3 light){return clamp(light,0.0,1.0);}
vec3 tonemap_aces(vec3 light){
vec3 x=clamp(light,0.0,1e4);
return clamp(x*(2.51*x + 0.03)/(x*(2.43*x + 0.59)+ 0.14),0.0,1.0);
}
float dither(vec2 pixel){
return fract(52.9829189*fract(dot(pixel,vec2(0.06711056,0.00583715))))- 0.5;
}
`;var nr=`const int kWeightsWidth=2048;
vec3 transferred_light(isampler2D weights,sampler2D table,int components,int vertex,int cluster,vec3 q){
vec4 red=texelFetch(table,ivec2(0,cluster),0);
vec4 green=texelFetch(table,ivec2(1,cluster),0);
vec4 blue=texelFetch(table,ivec2(2,cluster),0);
int first=vertex*((components + 3)/ 4);
for(int k=0;k < components;k +=4){
int at=first + k / 4;
vec4 w=vec4(texelFetch(weights,ivec2(at % kWeightsWidth,at / kWeightsWidth),0))/ 32767.0;
for(int i=0;i < 4;++i){
int texel=3*(k + i + 1);
if(k + i >=components)break;
red +=w[i]*texelFetch(table,ivec2(texel,cluster),0);
green +=w[i]*texelFetch(table,ivec2(texel + 1,cluster),0);
blue +=w[i]*texelFetch(table,ivec2(texel + 2,cluster),0);
}
}
vec4 at=vec4(1.0,q);
return vec3(dot(red,at),dot(green,at),dot(blue,at));
}
`;var or=`#include "passes/surface.glsl"
#include "lib/lit_surface.glsl"
uniform sampler2D u_change;
uniform usampler2D u_surfaces;
uniform bool u_changed;
in vec3 v_light;
vec3 bright_light(){
ivec2 at=ivec2(gl_FragCoord.xy),last=textureSize(u_change,0)- 1;
for(int i=0;i < 9;++i){
int k=(i + 4)% 9;
ivec2 texel=clamp(at + ivec2(k % 3,k / 3)- 1,ivec2(0),last);
if(int(texelFetch(u_surfaces,texel,0).w >> 22)!=kNoSurface)return texelFetch(u_change,texel,0).rgb;
}
return vec3(0.0);
}
vec3 irradiance_here(vec3 normal){
vec3 irradiance=kPi*max(v_light,0.0);
if(u_changed)irradiance +=bright_light();
return irradiance;
}
#include "passes/opaque.glsl"
`;var ar=`#include "lib/transfer.glsl"
layout(location=0)in vec3 a_position;
layout(location=1)in vec3 a_normal;
layout(location=2)in vec2 a_uv;
layout(location=4)in vec4 a_color;
layout(location=5)in vec2 a_normal_uv;
layout(location=6)in vec4 a_tangent;
layout(location=7)in float a_cluster;
uniform mat4 u_clip_from_pack;
uniform mat4 u_pack_from_object;
uniform vec3 u_box_center;
uniform vec3 u_box_scale;
uniform isampler2D u_codes;
uniform sampler2D u_table;
uniform int u_components;
invariant gl_Position;
out vec3 v_position;
out vec3 v_normal;
out vec2 v_uv;
out vec4 v_color;
out vec2 v_normal_uv;
out vec4 v_tangent;
out vec3 v_light;
void main(){
gl_Position=u_clip_from_pack*vec4(a_position,1.0);
v_position=(u_pack_from_object*vec4(a_position,1.0)).xyz;
v_normal=mat3(u_pack_from_object)*a_normal;
v_uv=a_uv;
v_color=a_color;
v_normal_uv=a_normal_uv;
v_tangent=vec4(mat3(u_pack_from_object)*a_tangent.xyz,a_tangent.w);
vec3 q=(a_position - u_box_center)*u_box_scale;
v_light=transferred_light(u_codes,u_table,u_components,gl_VertexID,int(a_cluster + 0.5),q);
}
`;var sr=`#include "passes/surface.glsl"
#include "passes/curved_lobe.glsl"
#include "lib/mirrored.glsl"
uniform bool u_modulate;
#ifdef SHADED
uniform sampler2D u_shaded;
uniform float u_id;
#endif
layout(location=0)out vec4 o_light;
#ifdef SHADED
vec3 shaded_light(vec3 mirror){
ivec2 at=ivec2(gl_FragCoord.xy),last=textureSize(u_shaded,0)- 1;
vec4 found=texelFetch(u_shaded,at,0);
float away=found.a==u_id ? 0.0 : 9.0;
for(int i=0;i < 9;++i){
ivec2 step=ivec2(i % 3,i / 3)- 1;
vec4 beside=texelFetch(u_shaded,clamp(at + step,ivec2(0),last),0);
float here=float(abs(step.x)+ abs(step.y));
if(beside.a !=u_id || here >=away)continue;
found=beside;
away=here;
}
if(away < 9.0)return found.rgb;
return pyramid_light(u_light,u_size,mirror,u_tap_count > 1 ? log2(float(u_size))- 2.0 : 0.0);
}
#endif
void main(){
vec3 tilted=tilted_by_map(),normal;
float cos_theta;
vec3 mirror=mirrored(tilted,normalize(v_position*u_eye.w - u_eye.xyz),normal,cos_theta);
#ifdef SHADED
vec3 light=shaded_light(mirror);
#else
vec3 light=curved_light(v_position,normal,mirror,cos_theta,spread_of(mirror));
#endif
light*=u_light_scale;
o_light=vec4(u_modulate ? light*reflectance_of(tilted): light,1.0);
}
`;var lr=`#include "passes/surface_vertex.glsl"
`;var cr=`#include "lib/kernel.glsl"
#include "lib/surround.glsl"
uniform vec3 u_centre;
uniform int u_size;
uniform sampler2D u_light;
uniform vec3 u_light_scale;
uniform sampler2D u_inverse_distance;
uniform vec2 u_range;
uniform sampler2D u_taps;
uniform int u_tap_count;
uniform bool u_wide;
uniform int u_tap_rows;
vec3 light_along(vec3 origin,vec3 direction,float inverse_distance,float spread){
vec3 from_centre=direction + origin*inverse_distance;
float stretch=length(from_centre);
if(stretch < 1e-3)return vec3(0.0);
from_centre /=stretch;
float texels=spread / stretch*octahedral_density(from_centre,u_size);
return pyramid_light(u_light,u_size,from_centre,log2(max(texels,1.0)));
}
const int kTapSteps=2;
const float kTapSphere=1.5;
float tap_distance(vec3 origin,vec3 direction){
float along=dot(origin,direction),apart=dot(origin,origin)- along*along;
float least=kTapSphere*length(origin);
vec3 way=direction;
float inverse=0.0;
for(int i=0;i <=kTapSteps;++i){
float seen=surround_distance(u_inverse_distance,u_size,way).x;
if(!(seen > 0.0))return 0.0;
float radius=max(1.0 / seen,least);
inverse=1.0 /(sqrt(radius*radius - apart)- along);
way=normalize(direction + origin*inverse);
}
return inverse;
}
vec3 lobe_light(vec3 origin,vec3 normal,vec3 mirror,float cos_theta,float inverse_distance,float spread){
vec3 along=normal - dot(normal,mirror)*mirror;
vec3 side=cross(mirror,abs(mirror.y)< 0.9 ? vec3(0.0,1.0,0.0): vec3(1.0,0.0,0.0));
along=dot(along,along)> 1e-8 ? normalize(along): normalize(side);
vec3 across=cross(mirror,along);
vec2 row=kernel_row(cos_theta,u_tap_rows);
vec3 sum=vec3(0.0);
float total=0.0;
for(int i=0;i < u_tap_count;++i){
vec4 tap=kernel_tap(u_taps,i,row);
vec3 direction=lobe_direction(mirror,across,along,tap.xy);
if(dot(direction,normal)<=0.0)continue;
float inverse=u_wide ? tap_distance(origin,direction): inverse_distance;
sum +=tap.w*light_along(origin,direction,inverse,max(tap.z,spread));
total +=tap.w;
}
return total > 0.0 ? sum / total : light_along(origin,mirror,inverse_distance,spread);
}
vec3 curved_light(vec3 position,vec3 normal,vec3 mirror,float cos_theta,float spread){
vec3 origin=position - u_centre;
float inverse=u_wide ? 0.0 : march_surroundings(u_inverse_distance,u_size,u_range,origin,mirror).w;
return u_tap_count > 1 ? lobe_light(origin,normal,mirror,cos_theta,inverse,spread)
: light_along(origin,mirror,inverse,spread);
}
`;var ur=`#include "passes/surface.glsl"
#include "lib/mirrored.glsl"
layout(location=0)out vec4 o_place;
layout(location=1)out vec4 o_normal;
void main(){
vec3 tilted=tilted_by_map(),normal;
float cos_theta;
vec3 mirror=mirrored(tilted,normalize(v_position*u_eye.w - u_eye.xyz),normal,cos_theta);
o_place=vec4(v_position,spread_of(mirror));
o_normal=vec4(tilted,1.0);
}
`;var hr=`#include "passes/surface_vertex.glsl"
`;var fr=`uniform sampler2D u_base_texture;
uniform float u_alpha;
#ifdef PLAIN
const float u_alpha_cutoff=-1.0;
#else
uniform float u_alpha_cutoff;
#endif
in vec2 v_uv;
in float v_alpha;
void main(){
if(u_alpha_cutoff >=0.0 && texture(u_base_texture,v_uv).a*u_alpha*v_alpha < u_alpha_cutoff)discard;
}
`;var mr=`layout(location=0)in vec3 a_position;
layout(location=2)in vec2 a_uv;
layout(location=4)in vec4 a_color;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec2 v_uv;
out float v_alpha;
void main(){
gl_Position=u_clip_from_pack*vec4(a_position,1.0);
v_uv=a_uv;
v_alpha=a_color.a;
}
`;var dr=`#include "passes/surface.glsl"
#include "lib/lightmap_uv.glsl"
uniform sampler2D u_lightmap;
uniform float u_lightmap_scale;
uniform sampler2D u_direction;
uniform bool u_detailed;
uniform highp usampler2D u_cells;
uniform sampler2D u_detail;
#ifdef PLAIN
const bool u_directional=false;
#else
uniform bool u_directional;
#endif
centroid in vec3 v_lightmap_uv;
const float kFullyFine=1.5;
const float kFewPlaces=8.0;
vec3 finest_light(vec2 at){
vec2 size=vec2(textureSize(u_lightmap,0));
at=clamp(at,vec2(0.0),size - 1.0);
vec2 corner=min(floor(at),max(size - 2.0,vec2(0.0)));
DetailBlock block=detail_block(texelFetch(u_cells,ivec2(corner),0).r);
if(block.side < 1.5)return textureLod(u_lightmap,(at + 0.5)/ size,0.0).rgb;
vec2 place=(block.first +(at - corner)*block.side + 0.5)/ vec2(textureSize(u_detail,0));
return textureLod(u_detail,place,0.0).rgb;
}
vec3 lightmap_at(vec2 uv){
vec3 light=texture(u_lightmap,uv).rgb;
if(!u_detailed)return light;
vec2 size=vec2(textureSize(u_lightmap,0));
vec2 at=uv*size - 0.5;
vec2 dx=dFdx(at),dy=dFdy(at);
vec2 corner=min(floor(clamp(at,vec2(0.0),size - 1.0)),max(size - 2.0,vec2(0.0)));
float side=detail_block(texelFetch(u_cells,ivec2(corner),0).r).side;
if(side < 1.5)return light;
bool along_x=dot(dx,dx)> dot(dy,dy);
vec2 longer=along_x ? dx : dy,shorter=along_x ? dy : dx;
float length_of_longer=length(longer);
if(length_of_longer*side <=1.0)return finest_light(at);
bool row=length_of_longer > 2.0*length(shorter);
float apart=row ? max(0.25*length_of_longer,length(shorter)): 0.5*length_of_longer;
if(apart >=1.0)return light;
vec3 sum=vec3(0.0);
int around=side > kFewPlaces ? 4 : 1;
for(int k=0;k < 4;++k){
vec2 place=row ? vec2(0.25*float(k)- 0.375,0.0): vec2(0.5*float(k & 1)- 0.25,0.5*float(k >> 1)- 0.25);
for(int j=0;j < around;++j){
vec2 beside=around==1 ? vec2(0.0): 0.25*vec2(float(j & 1)- 0.5,float(j >> 1)- 0.5)*(row ? vec2(0.5,2.0): vec2(1.0));
sum +=finest_light(at +(place.x + beside.x)*longer +(place.y + beside.y)*shorter);
}
}
side=min(side,kFewPlaces);
float faded=log2(max(apart*side / kFullyFine,1.0))/ log2(side / kFullyFine);
return mix(sum / float(4*around),light,clamp(faded,0.0,1.0));
}
vec3 baked_light(){
vec2 uv=lightmap_uv(v_lightmap_uv);
return lightmap_at(uv)*u_lightmap_scale;
}
vec3 irradiance_on(vec3 tilted){
vec3 irradiance=baked_light();
if(!gl_FrontFacing)return vec3(0.0);
if(!u_normal_mapped || !u_directional)return irradiance;
return irradiance*directional_ratio(texture(u_direction,lightmap_uv(v_lightmap_uv)).xyz,tilted,front_normal());
}
`;var pr=`uniform sampler2D u_base_texture;
uniform vec4 u_base_color;
#ifdef PLAIN
const float u_alpha_cutoff=-1.0;
const bool u_unlit=false;
#else
uniform float u_alpha_cutoff;
uniform bool u_unlit;
#endif
#if defined(PLAIN) && !defined(REFLECTED)
#define NO_DISTANCE
#endif
#include "lib/distance_alpha.glsl"
uniform float u_diffuse_share;
uniform vec3 u_emission;
#ifndef PLAIN
uniform sampler2D u_emission_texture;
#endif
uniform vec3 u_weights;
in vec2 v_uv;
in vec4 v_color;
layout(location=0)out vec4 o_light;
float alpha_of_light(float kind){return u_alpha_kind==0 ? kind : inverse_distance(u_eye.xyz,v_position);}
void main(){
vec3 normal=tilted_by_map();
vec4 base=u_base_color*v_color*texture_along(u_base_texture,v_uv);
if(u_alpha_cutoff >=0.0 && u_base_color.a*v_color.a*texture(u_base_texture,v_uv).a < u_alpha_cutoff)discard;
if(u_unlit){
o_light=vec4(u_weights.z*u_emission*base.rgb,alpha_of_light(u_weights.z > 0.0 ? 2.0 : 1.0));
return;
}
vec3 reflectance=reflectance_of(normal);
vec3 irradiance=irradiance_here(normal);
vec3 light=u_weights.x*diffuse_light(base.rgb*u_diffuse_share,reflectance,irradiance);
light +=u_weights.y*ambient_reflection(reflectance,irradiance);
#ifdef PLAIN
light +=u_weights.z*u_emission;
#else
light +=u_weights.z*u_emission*texture_along(u_emission_texture,v_uv).rgb;
#endif
o_light=vec4(light,alpha_of_light(1.0));
}
`;var vr=`#include "passes/reflector_reflectance.glsl"
uniform sampler2D u_image;
uniform vec2 u_texture_size;
uniform vec2 u_image_size;
uniform vec2 u_origin;
uniform vec3 u_missing;
uniform bool u_with_distance;
layout(location=0)out vec4 o_light;
void main(){
vec2 at=clamp(gl_FragCoord.xy - u_origin,vec2(0.5),max(u_image_size - 0.5,vec2(0.5)));
vec4 image=textureLod(u_image,at / u_texture_size,0.0);
vec3 light=image.a > 0.0 ? image.rgb : u_missing;
o_light=vec4(light*reflector_reflectance(reflector_cosine()),u_with_distance ? image.a : 1.0);
}
`;var gr=`#include "passes/reflector_surface.glsl"
`;var _r=`#include "passes/reflector_reflectance.glsl"
#include "passes/screen_convolve.glsl"
uniform vec2 u_origin;
uniform sampler2D u_blurred;
uniform vec3 u_missing;
uniform bool u_with_distance;
layout(location=0)out vec4 o_light;
const float kLeastRadius=1.0;
void main(){
vec2 pixel=gl_FragCoord.xy - u_origin;
vec4 image;
if(u_coarse > 1 && lobe_radius(pixel)>=kLeastRadius*float(u_coarse)){
vec2 size=vec2(u_image_size)/ float(u_coarse);
vec2 at=clamp(pixel / float(u_coarse),vec2(0.5),max(size - 0.5,vec2(0.5)));
image=textureLod(u_blurred,at / u_texture_size,0.0);
}else{
image=convolved(pixel);
}
vec3 light=image.a > 0.0 ? image.rgb : u_missing;
o_light=vec4(light*reflector_reflectance(reflector_cosine()),u_with_distance ? image.a : 1.0);
}
`;var br=`#include "passes/reflector_surface.glsl"
`;var yr=`#include "lib/kernel.glsl"
#include "lib/lobe_light.glsl"
#include "passes/reflector_reflectance.glsl"
#include "passes/reflector_emitters.glsl"
uniform sampler2D u_lobes;
uniform int u_lobe_rows;
layout(location=0)out vec4 o_light;
const float kLeastCosine=1e-3;
vec3 s_eye;
float s_mean_factor;
vec2 fresnel_factors(float cosine){
vec2 at=kernel_row(cosine,u_lobe_rows);
vec2 low=texelFetch(u_lobes,ivec2(int(at.x),1),0).xy;
return mix(low,texelFetch(u_lobes,ivec2(min(int(at.x)+ 1,u_lobe_rows - 1),1),0).xy,at.y);
}
float share_of_polygon(vec4 lobe,vec3 corners[4]){
vec3 seen=reflected_vector(lobe,corners);
if(seen.z==0.0)return 0.0;
vec3 half_vector=normalize(from_lobe(lobe,seen.z < 0.0 ? -seen : seen))+ s_eye;
return seen.z*fresnel_factors(dot(s_eye,normalize(half_vector))).x / s_mean_factor;
}
void main(){
float cos_theta=reflector_cosine();
vec2 row=kernel_row(cos_theta,u_lobe_rows);
vec4 below=texelFetch(u_lobes,ivec2(int(row.x),0),0);
vec4 above=texelFetch(u_lobes,ivec2(min(int(row.x)+ 1,u_lobe_rows - 1),0),0);
s_eye=vec3(sqrt(max(0.0,1.0 - cos_theta*cos_theta)),0.0,cos_theta);
s_mean_factor=max(fresnel_factors(cos_theta).y,1e-6);
vec4 lobe=lobe_in_surface_frame(mix_lobes(below,above,row.y),max(cos_theta,kLeastCosine));
o_light=vec4(light_of_emitters(lobe)*reflector_reflectance(cos_theta),1.0);
}
`;var xr=`float share_of_polygon(vec4 lobe,vec3 corners[4]);
uniform sampler2D u_polygons;
uniform sampler2D u_visibility;
uniform usampler2D u_seen;
uniform ivec2 u_cells;
uniform vec2 u_lower;
uniform vec2 u_upper;
uniform mat4 u_emitters_from_pack;
float visible_share(int emitter,ivec2 cell,vec2 t){
vec4 nodes=texelFetch(u_visibility,cell + ivec2(0,emitter*u_cells.y),0);
vec2 sides=mix(nodes.xz,nodes.yw,t.x);
return mix(sides.x,sides.y,t.y);
}
vec3 light_of_polygon(int k,vec4 lobe,vec2 place,vec2 x,ivec2 cell,vec2 t){
vec4 a=texelFetch(u_polygons,ivec2(0,k),0),b=texelFetch(u_polygons,ivec2(1,k),0);
vec4 c=texelFetch(u_polygons,ivec2(2,k),0),light=texelFetch(u_polygons,ivec2(3,k),0);
vec3 corners[4]=vec3[4](a.xyz,vec3(a.w,b.xy),vec3(b.zw,c.x),c.yzw);
for(int i=0;i < 4;++i){
vec2 v=corners[i].xy - place;
corners[i].xy=vec2(dot(v,x),dot(v,vec2(-x.y,x.x)));
}
float share=share_of_polygon(lobe,corners);
float shown=light.a < 0.0 ? abs(share): max(share,0.0);
return visible_share(int(abs(light.a))- 1,cell,t)*shown*light.rgb;
}
vec3 light_of_emitters(vec4 lobe){
vec2 place=(u_emitters_from_pack*vec4(v_position,1.0)).xy;
vec2 to_eye=(mat3(u_emitters_from_pack)*(u_eye.xyz - v_position*u_eye.w)).xy;
vec2 x=dot(to_eye,to_eye)> 0.0 ? normalize(to_eye): vec2(1.0,0.0);
vec2 at=clamp((place - u_lower)/(u_upper - u_lower),0.0,1.0)*vec2(u_cells);
ivec2 cell=min(ivec2(at),u_cells - 1);
uvec4 words=texelFetch(u_seen,cell,0);
vec3 sum=vec3(0.0);
for(int word=0;word < 4;++word){
int k=32*word;
for(uint seen=words[word];seen !=0u;seen >>=1,++k)
if((seen & 1u)!=0u)sum +=light_of_polygon(k,lobe,place,x,cell,at - vec2(cell));
}
return sum;
}
`;var wr=`#include "lib/lobe_light.glsl"
#include "passes/reflector_reflectance.glsl"
#include "passes/reflector_emitters.glsl"
layout(location=0)out vec4 o_light;
float s_pixel;
float s_way;
float share_of_polygon(vec4 lobe,vec3 corners[4]){
vec3 seen[4];
for(int i=0;i < 4;++i)seen[i]=corners[i] + s_way*lobe.xyz;
return polygon_share(seen,lobe.xyz,s_pixel);
}
void main(){
vec3 way=normalize(v_position*u_eye.w - u_eye.xyz);
s_pixel=sqrt(length(cross(dFdx(way),dFdy(way))));
s_way=u_eye.w*length(mat3(u_emitters_from_pack)*(v_position - u_eye.xyz));
float cos_theta=reflector_cosine();
vec4 mirror=vec4(-sqrt(max(0.0,1.0 - cos_theta*cos_theta)),0.0,cos_theta,0.0);
o_light=vec4(light_of_emitters(mirror)*reflector_reflectance(cos_theta),1.0);
}
`;var kr=`#include "passes/reflector_surface.glsl"
`;var Mr=`#include "passes/reflector_surface.glsl"
`;var Fr=`void main(){}
`;var Tr=`layout(location=0)in vec3 a_position;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
void main(){gl_Position=u_clip_from_pack*vec4(a_position,1.0);}
`;var Er=`#include "lib/reflectance.glsl"
#include "lib/shading.glsl"
uniform vec4 u_eye;
uniform vec3 u_normal;
uniform sampler2D u_reflectance;
uniform int u_reflectance_row;
uniform int u_reflectance_count;
uniform bool u_modulate;
in vec3 v_position;
float reflector_cosine(){return view_cosine(u_normal,u_normal,v_position,u_eye);}
vec3 reflector_reflectance(float cos_theta){
if(!u_modulate)return vec3(1.0);
if(u_reflectance_row < 0)return vec3(0.0);
return reflectance_from_table(u_reflectance,u_reflectance_row,u_reflectance_count,cos_theta);
}
`;var Rr=`layout(location=0)in vec3 a_position;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;
void main(){
gl_Position=u_clip_from_pack*vec4(a_position,1.0);
v_position=a_position;
}
`;var Ar=`#include "passes/lightmap.glsl"
#include "lib/taken_light.glsl"
uniform sampler2D u_change;
uniform usampler2D u_surfaces;
#ifdef PLAIN
const vec2 u_change_scale=vec2(0.0);
#else
uniform vec2 u_change_scale;
#endif
vec3 irradiance_here(vec3 normal){
vec3 irradiance=irradiance_on(normal);
if(u_change_scale.x > 0.0){
vec2 at=gl_FragCoord.xy*u_change_scale;
irradiance=max(irradiance - taken_light(u_change,u_surfaces,at,v_position,front_normal()),0.0);
}
return irradiance;
}
#include "passes/opaque.glsl"
`;var Sr=`#include "passes/surface_vertex.glsl"
`;var Lr=`uniform vec4 u_ndc_from_image;
uniform vec2 u_tangents;
uniform float u_ortho;
uniform vec3 u_plane_normal;
uniform float u_plane_offset;
uniform float u_farthest;
uniform float u_median;
uniform float u_pixels_per_tangent;
uniform int u_coarse;
struct PlaneHit{
vec3 view;
vec3 at;
float cos_theta;
float distance;
bool valid;
};
PlaneHit plane_hit(vec2 pixel){
vec2 ndc=pixel*u_ndc_from_image.xy + u_ndc_from_image.zw;
vec3 origin=vec3(ndc*u_tangents,0.0)*u_ortho;
vec3 view=normalize(vec3(ndc*u_tangents*(1.0 - u_ortho),-1.0));
float cos_theta=-dot(u_plane_normal,view);
float distance=(u_plane_offset - dot(u_plane_normal,origin))/ -max(cos_theta,1e-6);
return PlaneHit(view,origin + distance*view,cos_theta,distance,cos_theta >=1e-4 && distance > 0.0);
}
float behind_plane(float inverse,float to_plane){
return max(1.0 / max(inverse,1.0 / u_farthest)- to_plane,0.0);
}
float pixels_at(float behind,float to_plane){
return u_pixels_per_tangent*(u_ortho > 0.5 ? behind : behind /(behind + to_plane));
}
`;var Pr=`#include "lib/kernel.glsl"
#include "passes/screen_blur_width.glsl"
uniform sampler2D u_image;
uniform ivec2 u_image_size;
uniform vec2 u_texture_size;
uniform sampler2D u_taps;
uniform int u_tap_count;
uniform int u_tap_rows;
vec4 image_at(vec2 pixel,float level){
float margin=0.5*exp2(ceil(level));
vec2 size=vec2(u_image_size);
vec2 at=clamp(pixel,min(vec2(margin),0.5*size),max(size - margin,0.5*size));
return textureLod(u_image,at / u_texture_size,level);
}
float distance_behind(vec2 pixel,float to_plane){
float level=log2(max(0.25*u_median*u_pixels_per_tangent / float(u_coarse),1.0));
return behind_plane(image_at(pixel,level).a,to_plane);
}
float lobe_radius(vec2 pixel){
PlaneHit hit=plane_hit(pixel);
return hit.valid ? u_median*pixels_at(distance_behind(pixel,hit.distance),hit.distance): 0.0;
}
vec2 pixel_of(vec3 at){
vec2 ndc=at.xy /(u_ortho > 0.5 ? u_tangents : u_tangents*max(-at.z,1e-12));
return(ndc - u_ndc_from_image.zw)/ u_ndc_from_image.xy;
}
vec4 convolved(vec2 pixel){
vec4 centre=image_at(pixel,0.0);
PlaneHit from=plane_hit(pixel);
if(!from.valid || centre.a <=0.0)return centre;
float behind=distance_behind(pixel,from.distance);
vec3 along=-u_plane_normal - from.cos_theta*from.view;
vec3 side=cross(from.view,abs(from.view.y)< 0.9 ? vec3(0.0,1.0,0.0): vec3(1.0,0.0,0.0));
along=dot(along,along)> 1e-8 ? normalize(along): normalize(side);
vec3 across=cross(from.view,along);
float to_pixels=pixels_at(behind,from.distance);
vec2 row=kernel_row(from.cos_theta,u_tap_rows);
vec3 sum=vec3(0.0);
float total=0.0;
for(int i=0;i < u_tap_count;++i){
vec4 tap=kernel_tap(u_taps,i,row);
vec3 direction=lobe_direction(from.view,across,along,tap.xy),at=from.at + behind*direction;
if(dot(direction,u_plane_normal)>=0.0 ||(u_ortho < 0.5 && at.z >=-1e-6*from.distance))continue;
sum +=tap.w*image_at(pixel_of(at),log2(max(tap.z*to_pixels,1.0))).rgb;
total +=tap.w;
}
return total > 0.0 ? vec4(sum / total,centre.a): centre;
}
`;var Gr=`#include "passes/screen_convolve.glsl"
layout(location=0)out vec4 o_light;
void main(){o_light=convolved(gl_FragCoord.xy*float(u_coarse));}
`;var zr=`#include "passes/curved_lobe.glsl"
#include "lib/mirrored.glsl"
uniform sampler2D u_places;
uniform sampler2D u_normals;
uniform vec4 u_eye;
uniform float u_id;
layout(location=0)out vec4 o_light;
void main(){
ivec2 at=ivec2(gl_FragCoord.xy);
vec4 place=texelFetch(u_places,at,0);
vec3 normal;
float cos_theta;
vec3 mirror=mirrored(texelFetch(u_normals,at,0).xyz,normalize(place.xyz*u_eye.w - u_eye.xyz),normal,cos_theta);
o_light=vec4(curved_light(place.xyz,normal,mirror,cos_theta,place.a),u_id);
}
`;var Vr=`#include "lib/fullscreen.glsl"
void main(){gl_Position=fullscreen_position(gl_VertexID);}
`;var Dr=`#include "lib/color.glsl"
uniform sampler2D u_frame;
uniform ivec2 u_frame_size;
uniform int u_block;
layout(location=0)out vec4 o_sum;
void main(){
ivec2 from=ivec2(gl_FragCoord.xy)*u_block;
ivec2 to=min(from + u_block,u_frame_size);
vec2 sum=vec2(0.0);
for(int y=from.y;y < to.y;++y){
for(int x=from.x;x < to.x;++x){
vec4 light=texelFetch(u_frame,ivec2(x,y),0);
float value=luminance(light.rgb);
if(light.a > 1.5 || !(value > 0.0))continue;
sum +=vec2(log2(max(value,1e-6)),1.0);
}
}
o_sum=vec4(sum,0.0,0.0);
}
`;var Br=`#include "lib/fill.glsl"
uniform sampler2D u_source;
uniform ivec2 u_source_size;
uniform float u_reach;
layout(location=0)out vec4 o_light;
void main(){
ivec2 at=2*ivec2(gl_FragCoord.xy);
vec4 light[4];
for(int i=0;i < 4;++i){
ivec2 from=at + ivec2(i & 1,i >> 1);
light[i]=all(lessThan(from,u_source_size))? texelFetch(u_source,from,0): vec4(0.0);
}
o_light=farther_average(light,vec4(1.0),u_reach);
}
`;var Cr=`#include "lib/normal_map.glsl"
#include "lib/reflectance.glsl"
#include "lib/shading.glsl"
#include "lib/texture_along.glsl"
uniform vec4 u_eye;
uniform sampler2D u_normal_texture;
uniform float u_normal_scale;
#ifdef REFLECTED
#define PLAIN
#endif
#ifdef PLAIN
const bool u_normal_mapped=false;
#else
uniform bool u_normal_mapped;
#endif
uniform sampler2D u_reflectance;
uniform int u_reflectance_row;
uniform int u_reflectance_count;
in vec3 v_position;
in vec3 v_normal;
in vec2 v_normal_uv;
in vec4 v_tangent;
vec3 front_normal(){
float length2=dot(v_normal,v_normal);
return length2 > 0.0 ? v_normal*inversesqrt(length2): vec3(0.0,0.0,1.0);
}
vec3 tilted_by_map(){
if(!u_normal_mapped)return v_normal;
vec3 n=front_normal();
vec4 tangent=tangent_of_steps(n,dFdx(v_position),dFdy(v_position),dFdx(v_normal_uv),dFdy(v_normal_uv));
if(abs(v_tangent.w)>=0.5)tangent=vec4(v_tangent.xyz,sign(v_tangent.w));
return tilted_normal(n,tangent,texture_along(u_normal_texture,v_normal_uv).rgb,u_normal_scale);
}
vec3 reflectance_of(vec3 tilted){
if(u_reflectance_row < 0)return vec3(0.0);
float cos_theta=view_cosine(tilted,v_normal,v_position,u_eye);
return reflectance_from_table(u_reflectance,u_reflectance_row,u_reflectance_count,cos_theta);
}
`;var Ur=`layout(location=0)in vec3 a_position;
layout(location=1)in vec3 a_normal;
layout(location=2)in vec2 a_uv;
layout(location=3)in vec2 a_lightmap_uv;
layout(location=4)in vec4 a_color;
layout(location=5)in vec2 a_normal_uv;
layout(location=6)in vec4 a_tangent;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;
out vec3 v_normal;
out vec2 v_uv;
centroid out vec3 v_lightmap_uv;
out vec4 v_color;
out vec2 v_normal_uv;
out vec4 v_tangent;
void main(){
gl_Position=u_clip_from_pack*vec4(a_position,1.0);
v_position=a_position;
v_normal=a_normal;
v_uv=a_uv;
v_lightmap_uv=vec3(a_lightmap_uv,1.0 + float(min(gl_VertexID,0)));
v_color=a_color;
v_normal_uv=a_normal_uv;
v_tangent=a_tangent;
}
`;var Ir=`#include "passes/lightmap.glsl"
uniform sampler2D u_base_texture;
uniform vec4 u_base_color;
uniform float u_alpha_cutoff;
uniform bool u_covers;
uniform float u_diffuse_share;
uniform float u_transmission;
uniform vec3 u_emission;
uniform sampler2D u_emission_texture;
uniform bool u_unlit;
uniform vec3 u_weights;
uniform bool u_dimming;
in vec2 v_uv;
in vec4 v_color;
layout(location=0)out vec4 o_light;
void main(){
vec3 normal=tilted_by_map();
vec4 base=u_base_color*v_color*texture_along(u_base_texture,v_uv);
float cut=u_base_color.a*v_color.a*texture(u_base_texture,v_uv).a;
if(u_alpha_cutoff >=0.0 &&(cut < u_alpha_cutoff)!=u_covers)discard;
float coverage=u_covers ? clamp(base.a,0.0,1.0): 1.0;
vec3 reflectance=u_unlit ? vec3(0.0): reflectance_of(normal);
if(u_dimming){
vec3 through=u_unlit ? vec3(0.0): base.rgb*u_transmission*(1.0 - max_channel(reflectance));
o_light=vec4(1.0 - coverage + coverage*through,1.0);
return;
}
vec3 irradiance=irradiance_on(normal);
vec3 light=u_weights.x*diffuse_light(base.rgb*u_diffuse_share,reflectance,irradiance);
light +=u_weights.y*ambient_reflection(reflectance,irradiance);
light +=u_weights.z*u_emission*texture_along(u_emission_texture,v_uv).rgb;
if(u_unlit)light=u_weights.z*u_emission*base.rgb;
o_light=vec4(coverage*light,coverage);
}
`;var Or=`#include "passes/surface_vertex.glsl"
`;var $r=`#include "lib/color.glsl"
#include "lib/tonemap.glsl"
uniform sampler2D u_frame;
uniform sampler2D u_before;
uniform float u_before_weight;
uniform float u_exposure;
uniform float u_unlit_exposure;
uniform bool u_encode;
uniform float u_count;
uniform float u_share;
uniform vec2 u_scale;
layout(location=0)out vec4 o_color;
void main(){
ivec2 at=ivec2(gl_FragCoord.xy*u_scale);
vec3 sum=u_before_weight > 0.0 ? texelFetch(u_before,at,0).rgb : vec3(0.0);
if(u_encode){
o_color=vec4(srgb_from_linear(sum / u_count)+ dither(gl_FragCoord.xy)/ 255.0,1.0);
return;
}
vec4 light=texelFetch(u_frame,at,0);
if(u_share > 0.0){
o_color=light*u_share;
return;
}
o_color=vec4(sum +(light.a > 1.5 ? tonemap_none(light.rgb*u_unlit_exposure): tonemap_aces(light.rgb*u_exposure)),1.0);
}
`;var ko={"lib/color.glsl":Ot,"lib/distance_alpha.glsl":$t,"lib/fill.glsl":Nt,"lib/fullscreen.glsl":Wt,"lib/kernel.glsl":Ht,"lib/lightmap_uv.glsl":qt,"lib/lobe_light.glsl":Xt,"lib/lit_surface.glsl":jt,"lib/mirrored.glsl":Kt,"lib/normal_map.glsl":Yt,"lib/octahedral.glsl":Qt,"lib/reflectance.glsl":Zt,"lib/shading.glsl":Jt,"lib/surround.glsl":er,"lib/taken_light.glsl":tr,"lib/texture_along.glsl":rr,"lib/tonemap.glsl":ir,"lib/transfer.glsl":nr,"passes/curved_light.frag":sr,"passes/curved_light.vert":lr,"passes/curved_lobe.glsl":cr,"passes/curved_surface.frag":ur,"passes/curved_surface.vert":hr,"passes/depth.frag":fr,"passes/depth.vert":mr,"passes/lightmap.glsl":dr,"passes/mover_light.frag":or,"passes/mover_light.vert":ar,"passes/opaque.glsl":pr,"passes/reflector_compose.frag":vr,"passes/reflector_compose.vert":gr,"passes/reflector_convolve.frag":_r,"passes/reflector_convolve.vert":br,"passes/reflector_emitters.frag":yr,"passes/reflector_emitters.glsl":xr,"passes/reflector_emitters_sharp.frag":wr,"passes/reflector_emitters_sharp.vert":kr,"passes/reflector_emitters.vert":Mr,"passes/reflector_mask.frag":Fr,"passes/reflector_mask.vert":Tr,"passes/reflector_reflectance.glsl":Er,"passes/reflector_surface.glsl":Rr,"passes/scene.frag":Ar,"passes/scene.vert":Sr,"passes/screen_blur_width.glsl":Lr,"passes/screen_convolve.glsl":Pr,"passes/screen_convolve.frag":Gr,"passes/screen_curved.frag":zr,"passes/screen_fullscreen.vert":Vr,"passes/screen_luminance.frag":Dr,"passes/screen_pull.frag":Br,"passes/surface.glsl":Cr,"passes/surface_vertex.glsl":Ur,"passes/transparent.frag":Ir,"passes/transparent.vert":Or,"passes/screen_average.frag":$r},Mo=["#version 300 es","precision highp float;","precision highp int;","precision highp sampler2D;","precision highp sampler2DArray;","precision highp isampler2D;","precision highp usampler2D;",""].join(`
`);function Nr(t,e=""){let r=new Set,i=n=>{if(r.has(n))return"";r.add(n);let o=ko[n];if(o===void 0)throw new Error(`found no shader ${n}`);return o.replace(/^#include "([^"]+)".*$/gm,(a,s)=>i(s))};return Mo+(e?`#define ${e}
`:"")+i(t)}var Wr={u_base_texture:0,u_lightmap:1,u_reflectance:2,u_direction:3,u_normal_texture:4,u_change:5,u_cells:6,u_detail:7,u_surfaces:8,u_image:9,u_frame:9,u_source:9,u_blurred:10,u_before:10,u_taps:11,u_emission_texture:11,u_polygons:12,u_visibility:13,u_seen:14,u_lobes:15,u_codes:6,u_table:7,u_light:9,u_inverse_distance:10,u_places:12,u_normals:13,u_shaded:15},P=class t{constructor(e,r,i){this.gl=e;this.name=r;this.define=i}at=new Map;program;linked=!1;static make(e,r,i=""){return new t(e,r,i)}start(){if(this.program)return;let{gl:e,name:r}=this,i=r.startsWith("screen_")?"screen_fullscreen":r;this.program=e.createProgram();for(let[n,o]of[[e.VERTEX_SHADER,`${i}.vert`],[e.FRAGMENT_SHADER,`${r}.frag`]]){let a=e.createShader(n);e.shaderSource(a,Nr(`passes/${o}`,this.define)),e.compileShader(a),e.attachShader(this.program,a)}e.linkProgram(this.program)}finish(){this.start(),this.linked=!0;let{gl:e}=this,r=this.program;if(!e.getProgramParameter(r,e.LINK_STATUS)&&!e.isContextLost()){let n=e.getAttachedShaders(r).map(o=>e.getShaderInfoLog(o)).join("");throw new Error(`shader ${this.name} ${this.define}: ${n}${e.getProgramInfoLog(r)}`)}e.useProgram(r);let i=e.getProgramParameter(r,e.ACTIVE_UNIFORMS);for(let n=0;n<i;++n){let o=e.getActiveUniform(r,n),a=e.getUniformLocation(r,o.name);this.at.set(o.name,{place:a,type:o.type});let s=Wr[o.name];[e.SAMPLER_2D,e.INT_SAMPLER_2D,e.UNSIGNED_INT_SAMPLER_2D].includes(o.type)&&s!==void 0&&e.uniform1i(a,s)}}use(){this.linked||this.finish(),this.gl.useProgram(this.program)}set(e,r){let i=this.at.get(e),n=this.gl;if(!i)return;let o=typeof r=="object"?Float32Array.from(r):void 0,a=Number(r);switch(i.type){case n.FLOAT:n.uniform1f(i.place,a);break;case n.INT:case n.BOOL:n.uniform1i(i.place,a);break;case n.INT_VEC2:n.uniform2i(i.place,o[0],o[1]);break;case n.FLOAT_VEC2:n.uniform2fv(i.place,o);break;case n.FLOAT_VEC3:n.uniform3fv(i.place,o);break;case n.FLOAT_VEC4:n.uniform4fv(i.place,o);break;case n.FLOAT_MAT4:n.uniformMatrix4fv(i.place,!1,o);break}}};function Fo(t,e){switch(e){case t.RGB16F:return[t.RGB,t.HALF_FLOAT];case t.RGBA16F:return[t.RGBA,t.HALF_FLOAT];case t.RGBA32F:return[t.RGBA,t.FLOAT];case t.RGB9_E5:return[t.RGB,t.UNSIGNED_INT_5_9_9_9_REV];case t.R32F:return[t.RED,t.FLOAT];case t.R32UI:return[t.RED_INTEGER,t.UNSIGNED_INT];case t.RGBA16I:return[t.RGBA_INTEGER,t.SHORT];case t.RGBA32UI:return[t.RGBA_INTEGER,t.UNSIGNED_INT];case t.DEPTH24_STENCIL8:return[t.DEPTH_STENCIL,t.UNSIGNED_INT_24_8];default:return[t.RGBA,t.UNSIGNED_BYTE]}}function F(t,e,r=null){let i=t.createTexture(),[n,o]=Fo(t,e.format);return t.activeTexture(t.TEXTURE0),t.bindTexture(t.TEXTURE_2D,i),t.pixelStorei(t.UNPACK_ALIGNMENT,1),t.texStorage2D(t.TEXTURE_2D,e.levels??1,e.format,e.width,e.height),r&&t.texSubImage2D(t.TEXTURE_2D,0,0,0,e.width,e.height,n,o,r),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,e.min??t.NEAREST),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MAG_FILTER,e.mag??t.NEAREST),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,e.wrapS??t.CLAMP_TO_EDGE),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,e.wrapT??t.CLAMP_TO_EDGE),i}function k(t,e,r){t.activeTexture(t.TEXTURE0+Wr[e]),t.bindTexture(t.TEXTURE_2D,r)}function re(t,e,r,i){let n=t.createFramebuffer();return t.bindFramebuffer(t.FRAMEBUFFER,n),t.framebufferTexture2D(t.FRAMEBUFFER,t.COLOR_ATTACHMENT0,t.TEXTURE_2D,e,0),i&&(t.framebufferTexture2D(t.FRAMEBUFFER,t.COLOR_ATTACHMENT1,t.TEXTURE_2D,i,0),t.drawBuffers([t.COLOR_ATTACHMENT0,t.COLOR_ATTACHMENT1])),r&&t.framebufferTexture2D(t.FRAMEBUFFER,t.DEPTH_STENCIL_ATTACHMENT,t.TEXTURE_2D,r,0),n}function A(t,e){let r=(n,o)=>{o?t.enable(n):t.disable(n)};r(t.DEPTH_TEST,!!e.depthTest),t.depthFunc(t.LEQUAL),t.depthMask(!!e.depthWrite);let i=e.color??!0;t.colorMask(i,i,i,i&&(e.alpha??!0)),r(t.CULL_FACE,!!e.cull),t.cullFace(t.BACK),t.frontFace(e.mirrored?t.CW:t.CCW),r(t.BLEND,!!e.blend),e.blend==="add"&&t.blendFuncSeparate(t.ONE,t.ONE,t.ONE,t.ZERO),e.blend==="multiply"&&t.blendFuncSeparate(t.ZERO,t.SRC_COLOR,t.ZERO,t.ONE),e.blend==="cover"&&t.blendFuncSeparate(t.ONE,t.ONE_MINUS_SRC_ALPHA,t.ZERO,t.ONE),r(t.STENCIL_TEST,e.stencilFunc!==void 0||!!e.stencilWrite),t.stencilFunc(e.stencilFunc??t.ALWAYS,e.stencilRef??0,e.stencilRead??255),t.stencilMask(e.stencilWrite??0),t.stencilOp(t.KEEP,t.KEEP,t.REPLACE)}function To(t,e,r,i){let n=Math.max(_e(t),1e-12),o=D(T(ae(t),e),r),a=o+n*1.01,s=o-n*1.01;return i?[s,Math.max(a,s+n*.001)]:(a=Math.max(a,n*.01),s=Math.max(s,Math.min(.02,n*.001),a*1e-5),[s,Math.max(a,s*1.001)])}function ze(t,e){let r=Math.max(e,t.near+.001*Math.max(Math.abs(t.near),1e-20)),i=r-t.near,[n,o]=t.tangents,a=new Float64Array(16),s=[t.centre[0]/n,t.centre[1]/o];return a[0]=1/n,a[5]=1/o,t.ortho?(a[12]=-s[0],a[13]=-s[1],a[10]=-2/i,a[14]=-(r+t.near)/i,a[15]=1):(a[10]=-(r+t.near)/i,a[14]=-2*r*t.near/i,a[11]=-1,a[8]=s[0],a[9]=s[1]),a}function ot(t){let e=$(t.forward,[0,0,-1]),r=$(t.up,[0,1,0]);j(O(e,r))<1e-5&&(r=Math.abs(e[1])<.9?[0,1,0]:[0,0,-1]);let i=$(O(e,r),[1,0,0]);return{right:i,up:O(i,e),forward:e}}function Hr(t,e,r,i,n=[0,0]){let{right:o,up:a,forward:s}=ot(t),l=t.fov===0,c=t.eye,u=new Float64Array([o[0],a[0],-s[0],0,o[1],a[1],-s[1],0,o[2],a[2],-s[2],0,-D(o,c),-D(a,c),D(s,c),1]),[h,f]=To(i,c,s,l),p=l?t.halfHeight>0?t.halfHeight:_e(i):Math.tan(.5*Math.min(Math.max(t.fov,.001),3.1)),m=[p*e/r,p],d={viewFromPack:u,clipFromView:u,clipFromPack:u,eye:l?[-s[0],-s[1],-s[2],0]:[...c,1],tangents:m,centre:[m[0]*2*n[0]/e,m[1]*2*n[1]/r],ortho:l,mirrored:!1,near:h,far:f,width:e,height:r};return d.clipFromView=ze(d,f),d.clipFromPack=Q(d.clipFromView,u),d}function qr(t,e,r,i){let n={...t,width:r,height:i};return n.tangents=[t.tangents[0]*r/t.width,t.tangents[1]*i/t.height],n.centre=[t.centre[0]+t.tangents[0]*((2*e[0]+r)/t.width-1),t.centre[1]+t.tangents[1]*((2*e[1]+i)/t.height-1)],n.clipFromView=ze(n,n.far),n.clipFromPack=Q(n.clipFromView,n.viewFromPack),n}function Xr(t,e){let r=Ge(t,e),i=r[0]*(r[0]<0?-1:1)+r[1]*(r[1]<0?-1:1)+r[2]+r[3];if(!(i>0))return t;let n=t.slice();for(let o=0;o<4;++o)n[4*o+2]=e[o]*2/i-t[4*o+3];return n}function Ve(t,e){let r=e.map(s=>ce(t,[s[0],s[1],s[2],1])),i=[[0,0,1,1],[1,0,0,1],[-1,0,0,1],[0,1,0,1],[0,-1,0,1]];for(let s of i){let l=c=>s[0]*c[0]+s[1]*c[1]+s[2]*c[2]+s[3]*c[3];r=r.flatMap((c,u)=>{let h=r[(u+1)%r.length],f=l(c),p=l(h),m=f>=0?[c]:[];return f>=0!=p>=0&&m.push(c.map((d,v)=>d+(h[v]-d)*f/(f-p))),m})}let n=r.filter(s=>s[3]>0).map(s=>[s[0]/s[3],s[1]/s[3]].map(l=>Math.min(Math.max(l,-1),1)));if(n.length===0)return;let o=n.map(s=>s[0]),a=n.map(s=>s[1]);return{lower:[Math.min(...o),Math.min(...a)],upper:[Math.max(...o),Math.max(...a)]}}var at=127,jr=128,Eo=.03,De=class{constructor(e,r){this.device=e;this.renderer=r}mask;surface;shade;light;shadedLight;made=!1;canvas;make(){let{gl:e}=this.device;this.made=!0,this.mask=P.make(e,"reflector_mask"),this.surface=P.make(e,"curved_surface"),this.shade=P.make(e,"screen_curved"),this.light=P.make(e,"curved_light"),this.shadedLight=P.make(e,"curved_light","SHADED")}draw(e,r,i){let n=[],o=[],a=[],{view:s}=r;if(i.largeOnly||e.surrounds.length===0)return{later:n,materials:o};this.made||this.make();for(let l of e.curved){if(l.count===0||!e.surrounds[l.map]||!te(s.clipFromPack,l.bounds))continue;let c=e.isTransparent(l.material);if(c?!r.inFrame:r.values+1>=at)continue;let u=c?jr:++r.values;c||o.push(l.material),c||!r.inFrame?(this.drawMask(e,r,l,u,c?jr:at),n.push(l)):a.push({curved:l,value:u})}return a.length>0&&this.drawShown(e,r,a,i),{later:n,materials:o}}add(e,r,i,n){for(let o of i)this.drawLight(e,r,o,this.light,{blend:"add",alpha:!1},n)}state(e,r){return{depthTest:!0,cull:!0,mirrored:e.view.mirrored,...r}}drawMask(e,r,i,n,o){A(this.device.gl,this.state(r,{color:!1,stencilRef:n,stencilWrite:o})),this.mask.use(),this.mask.set("u_clip_from_pack",r.view.clipFromPack),e.bindGeometry(),e.draw(i)}drawShown(e,r,i,n){let{gl:o,color:a}=this.device,s=a===o.RGBA32F;s&&this.shadeAll(e,r,i,n),r.begin();for(let{curved:l,value:c}of i){let u={stencilRef:c,stencilWrite:at};s&&(this.shadedLight.use(),this.shadedLight.set("u_id",c),k(o,"u_shaded",this.canvas.light)),this.drawLight(e,r,l,s?this.shadedLight:this.light,u,n)}}drawLight(e,r,i,n,o,a){A(this.device.gl,this.state(r,o)),n.use(),this.setLobe(n,e,r,i,a),this.setNormals(n,e,r,i),n.set("u_modulate",!0),e.setReflectance(n,i.material),e.bindGeometry(),e.draw(i)}ensure(e,r){let i=this.canvas,{gl:n}=this.device;if(i&&i.width>=e&&i.height>=r)return i;if(i){for(let f of[i.places,i.normals,i.depth,i.light])n.deleteTexture(f);for(let f of[i.surfaces,i.shaded])n.deleteFramebuffer(f)}let o=Math.max(e,i?.width??0),a=Math.max(r,i?.height??0),s=f=>F(n,{width:o,height:a,format:f}),l=s(n.RGBA32F),c=s(n.RGBA32F),u=s(n.DEPTH24_STENCIL8),h=s(n.RGBA16F);return this.canvas={width:o,height:a,places:l,normals:c,depth:u,light:h,surfaces:re(n,l,u,c),shaded:re(n,h,u)}}shadeAll(e,r,i,n){let{gl:o}=this.device,{view:a}=r,s=this.ensure(a.width,a.height);o.enable(o.SCISSOR_TEST);let l=(c,u)=>{o.bindFramebuffer(o.FRAMEBUFFER,c),o.viewport(0,0,a.width,a.height),o.scissor(0,0,a.width,a.height),A(o,{depthWrite:!0,stencilWrite:255}),o.clearColor(0,0,0,0),o.clear(u)};l(s.surfaces,o.DEPTH_BUFFER_BIT|o.STENCIL_BUFFER_BIT),this.surface.use();for(let{curved:c,value:u}of i)A(o,this.state(r,{depthWrite:!0,stencilRef:u,stencilWrite:255})),this.setNormals(this.surface,e,r,c),e.bindGeometry(),e.draw(c);l(s.shaded,o.COLOR_BUFFER_BIT),this.shade.use(),k(o,"u_places",s.places),k(o,"u_normals",s.normals);for(let{curved:c,value:u}of i)A(o,{stencilFunc:o.EQUAL,stencilRef:u}),this.setLobe(this.shade,e,r,c,n),this.shade.set("u_id",u),this.scissor(r,c),this.renderer.drawScreen();o.disable(o.SCISSOR_TEST)}scissor(e,r){let{lower:i,upper:n}=r.bounds,{view:o}=e,a={x0:1,y0:1,x1:-1,y1:-1};for(let u=0;u<6;++u){let h=u>>1,f=(h+1)%3,p=(h+2)%3,m=[0,1,2,3].map(v=>{let b=u%2===0?[...i]:[...n];return b[f]=v===1||v===2?n[f]:i[f],b[p]=v>=2?n[p]:i[p],b}),d=Ve(o.clipFromPack,m);d&&(a.x0=Math.min(a.x0,d.lower[0]),a.y0=Math.min(a.y0,d.lower[1]),a.x1=Math.max(a.x1,d.upper[0]),a.y1=Math.max(a.y1,d.upper[1]))}let s=(u,h,f)=>f((u*.5+.5)*h),l=s(a.x0,o.width,Math.floor),c=s(a.y0,o.height,Math.floor);this.device.gl.scissor(l,c,Math.max(0,s(a.x1,o.width,Math.ceil)-l),Math.max(0,s(a.y1,o.height,Math.ceil)-c))}setNormals(e,r,i,n){e.set("u_clip_from_pack",i.view.clipFromPack),e.set("u_eye",i.view.eye),r.setNormals(e,n.material)}setLobe(e,r,i,n,o){let{gl:a}=this.device,s=r.surrounds[n.map],l=r.kernel(n.material,o.taps);k(a,"u_light",s.light),k(a,"u_inverse_distance",s.inverseDistance),k(a,"u_taps",l.taps),e.set("u_eye",i.view.eye),e.set("u_centre",s.centre),e.set("u_size",s.size),e.set("u_light_scale",s.tint.map(c=>c*s.scale*r.unit)),e.set("u_range",s.range),e.set("u_tap_count",l.count),e.set("u_tap_rows",l.rows),e.set("u_wide",l.median>=Eo)}};var st=127,Kr=128,Ro=.01,Ao=.001,Yr=.5,Qr=1e-5,So=.02,lt=6,Lo=16/6,Zr=t=>.25*(t.upper[0]-t.lower[0])*(t.upper[1]-t.lower[1]),Be=class{constructor(e,r,i){this.device=e;this.renderer=r;this.none=i;let{gl:n}=e;this.mask=P.make(n,"reflector_mask"),this.compose=P.make(n,"reflector_compose"),this.convolve=P.make(n,"reflector_convolve"),this.emitters=P.make(n,"reflector_emitters"),this.glints=P.make(n,"reflector_emitters_sharp"),this.curved=new De(e,r),this.pull=P.make(n,"screen_pull"),this.blur=P.make(n,"screen_convolve")}mask;compose;convolve;emitters;glints;pull;blur;curved;images=[];get programs(){return[this.mask,this.compose,this.convolve,this.emitters,this.glints,this.pull,this.blur]}drawMasks(e,r,i){let n=[],{gl:o}=this.device,a=r.view;if(r.values=0,i.orders===0)return n;for(let s of e.reflectors){let l=ce(s.reflectorFromPack,a.eye);if(s.count===0||l[2]<=(a.ortho?Qr:Qr*s.size))continue;let c=Ve(a.clipFromPack,s.corners);if(!c||i.largeOnly&&r.share*Zr(c)<So)continue;let u=e.isTransparent(s.material),h=r.reflectance*e.reflectanceOf(s.material);if(!r.inFrame&&(u||h<Ro||h*r.share*Zr(c)<Ao)||r.mirrors>=i.orders&&(h<Yr||e.kernel(s.material,i.taps).count>1)||!u&&r.values+1>=st)continue;let f=u?0:++r.values;if(this.drawMask(e,s,a,f,r.inFrame),r.inFrame&&!s.visible){u||this.drawMask(e,s,a,0,!1,!0);continue}n.push({reflector:s,screen:c,value:f})}return o.disable(o.STENCIL_TEST),n}drawMask(e,r,i,n,o,a=!1){let{gl:s}=this.device;o&&r.asked&&s.getQueryParameter(r.query,s.QUERY_RESULT_AVAILABLE)&&(r.visible=s.getQueryParameter(r.query,s.QUERY_RESULT)>0,r.asked=!1);let l=n===0&&!a;A(s,{depthTest:!0,color:!1,cull:!0,mirrored:i.mirrored,stencilRef:l?Kr:n,stencilWrite:l?Kr:st}),this.mask.use(),this.mask.set("u_clip_from_pack",i.clipFromPack),e.bindGeometry();let c=o&&!r.asked;c&&s.beginQuery(s.ANY_SAMPLES_PASSED,r.query??=s.createQuery()),e.draw(r),c&&(s.endQuery(s.ANY_SAMPLES_PASSED),r.asked=!0)}chooseImage(e,r,i){let n=i.ortho?0:.5*r*.5*i.height/i.tangents[1],o=n>=Lo*lt?4:n>=lt?2:1,a=n>=lt?4:1,s=Math.max(i.width,i.height),l=Math.ceil(Math.min(Math.max(4*n,4),.15*s+4)),c=(m,d,v,b)=>a*b(((m*.5+.5)*d+v)/a),u=c(e.lower[0],i.width,-l,Math.floor),h=c(e.lower[1],i.height,-l,Math.floor),f=c(e.upper[0],i.width,l,Math.ceil),p=c(e.upper[1],i.height,l,Math.ceil);return{origin:[u,h],width:Math.max(f-u,1),height:Math.max(p-h,1),coarse:o}}image(e,r,i){let n=this.images[e];if(n&&n.width>=r&&n.height>=i)return n;let{gl:o,color:a,linear:s}=this.device,l=(d,v)=>2**Math.ceil(Math.log2(Math.max(d,v,16))),c=l(r,n?.width??0),u=l(i,n?.height??0);if(n){for(let d of[n.color,n.blurred,n.depth])o.deleteTexture(d);for(let d of[n.target,n.level])o.deleteFramebuffer(d)}let h=Math.log2(Math.max(c,u))+1,f=F(o,{width:c,height:u,levels:h,format:a,min:o.LINEAR_MIPMAP_NEAREST,mag:s}),p=F(o,{width:c,height:u,format:a,min:s,mag:s}),m=F(o,{width:c,height:u,format:o.DEPTH24_STENCIL8});return this.images[e]={width:c,height:u,color:f,blurred:p,depth:m,target:re(o,f,m),level:re(o,p)}}draw(e,r,i,n){let o=i.reflector,a=e.kernel(o.material,n.taps),s=a.count>1,l=this.chooseImage(i.screen,s?a.median:0,r.view),c=this.image(r.mirrors,l.width,l.height);this.drawMirrored(e,r,o,l,c,n),s&&this.makeLevels(l,c),s&&l.coarse>1&&this.drawBlurred(e,r.view,o,a,l,c),r.begin(),this.drawComposed(e,r,i,a,l,c),this.drawEmitters(e,r,i,a)}drawMirrored(e,r,i,n,o,a){let{gl:s,closest:l}=this.device,c=r.view,u=()=>{s.bindFramebuffer(s.FRAMEBUFFER,o.target),s.viewport(0,0,n.width,n.height)};u(),s.enable(s.SCISSOR_TEST),s.scissor(0,0,n.width,n.height),this.renderer.clear([...e.sky.map(d=>d*e.unit),l]),s.disable(s.SCISSOR_TEST);let h=this.mirroredView(e,i,c,n),f=e.opaque.filter(d=>te(h.clipFromPack,d.bounds)),p=i.dark.filter(d=>te(h.clipFromPack,d.bounds)),m={view:h,begin:u,inFrame:!1,mirrors:r.mirrors+1,texture:o.color,values:0,reflectance:r.reflectance*e.reflectanceOf(i.material),share:r.share*h.width*h.height/(c.width*c.height)};if(m.mirrors<a.mirrors){this.renderer.drawDepth(e,h,f);let d=this.drawMasks(e,m,a),v=this.curved.draw(e,m,a);this.renderer.drawReflected(e,h,f,p,new Set([...d.map(b=>b.reflector.material),...v.materials]));for(let b of d)this.draw(e,m,b,a);u(),this.curved.add(e,m,v.later,a)}else this.renderer.drawReflected(e,h,f,p,new Set);e.movers.some&&(e.movers.drawDepth(h),e.movers.drawLight(h,!0)),this.renderer.drawTransparent(e,h)}mirroredView(e,r,i,n){let o=Ut();o[10]=-1;let a=Q(i.viewFromPack,r.packFromReflector),s=Q(Q(a,o),r.reflectorFromPack),l=ce(r.reflectorFromPack,i.eye);l[2]=-l[2];let c=0,u=e.bounds;for(let p=0;p<8;++p){let m=ee(s,[p&1?u.upper[0]:u.lower[0],p&2?u.upper[1]:u.lower[1],p&4?u.upper[2]:u.lower[2]]);c=Math.max(c,-1.01*m[2])}let h=qr(i,n.origin,n.width,n.height);h.far=Math.max(i.far,c),h.mirrored=!i.mirrored,h.viewFromPack=s,h.eye=ce(r.packFromReflector,l),h.clipFromView=ze(h,h.far);let f=r.reflectorFromPack;return h.clipFromPack=Xr(Q(h.clipFromView,s),[f[2],f[6],f[10],f[14]-r.flatness-1e-5*r.size]),h}makeLevels(e,r){let{gl:i}=this.device,n=Math.ceil(Math.log2(Math.max(e.width,e.height)))+1,o=(a,s)=>Math.max(1,a+(1<<s)-1>>s);A(i,{}),this.pull.use(),this.pull.set("u_reach",1e30),i.bindFramebuffer(i.FRAMEBUFFER,r.level);for(let a=1;a<n;++a)k(i,"u_source",r.color),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_BASE_LEVEL,a-1),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MAX_LEVEL,a-1),i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,r.color,a),this.pull.set("u_source_size",[o(e.width,a-1),o(e.height,a-1)]),i.viewport(0,0,o(e.width,a),o(e.height,a)),this.renderer.drawScreen();i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,r.blurred,0),k(i,"u_source",r.color),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_BASE_LEVEL,0),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MAX_LEVEL,n-1)}setConvolution(e,r,i,n,o,a,s){let{gl:l}=this.device,c=Q(i.viewFromPack,n.packFromReflector),u=$([c[8],c[9],c[10]],[0,0,1]),h=[i.centre[0]/i.tangents[0],i.centre[1]/i.tangents[1]];e.set("u_ndc_from_image",[2/i.width,2/i.height,2*a.origin[0]/i.width-1+h[0],2*a.origin[1]/i.height-1+h[1]]),e.set("u_tangents",i.tangents),e.set("u_ortho",i.ortho?1:0),e.set("u_plane_normal",u),e.set("u_plane_offset",D(u,[c[12],c[13],c[14]])),e.set("u_farthest",1e4*Math.max(_e(r.bounds),1e-12)),e.set("u_constant_footprint",-1),e.set("u_median",o.median),e.set("u_coarse",a.coarse),e.set("u_pixels_per_tangent",.5*i.height/i.tangents[1]),k(l,"u_image",s.color),k(l,"u_taps",o.taps),e.set("u_image_size",[a.width,a.height]),e.set("u_texture_size",[s.width,s.height]),e.set("u_tap_count",o.count),e.set("u_tap_rows",o.rows)}drawBlurred(e,r,i,n,o,a){let{gl:s}=this.device;s.bindFramebuffer(s.FRAMEBUFFER,a.level),s.viewport(0,0,Math.floor(o.width/o.coarse),Math.floor(o.height/o.coarse)),A(s,{}),this.blur.use(),this.setConvolution(this.blur,e,r,i,n,o,a),s.bindVertexArray(this.none),this.renderer.drawScreen()}where(e,r,i){let n={depthTest:!0,cull:!0,mirrored:e.view.mirrored};return e.inFrame&&r.value>0?{...n,stencilFunc:this.device.gl.EQUAL,stencilRef:r.value,stencilRead:st}:{...n,blend:"add",alpha:i}}setReflector(e,r,i,n){let o=n.packFromReflector;r.bindGeometry(),e.set("u_clip_from_pack",i.view.clipFromPack),e.set("u_eye",i.view.eye),e.set("u_normal",[o[8],o[9],o[10]]),r.setReflectance(e,n.material),e.set("u_modulate",!0)}drawComposed(e,r,i,n,o,a){let{gl:s}=this.device,l=i.reflector,c=!r.inFrame&&e.reflectanceOf(l.material)>Yr,u=n.count>1?this.convolve:this.compose;A(s,this.where(r,i,c)),u.use(),u.set("u_origin",o.origin),u.set("u_missing",[0,0,0]),u.set("u_with_distance",c),this.setReflector(u,e,r,l),k(s,"u_blurred",a.blurred),this.setConvolution(u,e,r.view,l,n,o,a),e.draw(l)}drawEmitters(e,r,i,n){let{gl:o}=this.device,a=i.reflector,s=a.emitters;if(!s)return;let l=e.data.reflectors[a.index],c=n.lobes?this.emitters:this.glints;c.use(),k(o,"u_polygons",s.polygons),k(o,"u_visibility",s.visibility),k(o,"u_seen",s.seen),n.lobes&&k(o,"u_lobes",n.lobes),c.set("u_cells",[s.cellsX,s.cellsY]),c.set("u_lower",l.lower.map(h=>h/a.size)),c.set("u_upper",l.upper.map(h=>h/a.size));let u=a.reflectorFromPack.slice();for(let h=0;h<4;++h)for(let f=0;f<3;++f)u[4*h+f]/=a.size;c.set("u_emitters_from_pack",u),n.lobes&&c.set("u_lobe_rows",33),this.setReflector(c,e,r,a),A(o,{...this.where(r,i,!1),blend:"add",alpha:!1}),e.draw(a)}};function Po(t,e,r){let i=t.corners.map(a=>L(ee(e,a),1/r)),n=i.flatMap((a,s)=>{let l=i[(s+1)%i.length],c=a[2]>=0?[a]:[];return a[2]>=0!=l[2]>=0&&c.push(I(a,L(T(l,a),a[2]/(a[2]-l[2])))),c}),o=[];return n.length>=3&&o.push([n[0],n[1],n[2],n[Math.min(n.length-1,3)]]),n.length===5&&o.push([n[0],n[3],n[4],n[4]]),o}function ct(t,e,r,i,n,o){if(e.emitters.length===0||!(n>0))return;let a=e.nodesX-1,s=e.nodesY-1,l=a*s,c=[],u=new Uint8Array(4*l*e.emitters.length),h=new Uint32Array(4*l);if(e.emitters.forEach((f,p)=>{let m=r[f],d=e.visibility.subarray(p*e.nodesX*e.nodesY),v=Po(m,i,n).map(b=>{let _=m.twoSided?-(p+1):p+1;return c.push(...b[0],...b[1],...b[2],...b[3],...m.radiance.map(g=>g*o),_),c.length/16-1});for(let b=0;b<s;++b)for(let _=0;_<a;++_){let g=b*e.nodesX+_,y=b*a+_,w=[d[g],d[g+1],d[g+e.nodesX],d[g+e.nodesX+1]];if(u.set(w,4*(p*l+y)),w.some(x=>x>0))for(let x of v)h[4*y+(x>>5)]|=1<<(x&31)}}),c.length!==0)return{cellsX:a,cellsY:s,polygons:F(t,{width:4,height:c.length/16,format:t.RGBA32F},new Float32Array(c)),visibility:F(t,{width:a,height:s*e.emitters.length,format:t.RGBA8},u),seen:F(t,{width:a,height:s,format:t.RGBA32UI},h)}}function Jr(t,e,r){let i=t.corners,n=i.length,o=[0,0,0],a=0;i.forEach((f,p)=>{o=I(o,O(T(f,i[0]),T(i[(p+1)%n],i[0]))),a=Math.max(a,j(T(i[(p+1)%n],f)))});let s=$(o,[0,0,0]),l=j(s)>0?.001*a:-1,c=i.map((f,p)=>$(O(s,T(i[(p+1)%n],f)),[0,0,0])),u=f=>{let p=[e.positions[3*f],e.positions[3*f+1],e.positions[3*f+2]];return Math.abs(D(T(p,i[0]),s))<=l&&i.every((m,d)=>D(T(p,m),c[d])>=-l)},h=[];for(let f of e.parts){if(r[f.material].emission.every(m=>m===0))continue;let p=[];for(let m=f.first;m<f.first+f.count;m+=3){let d=[...e.indices.subarray(m,m+3)];d.every(u)&&p.push(...d)}p.length>0&&h.push({part:f,indices:p})}return h}var Go=Float32Array.from({length:256},(t,e)=>e/255<=.04045?e/255/12.92:((e/255+.055)/1.055)**2.4),zo=t=>t<=.0031308?12.92*t:1.055*t**(1/2.4)-.055,ei=t=>Math.round(255*Math.min(Math.max(t,0),1));function Vo(t,e){let r=t.width*t.height,i=new Float32Array(5*r),n=t.texels;for(let o=0;o<r;++o){let a=n[4*o+3]/255,s=e>0?+(a>=Math.fround(e)):a;for(let l=0;l<3;++l)i[5*o+l]=Go[n[4*o+l]]*s;i[5*o+3]=s,i[5*o+4]=a}return{width:t.width,height:t.height,texels:i}}function ti(t,e){let r=t/e;return Array.from({length:e},(i,n)=>{let o=[];for(let a=Math.floor(n*r);a<t&&a<(n+1)*r;++a)o.push([a,(Math.min((n+1)*r,a+1)-Math.max(n*r,a))/r]);return o})}function Do(t){let e=Math.max(1,t.width>>1),r=Math.max(1,t.height>>1),i=new Float32Array(5*e*r),n=ti(t.width,e);return ti(t.height,r).forEach((a,s)=>n.forEach((l,c)=>{for(let[u,h]of a)for(let[f,p]of l)for(let m=0;m<5;++m)i[5*(s*e+c)+m]+=p*h*t.texels[5*(u*t.width+f)+m]})),{width:e,height:r,texels:i}}function Bo(t,e,r){let i=t.texels.length/5,n=Math.min(Math.round(e*i),i),o=new Float32Array(i);for(let h=0;h<i;++h)o[h]=t.texels[5*h+4];o.sort().reverse();let a=o.filter(h=>h>=Math.fround(r)).length;if(n===0||n===a)return 1;let s=o[n-1],l=o.indexOf(s),c=o.lastIndexOf(s)+1,u=l===0||c-n<=n-l?s:o[l-1];return u>0?(r+1/255)/u:1}function Co(t,e){let r=new Uint8Array(t.texels.length/5*4),i=t.texels;for(let n=0;n<r.length/4;++n){let o=i[5*n+3];for(let a=0;a<3;++a)r[4*n+a]=ei(o>0?zo(i[5*n+a]/o):0);r[4*n+3]=ei(e*i[5*n+4])}return r}function ri(t,e){let r=[];for(let n=Vo(t,e);n.width>1||n.height>1;)r.push(n=Do(n));if(r.length===0)return[];let i=r[r.length-1].texels[3];for(let n=r.length-2;n>=0;--n){let o=r[n+1],a=r[n];for(let s=0,l=0;s<a.height;++s)for(let c=0;c<a.width;++c,++l){if(a.texels[5*l+3]>0)continue;let u=5*(Math.min(s>>1,o.height-1)*o.width+Math.min(c>>1,o.width-1));a.texels.set(o.texels.subarray(u,u+4),5*l)}}return r.map(n=>({width:n.width,height:n.height,texels:Co(n,e>0?Bo(n,i,e):1)}))}var ni=1667,oi=25e3,Uo=100,Io=.01,Oo=t=>.2126*t[0]+.7152*t[1]+.0722*t[2],ut=t=>t.map(e=>e/Math.max(Oo(t),1e-6));function ht(t){let e=1e3/Math.min(Math.max(t,ni),oi),r=t<=4e3?((-.2661239*e-.2343589)*e+.8776956)*e+.17991:((-3.0258469*e+2.1070379)*e+.2226347)*e+.24039,i=t<=2222?((-1.1063814*r-1.3481102)*r+2.18555832)*r-.20219683:t<=4e3?((-.9549476*r-1.37418593)*r+2.09137015)*r-.16748867:((3.081758*r-5.8733867)*r+3.75112997)*r-.37001483,n=r/i,o=(1-r-i)/i;return ut([3.2404542*n-1.5371385-.4985314*o,-.969266*n+1.8760108+.041556*o,.0556434*n-.2040259+1.0572252*o].map(a=>Math.max(a,0)))}function $o(t){if(!/^#[0-9a-f]{6}$/i.test(t))return;let e=[1,3,5].map(r=>{let i=parseInt(t.slice(r,r+2),16)/255;return i<=.04045?i/12.92:((i+.055)/1.055)**2.4});return Math.max(...e)>0?ut(e):void 0}function No(t){let e=Math.max(...t);return`#${t.map(r=>{let i=r/e<=.0031308?12.92*r/e:1.055*(r/e)**.4166666666666667-.055;return Math.round(255*Math.min(Math.max(i,0),1)).toString(16).padStart(2,"0")}).join("")}`}var Ce=(t,e)=>t.map((r,i)=>{let n={on:!0,value:r.value};return e?.hours.some(o=>o.group===i)&&(n.value=1,n.hour=e.shown),r.color.some(o=>o!==1)&&(n.color=ut(r.color.map((o,a)=>o*r.ownColor[a]))),n});function Wo(t,e){let r=$o(t),i=/^([0-9.]+)k$/i.exec(t),n=Number(t);t==="on"||t==="off"?e.on=t==="on":r?(e.color=r,delete e.kelvin):i&&Number(i[1])>=ni&&Number(i[1])<=oi?Ue(e,Number(i[1])):t!==""&&n>=0&&n<=Uo&&(e.value=n,e.on=!0)}function Ue(t,e){t.kelvin=e,t.color=ht(e)}function ai(t,e,r,i){for(let n of e){let o=n.lastIndexOf("="),a=n.slice(0,o);i&&a==="hour"&&t.every(s=>s.name!==a)&&ft(i,Number(n.slice(o+1)),r),t.forEach((s,l)=>{let c=a==="*"||(r[l].hour===void 0?a===s.name:a==="day");o>0&&c&&n.slice(o+1).split(/\s+/).forEach(u=>Wo(u,r[l]))})}}function ft(t,e,r){if(e>=t.hours[0].hour&&e<=t.hours.at(-1).hour)for(let i of r)i.hour!==void 0&&(i.hour=e)}function Ho(t,e){let r=t.find(u=>u.hour!==void 0)?.hour;if(!e||r===void 0)return t.map(()=>1);let{hours:i}=e,n=i.filter(u=>u.group<t.length).length,o=Math.max(i.findIndex(u=>u.hour>=r),0),a=Math.max(o-1,0),s=i[a].hour,l=i[o].hour,c=l>s?(r-s)/(l-s):1;return t.map((u,h)=>u.hour===void 0?1:n*((i[o].group===h?c:0)+(a<o&&i[a].group===h?1-c:0)))}function si(t,e,r){let i=s=>[String(+s.value.toFixed(3)),s.kelvin?`${Math.round(s.kelvin)}K`:s.color?No(s.color):"",s.on?"":"off"].filter(Boolean).join(" "),n=Ce(t,r),o=e.find(s=>s.hour!==void 0)?.hour,a=e.flatMap((s,l)=>i(s)===i(n[l])?[]:[`${t[l].name}=${i(s)}`]);return o===void 0||o===r?.shown?a:[`hour=${o}`,...a]}var li=(t,e,r,i=Ho(e,r))=>e.map((n,o)=>[0,1,2].map(a=>n.on?i[o]*n.value*(n.color?n.color[a]/Math.max(t[o].ownColor[a],Io):1):0)),qo;function ii(t,e,r,i,n,o){let a=e?t.restOfDetail:t.rest,s=new Uint16Array(i.length),l=qo??=Float32Array.from({length:1984},(c,u)=>Y(u<<4));for(let c=0;c<a.length;++c){let u=a[c],h=r[u];for(let f=0;f<3;++f){let p=h[f]*Y(i[3*c+f])*n;for(let m of t.others)m.group!==u&&(p+=(r[m.group][f]-h[f])*t.scale*l[(e?m.detail:m.light)[3*c+f]]);s[3*c+f]=Ct(Math.max(p,0)/o)}}return s}function ci(t,e,r){if(!e||e.width!==t.width||e.height!==t.height||r.every(o=>o.every(a=>a===1)))return t;let i=Math.max(1,...r.flat()),n=t.scale*2**Math.ceil(Math.log2(i));return{...t,scale:n,light:ii(e,!1,r,t.light,t.scale,n),detail:t.detail&&ii(e,!0,r,t.detail,t.scale,n)}}function ui(t,e){let r=t.hours.filter(i=>i.group<e.length);return[0,1,2].map(i=>r.reduce((n,o)=>n+e[o.group][i]/r.length*o.sky[i],0))}function be(t,e,r,i){return[0,1,2].map(n=>Math.max(0,t.reduce((o,a,s)=>o+(e[s][n]-1)*(a[r][3*i+n]??0),1)))}var Xo=.001,mt=.2,Ie=16;function Oe(t,e){let r=new Float64Array(e*e),i=Math.sqrt(.25/Math.PI),n=1,o=0;for(let a=0;a<e;++a){a>0&&(i*=Math.sqrt((2*a+1)/(2*a)),[n,o]=[t[0]*n-t[1]*o,t[0]*o+t[1]*n]);let s=0,l=i*(a>0?Math.SQRT2:1);for(let c=a;c<e;++c){if(c>a){let u=Math.sqrt((4*c*c-1)/(c*c-a*a)),h=c===a+1?0:-u*Math.sqrt(((c-1)**2-a*a)/(4*(c-1)**2-1));[s,l]=[l,u*t[2]*l+h*s]}r[c*(c+1)+a]=l*n,a>0&&(r[c*(c+1)-a]=l*o)}}return r}function fi(t,e,r){let i=t.lights.map(n=>n.intensity);return e.forEach((n,o)=>{for(let a of n.brightLights)i[a]=t.lights[a].intensity.map((s,l)=>s*r[o][l])}),{field:t,bright:i,probes:t.valid.length===0?[]:Array.from(t.valid,(n,o)=>be(e,r,"probes",o))}}function jo(t,e,r){let i=Math.sqrt(Math.max(0,1-Math.abs(r[2]))),n=i*Math.atan2(Math.abs(r[1]),Math.abs(r[0]))*(2/Math.PI),o=i-n,[a,s]=r[2]<0?[1-n,1-o]:[o,n],l=t.depthSide,c=_=>_<0||Object.is(_,-0)?-1:1,u=(.5*a*c(r[0])+.5)*l-.5,h=(.5*s*c(r[1])+.5)*l-.5,f=Math.floor(u),p=Math.floor(h),m=u-f,d=h-p,v=l*l,b=[0,0];for(let _=0;_<4;++_){let g=[f+(_&1),p+(_>>1)];for(let x of[0,1])(g[x]<0||g[x]>=l)&&(g[x]=g[x]<0?-1-g[x]:2*l-1-g[x],g[1-x]=l-1-g[1-x]);let y=(_&1?m:1-m)*(_>>1?d:1-d),w=e*v+g[1]*l+g[0];b[0]+=y*t.depth[w]/65535,b[1]+=y*t.depthSquared[w]/65535}return b}function Ko(t,e,r){let i=T(r,[t.positions[3*e],t.positions[3*e+1],t.positions[3*e+2]]),n=j(i);if(!(n>0))return 1;let[o,a]=jo(t,e,L(i,1/n)),s=n/t.depthCap-o;if(s<=0)return 1;let l=Math.max(a-o*o,1e-6);return(l/(l+s*s))**3}function Yo(t,e){let r=[0,0,0],i=0,n=1;for(let o=0;o<3;++o){let a=t.size[o],s=Math.min(Math.max((e[o]-t.lower[o])/t.cell[o],0),a),l=Math.min(Math.floor(s),a-1);r[o]=s-l,i+=l*n,n*=a}for(;t.cells[9*i]!==0;){i=t.cells[9*i];for(let o=0;o<3;++o){let a=r[o]>=.5;r[o]=2*r[o]-Number(a),a&&(i+=1<<o)}}return{cell:i,inCell:r}}var hi=(t,e,r)=>(t[2*e+(r>>5)]>>>(r&31)&1)>0;function Qo(t){if(t.kind===1||t.kind===2)return[{at:t.position,w:1}];let e=[];if(t.kind===3){let o=Math.tan(Math.min(t.angularRadius,1.5)),a=L(t.direction,-1),s=o>0?Ie:1,l=$(O(Math.abs(a[0])<.9?[1,0,0]:[0,1,0],a),[1,0,0]),c=O(a,l);for(let u=0;u<s;++u){let h=s>1?o*Math.sqrt((u+.5)/s):0,f=2.3999632*u;e.push({at:$(I(a,I(L(l,h*Math.cos(f)),L(c,h*Math.sin(f)))),a),w:0})}return e}let r=[],i=t.corners,n=0;for(let o=0;o+2<i.length;o+=3)r.push(n+=.5*j(O(T(i[o+1],i[o]),T(i[o+2],i[o]))));for(let o=0;o<Ie&&n>0;++o){let a=.5/Ie,s=0;for(let m=o,d=.5;m>0;m>>=1,d*=.5)a+=(m&1)*d;let l=(o+.5)/Ie*n;for(;s+1<r.length&&r[s]<=l;)++s;let c=s>0?r[s-1]:0,u=Math.sqrt(Math.min(Math.max((l-c)/Math.max(r[s]-c,1e-30),0),1)),[h,f,p]=[i[3*s],i[3*s+1],i[3*s+2]];e.push({at:I(L(h,1-u),I(L(f,u*(1-a)),L(p,u*a))),w:1})}return e}function Zo(t,e,r,i,n,o){let a=Qo(t),s=n*n,l=1;if(t.kind===0){l=0;for(let h=0,f=t.corners;h+2<f.length;h+=3)l+=.5*j(O(T(f[h+1],f[h]),T(f[h+2],f[h])))}let c=Math.cos(t.outerCone),u=c+Math.max(.001,Math.cos(t.innerCone)-c);for(let{at:h,w:f}of a){let p=T(h,L(i,f)),m=Math.max(D(p,p),1e-12),d=L(p,1/Math.sqrt(m)),v=-D(d,t.direction),b=1;t.kind===0&&(b=t.twoSided?Math.abs(v):Math.max(v,0)),t.kind===2&&(b=Math.min(Math.max((v-c)/(u-c),0),1)**2);let _=f===0?1:l*b/m,g=Oe(d,n),y=_*r/a.length;for(let w=0;w<3;++w)for(let x=0;x<s;++x)o[w*s+x]+=y*e[w]*g[x]}}function mi(t,e){let{field:r}=t,i=r.bands*r.bands,n=new Float64Array(3*i),{cell:o,inCell:a}=Yo(r,e),s=[...r.cells.subarray(9*o+1,9*o+9)],l=[],c=[],u=[];s.forEach((b,_)=>{let g=a.reduce((x,z,C)=>x*(_>>C&1?z:1-z),1),y=r.valid[b]>0,w=y?Ko(r,b,e):0;w<mt&&(w*=w*w/(mt*mt)),u.push(g),c.push(y?g:0),l.push(w*g)});let h=b=>b.reduce((_,g)=>_+g,0),f=Math.min(1,h(l)),p=f>Xo?l:h(c)>0?c:u,m=h(p),d=r.lights.map(()=>0),v=r.lights.map(()=>!1);return s.forEach((b,_)=>{let g=p[_]/m;if(g>0){for(let y=0;y<3;++y){let w=g*(t.probes[b]?.[y]??1);for(let x=0;x<i;++x)n[y*i+x]+=w*r.harmonics[(y*i+x)*r.valid.length+b]}r.lights.forEach((y,w)=>{v[w]||=hi(r.bright,b,w),hi(r.kept,b,w)&&(d[w]+=g)})}}),r.lights.forEach((b,_)=>{v[_]&&Zo(b,t.bright[_],Math.max(0,1-d[_]),e,r.bands,n)}),{sh:n,trust:f}}var fe=.7,Jo=.02,ea=.05;function ta(t,e,r){let i=t.reduce((a,s,l)=>a+s*e[l],0),n=e;if(i<0&&(i=-i,n=e.map(a=>-a)),i>1-1e-7)return t.map((a,s)=>a+(n[s]-a)*r);let o=Math.acos(i);return t.map((a,s)=>(Math.sin((1-r)*o)*a+Math.sin(r*o)*n[s])/Math.sin(o))}function di(t,e){let r=t.keys,i=r[r.length-1];if(!i)return t.rest;let n=e>i.time?i.time>0?e%i.time:i.time:e,o=r.findIndex(c=>c.time>n);if(o<=0)return(o===0?r[0]:i).pose;let a=r[o-1],s=r[o],l=(n-a.time)/(s.time-a.time);return{position:I(a.pose.position,L(T(s.pose.position,a.pose.position),l)),rotation:ta(a.pose.rotation,s.pose.rotation,l)}}function pt(t){let e=Math.hypot(...t.rotation)||1,[r,i,n,o]=t.rotation.map(a=>a/e);return new Float64Array([1-2*(i*i+n*n),2*(r*i+o*n),2*(r*n-o*i),0,2*(r*i-o*n),1-2*(r*r+n*n),2*(i*n+o*r),0,2*(r*n+o*i),2*(i*n-o*r),1-2*(r*r+i*i),0,...t.position,1])}var $e=t=>[1,t&1?fe:-fe,t&2?fe:-fe,t&4?fe:-fe];function ra(t){let e=Array.from({length:4},(i,n)=>Array.from({length:4},(o,a)=>t.reduce((s,l,c)=>s+l*$e(c)[n]*$e(c)[a],0)));for(let i=1;i<4;++i)e[i][i]+=ea*e[0][0];let r=new Float64Array(e.flat());return t.map((i,n)=>Ge(r,$e(n)).map(o=>i*o))}var ia=[[.1252334085114689,.2491470458134028],[.3678314989981802,.2334925365383548],[.5873179542866175,.2031674267230659],[.7699026741943047,.1600783285433462],[.9041172563704749,.1069393259953184],[.9815606342467192,.0471753363865118]],dt;function na(){if(dt)return dt;let t=[],e=12;for(let[r,i]of ia)for(let n of[r,-r])for(let o=0;o<e;++o){let a=2*Math.PI*o/e,s=Math.sqrt(1-n*n);t.push({way:[s*Math.cos(a),s*Math.sin(a),n],weight:i*2*Math.PI/e})}return dt=t}function oa(t,e,r,i){let n=r*r,o=new Float64Array(t.length);for(let{way:a,weight:s}of na()){let l=Oe(a,r),c=[0,1,2].map(h=>i[h]*a[0]+i[4+h]*a[1]+i[8+h]*a[2]),u=Oe(c,r);for(let h=0;h<e;++h){let f=0;for(let p=0;p<n;++p)f+=t[h*n+p]*u[p];for(let p=0;p<n;++p)o[h*n+p]+=s*f*l[p]}}return o}function pi(t,e,r,i){let n=e.components+1,o=new Float32Array(e.clusters*n*3*4),{bands:a}=t.field,s=a*a,l=Array.from({length:8},(m,d)=>{let v=$e(d),b=[0,1,2].map(_=>.5*(r.lower[_]+r.upper[_])+.5*v[_+1]*(r.upper[_]-r.lower[_]));return mi(t,ee(i,b))}),c=ra(l.map(m=>Math.max(m.trust,Jo))),u=new Float64Array(12*s);for(let m=0;m<3;++m)for(let d=0;d<4;++d)for(let v=0;v<s;++v)u[(4*m+d)*s+v]=l.reduce((b,_,g)=>b+c[g][d]*_.sh[m*s+v],0);let h=oa(u,12,a,i),f=Math.min(e.bands*e.bands,s),p=e.channels*e.bands*e.bands;for(let m=0;m<e.clusters*n;++m){let d=Math.floor(m/n),v=m%n,b=v===0?1:e.weightScale[d*(n-1)+v-1];for(let _=0;_<3;++_){let g=m*p+(e.channels===3?_*e.bands*e.bands:0);for(let y=0;y<4;++y){let w=0;for(let x=0;x<f;++x)w+=e.basis[g+x]*h[(4*_+y)*s+x];o[4*(3*m+_)+y]=b*w}}}return o}var vt=2048,vi=127;function aa(t,e){let{mesh:r,transfer:i}=e,n=0,o=(a,s,l,c=t.FLOAT,u=!1)=>{s&&(t.bindBuffer(t.ARRAY_BUFFER,t.createBuffer()),t.bufferData(t.ARRAY_BUFFER,s,t.STATIC_DRAW),t.enableVertexAttribArray(a),t.vertexAttribPointer(a,l,c,u,0,0),n+=s.byteLength)};return o(0,r.positions,3),o(1,r.normals,3),o(2,r.uvs,2),o(4,r.colors,4,t.UNSIGNED_BYTE,!0),o(5,r.normalUvs,2),o(6,r.tangents,4),o(7,i.cluster,1,t.UNSIGNED_BYTE),t.vertexAttrib4f(4,1,1,1,1),t.bindBuffer(t.ELEMENT_ARRAY_BUFFER,t.createBuffer()),t.bufferData(t.ELEMENT_ARRAY_BUFFER,r.indices,t.STATIC_DRAW),n+r.indices.byteLength}var Ne=class{constructor(e,r){this.device=e;this.scene=r}movers=[];depth;light;field;shining;get animated(){return this.movers.some(e=>(e?.mover.keys.length??0)>1)}get some(){return this.movers.some(e=>e?.table)}setField(e){this.field=e,this.relight()}relight(){if(this.field){this.shining=fi(this.field,this.scene.data.groups,this.scene.factors);for(let e of this.movers)e&&delete e.placedAt}}add(e,r){let{gl:i}=this.device,n=r.mesh.positions;this.depth??=P.make(i,"depth"),this.light??=P.make(i,"mover_light");let o=he(),a=[];for(let m of r.mesh.parts){if(m.count===0)continue;let d=this.scene.data.materials[m.material];d.alphaMode===2&&(d.alphaMode=0);let v={...m,page:-1,bounds:he()};for(let b=m.first;b<m.first+m.count;++b){let _=3*r.mesh.indices[b];ne(v.bounds,n[_],n[_+1],n[_+2])}ne(o,...v.bounds.lower),ne(o,...v.bounds.upper),a.push(v)}if(a.length===0)return;let s=i.createVertexArray(),l=r.transfer.components,c=Math.ceil(l/4),u=n.length/3;i.bindVertexArray(s),this.scene.bytes+=aa(i,r),i.bindVertexArray(null);let h=Math.max(1,Math.ceil(u*c/vt)),f=new Int16Array(h*vt*4);for(let m=0;m<u;++m)f.set(r.transfer.weight.subarray(m*l,m*l+l),m*c*4);let p=F(i,{width:vt,height:h,format:i.RGBA16I},f);this.movers[e]={mover:r,array:s,ranges:a,bounds:o,weights:p,packFromObject:pt(r.rest)},this.scene.bytes+=f.byteLength}place(e){let{gl:r}=this.device;for(let i of this.movers){if(!i||!this.shining)continue;let n=i.mover.keys.length>1?e:0;if(i.placedAt===n)continue;i.placedAt=n,i.packFromObject=pt(di(i.mover,n)),i.table&&r.deleteTexture(i.table);let{components:o,clusters:a}=i.mover.transfer,s=pi(this.shining,i.mover.transfer,i.bounds,i.packFromObject);i.table=F(r,{width:3*(o+1),height:a,format:r.RGBA32F},s.map(l=>l*this.scene.unit))}}bounds(){let e=this.scene.bounds,r={lower:[...e.lower],upper:[...e.upper]};for(let i of this.movers)for(let n=0;i?.table&&n<8;++n){let{lower:o,upper:a}=i.bounds,s=[n&1?a[0]:o[0],n&2?a[1]:o[1],n&4?a[2]:o[2]];ne(r,...ee(i.packFromObject,s))}return r}drawDepth(e){this.each(e,this.depth,r=>{let i=this.scene.data.materials[r.material];A(this.device.gl,{depthTest:!0,depthWrite:!0,color:!1,cull:!i.doubleSided,mirrored:e.mirrored}),this.depth.set("u_alpha",i.alpha),this.depth.set("u_alpha_cutoff",se(i)),this.scene.bindBase(i.texture)})}drawLight(e,r){if(!this.some)return;let i=e.viewFromPack;this.light.use(),this.light.set("u_eye",e.eye),this.light.set("u_alpha_kind",r?e.ortho?2:1:0),this.light.set("u_depth_row",[-i[2],-i[6],-i[10],-i[14]]),this.light.set("u_closest",this.device.closest),this.light.set("u_changed",!1),this.light.set("u_weights",[1,1,1]),this.each(e,this.light,(n,o)=>{let a={depthTest:!0,stencilRef:vi,stencilWrite:vi,mirrored:e.mirrored};A(this.device.gl,{...a,cull:!this.scene.data.materials[n.material].doubleSided}),this.scene.setSurface(this.light,n,!!o.mesh.normalUvs)})}each(e,r,i){let{gl:n}=this.device;for(let o of this.movers){if(!o?.table)continue;let a=Q(e.clipFromPack,o.packFromObject),s=o.bounds.upper.map((l,c)=>.5*(l-o.bounds.lower[c]));this.scene.bindGeometry(),n.bindVertexArray(o.array),r.use(),r.set("u_clip_from_pack",a),r.set("u_pack_from_object",o.packFromObject),r.set("u_box_center",ae(o.bounds)),r.set("u_box_scale",s.map(l=>l>0?1/l:0)),r.set("u_components",o.mover.transfer.components);for(let l of o.ranges)te(a,l.bounds)&&(i(l,o.mover),k(n,"u_codes",o.weights),k(n,"u_table",o.table),this.scene.draw(l))}}};function sa(t){let e=new Float32Array(4*t.light.length);return t.light.forEach((r,i)=>{if(t.valid[i]===0)return;let n=t.scale*2**((r>>>27)-24);e.set([(r&511)*n,(r>>>9&511)*n,(r>>>18&511)*n,1],4*i)}),{size:t.size,texels:e}}function la(t){let e=t.size/2,r={size:e,texels:new Float32Array(4*e*e)};for(let i=0;i<e;++i)for(let n=0;n<e;++n){let o=[0,0,0,0];for(let a=0;a<4;++a){let s=4*((2*i+(a>>1))*t.size+2*n+(a&1)),l=t.texels[s+3];for(let c=0;c<3;++c)o[c]+=l*t.texels[s+c];o[3]+=l}o[3]>0&&r.texels.set([o[0]/o[3],o[1]/o[3],o[2]/o[3],.25*o[3]],4*(i*e+n))}return r}function ca(t){for(let e=t.length-2;e>=0;--e){let r=t[e],i=t[e+1];for(let n=0;n<r.size*r.size;++n){if(r.texels[4*n+3]>0)continue;let o=4*((n/r.size>>1)*i.size+(n%r.size>>1));r.texels.set(i.texels.subarray(o,o+4),4*n)}}}function gi(t,e){for(let r=-1;r<=t;++r)for(let i=-1;i<=t;++i){let n=[i,r];for(let o of[0,1])(n[o]<0||n[o]>=t)&&(n[o]=n[o]<0?-1-n[o]:2*t-1-n[o],n[1-o]=t-1-n[1-o]);e(i+1,r+1,n[1]*t+n[0])}}function ua(t,e,r){let i=u=>u>0?Math.min(u,65408):0,n=[i(t),i(e),i(r)],o=Math.max(...n);if(o<=0)return 0;let a=Math.max(-16,Math.floor(Math.log2(o)))+16;Math.floor(o*2**(24-a)+.5)>=512&&++a;let[s,l,c]=n.map(u=>Math.floor(u*2**(24-a)+.5));return(s|l<<9|c<<18|a<<27)>>>0}var _i=(t,e)=>e===0?[0,0]:[t+2,t-(t>>e-1)+2*(e-1)];function bi(t,e){let r=[sa(e)],i=e.size;for(;r[r.length-1].size>1;)r.push(la(r[r.length-1]));ca(r);let n=0,o=0,a=1/0;for(let m=0;m<i*i;++m){for(let d=0;d<3;++d)n=Math.max(n,r[0].texels[4*m+d]);o=Math.max(o,e.inverseDistance[m]),a=Math.min(a,e.inverseDistance[m])}let s=n>0?2**Math.min(Math.max(Math.floor(Math.log2(n))-14,-120),120):1,l=r.length-1,c=Math.max(i+2,l>0?i+i/2+4:0),u=Math.max(i+2,l>0?_i(i,l)[1]+3:3),h=new Uint32Array(c*u),f=new Float32Array((i+2)**2);r.forEach((m,d)=>{let[v,b]=_i(i,d),_=m.texels;gi(m.size,(g,y,w)=>{h[(b+y)*c+v+g]=ua(_[4*w]/s,_[4*w+1]/s,_[4*w+2]/s)})}),gi(i,(m,d,v)=>{f[d*(i+2)+m]=e.inverseDistance[v]});let p=t.getExtension("OES_texture_float_linear")?t.LINEAR:t.NEAREST;return{centre:e.centre,size:i,scale:s,range:[o,a],tint:[1,1,1],light:F(t,{width:c,height:u,format:t.RGB9_E5,min:t.LINEAR,mag:t.LINEAR},h),inverseDistance:F(t,{width:i+2,height:i+2,format:t.R32F,min:p,mag:p},f)}}function yi(t,e){let r=0;for(let n=0;n<t.length;++n)r+=t[n];let i=e*r;for(let n=0;n<t.length;++n){if(i<t[n])return n+i/t[n];i-=t[n]}return t.length}function ha(t){let e=0;for(let r=.5;t!==0;t>>>=1,r*=.5)e+=(t&1)*r;return e}function xi(t,e,r,i){let n=new Float64Array(e);for(let c=0;c<e;++c)for(let u=0;u<e;++u)n[c]+=t[c*e+u];let o=[],a=i(1,1),s=i(0,0),l=(a[0]-s[0])*(a[1]-s[1]);for(let c=0;c<r;++c){let u=yi(n,(c+.5)/r),h=Math.min(Math.floor(u),e-1),f=yi(t.subarray(h*e,h*e+e),ha(c)+.5/r),p=Math.min(Math.floor(f),e-1),m=i(p/e,h/e),d=i((p+1)/e,(h+1)/e),v=i(f/e,u/e),b=Math.max(t[h*e+p],1e-12)*r;o.push({x:v[0],y:v[1],width:Math.sqrt(Math.min((d[0]-m[0])*(d[1]-m[1])/b,l)),weight:1})}return o}var fa=t=>(e,r)=>[t.width[0]*Math.sinh(t.lower[0]+e*(t.upper[0]-t.lower[0])),t.shift+t.width[1]*Math.sinh(t.lower[1]+r*(t.upper[1]-t.lower[1]))];function ma(t,e){return(r,i)=>{let n=(2*r-1)*t.halfExtent*e,o=(2*i-1)*t.halfExtent,a=2/(1+Math.sqrt(1+n*n+o*o));return[n*a,o*a]}}function wi(t,e){if(t.length===1)return[0,0,0];let r=a=>Math.sqrt(t[a].cosTheta),i=Math.sqrt(e),n=1;for(;n+1<t.length&&r(n)<i;)++n;let o=r(n-1);return[n-1,n,Math.min(Math.max((i-o)/(r(n)-o),0),1)]}function ki(t,e){let r=t?.factor;if(!r||r.length===0)return 1;let i=r.length/3-1,n=Math.sqrt(Math.min(Math.max(e,0),1))*i,o=Math.min(Math.floor(n),i),a=s=>.2126*r[3*s]+.7152*r[3*s+1]+.0722*r[3*s+2];return a(o)+(a(Math.min(o+1,i))-a(o))*(n-o)}function da(t,e,r){let i=e*e,n=Math.sqrt(Math.max(0,1-i*i)),o=0,a=0;for(let l of t){let c=.25*(l.x*l.x+l.y*l.y),u=[l.x/(1+c),l.y/(1+c),(1-c)/(1+c)],h=[0,2*i*n,2*i*i-1];l.weight=ki(r,Math.sqrt(Math.max(0,.5*(1+h[1]*u[1]+h[2]*u[2])))),n*u[1]+i*u[2]>0&&(o+=l.weight,++a)}let s=a>0?o/a:1;for(let l of t)l.weight=s>0?l.weight/s:1;return s}function Mi(t,e,r){if(!t||t.size<=1||!(t.halfExtent>0))return{count:1,rows:1,median:0,texels:new Float32Array([0,0,0,1]),means:[1]};let i=t.slices.map(l=>xi(l.weights,t.sliceSize,e,fa(l))),n=i.length===0?9:Math.max(i.length,2),o=new Float32Array(4*e*n),a=[],s=0;for(let l=0;l<n;++l){let c=l/(n-1),u;if(i.length===0)u=xi(t.weights,t.size,e,ma(t,Math.max(c*c,.001)));else{let[h,f,p]=wi(t.slices,c*c);u=i[h].map((m,d)=>{let v=i[f][d],b=(_,g)=>_+(g-_)*p;return{x:b(m.x,v.x),y:b(m.y,v.y),width:b(m.width,v.width),weight:1}})}a.push(da(u,c,r)),u.forEach((h,f)=>o.set([h.x,h.y,h.width,h.weight],4*(l*e+f))),l===n-1&&(s=u.map(h=>Math.hypot(h.x,h.y)).sort((h,f)=>h-f)[e>>1])}return{count:e,rows:n,median:s,texels:o,means:a}}var me=33;function Fi(t,e,r){let i=new Float32Array(8*me),n=o=>{let[a,s,l,c]=t.fits[o],u=t.slices[o].cosTheta,h=Math.sqrt(Math.max(0,1-u*u));return[a*u+s*h,s*u-a*h,l,c*u+h].map(f=>f/(u-c*h))};for(let o=0;o<me;++o){let a=o/(me-1),[s,l,c]=wi(t.slices,a*a),u=n(s),h=n(l),f=u.map((v,b)=>v+(h[b]-v)*c);f[2]=u[2]*h[2]/(h[2]+(u[2]-h[2])*c),i.set(f,4*o);let p=a*(r.length-1),m=Math.min(Math.floor(p),Math.max(r.length-2,0)),d=Math.min(m+1,r.length-1);i.set([ki(e,a*a),r[m]+(r[d]-r[m])*(p-m)],4*(me+o))}return i}function gt(t){let e=t.getExtension("EXT_color_buffer_float")&&t.getExtension("EXT_float_blend")&&t.getExtension("OES_texture_float_linear");if(!e&&!t.getExtension("EXT_color_buffer_float")&&!t.getExtension("EXT_color_buffer_half_float"))throw new Error("This device cannot draw light of more than eight bits.");return{gl:t,color:e?t.RGBA32F:t.RGBA16F,linear:t.LINEAR,closest:e?1e-15:1e-7}}var We=class{constructor(e,r){this.device=e;this.data=r;let i=e.gl,n=r.mesh,o=Math.max(1,...r.materials.flatMap(c=>c.emission),...r.sky);this.emission=r.materials.map(c=>c.unlit&&!c.emission.some(u=>u>0)?[1,1,1]:c.emission),this.sky=r.sky,this.unlitWhite=Math.max(...this.emission.filter((c,u)=>r.materials[u].unlit).flat(),0)||1,this.factors=r.groups.map(()=>[1,1,1]),this.unit=e.color===i.RGBA32F?1:Math.min(1,8192/o);let a=this.sortRanges();r.reflectors.forEach((c,u)=>this.addReflector(u,a)),this.movers=new Ne(e,this),this.curved=r.curved.map(c=>({...this.rangeOf(a,c.indices,c.material,-1),map:c.map})),this.array=i.createVertexArray(),i.bindVertexArray(this.array);let s=(c,u,h,f=i.FLOAT)=>{u&&(i.bindBuffer(i.ARRAY_BUFFER,i.createBuffer()),i.bufferData(i.ARRAY_BUFFER,u,i.STATIC_DRAW),i.enableVertexAttribArray(c),i.vertexAttribPointer(c,h,f,f===i.UNSIGNED_BYTE,0,0),this.bytes+=u.byteLength)};s(0,n.positions,3),s(1,n.normals,3),s(2,n.uvs,2),s(3,n.lightmapUvs,2),s(4,n.colors,4,i.UNSIGNED_BYTE),s(5,n.normalUvs,2),s(6,n.tangents,4),i.vertexAttrib4f(4,1,1,1,1),i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,i.createBuffer()),i.bufferData(i.ELEMENT_ARRAY_BUFFER,new Uint32Array(a),i.STATIC_DRAW),i.bindVertexArray(null),this.bytes+=4*a.length;let l=(c,u)=>F(i,{width:1,height:1,format:c},u);this.white=l(i.SRGB8_ALPHA8,new Uint8Array([255,255,255,255])),this.flat=l(i.RGBA8,new Uint8Array([128,128,255,255])),this.zero=l(i.R32UI,new Uint32Array([0])),this.reflectance=this.uploadReflectance(),r.pages.forEach((c,u)=>this.setPage(u,c)),k(i,"u_surfaces",this.zero),k(i,"u_cells",this.zero),k(i,"u_seen",this.zero)}bounds=he();opaque=[];transparent=[];reflectors=[];curved;surrounds=[];movers;unit;bytes=0;array;textures=[];normals=[];pages=[];shown=[];pageGroups=[];factors;emission;unlitWhite;sky;white;flat;zero;reflectance;kernels=new Map;isTransparent(e){let r=this.data.materials[e];return r.alphaMode===2||r.transmission>0}rangeOf(e,r,i,n){let o={first:e.length,count:r.length,material:i,page:n,bounds:he()},a=this.data.mesh.positions;for(let s=0;s<r.length;++s){let l=r[s];e.push(l),ne(o.bounds,a[3*l],a[3*l+1],a[3*l+2])}return o}facesInward(e,r){let i=this.data.mesh.positions,n=ae(r.bounds),o=s=>T([i[3*e[s]],i[3*e[s]+1],i[3*e[s]+2]],n),a=0;for(let s=r.first;s<r.first+r.count;s+=3)a+=D(o(s),O(o(s+1),o(s+2)));return a<0}sortRanges(){let e=this.data.mesh,r=[],i=e.parts.filter(o=>o.count>0).sort((o,a)=>o.material-a.material||o.page-a.page);for(let o of i){let a=this.rangeOf(r,e.indices.subarray(o.first,o.first+o.count),o.material,o.page),s=this.isTransparent(o.material);s&&this.transparent.push(a),(!s||He(this.data.materials[o.material]))&&this.opaque.push(a),ne(this.bounds,...a.bounds.lower),ne(this.bounds,...a.bounds.upper)}let n=new Map(this.transparent.map(o=>[o,this.facesInward(r,o)]));return this.transparent.sort((o,a)=>Number(n.get(a))-Number(n.get(o))),r}addReflector(e,r){let{gl:i}=this.device,n=this.data.reflectors[e],o=n.packFromReflector,a=It(o),s=Math.hypot(n.upper[0]-n.lower[0],n.upper[1]-n.lower[1]),l=[n.lower[0],n.upper[0],n.upper[0],n.lower[0]],c=[n.lower[1],n.lower[1],n.upper[1],n.upper[1]],u=this.rangeOf(r,n.indices,n.material,-1),h=[];for(let f of n.emitters)for(let p of Jr(this.data.emitters[f],this.data.mesh,this.data.materials))this.isTransparent(p.part.material)||h.push(this.rangeOf(r,p.indices,p.part.material,p.part.page));this.reflectors.push({index:e,material:n.material,first:u.first,count:u.count,packFromReflector:o,reflectorFromPack:a,corners:l.map((f,p)=>ee(o,[f,c[p],0])),size:s,flatness:n.flatness,dark:h,emitters:ct(i,n,this.data.emitters,a,s,this.unit),asked:!1,visible:!0})}uploadReflectance(){let e=this.data.fresnels,r=Math.max(1,...e.map(o=>o.table.length/3)),i=Math.max(e.length,1),n=new Float32Array(4*r*i);return e.forEach((o,a)=>{for(let s=0;s<o.table.length/3;++s)n.set(o.table.subarray(3*s,3*s+3),4*(a*r+s))}),F(this.device.gl,{width:r,height:i,format:this.device.gl.RGBA32F},n)}setPage(e,r){this.data.pages[e]=r,this.uploadPage(e)}setPageGroups(e){this.pageGroups[e.page]=e,this.uploadPage(e.page)}setLights(e){let{groups:r,emitters:i}=this.data,n=i.slice(),o=(a,s)=>a.map((l,c)=>l*s[c]);this.factors=e,r.forEach((a,s)=>{for(let l of a.materials)this.emission[l]=o(this.data.materials[l].emission,e[s]);for(let l of a.emitters)n[l]={...i[l],radiance:o(i[l].radiance,e[s])};a.sky&&(this.sky=o(this.data.sky,e[s]))}),this.data.day&&(this.sky=ui(this.data.day,e));for(let a of this.reflectors){let s=a.emitters;if(s){for(let l of[s.polygons,s.visibility,s.seen])this.device.gl.deleteTexture(l);a.emitters=ct(this.device.gl,this.data.reflectors[a.index],n,a.reflectorFromPack,a.size,this.unit)}}this.data.pages.forEach((a,s)=>this.uploadPage(s)),this.surrounds.forEach((a,s)=>{a.tint=be(r,e,"surrounds",s)}),this.movers.relight()}uploadPage(e){let r=ci(this.data.pages[e],this.pageGroups[e],this.factors);if(r===this.shown[e])return;this.shown[e]=r;let{gl:i}=this.device,n=this.pages[e];for(let l of[n?.light,n?.direction,n?.cells,n?.detail])l&&i.deleteTexture(l);this.bytes-=n?.bytes??0;let o=this.bytes,a=(l,c,u)=>(this.bytes+=l.byteLength,F(i,{width:c,height:u,format:i.RGB16F,min:i.LINEAR,mag:i.LINEAR},l)),s={light:a(r.light,r.width,r.height),scale:r.scale,bytes:0};r.direction&&(s.direction=a(r.direction,r.width,r.height)),r.detail&&r.cells&&(s.cells=F(i,{width:r.width,height:r.height,format:i.R32UI},r.cells),s.detail=a(r.detail,r.detailWidth,r.detailHeight),this.bytes+=r.cells.byteLength),s.bytes=this.bytes-o,this.pages[e]=s}setTexture(e,r,i){let{gl:n}=this.device,o=[n.REPEAT,n.CLAMP_TO_EDGE,n.MIRRORED_REPEAT],a=Math.floor(Math.log2(Math.max(r.width,r.height)))+1,s=F(n,{width:r.width,height:r.height,levels:a,format:i?n.RGBA8:n.SRGB8_ALPHA8,min:n.LINEAR_MIPMAP_LINEAR,mag:r.nearest?n.NEAREST:n.LINEAR,wrapS:o[r.wrapS],wrapT:o[r.wrapT]},r.texels),l=i?void 0:this.cutoffIn(e),c=r.texels,u=!1;for(let h=3;h<c.length&&l!==void 0&&!u;h+=4)u=c[h]<255;u?ri(r,l).forEach((h,f)=>{n.texSubImage2D(n.TEXTURE_2D,f+1,0,0,h.width,h.height,n.RGBA,n.UNSIGNED_BYTE,h.texels)}):n.generateMipmap(n.TEXTURE_2D),(i?this.normals:this.textures)[e]=s,this.bytes+=r.texels.byteLength*4/3}cutoffIn(e){let r;for(let i of this.data.materials)if(i.texture===e){if(i.alphaMode===0)return;if(i.alphaMode===2)r??=0;else if(!r){if(!(i.cutoff>0))return;r=i.alpha>0?i.cutoff/i.alpha:2}}return r}setSurround(e,r){this.surrounds[e]=bi(this.device.gl,r),this.surrounds[e].tint=be(this.data.groups,this.factors,"surrounds",e),this.bytes+=10*r.light.length}setNormals(e,r,i=!!this.data.mesh.normalUvs){let n=this.data.materials[r],o=n.normalTexture>=0&&i?this.normals[n.normalTexture]:void 0;e.set("u_normal_mapped",!!o),e.set("u_normal_scale",n.normalScale),k(this.device.gl,"u_normal_texture",o??this.flat)}kernel(e,r){let i=this.data.materials[e],n=`${i.kernel} ${i.fresnel} ${r}`,o=this.kernels.get(n);if(o)return o;let{gl:a}=this.device,s=this.data.kernels[i.kernel],l=this.data.fresnels[i.fresnel],c=Mi(s,r,l),u={taps:F(a,{width:c.count,height:c.rows,format:a.RGBA32F},c.texels),count:c.count,rows:c.rows,median:c.median};return s&&s.fits.length>0&&(u.lobes=F(a,{width:me,height:2,format:a.RGBA32F},Fi(s,l,c.means))),this.kernels.set(n,u),u}reflectanceOf(e){let r=this.data.fresnels[this.data.materials[e].fresnel]?.table;if(!r)return 0;let i=3*(r.length/6|0);return Math.max(r[i],r[i+1],r[i+2])}bindGeometry(){this.device.gl.bindVertexArray(this.array),k(this.device.gl,"u_reflectance",this.reflectance)}draw(e){let{gl:r}=this.device;r.drawElements(r.TRIANGLES,e.count,r.UNSIGNED_INT,4*e.first)}bindBase(e){k(this.device.gl,"u_base_texture",this.textures[e]??this.white)}picture(e){return this.data.emissionTextures.find(r=>r.material===e)}setReflectance(e,r){let i=this.data.materials[r].fresnel;e.set("u_reflectance_row",i),e.set("u_reflectance_count",i<0?1:this.data.fresnels[i].table.length/3)}setSurface(e,r,i=!!this.data.mesh.normalUvs){let{gl:n}=this.device,o=this.data.materials[r.material],a=this.pages[r.page];e.set("u_base_color",[...o.baseColor.map(c=>Math.min(Math.max(c,0),1)),o.alpha]),e.set("u_alpha_cutoff",se(o)),e.set("u_covers",o.alphaMode===2),e.set("u_diffuse_share",(1-o.metallic)*(1-o.transmission)),e.set("u_transmission",o.transmission);let s=this.picture(r.material),l=s&&this.textures[s.texture];e.set("u_emission",this.emission[r.material].map((c,u)=>c*this.unit*(l?pa(s.mean[u]):1))),k(n,"u_emission_texture",l??this.white),e.set("u_unlit",o.unlit),this.setReflectance(e,r.material),this.bindBase(o.texture),this.setNormals(e,r.material,i),k(n,"u_lightmap",a?.light??this.white),e.set("u_lightmap_scale",a?a.scale*this.unit:0),e.set("u_directional",!!a?.direction),k(n,"u_direction",a?.direction??a?.light??this.white),e.set("u_detailed",!!a?.detail),k(n,"u_cells",a?.cells??this.zero),k(n,"u_detail",a?.detail??this.white)}luxAt(e,r,i){let n=this.shown[e];if(!n)return 0;let o=Math.min(Math.floor(r*n.width),n.width-1),a=Math.min(Math.floor(i*n.height),n.height-1),s=3*(a*n.width+o);return n.scale*(.2126*Y(n.light[s])+.7152*Y(n.light[s+1])+.0722*Y(n.light[s+2]))}},pa=t=>t>0?1/t:0,Ti=254.5/255,He=t=>t.alphaMode===2&&t.alpha>=Ti&&t.transmission<=0,se=t=>He(t)?Ti:t.alphaMode===1?Math.max(t.cutoff,0):-1;var va=127,Ei=128,Ri={orders:2,mirrors:16,taps:48,largeOnly:!1},Ai={orders:0,mirrors:0,taps:12,largeOnly:!0},Si={orders:1,mirrors:1,taps:12,largeOnly:!0},ga=[[-.125,-.375],[.375,-.125],[-.375,.125],[.125,.375]],_t=16,ye=class{constructor(e){this.device=e;let r=e.gl,i=(n,o="")=>P.make(r,n,o);this.depth=i("depth"),this.plainDepth=i("depth","PLAIN"),this.opaque=i("scene"),this.plain=i("scene","PLAIN"),this.reflected=i("scene","REFLECTED"),this.transparent=i("transparent"),this.luminance=i("screen_luminance"),this.average=i("screen_average"),this.none=r.createVertexArray(),this.reflections=new Be(e,this,this.none)}frame;sums;mean;blocks;depth;plainDepth;opaque;plain;reflected;transparent;luminance;average;reflections;none;start(){for(let e of[this.plainDepth,this.plain,this.luminance,this.average])e.start()}startRest(){for(let e of[...this.reflections.programs,this.reflected,this.opaque,this.depth,this.transparent])e.start()}drawScreen(){let{gl:e}=this.device;e.bindVertexArray(this.none),e.drawArrays(e.TRIANGLES,0,3)}ensure(e,r){if(this.frame?.width===e&&this.frame.height===r)return this.frame;let{gl:i,color:n}=this.device;for(let l of[this.frame?.light,this.frame?.depth,...[...this.sums??[],this.mean].map(c=>c?.texture)])l&&i.deleteTexture(l);for(let l of[this.frame?.target,...[...this.sums??[],this.mean].map(c=>c?.target)])l&&i.deleteFramebuffer(l);let o=F(i,{width:e,height:r,format:n}),a=F(i,{width:e,height:r,format:i.DEPTH24_STENCIL8}),s=l=>{let c=F(i,{width:e,height:r,format:l});return{texture:c,target:re(i,c)}};return this.sums=[s(i.RGBA16F),s(i.RGBA16F)],this.mean=s(n),this.frame={width:e,height:r,light:o,depth:a,target:re(i,o,a)},this.frame}draw(e,r,i,n,o,a){let{gl:s}=this.device,l=this.ensure(i,n),c=Hr(r,i,n,e.movers.bounds(),o===void 0?[0,0]:ga[o%4]),u=()=>{s.bindFramebuffer(s.FRAMEBUFFER,l.target),s.viewport(0,0,i,n)};u(),this.clear([...e.sky.map(d=>d*e.unit),1]);let h=e.opaque.filter(d=>te(c.clipFromPack,d.bounds));this.drawDepth(e,c,h),e.movers.drawDepth(c);let f={view:c,begin:u,inFrame:!0,mirrors:0,reflectance:1,share:1,texture:l.light,values:0},p=this.reflections.drawMasks(e,f,a);for(let d of p)d.value>0&&this.reflections.draw(e,f,d,a);let m=this.reflections.curved.draw(e,f,a);u(),this.drawOpaque(e,c,h,new Set([...p.filter(d=>d.value>0).map(d=>d.reflector.material),...m.materials])),e.movers.drawLight(c,!1),this.drawTransparent(e,c);for(let d of p)d.value===0&&this.reflections.draw(e,f,d,a);u(),this.reflections.curved.add(e,f,m.later,a)}clear(e){let{gl:r}=this.device;A(r,{depthWrite:!0,stencilWrite:255}),r.clearColor(e[0],e[1],e[2],e[3]),r.clear(r.COLOR_BUFFER_BIT|r.DEPTH_BUFFER_BIT|r.STENCIL_BUFFER_BIT)}drawDepth(e,r,i){e.bindGeometry();for(let n of i){let o=e.data.materials[n.material],a=se(o)<0?this.plainDepth:this.depth;A(this.device.gl,{depthTest:!0,depthWrite:!0,color:!1,cull:!o.doubleSided,mirrored:r.mirrored}),a.use(),a.set("u_clip_from_pack",r.clipFromPack),a.set("u_alpha",o.alpha),a.set("u_alpha_cutoff",se(o)),e.bindBase(o.texture),e.draw(n)}}setFrame(e,r,i,n){e.use(),e.set("u_clip_from_pack",i.clipFromPack),e.set("u_eye",i.eye),e.set("u_change_scale",[0,0]),e.set("u_alpha_kind",n?i.ortho?2:1:0);let o=i.viewFromPack;e.set("u_depth_row",[-o[2],-o[6],-o[10],-o[14]]),e.set("u_closest",this.device.closest),r.bindGeometry()}drawRanges(e,r,i,n,o,a,s){let{gl:l}=this.device;for(let c of[n,this.opaque])this.setFrame(c,e,r,s);for(let c of i){let u=e.data.materials[c.material],h=He(u),f=o.has(c.material)||h&&!s,p=h?Ei:va,m=u.normalTexture<0&&se(u)<0&&!u.unlit&&!e.picture(c.material)?n:this.opaque;m.use(),e.setSurface(m,c),m.set("u_weights",[1,1,1]),A(l,{...a,cull:!u.doubleSided,stencilRead:p,stencilFunc:f?l.EQUAL:void 0}),e.draw(c),f&&(m.set("u_weights",[1,0,1]),A(l,{...a,cull:!u.doubleSided,stencilRead:p,stencilFunc:l.NOTEQUAL,blend:s?void 0:"add"}),e.draw(c))}}drawOpaque(e,r,i,n){this.drawRanges(e,r,i,this.plain,n,{depthTest:!0},!1)}drawReflected(e,r,i,n,o){let a={depthTest:!0,depthWrite:!0,mirrored:r.mirrored};this.drawRanges(e,r,i,this.reflected,o,a,!0);for(let s of n){let l=e.data.materials[s.material],c=l.normalTexture<0&&se(l)<0&&!l.unlit?this.reflected:this.opaque;c.use(),e.setSurface(c,s),c.set("u_weights",[1,1,0]),A(this.device.gl,{...a,cull:!l.doubleSided}),e.draw(s)}}drawTransparent(e,r){let{gl:i}=this.device,n=r.viewFromPack,o=s=>{let l=ae(s.bounds);return n[2]*l[0]+n[6]*l[1]+n[10]*l[2]},a=e.transparent.filter(s=>te(r.clipFromPack,s.bounds)).sort((s,l)=>o(s)-o(l));if(a.length!==0){this.setFrame(this.transparent,e,r,!1);for(let s of a){e.setSurface(this.transparent,s);let l=e.data.materials[s.material],c=l.alphaMode===2&&l.transmission<=0,u={depthTest:!0,alpha:!1,mirrored:r.mirrored,stencilRead:Ei,cull:!l.doubleSided},h=(p,m,d)=>{A(i,{...u,...p}),this.transparent.set("u_dimming",m),this.transparent.set("u_weights",[1,d,1]),e.draw(s)};c||h({blend:"multiply"},!0,0);let f=c?"cover":"add";h({blend:f,stencilFunc:r.mirrored?void 0:i.EQUAL},!1,1),r.mirrored||h({blend:f,stencilFunc:i.NOTEQUAL},!1,0)}}}white=1.2;addToMean(e,r){let{gl:i}=this.device,n=this.frame;i.bindFramebuffer(i.FRAMEBUFFER,this.mean.target),i.viewport(0,0,n.width,n.height),A(i,r?{}:{blend:"add"}),r||i.blendFunc(i.ONE,i.ONE),this.average.use(),this.average.set("u_share",e),this.average.set("u_encode",!1),this.average.set("u_before_weight",0),this.average.set("u_scale",[1,1]),k(i,"u_frame",n.light),this.drawScreen(),this.average.set("u_share",0)}show(e,r,i,n,o=!0){let a=this.frame.width!==i||this.frame.height!==n,{gl:s}=this.device,l=this.frame,[c,u]=this.sums;A(s,{}),this.average.use(),this.average.set("u_exposure",1/(this.white*e.unit)),this.average.set("u_unlit_exposure",1/(e.unlitWhite*e.unit)),this.average.set("u_count",r+1),k(s,"u_frame",l.light),k(s,"u_before",c.texture),this.average.set("u_before_weight",r),this.average.set("u_encode",!1),this.average.set("u_scale",[1,1]),s.bindFramebuffer(s.FRAMEBUFFER,u.target),s.viewport(0,0,l.width,l.height),this.drawScreen(),this.sums=[u,c],o&&(k(s,"u_before",u.texture),this.average.set("u_scale",a?[l.width/i,l.height/n]:[1,1]),this.average.set("u_before_weight",1),this.average.set("u_encode",!0),s.bindFramebuffer(s.FRAMEBUFFER,null),s.viewport(0,0,i,n),this.drawScreen())}meter(e,r=!1){let{gl:i}=this.device,n=this.frame,o=Math.ceil(n.width/_t),a=Math.ceil(n.height/_t);if(this.blocks?.width!==o||this.blocks.height!==a){let c=F(i,{width:o,height:a,format:this.device.color});this.blocks={width:o,height:a,texture:c,target:re(i,c)}}i.bindFramebuffer(i.FRAMEBUFFER,this.blocks.target),i.viewport(0,0,o,a),A(i,{}),this.luminance.use(),k(i,"u_frame",r?this.mean.texture:n.light),this.luminance.set("u_frame_size",[n.width,n.height]),this.luminance.set("u_block",_t),this.drawScreen();let s=new Float32Array(4*o*a);i.readPixels(0,0,o,a,i.RGBA,i.FLOAT,s);let l=_a(s,o,a);return l===void 0?void 0:l-Math.log2(e.unit)}};function _a(t,e,r){let i=[],n=0;for(let c=0;c<e*r;++c){let u=t[4*c],h=t[4*c+1];if(!(h>0)||!Number.isFinite(u))continue;let f=(2*(c%e)+1)/e-1,p=(2*Math.floor(c/e)+1)/r-1,m=h*(.1+Math.exp(-.5*(f*f+p*p)/.25));i.push({log:u/h,weight:m}),n+=m}if(i.length===0)return;i.sort((c,u)=>c.log-u.log);let o=0,a=i[i.length-1].log;for(let c of i)if(o+=c.weight,o>=.9*n){a=c.log;break}let s=0,l=0;for(let c of i)c.log>=a-7&&(s+=c.log*c.weight,l+=c.weight);return s/l}var qe=class{constructor(e){this.grids=e;this.eyeHeight=e[0]?.eyeHeight??1.6,this.step=.4*this.eyeHeight/1.6,this.beside=this.eyeHeight/1.6}eyeHeight;step;beside;eyeOf(e,r){let i=this.grids[e];return[i.lower[0]+(r%i.width+.5)*i.cell,i.floor[r]+i.eyeHeight,i.lower[1]+(Math.floor(r/i.width)+.5)*i.cell]}stand(e,r,i,n=this.step){let o;return this.grids.forEach((a,s)=>{let l=Math.floor((e-a.lower[0])/a.cell),c=Math.floor((r-a.lower[1])/a.cell),u=c*a.width+l;if(!(l>=0&&c>=0&&l<a.width&&c<a.height)||!a.walkable[u])return;let h=this.eyeOf(s,u);h[1]<=i+n&&(!o||h[1]>o.eye[1])&&(o={grid:s,cell:u,eye:h})}),o}nearest(e,r,i=(n,o)=>e[1]>n&&e[1]<=o+2*this.step){let n,o=r;return this.grids.forEach((a,s)=>{for(let l=0;l<a.floor.length;++l){if(!a.walkable[l]||!i(a.floor[l],a.floor[l]+a.eyeHeight))continue;let c=this.eyeOf(s,l),u=Math.hypot(c[0]-e[0],c[2]-e[2]);u<o&&(o=u,n={grid:s,cell:l,eye:c})}}),n}distance(e){let r=this.nearest(e,this.beside);return r?Math.hypot(r.eye[0]-e[0],r.eye[2]-e[2]):1/0}walk(e,r,i,n){let o=(this.stand(e[0],e[2],e[1])??this.stand(e[0],e[2],e[1]+this.eyeHeight,0))?.eye[1];if(o===void 0){let g=this.distance(e);if(n.fall=0,g===1/0||this.stand(r[0],r[2],e[1])||this.distance(r)<g)return r;for(let y of[[r[0],e[1],e[2]],[e[0],e[1],r[2]]])if((y[0]!==e[0]||y[2]!==e[2])&&this.distance(y)<=g)return y;return e}let a=1/0,s=this.step;for(let g of this.grids)a=Math.min(a,g.cell),s=Math.max(s,g.cell);let l=[r[0]-e[0],r[2]-e[2]],c=Math.hypot(...l)/(.5*a),u=Math.min(Math.max(Math.ceil(c),1),64),h=Math.max(u,c),f=e[0],p=e[2],m=o,d=(g,y)=>{let w=this.stand(f+g,p+y,m,s);return!w||m-w.eye[1]>s?!1:(f+=g,p+=y,m=w.eye[1],!0)},v=l[0]/h,b=l[1]/h;for(let g=0;g<u&&!(!d(v,b)&&!d(v,0)&&!d(0,b));++g);let _=e[1];return _-m>2*this.step?(n.fall+=9.81*this.beside*i,_=Math.max(_-n.fall*i,m)):(n.fall=0,_+=(m-_)*(1-Math.exp(-i/.08)),Math.abs(m-_)<.001*this.step&&(_=m)),[f,_,p]}way(e,r){let i=this.stand(e[0],e[2],e[1])??this.nearest(e,this.beside);if(!i)return[];let n=u=>u.grid*2**30+u.cell,o=new Map([[n(i),void 0]]),a=[i],s=i,l=1/0;for(let u=0;u<a.length;++u){let h=a[u],f=this.grids[h.grid],p=Math.hypot(h.eye[0]-r[0],h.eye[1]-this.grids[h.grid].eyeHeight-r[1],h.eye[2]-r[2]);p<l&&(l=p,s=h);for(let[m,d]of[[1,0],[-1,0],[0,1],[0,-1],[1,1],[1,-1],[-1,1],[-1,-1]]){let v=this.stand(h.eye[0]+m*f.cell,h.eye[2]+d*f.cell,h.eye[1],Math.max(this.step,f.cell));!v||h.eye[1]-v.eye[1]>Math.max(this.step,f.cell)||o.has(n(v))||m&&d&&(!this.stand(h.eye[0]+m*f.cell,h.eye[2],h.eye[1])||!this.stand(h.eye[0],h.eye[2]+d*f.cell,h.eye[1]))||(o.set(n(v),h),a.push(v))}}let c=[];for(let u=s;u&&n(u)!==n(i);u=o.get(n(u)))c.push(u.eye);return c}};var ba=2,ya=3,Li=1.55,bt=t=>Math.atan2(-t[0],-t[2]),Pi=t=>Math.asin(Math.min(Math.max(t[1]/Math.max(j(t),1e-12),-1),1)),Gi=(t,e)=>[-Math.sin(t)*Math.cos(e),Math.sin(e),-Math.cos(t)*Math.cos(e)],Xe=class{camera;cameras;path;floors;origin;state={fall:0};way=[];tour;place=0;clock;constructor(e){this.floors=new qe(e.grids),this.origin=e.mesh.origin,this.path=e.paths.find(n=>n.keys.length>1),this.cameras=e.cameras.length>0?e.cameras:[this.somewhere(e)],this.camera={...this.fromHash()??this.cameras[0]};let r=Number(new URLSearchParams(location.hash.slice(1)).get("time")??NaN),i=Number.isFinite(r);this.clock={seconds:i?Math.max(r,0):0,runs:!i&&!matchMedia("(prefers-reduced-motion: reduce)").matches}}somewhere(e){let r=e.grids.findIndex(n=>n.walkable.some(o=>o>0));return{name:"start",eye:r<0?[0,1.6,0]:this.floors.eyeOf(r,e.grids[r].walkable.indexOf(1)),forward:[0,0,-1],up:[0,1,0],fov:1.05,halfHeight:0}}fromHash(){let e=new URLSearchParams(location.hash.slice(1)).get("camera");if(!e)return;let r=this.cameras.find(a=>a.name===e);if(r)return r;let i=e.split(",").map(Number);if(i.length<5||i.length>6||!i.every(Number.isFinite))return;let n=i[5]===void 0?60:Math.min(Math.max(i[5],10),120),o=Math.PI/180;return{name:"",eye:T(i.slice(0,3),this.origin),forward:Gi(i[3]*o,i[4]*o),up:[0,1,0],fov:n*o,halfHeight:0}}toHash(){let e=this.camera,r=I(e.eye,this.origin),i=180/Math.PI;return`#camera=${[...r.map(o=>o.toFixed(3)),...[bt(e.forward),Pi(e.forward),e.fov].map(o=>(o*i).toFixed(2))].join(",")}`}jump(e){this.camera={...e},this.way=[],this.tour=void 0,this.state.fall=0}goTo(e,r){return this.tour=void 0,this.way=this.floors.way(this.camera.eye,e),r&&this.way[0]&&this.jump({...this.camera,eye:this.way[0]}),this.way.length>0||r}get touring(){return this.tour!==void 0}toggleTour(){this.tour=this.touring||!this.path?void 0:this.path.keys[0].time,this.way=[]}step(e,r){let i={...this.camera},n=e.right!==0||e.ahead!==0,o=e.yaw!==0||e.pitch!==0;if(n&&(this.way=[]),(n||o)&&(this.tour=void 0),this.touring&&this.alongPath(r),o){let s=Math.min(Math.max(Pi(this.camera.forward)-e.pitch,-Li),Li);this.camera.forward=Gi(bt(this.camera.forward)-e.yaw,s),this.camera.up=[0,1,0]}!this.touring&&(n||this.way.length>0||this.state.fall>0||this.settling)&&this.walk(e,r);let a=(s,l)=>s.some((c,u)=>c!==l[u]);return a(i.eye,this.camera.eye)||a(i.forward,this.camera.forward)}settling=!1;walk(e,r){let i=ba*this.floors.eyeHeight*(e.fast?ya:1)/1.6,n=this.camera.eye,o=[...n];if(this.way.length>0){let a=i*1.5*r;for(;this.way.length>0&&a>0;){let s=this.way[this.way.length-1],l=[s[0]-o[0],s[2]-o[2]],c=Math.hypot(...l),u=c>a?a/c:1;o=[o[0]+l[0]*u,o[1],o[2]+l[1]*u],a-=c,u===1&&this.way.pop()}}else{let a=bt(this.camera.forward),s=Math.max(Math.hypot(e.right,e.ahead),1),l=i*r/s;o[0]+=(Math.cos(a)*e.right-Math.sin(a)*e.ahead)*l,o[2]+=(-Math.sin(a)*e.right-Math.cos(a)*e.ahead)*l}this.camera.eye=this.floors.grids.length>0?this.floors.walk(n,o,r,this.state):o,this.settling=this.camera.eye[1]!==n[1]}alongPath(e){let r=this.path.keys,i=r[r.length-1];this.tour+=e,this.tour>=i.time&&(this.tour=void 0);let n=this.tour??i.time,o=Math.max(1,r.findIndex(u=>u.time>=n)),a=r[o-1],s=r[o],l=Math.min(Math.max((n-a.time)/Math.max(s.time-a.time,1e-9),0),1),c=(u,h)=>u.map((f,p)=>f+(h[p]-f)*l);this.camera={name:"",eye:c(a.eye,s.eye),forward:$(c(a.forward,s.forward),a.forward),up:[0,1,0],fov:this.path.fov,halfHeight:0}}};var xa=ArrayBuffer,G=Uint8Array,je=Uint16Array,wa=Int16Array;var Ke=Int32Array,yt=function(t,e,r){if(G.prototype.slice)return G.prototype.slice.call(t,e,r);(e==null||e<0)&&(e=0),(r==null||r>t.length)&&(r=t.length);var i=new G(r-e);return i.set(t.subarray(e,r)),i},we=function(t,e,r,i){if(G.prototype.fill)return G.prototype.fill.call(t,e,r,i);for((r==null||r<0)&&(r=0),(i==null||i>t.length)&&(i=t.length);r<i;++r)t[r]=e;return t},ka=function(t,e,r,i){if(G.prototype.copyWithin)return G.prototype.copyWithin.call(t,e,r,i);for((r==null||r<0)&&(r=0),(i==null||i>t.length)&&(i=t.length);r<i;)t[e++]=t[r++]};var Ma=["invalid zstd data","window size too large (>2046MB)","invalid block type","FSE accuracy too high","match distance too far back","unexpected EOF"],B=function(t,e,r){var i=new Error(e||Ma[t]);if(i.code=t,Error.captureStackTrace&&Error.captureStackTrace(i,B),!r)throw i;return i},zi=function(t,e,r){for(var i=0,n=0;i<r;++i)n|=t[e++]<<(i<<3);return n},Fa=function(t,e){return(t[e]|t[e+1]<<8|t[e+2]<<16|t[e+3]<<24)>>>0},Ta=function(t,e){var r=t[0]|t[1]<<8|t[2]<<16;if(r==3126568&&t[3]==253){var i=t[4],n=i>>5&1,o=i>>2&1,a=i&3,s=i>>6;i&8&&B(0);var l=6-n,c=a==3?4:a,u=zi(t,l,c);l+=c;var h=s?1<<s:n,f=zi(t,l,h)+(s==1&&256),p=f;if(!n){var m=1<<10+(t[5]>>3);p=m+(m>>3)*(t[5]&7)}p>2145386496&&B(1);var d=new G((e==1?f||p:e?0:p)+12);return d[0]=1,d[4]=4,d[8]=8,{b:l+h,y:0,l:0,d:u,w:e&&e!=1?e:d.subarray(12),e:p,o:new Ke(d.buffer,0,3),u:f,c:o,m:Math.min(131072,p)}}else if((r>>4|t[3]<<20)==25481893)return Fa(t,4)+8;B(0)},ue=function(t){for(var e=0;1<<e<=t;++e);return e-1},ke=function(t,e,r){var i=(e<<3)+4,n=(t[e]&15)+5;n>r&&B(3);for(var o=1<<n,a=o,s=-1,l=-1,c=-1,u=o,h=new xa(512+(o<<2)),f=new wa(h,0,256),p=new je(h,0,256),m=new je(h,512,o),d=512+(o<<1),v=new G(h,d,o),b=new G(h,d+o);s<255&&a>0;){var _=ue(a+1),g=i>>3,y=(1<<_+1)-1,w=(t[g]|t[g+1]<<8|t[g+2]<<16)>>(i&7)&y,x=(1<<_)-1,z=y-a-1,C=w&x;if(C<z?(i+=_,w=C):(i+=_+1,w>x&&(w-=z)),f[++s]=--w,w==-1?(a+=w,v[--u]=s):a-=w,!w)do{var X=i>>3;l=(t[X]|t[X+1]<<8)>>(i&7)&3,i+=2,s+=l}while(l==3)}(s>255||a)&&B(0);for(var U=0,W=(o>>1)+(o>>3)+3,J=o-1,K=0;K<=s;++K){var R=f[K];if(R<1){p[K]=-R;continue}for(c=0;c<R;++c){v[U]=K;do U=U+W&J;while(U>=u)}}for(U&&B(0),c=0;c<o;++c){var M=p[v[c]]++,H=b[c]=n-ue(M);m[c]=(M<<H)-o}return[i+7>>3,{b:n,s:v,n:b,t:m}]},Ea=function(t,e){var r=0,i=-1,n=new G(292),o=t[e],a=n.subarray(0,256),s=n.subarray(256,268),l=new je(n.buffer,268);if(o<128){var c=ke(t,e+1,6),u=c[0],h=c[1];e+=o;var f=u<<3,p=t[e];p||B(0);for(var m=0,d=0,v=h.b,b=v,_=(++e<<3)-8+ue(p);_-=v,!(_<f);){var g=_>>3;if(m+=(t[g]|t[g+1]<<8)>>(_&7)&(1<<v)-1,a[++i]=h.s[m],_-=b,_<f)break;g=_>>3,d+=(t[g]|t[g+1]<<8)>>(_&7)&(1<<b)-1,a[++i]=h.s[d],v=h.n[m],m=h.t[m],b=h.n[d],d=h.t[d]}++i>255&&B(0)}else{for(i=o-127;r<i;r+=2){var y=t[++e];a[r]=y>>4,a[r+1]=y&15}++e}var w=0;for(r=0;r<i;++r){var x=a[r];x>11&&B(0),w+=x&&1<<x-1}var z=ue(w)+1,C=1<<z,X=C-w;for(X&X-1&&B(0),a[i++]=ue(X)+1,r=0;r<i;++r){var x=a[r];++s[a[r]=x&&z+1-x]}var U=new G(C<<1),W=U.subarray(0,C),J=U.subarray(C);for(l[z]=0,r=z;r>0;--r){var K=l[r];we(J,r,K,l[r-1]=K+s[r]*(1<<z-r))}for(l[0]!=C&&B(0),r=0;r<i;++r){var R=a[r];if(R){var M=l[R];we(W,r,M,l[R]=M+(1<<z-R))}}return[e,{n:J,b:z,s:W}]},Ra=ke(new G([81,16,99,140,49,198,24,99,12,33,196,24,99,102,102,134,70,146,4]),0,6)[1],Aa=ke(new G([33,20,196,24,99,140,33,132,16,66,8,33,132,16,66,8,33,68,68,68,68,68,68,68,68,36,9]),0,6)[1],Sa=ke(new G([32,132,16,66,102,70,68,68,68,68,36,73,2]),0,5)[1],Vi=function(t,e){for(var r=t.length,i=new Ke(r),n=0;n<r;++n)i[n]=e,e+=1<<t[n];return i},xt=new G(new Ke([0,0,0,0,16843009,50528770,134678020,202050057,269422093]).buffer,0,36),La=Vi(xt,0),wt=new G(new Ke([0,0,0,0,0,0,0,0,16843009,50528770,117769220,185207048,252579084,16]).buffer,0,53),Pa=Vi(wt,3),xe=function(t,e,r){var i=t.length,n=e.length,o=t[i-1],a=(1<<r.b)-1,s=-r.b;o||B(0);for(var l=0,c=r.b,u=(i<<3)-8+ue(o)-c,h=-1;u>s&&h<n;){var f=u>>3,p=(t[f]|t[f+1]<<8|t[f+2]<<16)>>(u&7);l=(l<<c|p)&a,e[++h]=r.s[l],u-=c=r.n[l]}(u!=s||h+1!=n)&&B(0)},Ga=function(t,e,r){var i=6,n=e.length,o=n+3>>2,a=o<<1,s=o+a;xe(t.subarray(i,i+=t[0]|t[1]<<8),e.subarray(0,o),r),xe(t.subarray(i,i+=t[2]|t[3]<<8),e.subarray(o,a),r),xe(t.subarray(i,i+=t[4]|t[5]<<8),e.subarray(a,s),r),xe(t.subarray(i),e.subarray(s),r)},za=function(t,e,r){var i,n=e.b,o=t[n],a=o>>1&3;e.l=o&1;var s=o>>3|t[n+1]<<5|t[n+2]<<13,l=(n+=3)+s;if(a==1)return n>=t.length?void 0:(e.b=n+1,r?(we(r,t[n],e.y,e.y+=s),r):we(new G(s),t[n]));if(!(l>t.length)){if(a==0)return e.b=l,r?(r.set(t.subarray(n,l),e.y),e.y+=s,r):yt(t,n,l);if(a==2){var c=t[n],u=c&3,h=c>>2&3,f=c>>4,p=0,m=0;u<2?h&1?f|=t[++n]<<4|(h&2&&t[++n]<<12):f=c>>3:(m=h,h<2?(f|=(t[++n]&63)<<4,p=t[n]>>6|t[++n]<<2):h==2?(f|=t[++n]<<4|(t[++n]&3)<<12,p=t[n]>>2|t[++n]<<6):(f|=t[++n]<<4|(t[++n]&63)<<12,p=t[n]>>6|t[++n]<<2|t[++n]<<10)),++n;var d=r?r.subarray(e.y,e.y+e.m):new G(e.m),v=d.length-f;if(u==0)d.set(t.subarray(n,n+=f),v);else if(u==1)we(d,t[n++],v);else{var b=e.h;if(u==2){var _=Ea(t,n);p+=n-(n=_[0]),e.h=b=_[1]}else b||B(0);(m?Ga:xe)(t.subarray(n,n+=p),d.subarray(v),b)}var g=t[n++];if(g){g==255?g=(t[n++]|t[n++]<<8)+32512:g>127&&(g=g-128<<8|t[n++]);var y=t[n++];y&3&&B(0);for(var w=[Aa,Sa,Ra],x=2;x>-1;--x){var z=y>>(x<<1)+2&3;if(z==1){var C=new G([0,0,t[n++]]);w[x]={s:C.subarray(2,3),n:C.subarray(0,1),t:new je(C.buffer,0,1),b:0}}else z==2?(i=ke(t,n,9-(x&1)),n=i[0],w[x]=i[1]):z==3&&(e.t||B(0),w[x]=e.t[x])}var X=e.t=w,U=X[0],W=X[1],J=X[2],K=t[l-1];K||B(0);var R=(l<<3)-8+ue(K)-J.b,M=R>>3,H=0,Te=(t[M]|t[M+1]<<8)>>(R&7)&(1<<J.b)-1;M=(R-=W.b)>>3;var Ee=(t[M]|t[M+1]<<8)>>(R&7)&(1<<W.b)-1;M=(R-=U.b)>>3;var Re=(t[M]|t[M+1]<<8)>>(R&7)&(1<<U.b)-1;for(++g;--g;){var it=J.s[Te],Pt=J.n[Te],nt=U.s[Re],Gt=U.n[Re],zt=W.s[Ee],Vt=W.n[Ee];M=(R-=zt)>>3;var Dt=1<<zt,le=Dt+((t[M]|t[M+1]<<8|t[M+2]<<16|t[M+3]<<24)>>>(R&7)&Dt-1);M=(R-=wt[nt])>>3;var pe=Pa[nt]+((t[M]|t[M+1]<<8|t[M+2]<<16)>>(R&7)&(1<<wt[nt])-1);M=(R-=xt[it])>>3;var Ae=La[it]+((t[M]|t[M+1]<<8|t[M+2]<<16)>>(R&7)&(1<<xt[it])-1);if(M=(R-=Pt)>>3,Te=J.t[Te]+((t[M]|t[M+1]<<8)>>(R&7)&(1<<Pt)-1),M=(R-=Gt)>>3,Re=U.t[Re]+((t[M]|t[M+1]<<8)>>(R&7)&(1<<Gt)-1),M=(R-=Vt)>>3,Ee=W.t[Ee]+((t[M]|t[M+1]<<8)>>(R&7)&(1<<Vt)-1),le>3)e.o[2]=e.o[1],e.o[1]=e.o[0],e.o[0]=le-=3;else{var Se=le-(Ae!=0);Se?(le=Se==3?e.o[0]-1:e.o[Se],Se>1&&(e.o[2]=e.o[1]),e.o[1]=e.o[0],e.o[0]=le):le=e.o[0]}for(var x=0;x<Ae;++x)d[H+x]=d[v+x];H+=Ae,v+=Ae;var ve=H-le;if(ve<0){var ge=-ve,_n=e.e+ve;ge>pe&&(ge=pe);for(var x=0;x<ge;++x)d[H+x]=e.w[_n+x];H+=ge,pe-=ge,ve=0}for(var x=0;x<pe;++x)d[H+x]=d[ve+x];H+=pe}if(H!=v)for(;v<d.length;)d[H++]=d[v++];else H=d.length;r?e.y+=H:d=yt(d,0,H)}else if(r){if(e.y+=f,v)for(var x=0;x<f;++x)d[x]=d[v+x]}else v&&(d=yt(d,v));return e.b=l,d}B(2)}},Va=function(t,e){if(t.length==1)return t[0];for(var r=new G(e),i=0,n=0;i<t.length;++i){var o=t[i];r.set(o,n),n+=o.length}return r};function Di(t,e){for(var r=[],i=+!e,n=0,o=0;t.length;){var a=Ta(t,i||e);if(typeof a=="object"){for(i?(e=null,a.w.length==a.u&&(r.push(e=a.w),o+=a.u)):(r.push(e),a.e=0);!a.l;){var s=za(t,a,e);s||B(5),e?a.e=a.y:(r.push(s),o+=s.length,ka(a.w,0,s.length),a.w.set(s,a.w.length-s.length))}n=a.b+a.c*4}else n=a;t=t.subarray(n)}return Va(r,o)}var Qe=64,q=32768,Bi=1983;function N(t){return t.floats(3)}function Ci(t,e){let r=new Float32Array(t.length*e);for(let i=0;i<t.length;++i){let n=t[i],o=Math.max(n<<16>>16,-32767)/32767,a=Math.max(n>>16,-32767)/32767,s=1-Math.abs(o)-Math.abs(a);s<0&&([o,a]=[(1-Math.abs(a))*(o<0?-1:1),(1-Math.abs(o))*(a<0?-1:1)]);let l=Math.hypot(o,a,s);r[e*i]=o/l,r[e*i+1]=a/l,r[e*i+2]=s/l}return r}function Ze(t){let e=[t.f64(),t.f64(),t.f64()],r=t.u32(),i=t.u32(),n=t.u32(),o=t.size(3,"mesh flags");i%3!==0&&t.fail(`found ${i} indices, expected triangles`);let a={origin:e,positions:t.planesF32(r,3),normals:Ci(t.planesU32(r),3),uvs:t.planesF32(r,2),lightmapUvs:t.planesF32(r,2),indices:new Uint32Array,parts:[]};if(o&1&&(a.colors=t.planes(r,4)),o&2){a.normalUvs=t.planesF32(r,2),a.tangents=Ci(t.planesU32(r),4);let s=new Int8Array(t.planes(r,1).buffer);for(let l=0;l<r;++l)a.tangents[4*l+3]=s[l]}a.indices=t.planesU32(i);for(let s=0,l=0;s<i;++s)l=l+a.indices[s]>>>0,l>=r&&t.fail(`found index ${l} of ${r} vertices`),a.indices[s]=l;for(let s=0;s<n;++s){let l={name:t.text(),first:t.u32(),count:t.u32(),material:t.u32(),page:t.i32()};(l.first%3||l.count%3||l.first+l.count>i)&&t.fail(`found part '${l.name}' outside the indices`),a.parts.push(l)}return a}var Ii=t=>({material:t.u32(),texture:t.u32(),mean:t.floats(3)});function Oi(t){let e=t.text(),r=t.floats(3),i=t.f32(),n=t.i32(),o=t.choice(2,"alpha mode"),a=t.choice(1,"flag")>0,s=t.choice(1,"flag")>0;t.choice(0,"reserved byte");let l=t.f32(),c=t.f32();return t.floats(5),{name:e,baseColor:r,alpha:i,texture:n,alphaMode:o,doubleSided:a,unlit:s,cutoff:l,metallic:c,transmission:t.f32(),emission:t.floats(3),kernel:t.i32(),fresnel:t.i32(),normalTexture:t.i32(),normalScale:t.f32()}}function kt(t){t.text();let e=t.size(q,"width"),r=t.size(q,"height"),i=t.choice(2,"wrap"),n=t.choice(2,"wrap"),o=t.choice(1,"filter")>0;return t.choice(0,"reserved byte"),(!e||!r)&&t.fail("found a texture without texels"),{width:e,height:r,wrapS:i,wrapT:n,nearest:o,texels:t.planes(e*r,4)}}function Ye(t,e,r){let i=t.planesU16(e,3);for(let n of i)((n&31744)===31744||!r&&n>32768)&&t.fail("found light that is negative or no number");return i}function de(t){let e=t.i32();return(e<-94||e>112)&&t.fail(`found exponent ${e}, expected -94 to 112`),e}function $i(t){let e=t.size(q,"width"),r=t.size(q,"height"),i=t.size(1,"lightmap flags"),n=t.size(16384,"details"),o=t.size(16384,"details"),a={width:e,height:r,detailWidth:n,detailHeight:o,scale:2**de(t),light:Ye(t,e*r,!1)};if((!e||!r)&&t.fail("found a page without texels"),i&1&&(a.direction=Ye(t,e*r,!0)),n>0){a.cells=t.planesU32(e*r);for(let s of a.cells){let l=s>>>28;s!==0&&(l<1||l>5||(s&16383)+(1<<l)>=n||(s>>>14&16383)+(1<<l)>=o)&&t.fail("found a cell outside of the image of details")}a.detail=Ye(t,n*o,!1)}return de(t),Ye(t,e*r,!1),t.planes(e*r,1),a}function Ni(t){let e=t.text(),r=t.u32(),i=new Float64Array(t.floats(16)),n=t.floats(2),o=t.floats(2);t.f32();let a=t.f32();t.u32s(4);let s=t.u32s(t.count(4)),l=t.size(64,"emitters"),c=t.size(q,"nodes"),u=t.size(q,"nodes");return l>0&&(c<2||u<2)&&t.fail("found emitters without nodes"),{name:e,material:r,packFromReflector:i,lower:n,upper:o,flatness:a,indices:s,nodesX:c,nodesY:u,emitters:t.u32s(l),visibility:t.planes(c*u*l,1)}}function Wi(t){let e=t.choice(4,"corners"),r=t.choice(1,"flag")>0;return e<3&&t.fail(`found ${e} corners, expected 3 or 4`),{twoSided:r,radiance:t.floats(3),corners:Array.from({length:e},()=>N(t))}}function Da(t,e){let r=t.f32();t.floats(3);let i=t.f32(),n=t.floats(2),o=t.floats(2),a=t.floats(2);t.f32(),t.planesU16(t.count(2));let s=t.planesU16(e*(e+1)/2),l=new Float32Array(e*e),c=0;for(let u=0;u<e;++u)for(let h=(e-1)/2;h<e;++h){let f=Y(s[c++]);f>=0&&f<=1||t.fail("found a weight outside 0 to 1"),l[u*e+h]=l[u*e+e-1-h]=f}return{cosTheta:r,shift:i,width:n,lower:o,upper:a,weights:l}}function Hi(t){t.choice(2,"kernel model"),t.u8(),t.u8(),t.u8(),t.floats(2);let e=t.f32();t.f32();let r=t.size(q,"kernel size"),i=t.planesF32(r*r),n=t.size(q,"slice size"),o=t.count(4);(o>256||o>0&&n%2===0)&&t.fail(`found ${o} slices of ${n}`);let a=Array.from({length:o},()=>Da(t,n)),s=t.count(20);return s!==0&&s!==o&&t.fail(`found ${s} cosine lobes of ${o} slices`),{size:r,halfExtent:e,weights:i,sliceSize:n,slices:a,fits:Array.from({length:s},()=>t.floats(5))}}function qi(t){t.f32();let e=t.u32(),r=t.u32(),i=t.size(q,"sphere");e<2&&t.fail("found a reflectance of fewer than two angles");let n={table:t.planesF32(e,3),factor:t.planesF32(r,3)};return t.planesF32(i*i,3),n}function Xi(t){return{name:t.text(),eye:N(t),forward:N(t),up:N(t),fov:t.f32(),halfHeight:t.f32()}}function ji(t){let e=t.text(),r=t.f32(),i=t.count(28);return{name:e,fov:r,keys:Array.from({length:i},()=>({time:t.f32(),eye:N(t),forward:N(t)}))}}function Ki(t){let e=t.floats(2),r=t.f32(),i=t.f32(),n=t.size(q,"width"),o=t.size(q,"height");return r>0||t.fail("found a walk grid without cells"),{lower:e,cell:r,eyeHeight:i,width:n,height:o,walkable:t.planes(n*o,1),floor:t.planesF32(n*o)}}function Mt(t,e){let r=()=>({position:N(t),rotation:t.floats(4)}),i=r(),n=S(t,t.count(32),()=>({time:t.f32(),pose:r()}));return n.forEach((o,a)=>{a>0&&o.time<n[a-1].time&&t.fail(`found keys of '${e}' whose times fall`)}),{rest:i,keys:n}}function Yi(t){let e=()=>Float32Array.from(t.floats(3*t.count(12))),r=()=>t.u32s(t.count(4)),i={name:t.text(),lamps:S(t,t.count(4),()=>t.text()),value:t.f32(),color:N(t),ownColor:N(t),materials:r(),emitters:r(),brightLights:r(),sky:t.choice(1,"sky flag")>0},n=t.choice(1,"motion flag")>0;for(let a=0;a<2;++a)t.choice(0,"reserved byte");(!(i.value>=0)||[...i.color,...i.ownColor].some(a=>a<0))&&t.fail(`found negative light in group '${i.name}'`);let o={...i,reflectors:e(),surrounds:e(),probes:e()};return n&&Mt(t,i.name),o}function Qi(t){t.text(),t.floats(3);let e=t.choice(1,"clock")>0;t.choice(16,"sky type");for(let s=0;s<2;++s)t.choice(0,"reserved byte");let r=t.f32(),i=t.f32(),n=Math.round(Math.abs(r)*60),o=e?"solar time":`UTC${r<0?"-":"+"}${Ft(n/60)}`,a=S(t,t.count(40),()=>{let s=t.f32(),l=t.u32();return t.floats(5),{hour:s,group:l,sky:t.floats(3)}});return a.some((s,l)=>l>0&&!(s.hour>a[l-1].hour))&&t.fail("found hours that do not rise"),{clock:o,shown:i,hours:a}}function Ft(t){let e=Math.round(t*60),r=i=>String(i).padStart(2,"0");return`${r(Math.floor(e/60))}:${r(e%60)}`}function Ui(t,e){let r=t.planesU16(e,3);for(let i=0;i<r.length;i+=3){r[i]+=r[i+1],r[i+2]+=r[i+1];for(let n=0;n<3;++n)r[i+n]>Bi&&t.fail(`found code ${r[i+n]} of light, expected at most ${Bi}`)}return r}function Zi(t){let e=t.u32(),r=t.size(q,"width"),i=t.size(q,"height"),n=t.size(16384,"details"),o=t.size(16384,"details"),a=2**de(t),s=t.size(Qe,"groups"),l=r*i,c=n*o;return{page:e,width:r,height:i,detailWidth:n,detailHeight:o,scale:a,rest:t.planes(l,1),restOfDetail:t.planes(c,1),others:S(t,s,()=>({group:t.u32(),light:Ui(t,l),detail:Ui(t,c)}))}}function Ji(t){let e={name:t.text(),material:t.u32(),map:t.u32(),indices:t.u32s(t.count(4))};return e.indices.length%3&&t.fail(`found ${e.indices.length} indices, expected triangles`),e}function en(t){let e=N(t),r=t.size(q,"texels"),i=2**de(t),n=t.f32(),o=r*r;(r===0||(r&r-1)>0)&&t.fail(`found ${r} texels a side, expected a power of two`),n>=0&&n<=1e18||t.fail(`found inverse distance ${n}`);let a=t.planesU32(o),s=t.planesU16(o);return{centre:e,size:r,scale:i,light:a,inverseDistance:Float32Array.from(s,l=>l/65535*n),valid:t.planes(o,1)}}function S(t,e,r){let i=[];for(let n=0;n<e;++n)i.push(r(t));return i}var Ba=64;function Ca(t,e){let r=t.u16(),i=t.u16(),n=t.u16(),o=t.u16();(r<2||r>6||i!==1&&i!==3||n<1||n>256||o<1||o>64)&&t.fail(`found a transfer of ${r} bands, ${i} channels, ${n} clusters and ${o} components`),t.f32();let a=t.f32s(n*(o+1)*i*r*r),s=t.f32s(n*o),l=t.planes(e,1),c=new Int16Array(t.planes(e*o,2).buffer);for(let u of l)u>=n&&t.fail(`found cluster ${u} of ${n}`);return{bands:r,channels:i,clusters:n,components:o,basis:a,weightScale:s,cluster:l,weight:c}}function tn(t){let e=t.text(),r=Mt(t,e),i=Ze(t);return{name:e,...r,mesh:i,transfer:Ca(t,i.positions.length/3)}}function Ua(t){return t.text(),{kind:t.choice(3,"kind of light"),twoSided:t.choice(1,"flag")>0,intensity:N(t),position:N(t),direction:N(t),innerCone:t.f32(),outerCone:t.f32(),angularRadius:t.f32(),corners:S(t,t.count(12),N)}}function rn(t){let e=t.u32(),r=t.u32();(e<2||e>6||r<2||r>64)&&t.fail(`found ${e} bands and depth maps of ${r} texels a side`);let i=t.f32();t.f32();let n=N(t),o=N(t),a=[t.u32(),t.u32(),t.u32()],s=t.count(36),l=t.count(12),c=t.size(Ba,"lights");(!(i>0)||o.some(y=>!(y>0))||a.some(y=>y<1)||a[0]*a[1]*a[2]>s)&&t.fail(`found a grid of ${a.join(" x ")} cells of ${s}`);let u=new Uint32Array(t.planes(s,36).buffer);for(let y=0;y<s;++y){let w=u[9*y];w!==0&&(w<=y||w+8>s)&&t.fail(`found parts ${w} of cell ${y} of ${s}`);for(let x=1;x<9;++x)u[9*y+x]>=l&&t.fail(`found probe ${u[9*y+x]} of ${l}`)}let h=t.planesF32(l,3),f=t.planes(l,1),p=()=>new Uint32Array(t.planes(l,8).buffer),m=p(),d=p(),v=2**de(t),b=t.planesU16(3*e*e*l),_=r*r*l,g=Float32Array.from(b,y=>Y(y)*v);return g.some(y=>!Number.isFinite(y))&&t.fail("found a coefficient that is not finite"),{bands:e,depthSide:r,depthCap:i,lower:n,cell:o,size:a,cells:u,positions:h,valid:f,bright:m,kept:d,harmonics:g,depth:t.planesU16(_),depthSquared:t.planesU16(_),lights:S(t,c,Ua)}}var Ia=2**30;function Oa(t,e,r,i){switch(t){case"SCNE":i.sky=r.floats(3);break;case"MESH":i.mesh=Ze(r);break;case"MATL":i.materials=S(r,e,Oi);break;case"ETEX":i.emissionTextures=S(r,e,Ii);break;case"TEXR":i.textures.push(...S(r,e,kt));break;case"NTEX":i.normals.push(...S(r,e,kt));break;case"LMAP":i.pages.push(...S(r,e,$i));break;case"RFLT":i.reflectors=S(r,e,Ni);break;case"EMIT":i.emitters=S(r,e,Wi);break;case"KERN":i.kernels=S(r,e,Hi);break;case"FRES":i.fresnels=S(r,e,qi);break;case"CAMS":i.cameras=S(r,e,Xi);break;case"PATH":i.paths=S(r,e,ji);break;case"CRFL":i.curved=S(r,e,Ji);break;case"SMAP":i.surrounds.push(...S(r,e,en));break;case"MOVR":i.movers.push(...S(r,e,tn));break;case"PROB":i.field=rn(r);break;case"LGRP":i.groups=S(r,e,Yi);break;case"GLMP":i.pageGroups.push(...S(r,e,Zi));break;case"DAYH":i.day=Qi(r);break;case"WALK":i.grids=S(r,e,Ki);break;default:r.fail("found a section that a piece does not have")}r.end()}var $a=[143,79,82,73,13,10,26,10];function Tt(t,e){let r=s=>{throw new V(`${e}: ${s}`)},i=new DataView(t.buffer,t.byteOffset,t.byteLength),n={sky:[0,0,0],materials:[],emissionTextures:[],textures:[],normals:[],pages:[],reflectors:[],emitters:[],kernels:[],fresnels:[],cameras:[],paths:[],grids:[],groups:[],pageGroups:[],curved:[],surrounds:[],movers:[]};(t.length<64||$a.some((s,l)=>t[l]!==s))&&r("is no piece of a pack"),i.getUint32(8,!0)!==1&&r(`found format version ${i.getUint32(8,!0)}, expected 1`);let o=i.getUint32(16,!0);64+o*64>t.length&&r("ends inside its table");let a=s=>Number(i.getBigUint64(s,!0));for(let s=0;s<o;++s){let l=64+64*s,c=String.fromCharCode(...t.subarray(l,l+4)),u=i.getUint32(l+4,!0),h=a(l+16),f=a(l+24),p=a(l+32),m=a(l+40),d=`${e}, ${c}`;h+f>t.length&&r(`section ${c} ends outside`),(p>Ia||p>f*65536+65536||m>p+1)&&r(`found ${p} bytes in section ${c}`);let v=t.subarray(h,h+f);if(u===1)try{v=Di(v,new Uint8Array(p))}catch{r(`section ${c} cannot be decompressed`)}else u!==0&&r(`found codec ${u}`);v.length!==p&&r(`section ${c}: found ${v.length} bytes, expected ${p}`),Oa(c,m,new Le(v,d),n)}return n}function nn(t,e,r,i){let n=s=>{throw new V(`scene: ${s}`)},o=(s,l,c,u=-1)=>{(s<u||s>=l)&&n(`found ${c} ${s} of ${l}`)},a=t.mesh;if(!a)return n("found no mesh");for(let s of a.parts)o(s.material,t.materials.length,"material",0),o(s.page,t.pages.length,"lightmap page");for(let s of t.materials)o(s.texture,e,"texture"),o(s.normalTexture,r,"normal texture"),o(s.kernel,t.kernels.length,"kernel"),o(s.fresnel,t.fresnels.length,"Fresnel map");for(let s of t.emissionTextures)o(s.material,t.materials.length,"material",0),o(s.texture,e,"texture",0);for(let s of t.reflectors){o(s.material,t.materials.length,"material",0);for(let l of s.indices)o(l,a.positions.length/3,"vertex",0);for(let l of s.emitters)o(l,t.emitters.length,"emitter",0)}for(let s of t.curved){o(s.material,t.materials.length,"material",0),o(s.map,i,"surround map",0);for(let l of s.indices)o(l,a.positions.length/3,"vertex",0)}t.groups.length>Qe&&n(`found ${t.groups.length} light groups, expected at most ${Qe}`);for(let s of t.groups){for(let l of s.materials)o(l,t.materials.length,"material",0);for(let l of s.emitters)o(l,t.emitters.length,"emitter",0)}}function on(t,e){for(let r of e.groups)for(let i of r.brightLights)if(i>=t.lights.length)throw new V(`group '${r.name}': found bright light ${i} of ${t.lights.length}`)}function an(t,e){for(let r of t.mesh.parts)if(r.material>=e.materials.length)throw new V(`mover '${t.name}': found material ${r.material} of ${e.materials.length}`)}function sn(t,e,r){let i=o=>{throw new V(`light of groups on page ${t.page}: ${o}`)},n=e.groups.length;if(!r)return i(`found no such page among ${e.pages.length}`);(t.width!==r.width||t.height!==r.height||t.detailWidth!==r.detailWidth||t.detailHeight!==r.detailHeight)&&i(`found ${t.width} x ${t.height} texels, expected ${r.width} x ${r.height} and as many details`);for(let o of[t.rest,t.restOfDetail])for(let a of o)a>=n&&i(`found group ${a} of ${n}`);for(let o of t.others)o.group>=n&&i(`found group ${o.group} of ${n}`)}var Na=2,Wa=1800,Ha=1e4,ln=2700,ie=t=>document.getElementById(t);function Me(t,e,r){let i=document.createElement("input");return i.type=t,i.setAttribute("aria-label",e),i.addEventListener("input",()=>r(i)),i}function Et(t,e,r,i){return t.min=String(e),t.max=String(r),t.step=String(i),t}function qa(t){let e=t.hours.slice(1).map((r,i)=>r.hour-t.hours[i].hour);return e.length>0?Math.min(...e)/4:.25}var Je=class{constructor(e,r,i){this.groups=e;this.day=r;this.wanted=i;this.settings=Ce(e,r),e.length!==0&&(ie("lamps").hidden=!1,ie("lamps").addEventListener("click",()=>this.toggle()),ie("lights-close").addEventListener("click",()=>this.toggle()),ie("lights-baked").addEventListener("click",()=>this.all(({hour:n})=>({on:!0,value:1,hour:n}))),ie("lights-off").addEventListener("click",()=>this.all(n=>({...n,on:!1}))),this.dialog.addEventListener("keydown",n=>{(n.key==="Escape"||n.key==="o"&&!(n.ctrlKey||n.altKey||n.metaKey))&&(this.toggle(),n.preventDefault())}),r&&ie("lights-groups").append(this.rowOfHour(r)),e.forEach((n,o)=>{this.settings[o].hour===void 0&&ie("lights-groups").append(this.rowsOf(o))}),this.fromHash())}settings;refreshes=[];dialog=ie("lights");get factors(){return li(this.groups,this.settings,this.day)}get changed(){return this.factors.some(e=>e.some(r=>r!==1))}toggle(){this.groups.length!==0&&(this.dialog.open?(this.dialog.close(),ie("view").focus()):this.dialog.show(),ie("lamps").setAttribute("aria-expanded",String(this.dialog.open)))}fromHash(){let e=new URLSearchParams(location.hash.slice(1)).getAll("light");e.length!==0&&(this.settings=Ce(this.groups,this.day),ai(this.groups,e,this.settings,this.day),this.refresh())}toHash(){return si(this.groups,this.settings,this.day).map(e=>`&light=${encodeURIComponent(e)}`).join("")}all(e){this.settings=this.settings.map(e),this.refresh()}refresh(){for(let e of this.refreshes)e();this.wanted()}rowOfHour(e){let r=document.createElement("label"),i=document.createElement("output"),n=()=>this.settings.find(a=>a.hour!==void 0).hour,o=Et(Me("range",`hour, ${e.clock}`,()=>{ft(e,Number(o.value),this.settings),this.refresh()}),e.hours[0].hour,e.hours.at(-1).hour,qa(e));return r.append("hour",o,i),this.refreshes.push(()=>{o.value=String(n()),i.textContent=`${Ft(n())} ${e.clock}`}),this.refreshes.at(-1)(),r}rowsOf(e){let{name:r,lamps:i}=this.groups[e],n=document.createElement("div"),o=()=>this.settings[e],a=v=>()=>{v(),this.refresh()},s=(v,...b)=>{let _=document.createElement("label");return _.append(...b.slice(0,1),v,...b.slice(1)),n.append(_),_};n.setAttribute("role","group"),n.setAttribute("aria-label",r),n.title=i.join(", ");let l=Me("checkbox",r,a(()=>{o().on=l.checked})),c=Et(Me("range",`${r}: light, times what was baked`,a(()=>{o().value=Number(c.value)})),0,Na,.05),u=Me("checkbox",`${r}: a colour of its own`,a(()=>{delete o().color,delete o().kelvin,u.checked&&Ue(o(),ln)})),h=Et(Me("range",`${r}: colour temperature, kelvin`,a(()=>Ue(o(),Number(h.value)))),Wa,Ha,100),f=document.createElement("output"),p=document.createElement("output");s(r,l);let m=s("",c,f),d=s("colour",u,h,p);return this.refreshes.push(()=>{let v=o();l.checked=v.on,c.value=String(v.value),u.checked=!!v.color,h.value=String(v.kelvin??ln),m.hidden=d.hidden=!v.on,h.hidden=p.hidden=v.kelvin===void 0,f.textContent=`× ${v.value.toFixed(2)}`,p.textContent=`${Math.round(v.kelvin??0)} K`,h.style.setProperty("accent-color",v.kelvin?Xa(v.kelvin):"")}),this.refreshes.at(-1)(),n}};function Xa(t){let e=ht(t),r=Math.max(...e);return`rgb(${e.map(i=>Math.round(255*(i/r)**(1/2.2))).join(" ")})`}function cn(t,e,r,i){let{right:n,up:o,forward:a}=ot(t),s=t.fov===0?t.halfHeight:Math.tan(.5*t.fov),l=I(L(n,(2*e-1)*s*i),L(o,(1-2*r)*s));return t.fov===0?{from:I(t.eye,l),way:a}:{from:t.eye,way:$(I(a,l),a)}}function un(t,e,r){let i=t.data.mesh,n=i.positions,o=d=>[n[3*d],n[3*d+1],n[3*d+2]],a;for(let d of i.parts){let v=t.data.materials[d.material].doubleSided;for(let b=d.first;b<d.first+d.count;b+=3){let _=o(i.indices[b]),g=T(o(i.indices[b+1]),_),y=T(o(i.indices[b+2]),_),w=O(r,y),x=D(g,w);if(x===0||x<0&&!v)continue;let z=T(e,_),C=D(z,w)/x,X=O(z,g),U=D(r,X)/x,W=D(y,X)/x;C<0||U<0||C+U>1||W<=1e-4||a&&W>=a.t||(a={t:W,index:b,u:C,w:U,page:d.page,normal:$(O(g,y),[0,1,0])})}}if(!a)return;let{t:s,index:l,u:c,w:u,page:h,normal:f}=a,p=i.lightmapUvs,m=d=>[0,1,2].reduce((v,b)=>v+p[2*i.indices[l+b]+d]*[1-c-u,c,u][b],0);return{at:I(e,L(r,s)),normal:f,distance:s,lux:h<0?0:t.luxAt(h,m(0),m(1))}}var et=4,ja=120,Rt=50,Ka=25,Ya=.25,Qa=.5,Za=.002,Ja=5e3,es=200,ts=4,tt=class{constructor(e,r,i,n,o,a){this.canvas=e;this.renderer=r;this.scene=i;this.walk=n;this.panel=o;this.lights=a;a.changed&&this.dim()}count=0;movedAt=-1e9;scale=1;hurries=!1;began=!1;presented=!1;meteredAt=-1e9;byHand;luxShown=!1;pointer=[.5,.5];frames=0;changed(){this.count=0,this.settled=!1}settled=!1;loading=!0;came=!1;drawnAt=-1e9;took=0;pieceCame(){this.came=!0}allCame(){this.loading=!1,delete document.body.dataset.rest,this.changed()}waits(e){let r=this.loading&&this.took>es&&this.count>0;return this.came&&(!r||e-this.drawnAt>ts*this.took)?(this.came=!1,this.changed(),!1):r||this.count>=et}dimmed=!1;dim(){this.dimmed=!0}brighter(e){this.byHand=(this.byHand??0)-e/3,this.meteredAt=-1e9,this.changed()}automatic(){this.byHand=void 0,this.meteredAt=-1e9,this.changed()}frame(e,r,i){let n=this.walk.step(e.take(r),r),o=this.walk.clock.runs&&this.scene.movers.animated,a=n||o;o&&(this.walk.clock.seconds+=r),this.scene.movers.place(this.walk.clock.seconds),this.panel.moversAre(this.scene.movers.animated,o),this.panel.stick(e.stick),this.dimmed&&(this.dimmed=!1,this.scene.setLights(this.lights.factors),this.changed());let s=Math.max(1,Math.round(this.canvas.clientWidth*Math.min(devicePixelRatio,2))),l=Math.max(1,Math.round(this.canvas.clientHeight*Math.min(devicePixelRatio,2)));(this.canvas.width!==s||this.canvas.height!==l)&&(this.canvas.width=s,this.canvas.height=l,this.changed()),a&&(i-this.movedAt<500&&this.adapt(r*1e3),this.movedAt=i,this.changed(),delete document.body.dataset.rest),!a&&i-this.movedAt>500&&(this.hurries=!1);let c=this.began&&i-this.movedAt<ja;if(this.frames===1&&!this.presented){this.presented=!0;return}(c?!a:this.waits(i))||(this.began?this.draw(c,s,l,i):this.drawFirst(s,l,i),++this.frames)}adapt(e){e>Rt&&!this.hurries?this.hurries=!0:e>Rt?this.scale=Math.max(this.scale*Math.max(Math.sqrt(Rt/e),.5),Ya):e<Ka&&(this.scale=Math.min(this.scale*1.05,1))}drawFirst(e,r,i){let n=o=>Math.max(1,Math.round(o*Qa));this.renderer.draw(this.scene,this.walk.camera,n(e),n(r),void 0,Ai),this.meter(!1,i),this.renderer.show(this.scene,0,e,r),this.renderer.startRest(),this.began=!0,this.changed()}draw(e,r,i,n){let o=e?this.scale:1,a=Math.max(1,Math.round(r*o)),s=Math.max(1,Math.round(i*o)),l=performance.now(),c=e?n-this.meteredAt>200:this.count===0&&!this.settled;this.renderer.draw(this.scene,this.walk.camera,a,s,e?void 0:this.count,e&&this.hurries?Si:Ri),c&&this.meter(e,n),c&&!e&&(this.took=performance.now()-l),this.drawnAt=performance.now(),!e&&!this.settled&&this.renderer.addToMean(1/et,this.count===0);let u=this.count===et-1;this.renderer.show(this.scene,e?0:this.count,r,i,e||!this.settled||u),this.count=e?0:this.count+1,!(this.count<et)&&(!this.settled&&this.settle(n)||(document.body.dataset.rest=String(this.frames),this.panel.lux(this.luxShown?this.luxThere():void 0)))}settle(e){let r=this.renderer.white;return this.settled=!0,this.meter(!1,e,!0),this.took>Ja||Math.abs(Math.log2(this.renderer.white/r))<Za?!1:(this.count=0,!0)}meter(e,r,i=!1){let n=this.renderer.meter(this.scene,i);if(this.meteredAt=r,n===void 0)return;let o=Math.min(Math.max(n-Math.log2(1.2*.18),-4),17)+(this.byHand??0),a=Math.log2(this.renderer.white/1.2),s=e?.45:1;this.renderer.white=1.2*2**(a+(o-a)*s)}get aspect(){return this.canvas.width/this.canvas.height}hitAt(e,r){let i=cn(this.walk.camera,e,r,this.aspect);return un(this.scene,i.from,i.way)}go(e,r){let i=this.hitAt(e,r);if(!i)return;let n=i.normal[1]>.7?0:.5,o=[i.at[0]+i.normal[0]*n,i.at[1],i.at[2]+i.normal[2]*n];n>0&&(o[1]=this.walk.floors.nearest(this.walk.camera.eye,1e9)?.eye[1]??o[1]),this.walk.goTo(o,matchMedia("(prefers-reduced-motion: reduce)").matches)||this.panel.say("Nobody can walk there."),this.changed()}hover(e,r){this.pointer=[e,r],this.luxShown&&this.panel.lux(this.luxThere())}luxThere(){let e=this.hitAt(...this.pointer);return e?`${e.lux<10?e.lux.toFixed(1):Math.round(e.lux)} lux`:"no surface"}toggleLux(){this.luxShown=!this.luxShown,this.panel.lux(this.luxShown?this.luxThere():void 0)}};var hn=2;async function fn(t,e){let r;try{r=await fetch(t,{integrity:e})}catch{throw new V(`${t} did not come, or is not the one that this page was made with`)}if(!r.ok)throw new V(`${t}: ${r.status} ${r.statusText}`);return new Uint8Array(await r.arrayBuffer())}async function mn(t,e){let r=JSON.parse(new TextDecoder().decode(await fn(t,e)));if(r.version!==hn)throw new V(`${t} is of version ${r.version}, this viewer of ${hn}: write the folder anew`);for(let i of r.pieces)if(!/^pieces\/[a-z]+-[0-9a-f]+\.oriel$/.test(i.file)||!(i.bytes>0)||!(i.index>=0))throw new V(`${t}: found piece '${i.file}'`);return r}async function At(t){let e=await fn(t.file,t.integrity);if(e.length!==t.bytes)throw new V(`${t.file}: found ${e.length} bytes, expected ${t.bytes}`);return e}function E(t){let e=document.getElementById(t);if(!e)throw new Error(`the page has no ${t}`);return e}var rt=class{walk;lights;show=()=>{};timer=0;begin(e,r,i){this.walk=e,this.lights=r,this.show=i;let n=E("places");e.cameras.forEach((o,a)=>n.append(new Option(o.name||`place ${a+1}`,String(a)))),n.addEventListener("change",()=>{n.value!==""&&this.jump(Number(n.value)),n.value="",E("view").focus()}),E("tour").hidden=!e.path,E("tour").addEventListener("click",()=>this.key("p")),E("movers").addEventListener("click",()=>this.key("m")),E("link").addEventListener("click",()=>void this.copyLink()),E("screen").hidden=!document.fullscreenEnabled,E("screen").addEventListener("click",()=>{(document.fullscreenElement?document.exitFullscreen():document.documentElement.requestFullscreen()).catch(()=>this.say("The browser does not give the whole screen."))}),E("help").addEventListener("click",()=>this.key("?")),addEventListener("hashchange",()=>{let o=e.fromHash();o&&(this.walk.jump(o),this.show()?.changed()),r.fromHash()})}sizes(e,r){E("sheet-sizes").textContent=`Loaded: ${(e/1e6).toFixed(1)} MB. Held on the graphics device: ${(r/1e6).toFixed(1)} MB, and the frame.`,document.body.dataset.held=String(r)}movers="";moversAre(e,r){let i=`${e} ${r}`;i!==this.movers&&(this.movers=i,E("movers").hidden=!e,E("movers").setAttribute("aria-pressed",String(r)))}progress(e){E("progress").value=e,E("bar").hidden=e>=1}say(e,r=!1){E("line").textContent=e,clearTimeout(this.timer),r||(this.timer=window.setTimeout(()=>{E("line").textContent=""},4e3))}lux(e){E("lux").hidden=e===void 0,E("lux").textContent=e??""}stick(e){let r=E("stick");r.hidden=!e,e&&(r.style.setProperty("left",`${e.startX}px`),r.style.setProperty("top",`${e.startY}px`)),E("tour").setAttribute("aria-pressed",String(!!this.walk?.touring))}jump(e){let r=this.walk,i=r.cameras[e];i&&(r.place=e,r.jump(i),this.show()?.changed(),this.say(i.name))}async copyLink(){let e=this.walk.toHash()+this.lights.toHash(),r=location.href.split("#")[0]+e;history.replaceState(null,"",e);try{await navigator.clipboard.writeText(r),this.say("A link to this view is on the clipboard.")}catch{this.say("The address now leads to this view.")}}key(e){let r=this.walk,i=this.show();if(!(!r||!i))switch(e){case"c":this.jump((r.place+1)%r.cameras.length);break;case"Home":this.jump(0);break;case"o":this.lights.toggle();break;case"m":r.clock.runs=!r.clock.runs;break;case"p":r.toggleTour();break;case"g":i.go(.5,.5);break;case"l":i.toggleLux();break;case"+":case"=":i.brighter(1);break;case"-":i.brighter(-1);break;case"x":i.automatic();break;case"?":E("sheet").showModal();break;default:/^[1-9]$/.test(e)&&this.jump(Number(e)-1)}}};var St=t=>{document.body.dataset.state=t};function pn(t){E("fallback").hidden=!1,E("fallback-text").textContent=t,E("tools").hidden=E("bar").hidden=!0,E("view").hidden=!0,St("refused")}var dn=3,vn=!1,Fe=E("view"),oe=new rt;function rs(){return Fe.getContext("webgl2",{antialias:!1,alpha:!1,depth:!1,powerPreference:"high-performance"})}var Lt=class{constructor(e,r,i){this.gl=e;this.scene=r;this.walk=i;this.lights=new Je(r.groups,r.day,()=>this.show?.dim())}pieces=new Map;show;lights;begin(e=new ye(gt(this.gl))){let r=new We(e.device,{...this.scene,pages:this.scene.pages.slice()});this.show=new tt(Fe,e,r,this.walk,oe,this.lights);for(let[i,n]of this.pieces)this.take(i,n)}take(e,r){this.pieces.set(e,r);let i=this.show,[n,o]=e.split(" "),a=Number(o);i&&(n==="light"&&r.pages[0]&&i.scene.setPage(a,r.pages[0]),n==="texture"&&r.textures[0]&&i.scene.setTexture(a,r.textures[0],!1),n==="normal"&&r.normals[0]&&i.scene.setTexture(a,r.normals[0],!0),n==="surround"&&r.surrounds[0]&&i.scene.setSurround(a,r.surrounds[0]),n==="field"&&r.field&&i.scene.movers.setField(r.field),n==="mover"&&r.movers[0]&&i.scene.movers.add(a,r.movers[0]),n==="lamps"&&r.pageGroups[0]&&i.scene.setPageGroups(r.pageGroups[0]),i.pieceCame())}};async function is(t){if(!("serviceWorker"in navigator)||!isSecureContext)return;let e=/pieces-([0-9a-f]+)\.json/.exec(document.body.dataset.pieces)?.[1];try{let r=await caches.open(`oriel ${new URL("./",location.href).pathname} ${e}`),i=[...document.querySelectorAll("script[src], link[href]")].map(n=>n.getAttribute("src")??n.getAttribute("href"));await r.addAll(["./",document.body.dataset.pieces,...i,...t.pieces.map(n=>n.file)]),await navigator.serviceWorker.register("offline.js"),document.body.dataset.offline="kept"}catch{}}var ns=t=>`${t.kind} ${t.index}`;async function os(){let t=await mn(document.body.dataset.pieces,document.body.dataset.integrity),e=t.pieces.reduce((g,y)=>g+y.bytes,0),r=t.pieces.find(g=>g.kind==="scene");if(!r)throw new V("found no scene among the pieces");let i=At(r);i.catch(()=>{});let n=rs();if(!n)return pn("This page shows a building in three dimensions. Your browser cannot draw it: it lacks WebGL 2.");let o=new ye(gt(n));o.start();let a=r.bytes;oe.progress(.05);let s=Tt(await i,r.file),l=n.getParameter(n.MAX_TEXTURE_SIZE);gn(s,r.file,l);let c=g=>t.pieces.filter(y=>y.kind===g).length;nn(s,c("texture"),c("normal"),c("surround"));let u=new Xe(s),h=new Lt(n,s,u);h.begin(o),vn=!0,oe.begin(u,h.lights,()=>h.show);let f=new Pe(Fe,{key:g=>oe.key(g),go:(g,y)=>h.show?.go(g,y),hover:(g,y)=>h.show?.hover(g,y)}),p=!1,m=performance.now();Fe.addEventListener("webglcontextlost",g=>{g.preventDefault(),p=!0,h.show=void 0}),Fe.addEventListener("webglcontextrestored",()=>{p=!1,h.begin(),document.body.dataset.state==="whole"&&h.show.allCame()});let d=g=>{requestAnimationFrame(d);let y=Math.min((g-m)/1e3,.25);m=g,!p&&(h.show?.frame(f,y,g),h.show?.frames&&document.body.dataset.state==="loading"&&(n.finish(),performance.mark("first frame"),St("first")))},v=t.pieces.filter(g=>g!==r),b=[],_=g=>{for(let y=b.length;y<Math.min(g,v.length);++y)(b[y]=At(v[y])).catch(()=>{})};_(dn),d(m),oe.progress(a/e);for(let[g,y]of v.entries()){_(g+dn);let w=Tt(await b[g],y.file);as(w,y,l),y.kind==="mover"&&an(w.movers[0],s),y.kind==="field"&&on(w.field,s),y.kind==="lamps"&&sn(w.pageGroups[0],s,h.pieces.get(`light ${w.pageGroups[0].page}`)?.pages[0]),h.take(ns(y),w),oe.progress((a+=y.bytes)/e)}h.show?.allCame(),St("whole"),oe.progress(1),oe.sizes(e,h.show?.scene.bytes??0),await is(t)}function as(t,e,r){let n={light:t.pages,texture:t.textures,normal:t.normals,surround:t.surrounds,lamps:t.pageGroups,mover:t.movers,field:t.field?[t.field]:[]}[e.kind]?.length??0;if(n!==1)throw new V(`${e.file}: found ${n} of kind '${e.kind}', expected one`);gn(t,e.file,r)}function gn(t,e,r){let i=[...t.textures,...t.normals,...t.pages].map(n=>[n.width,n.height]);for(let n of t.pages)i.push([n.detailWidth,n.detailHeight]);for(let n of t.surrounds)i.push([1.5*n.size+4,n.size+64]);for(let[n,o]of i)if(Math.max(n,o)>r)throw new V(`${e}: found an image of ${n} x ${o} texels, but this device holds at most ${r} a side`)}os().catch(t=>{vn?oe.say(`A part is missing: ${t.message}`,!0):pn(`This walkthrough cannot be shown: ${t.message}`),t instanceof V||console.error(t)});
