var D=class extends Error{},Ge=class{constructor(e,r){this.bytes=e;this.name=r;this.view=new DataView(e.buffer,e.byteOffset,e.byteLength)}at=0;view;get left(){return this.bytes.length-this.at}fail(e){throw new D(`${this.name}: ${e}`)}take(e){return e>this.left&&this.fail(`found ${this.left} bytes more, expected ${e}`),this.at+=e,this.at-e}u8(){return this.view.getUint8(this.take(1))}u32(){return this.view.getUint32(this.take(4),!0)}u16(){return this.view.getUint16(this.take(2),!0)}i32(){return this.view.getInt32(this.take(4),!0)}f64(){return this.view.getFloat64(this.take(8),!0)}f32(){let e=this.view.getFloat32(this.take(4),!0);return Number.isFinite(e)||this.fail("found a number that is not finite"),e}floats(e){let r=[];for(let i=0;i<e;++i)r.push(this.f32());return r}count(e){let r=this.u32();return r*e>this.left&&this.fail(`found ${r} elements in ${this.left} bytes`),r}text(){let e=this.count(1),r=this.take(e);return new TextDecoder().decode(this.bytes.subarray(r,r+e))}choice(e,r){let i=this.u8();return i>e&&this.fail(`found ${r} ${i}, expected 0 to ${e}`),i}size(e,r){let i=this.u32();return i>e&&this.fail(`found ${r} ${i}, expected at most ${e}`),i}planes(e,r){e*r>this.left&&this.fail(`found ${this.left} bytes, expected ${e*r}`);let i=this.take(e*r),a=new Uint8Array(e*r);for(let n=0;n<r;++n){let o=0;for(let s=0,l=n,c=i+n*e;s<e;++s,l+=r)o=o+this.bytes[c+s]&255,a[l]=o}return a}planesF32(e,r=1){let i=new Float32Array(this.planes(e,4*r).buffer);for(let a=0;a<i.length;++a)Number.isFinite(i[a])||this.fail("found a number that is not finite");return i}planesU32(e){return new Uint32Array(this.planes(e,4).buffer)}planesU16(e,r=1){return new Uint16Array(this.planes(e,2*r).buffer)}f32s(e){return 4*e>this.left&&this.fail(`found ${this.left} bytes, expected ${4*e}`),Float32Array.from(this.floats(e))}u32s(e){4*e>this.left&&this.fail(`found ${this.left} bytes, expected ${4*e}`);let r=this.take(4*e),i=new Uint32Array(e);for(let a=0;a<e;++a)i[a]=this.view.getUint32(r+4*a,!0);return i}end(){this.left>0&&this.fail(`found ${this.left} bytes more than expected`)}};function Z(t){let e=t>>10&31,r=t&1023,i=t&32768?-1:1;return e===0?i*r*2**-24:e===31?NaN:i*(1+r/1024)*2**(e-15)}var Ht=new Float32Array(1),Oa=new Uint32Array(Ht.buffer);function qt(t){if(!(t<65504))return 31743;if(t<2**-14)return Math.round(t*2**24);Ht[0]=t;let e=Oa[0]-939524096,r=e>>>13,i=e&8191;return r+ +(i>4096||i===4096&&(r&1)>0)}var Ve=class{constructor(e,r){this.canvas=e;this.events=r;addEventListener("keydown",i=>this.key(i)),addEventListener("keyup",i=>this.down.delete(i.code)),addEventListener("blur",()=>this.reset()),e.addEventListener("pointerdown",i=>this.begin(i)),e.addEventListener("pointermove",i=>this.move(i)),e.addEventListener("pointerup",i=>this.end(i)),e.addEventListener("pointercancel",i=>this.fingers.delete(i.pointerId)),e.addEventListener("contextmenu",i=>i.preventDefault())}down=new Set;fingers=new Map;yaw=0;pitch=0;pressed=[];reset(){this.down.clear(),this.fingers.clear()}key(e){e.ctrlKey||e.altKey||e.metaKey||e.target instanceof Element&&e.target.closest("button, select, dialog, a")&&!/^Key[WASD]$/.test(e.code)||e.target instanceof HTMLSelectElement||(/^Arrow|^Space$/.test(e.code)&&e.preventDefault(),e.repeat||this.events.key(e.key.length===1?e.key.toLowerCase():e.key),this.down.add(e.code))}begin(e){if(e.button!==0)return;this.canvas.focus({preventScroll:!0});try{this.canvas.setPointerCapture(e.pointerId)}catch{}let r=e.pointerType==="touch"&&e.clientX<.5*innerWidth&&![...this.fingers.values()].some(i=>i.moves);this.fingers.set(e.pointerId,{x:e.clientX,y:e.clientY,startX:e.clientX,startY:e.clientY,begin:e.timeStamp,moves:r,far:!1})}move(e){let r=this.fingers.get(e.pointerId);if(!r){e.pointerType==="mouse"&&this.events.hover(...this.place(e));return}if(r.far||=Math.hypot(e.clientX-r.startX,e.clientY-r.startY)>12,!r.moves){let i=e.pointerType==="touch"?.006:.004;this.yaw+=(e.clientX-r.x)*i,this.pitch+=(e.clientY-r.y)*i}r.x=e.clientX,r.y=e.clientY}end(e){let r=this.fingers.get(e.pointerId);this.fingers.delete(e.pointerId),!(!r||r.far||e.timeStamp-r.begin>800)&&(e.pointerType!=="mouse"||e.detail>=2||this.doubled(e))&&this.events.go(...this.place(e))}lastClick=-1e9;doubled(e){let r=e.timeStamp-this.lastClick<400;return this.lastClick=e.timeStamp,r}place(e){let r=this.canvas.getBoundingClientRect();return[(e.clientX-r.left)/r.width,(e.clientY-r.top)/r.height]}get stick(){return[...this.fingers.values()].find(e=>e.moves&&e.far)}gamepad(e,r){let i=(navigator.getGamepads?.()??[]).find(o=>o?.connected);if(!i)return;let a=o=>{let s=i.axes[o]??0;return Math.abs(s)<.15?0:(s-Math.sign(s)*.15)/(1-.15)};e.right+=a(0),e.ahead-=a(1),e.yaw+=a(2)*2*r,e.pitch+=a(3)*2*r;let n=["g",void 0,"p",void 0,"Shift","c",void 0,void 0,"?","Home",void 0,void 0,"+","-"];e.fast||=!!i.buttons[4]?.pressed,i.buttons.forEach((o,s)=>{let l=n[s];o.pressed&&!this.pressed[s]&&l&&s!==4&&this.events.key(l),this.pressed[s]=o.pressed})}take(e){let r=n=>Number(this.down.has(n)),i={right:r("KeyD")-r("KeyA"),ahead:r("KeyW")-r("KeyS"),fast:!!(r("ShiftLeft")+r("ShiftRight")),yaw:-this.yaw+(r("ArrowRight")-r("ArrowLeft"))*1.5*e,pitch:-this.pitch+(r("ArrowDown")-r("ArrowUp"))*1.2*e};this.yaw=this.pitch=0;for(let n of this.fingers.values())!n.moves||!n.far||(i.right+=(n.x-n.startX)/60,i.ahead-=(n.y-n.startY)/60);this.gamepad(i,e);let a=n=>Math.min(Math.max(n,-1),1);return i.right=a(i.right),i.ahead=a(i.ahead),i}};var ae=(t,e)=>[t[3*e],t[3*e+1],t[3*e+2]],B=(t,e)=>[t[0]+e[0],t[1]+e[1],t[2]+e[2]],F=(t,e)=>[t[0]-e[0],t[1]-e[1],t[2]-e[2]],E=(t,e)=>[t[0]*e,t[1]*e,t[2]*e],S=(t,e)=>t[0]*e[0]+t[1]*e[1]+t[2]*e[2],G=(t,e)=>[t[1]*e[2]-t[2]*e[1],t[2]*e[0]-t[0]*e[2],t[0]*e[1]-t[1]*e[0]],W=t=>Math.hypot(t[0],t[1],t[2]),N=(t,e)=>{let r=W(t);return r>0&&Number.isFinite(r)?E(t,1/r):e};function Xt(){let t=new Float64Array(16);return t[0]=t[5]=t[10]=t[15]=1,t}function J(t,e){let r=new Float64Array(16);for(let i=0;i<4;++i)for(let a=0;a<4;++a){let n=0;for(let o=0;o<4;++o)n+=t[4*o+a]*e[4*i+o];r[4*i+a]=n}return r}function fe(t,e){let r=[0,0,0,0];for(let i=0;i<4;++i)r[i]=t[i]*e[0]+t[4+i]*e[1]+t[8+i]*e[2]+t[12+i]*e[3];return r}var ee=(t,e)=>fe(t,[e[0],e[1],e[2],1]).slice(0,3);function jt(t){let e=new Float64Array(16);for(let r=0;r<3;++r)for(let i=0;i<3;++i)e[4*i+r]=t[4*r+i];for(let r=0;r<3;++r)e[12+r]=-(t[4*r]*t[12]+t[4*r+1]*t[13]+t[4*r+2]*t[14]);return e[15]=1,e}function De(t,e){let r=Array.from({length:4},(i,a)=>[...Array.from({length:4},(n,o)=>t[4*a+o]),e[a]]);for(let i=0;i<4;++i){let a=i;for(let n=i+1;n<4;++n)Math.abs(r[n][i])>Math.abs(r[a][i])&&(a=n);[r[i],r[a]]=[r[a],r[i]];for(let n=0;n<4;++n){if(n===i)continue;let o=r[n][i]/r[i][i];for(let s=i;s<5;++s)r[n][s]-=o*r[i][s]}}return r.map((i,a)=>i[4]/i[a])}var de=()=>({lower:[1/0,1/0,1/0],upper:[-1/0,-1/0,-1/0]});function ne(t,e,r,i){t.lower[0]=Math.min(t.lower[0],e),t.lower[1]=Math.min(t.lower[1],r),t.lower[2]=Math.min(t.lower[2],i),t.upper[0]=Math.max(t.upper[0],e),t.upper[1]=Math.max(t.upper[1],r),t.upper[2]=Math.max(t.upper[2],i)}var le=t=>E(B(t.lower,t.upper),.5),xe=t=>.5*W(F(t.upper,t.lower));function te(t,e){for(let r=0;r<6;++r){let i=r>>1,a=r&1?-1:1,n=t[15]+a*t[12+i];for(let o=0;o<3;++o){let s=t[4*o+3]+a*t[4*o+i];n+=s*(s>0?e.upper[o]:e.lower[o])}if(n<0)return!1}return!0}var Kt=`float luminance(vec3 rgb){return dot(rgb,vec3(0.2126,0.7152,0.0722));}
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
`;var Yt=`#ifdef NO_DISTANCE
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
`;var Qt=`vec4 farther_average(vec4 light[4],vec4 weight,float reach){
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
`;var Zt=`vec4 fullscreen_position(int vertex){
vec2 corner=vec2(float((vertex & 1)<< 2)- 1.0,float((vertex & 2)<< 1)- 1.0);
return vec4(corner,0.0,1.0);
}
`;var Jt=`vec2 kernel_row(float cos_theta,int rows){
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
`;var er=`vec2 lightmap_uv(vec3 v){
return v.xy / v.z;
}
struct DetailBlock{
vec2 first;
float side;
};
DetailBlock detail_block(uint code){
return DetailBlock(vec2(code & 0x3fffu,code >> 14u & 0x3fffu),float(1u <<(code >> 28u)));
}
`;var tr=`vec4 turned_lobe(vec4 m,float cosine,float sine){
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
`;var rr=`#include "lib/octahedral.glsl"
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
`;var ir=`uniform bool u_metal_varies;
uniform float u_metal;
uniform vec3 u_dielectric;
uniform vec3 u_f0;
vec3 reflectance_in_place(vec3 reflectance,vec3 base,float metal){
vec3 f0=mix(u_dielectric,base,metal),beyond=1.0 - u_f0;
vec3 a=mix(vec3(1.0),(1.0 - reflectance)/ max(beyond,1e-4),smoothstep(0.0,0.05,beyond));
return clamp(1.0 -(1.0 - f0)*a,0.0,1.0);
}
`;var ar=`vec3 mirrored(vec3 tilted,vec3 view,out vec3 normal,out float cos_theta){
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
`;var nr=`vec4 tangent_of_steps(vec3 n,vec3 step_a,vec3 step_b,vec2 uv_a,vec2 uv_b){
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
`;var or=`vec2 octahedral_from_direction(vec3 d){
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
`;var sr=`vec3 reflectance_from_table(sampler2D tables,int row,int count,float cos_theta){
float at=sqrt(clamp(cos_theta,0.0,1.0))*float(count - 1);
int low=min(int(at),max(count - 2,0));
vec3 a=texelFetch(tables,ivec2(low,row),0).rgb;
vec3 b=texelFetch(tables,ivec2(min(low + 1,count - 1),row),0).rgb;
return mix(a,b,at - float(low));
}
`;var lr=`const float kPi=3.14159265358979323846;
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
`;var cr=`uniform highp usampler2D u_sharp_at;
uniform highp usampler2D u_sharp_words;
uniform highp sampler2D u_sharp_triangles;
uniform highp sampler2D u_sharp_lamps;
const uint kSharpSplit=0xffffffffu;
const float kMostSharpLux=1.5e5;
struct SharpLamp{
vec3 to;
float near;
float spread;
vec3 light;
};
ivec2 sharp_texel(uint i){return ivec2(int(i & 4095u),int(i >> 12u));}
uint sharp_word(uint i){return texelFetch(u_sharp_words,sharp_texel(i + 8192u),0).r;}
vec3 color_of_word(uint code){
return vec3(code & 511u,code >> 9u & 511u,code >> 18u & 511u)*exp2(float(code >> 27u)- 24.0);
}
float profile_candela(int row,vec4 place,vec4 axis,float steps,vec3 direction){
vec4 right=texelFetch(u_sharp_lamps,ivec2(3,row),0);
vec4 over=texelFetch(u_sharp_lamps,ivec2(4,row),0);
vec2 across=vec2(dot(right.xyz,direction),dot(over.xyz,direction));
float y=(atan(length(across),dot(axis.xyz,direction))- axis.w)*steps;
if(abs(y - 0.5*right.w)> 0.5*right.w + 1e-4)return 0.0;
if(across==vec2(0.0))across.x=1.0;
float x=fract(atan(across.y,across.x)/ 6.2831853)*-place.w;
vec2 at=clamp(floor(vec2(x,y)),vec2(0.0),vec2(-place.w,right.w)- 1.0);
vec4 around=texelFetch(u_sharp_triangles,sharp_texel(uint(over.w)*4096u + uint(at.y*-place.w + at.x)),0);
vec2 between=mix(around.xz,around.yw,clamp(y - at.y,0.0,1.0));
return mix(between.x,between.y,clamp(x - at.x,0.0,1.0));
}
SharpLamp lamp_at(int row,vec3 p,vec3 normal){
vec4 place=texelFetch(u_sharp_lamps,ivec2(0,row),0);
vec4 axis=texelFetch(u_sharp_lamps,ivec2(1,row),0);
vec4 power=texelFetch(u_sharp_lamps,ivec2(2,row),0);
#ifdef SUNS
if(place.w > 0.5)return SharpLamp(place.xyz,0.0,power.w,power.rgb*max(dot(normal,place.xyz),0.0));
#endif
vec3 to=place.xyz - p;
float distance2=max(dot(to,to),1e-12);
vec3 towards=to*inversesqrt(distance2);
float cone=clamp((-dot(axis.xyz,towards)- axis.w)*power.w,0.0,1.0);
float share=place.w < 0.0 ? profile_candela(row,place,axis,power.w,-towards): cone*cone;
return SharpLamp(to,1.0,0.0,power.rgb*(share*max(dot(normal,towards),0.0)/ distance2));
}
float extent(vec3 v){return dot(abs(v),vec3(1.0));}
#ifdef SUNS
#define COVER uvec2
#define IS_FULL(cover) ((cover.x & cover.y) == 0xffffffffu)
uvec2 half_disk(vec2 across,float off){
if(off >=1.0)return uvec2(0xffffffffu);
if(off <=-1.0)return uvec2(0u);
float x=across.x / max(abs(across.x)+ abs(across.y),1e-30);
int direction=int((across.y < 0.0 ? 3.0 + x : 1.0 - x)*16.0)& 63;
int at=128*direction + 2*min(int(off*32.0 + 32.0),63);
ivec2 texel=ivec2(at & 4095,at >> 12);
return uvec2(texelFetch(u_sharp_words,texel,0).r,texelFetch(u_sharp_words,texel + ivec2(1,0),0).r);
}
float ones(uvec2 bits){
bits -=bits >> 1u & 0x55555555u;
bits=(bits & 0x33333333u)+(bits >> 2u & 0x33333333u);
bits=(bits +(bits >> 4u)& 0x0f0f0f0fu)*0x01010101u >> 24u;
return float(bits.x + bits.y);
}
#else
#define COVER float
#define IS_FULL(cover) (cover >= 1.0)
#endif
COVER inside(vec3 a,vec3 ab,SharpLamp lamp,vec3 u,vec3 v,float turn,bool ends,vec3 dx,vec3 dy){
vec3 to=lamp.to - lamp.near*a,across=cross(ab,to);
float rounding=1e-6*extent(ab)*extent(to)*extent(a)+ 1e-30,depth=turn*dot(across,a);
vec2 by_pixel=vec2(dot(across,dx),dot(across,dy));
float width=abs(by_pixel.x)+ abs(by_pixel.y);
#ifdef SUNS
vec3 plane=turn*lamp.spread*cross(a,ab);
vec2 slope=lamp.spread > 0.0 ? vec2(dot(plane,u),dot(plane,v)): by_pixel;
float pixel=ends ? 0.5*width : 0.0;
float reach=max(lamp.spread > 0.0 ? length(vec3(slope,pixel)): pixel,rounding);
return half_disk(slope,ends ? depth / reach :(depth + 2.0*rounding)/ reach + 0.0625);
#else
return clamp(ends ? depth / max(width,rounding)+ 0.5 : depth / rounding + 2.0,0.0,1.0);
#endif
}
float sharp_visible(SharpLamp lamp,uint first,uint count,vec3 p,vec3 dx,vec3 dy){
vec3 u=normalize(abs(lamp.to.x)< abs(lamp.to.y)? vec3(0.0,lamp.to.z,-lamp.to.y): vec3(-lamp.to.z,0.0,lamp.to.x));
vec3 v=cross(lamp.to,u);
COVER front=COVER(0),back=COVER(0);
uint end=first + count;
do{
uint word=sharp_word(first);
ivec2 texel=sharp_texel(4u*(word & 0x1fffffffu));
vec3 a=texelFetch(u_sharp_triangles,texel,0).xyz;
vec3 b=texelFetch(u_sharp_triangles,texel + ivec2(1,0),0).xyz;
vec3 c=texelFetch(u_sharp_triangles,texel + ivec2(2,0),0).xyz;
vec3 ab=b - a,bc=c - b,ca=a - c,normal=cross(ab,bc);
a -=p,b -=p,c -=p;
float height=dot(normal,a);
if(lamp.near*(height*height - height*dot(normal,lamp.to))>=(1.0 - lamp.near)*height*height)continue;
float turn=sign(height);
COVER in_ab=inside(a,ab,lamp,u,v,turn,(word & 0x20000000u)!=0u,dx,dy);
COVER in_bc=inside(b,bc,lamp,u,v,turn,(word & 0x40000000u)!=0u,dx,dy);
COVER in_ca=inside(c,ca,lamp,u,v,turn,(word & 0x80000000u)!=0u,dx,dy);
#ifdef SUNS
front |=in_ab & in_bc & in_ca;
#else
float in_all=max(in_ab + in_bc + in_ca - 2.0,0.0),faces=step(0.0,dot(normal,lamp.to - lamp.near*a));
front +=faces*in_all,back +=(1.0 - faces)*in_all;
#endif
}while(++first < end && !IS_FULL(front)&& !IS_FULL(back));
#ifdef SUNS
return 1.0 - ones(front)/ 64.0;
#else
return 1.0 - min(max(front,back),1.0);
#endif
}
vec3 sharp_light(vec2 uv,vec3 p,vec3 dx,vec3 dy,vec3 normal){
vec2 size=vec2(textureSize(u_sharp_at,0));
vec2 at=uv*size,texel=clamp(floor(at),vec2(0.0),size - 1.0);
uint place=texelFetch(u_sharp_at,ivec2(texel),0).r;
if(place==0u)return vec3(0.0);
vec2 within=clamp(at - texel,0.0,1.0);
uint head=sharp_word(place);
while(head==kSharpSplit){
within*=2.0;
vec2 quarter=step(1.0,within);
within -=quarter;
place=sharp_word(place + 1u + uint(quarter.x + 2.0*quarter.y));
head=sharp_word(place);
}
if(head==0u)return vec3(0.0);
vec3 sum=vec3(0.0);
uint next=place + 1u;
do{
uint shine=sharp_word(next++);
vec3 tint=(shine & 0x400u)!=0u ? color_of_word(sharp_word(next++)): vec3(1.0);
uint count=shine >> 11u;
SharpLamp lamp=lamp_at(int(shine & 0x3ffu),p,normal);
if(lamp.light.r + lamp.light.g + lamp.light.b > 0.0){
float visible=count > 0u ? sharp_visible(lamp,next,count,p,dx,dy): 1.0;
sum +=lamp.light*tint*visible;
}
next +=count;
}while(--head > 0u);
return min(sum,kMostSharpLux);
}
`;var ur=`#include "lib/octahedral.glsl"
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
`;var hr=`vec3 taken_light(sampler2D change,usampler2D surfaces,vec2 at,vec3 p,vec3 n){
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
`;var fr=`const float kMostPlaces=8.0;
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
`;var mr=`vec3 tonemap_none(vec3 light){return clamp(light,0.0,1.0);}
vec3 tonemap_aces(vec3 light){
vec3 x=clamp(light,0.0,1e4);
return clamp(x*(2.51*x + 0.03)/(x*(2.43*x + 0.59)+ 0.14),0.0,1.0);
}
float dither(vec2 pixel){
return fract(52.9829189*fract(dot(pixel,vec2(0.06711056,0.00583715))))- 0.5;
}
`;var dr=`const int kWeightsWidth=2048;
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
`;var pr=`#include "passes/surface.glsl"
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
`;var vr=`#include "lib/transfer.glsl"
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
centroid out vec3 v_normal;
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
`;var gr=`#include "passes/surface.glsl"
#include "passes/place_reflectance.glsl"
#include "passes/curved_lobe.glsl"
#include "lib/mirrored.glsl"
uniform bool u_modulate;
layout(location=0)out vec4 o_light;
#ifdef SHADED
uniform sampler2D u_shaded,u_normals;
uniform float u_id;
const float kStep=0.01,kOther=0.5;
vec3 shaded_light(vec3 normal,vec3 mirror){
ivec2 at=ivec2(gl_FragCoord.xy),last=textureSize(u_shaded,0)- 1;
vec3 found=pyramid_light(u_light,u_size,mirror,u_tap_count > 1 ? log2(float(u_size))- 2.0 : 0.0);
float least=kOther;
for(int i=0;i < 9 && least > kStep;++i){
ivec2 step=ivec2((i + 4)% 3,(i + 4)% 9 / 3)- 1,beside=clamp(at + step,ivec2(0),last);
vec4 shaded=texelFetch(u_shaded,beside,0);
float away=distance(texelFetch(u_normals,beside,0).xyz,normal)+ kStep*float(abs(step.x)+ abs(step.y));
if(shaded.a==u_id && away < least)found=shaded.rgb,least=away;
}
return found;
}
#endif
void main(){
vec3 tilted=tilted_by_map(),normal;
float cos_theta;
vec3 mirror=mirrored(tilted,normalize(v_position*u_eye.w - u_eye.xyz),normal,cos_theta);
#ifdef SHADED
vec3 light=shaded_light(normal,mirror);
#else
vec3 light=curved_light(v_position,normal,mirror,cos_theta,spread_of(mirror));
#endif
light*=u_light_scale;
o_light=vec4(u_modulate ? light*reflectance_here(reflectance_of(tilted)): light,1.0);
}
`;var _r=`#include "passes/surface_vertex.glsl"
`;var br=`#include "lib/kernel.glsl"
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
const float kOverlap=1.6;
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
float width=kOverlap*max(tap.z,1e-6)/(1.0 + 0.25*dot(tap.xy,tap.xy));
float weight=tap.w*clamp(0.5 + dot(direction,normal)/ width,0.0,1.0);
if(weight <=0.0)continue;
float inverse=u_wide ? tap_distance(origin,direction): inverse_distance;
sum +=weight*light_along(origin,direction,inverse,max(width,spread));
total +=weight;
}
return total > 0.0 ? sum / total : light_along(origin,mirror,inverse_distance,spread);
}
vec3 curved_light(vec3 position,vec3 normal,vec3 mirror,float cos_theta,float spread){
vec3 origin=position - u_centre;
float inverse=u_wide ? 0.0 : march_surroundings(u_inverse_distance,u_size,u_range,origin,mirror).w;
return u_tap_count > 1 ? lobe_light(origin,normal,mirror,cos_theta,inverse,spread)
: light_along(origin,mirror,inverse,spread);
}
`;var xr=`#include "passes/surface.glsl"
#include "lib/mirrored.glsl"
layout(location=0)out vec4 o_place;
layout(location=1)out vec4 o_normal;
void main(){
vec3 tilted=tilted_by_map(),normal;
float cos_theta;
vec3 mirror=mirrored(tilted,normalize(v_position*u_eye.w - u_eye.xyz),normal,cos_theta);
o_place=vec4(v_position,spread_of(mirror));
o_normal=vec4(normal,1.0);
}
`;var yr=`#include "passes/surface_vertex.glsl"
`;var wr=`uniform sampler2D u_base_texture;
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
`;var kr=`layout(location=0)in vec3 a_position;
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
`;var Mr=`#include "passes/surface.glsl"
#include "lib/lightmap_uv.glsl"
#ifdef SHARP
#include "lib/sharp_light.glsl"
#endif
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
#ifdef SHARP
centroid in vec3 v_lit_position;
#endif
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
int j=0;
do{
vec2 beside=around==1 ? vec2(0.0): 0.25*vec2(float(j & 1)- 0.5,float(j >> 1)- 0.5)*(row ? vec2(0.5,2.0): vec2(1.0));
sum +=finest_light(at +(place.x + beside.x)*longer +(place.y + beside.y)*shorter);
}while(++j < around);
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
#ifdef SHARP
vec3 dx=dFdx(v_position),dy=dFdy(v_position);
#endif
if(!gl_FrontFacing)return vec3(0.0);
if(u_normal_mapped && u_directional)
irradiance*=directional_ratio(texture(u_direction,lightmap_uv(v_lightmap_uv)).xyz,tilted,front_normal());
#ifdef SHARP
vec3 normal=u_normal_mapped ? normalize(tilted): front_normal();
irradiance +=sharp_light(lightmap_uv(v_lightmap_uv),v_lit_position / v_lightmap_uv.z,dx,dy,normal);
#endif
return irradiance;
}
`;var Fr=`uniform sampler2D u_base_texture;
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
#include "lib/metalness.glsl"
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
float diffuse_share=u_diffuse_share;
#ifndef PLAIN
vec4 picture=texture_along(u_emission_texture,v_uv);
if(u_metal_varies){
float metal=u_metal*picture.a;
reflectance=reflectance_in_place(reflectance,base.rgb,metal);
diffuse_share*=1.0 - metal;
}
#endif
vec3 light=u_weights.x*diffuse_light(base.rgb*diffuse_share,reflectance,irradiance);
light +=u_weights.y*ambient_reflection(reflectance,irradiance);
#ifdef PLAIN
light +=u_weights.z*u_emission;
#else
light +=u_weights.z*u_emission*picture.rgb;
#endif
o_light=vec4(light,alpha_of_light(1.0));
}
`;var Sr=`#include "lib/color.glsl"
#include "passes/reflector_reflectance.glsl"
uniform sampler2D u_image;
uniform vec2 u_image_size;
uniform vec2 u_origin;
uniform vec3 u_missing;
uniform bool u_smooth;
uniform bool u_with_distance;
layout(location=0)out vec4 o_light;
const float kContrast=0.25;
const float kLevel=0.25;
const int kReach=16;
ivec2 on_image(ivec2 at){return clamp(at,ivec2(0),ivec2(u_image_size)- 1);}
float bright(ivec2 at){return luminance(texelFetch(u_image,on_image(at),0).rgb);}
vec4 without_stairs(ivec2 at){
vec4 own=texelFetch(u_image,at,0);
if(!u_smooth)return own;
float c=bright(at),n=bright(at + ivec2(0,1)),s=bright(at - ivec2(0,1)),e=bright(at + ivec2(1,0)),
w=bright(at - ivec2(1,0));
float most=max(c,max(max(n,s),max(e,w))),least=min(c,min(min(n,s),min(e,w)));
if(most - least <=kContrast*most)return own;
float ne=bright(at + 1),sw=bright(at - 1),nw=bright(at + ivec2(-1,1)),se=bright(at + ivec2(1,-1));
bool level=2.0*abs(n + s - 2.0*c)+ abs(ne + se - 2.0*e)+ abs(nw + sw - 2.0*w)>=
2.0*abs(e + w - 2.0*c)+ abs(ne + nw - 2.0*n)+ abs(se + sw - 2.0*s);
ivec2 along=level ? ivec2(1,0): ivec2(0,1),over=ivec2(1)- along;
float other=level ? n : e,opposite=level ? s : w;
if(abs(opposite - c)> abs(other - c))over=-over,other=opposite;
float middle=0.5*(c + other),step_over=abs(c - other);
vec2 ends=vec2(0.0),departs=vec2(0.0);
int i=0;
do{
++i;
ivec2 to=at + i*along,back=at - i*along;
vec2 mean=0.5*vec2(bright(to)+ bright(to + over),bright(back)+ bright(back + over))- middle;
bvec2 goes_on=lessThan(abs(departs),vec2(kLevel*step_over));
departs=mix(departs,mean,goes_on),ends=mix(ends,vec2(float(i)),goes_on);
}while(i < kReach && any(lessThan(abs(departs),vec2(kLevel*step_over))));
bool first=ends.x < ends.y;
float nearer=first ? departs.x : departs.y;
bool covered=step_over > 0.0 && abs(nearer)>=kLevel*step_over &&(nearer < 0.0)!=(c < middle);
if(!covered)return own;
float share=0.5 -(min(ends.x,ends.y)- 0.5)/(ends.x + ends.y - 1.0);
return vec4(mix(own.rgb,texelFetch(u_image,on_image(at + over),0).rgb,share),own.a);
}
void main(){
vec4 image=without_stairs(on_image(ivec2(floor(gl_FragCoord.xy - u_origin))));
vec3 light=image.a > 0.0 ? image.rgb : u_missing;
o_light=vec4(light*reflector_reflectance(reflector_cosine()),u_with_distance ? image.a : 1.0);
}
`;var Tr=`#include "passes/reflector_surface.glsl"
`;var Er=`#include "passes/reflector_reflectance.glsl"
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
`;var Rr=`#include "passes/reflector_surface.glsl"
`;var Ar=`#include "lib/kernel.glsl"
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
`;var Lr=`float share_of_polygon(vec4 lobe,vec3 corners[4]);
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
`;var Pr=`#include "lib/lobe_light.glsl"
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
`;var zr=`#include "passes/reflector_surface.glsl"
`;var Gr=`#include "passes/reflector_surface.glsl"
`;var Vr=`void main(){}
`;var Dr=`layout(location=0)in vec3 a_position;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
void main(){gl_Position=u_clip_from_pack*vec4(a_position,1.0);}
`;var Br=`#include "lib/reflectance.glsl"
#include "lib/shading.glsl"
#include "passes/place_reflectance.glsl"
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
return reflectance_here(reflectance_from_table(u_reflectance,u_reflectance_row,u_reflectance_count,cos_theta));
}
`;var Cr=`#include "lib/metalness.glsl"
#include "lib/texture_along.glsl"
uniform vec4 u_base_color;
uniform sampler2D u_base_texture;
uniform sampler2D u_metal_texture;
in vec2 v_uv;
in vec4 v_color;
vec3 reflectance_here(vec3 reflectance){
if(!u_metal_varies)return reflectance;
vec3 base=(u_base_color*v_color*texture_along(u_base_texture,v_uv)).rgb;
return reflectance_in_place(reflectance,base,u_metal*texture_along(u_metal_texture,v_uv).a);
}
`;var Ur=`layout(location=0)in vec3 a_position;
layout(location=2)in vec2 a_uv;
layout(location=4)in vec4 a_color;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;
out vec2 v_uv;
out vec4 v_color;
void main(){
gl_Position=u_clip_from_pack*vec4(a_position,1.0);
v_position=a_position;
v_uv=a_uv;
v_color=a_color;
}
`;var Ir=`#include "passes/lightmap.glsl"
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
`;var Or=`#include "passes/surface_vertex.glsl"
`;var Nr=`uniform vec4 u_ndc_from_image;
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
`;var $r=`#include "lib/kernel.glsl"
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
`;var Wr=`#include "passes/screen_convolve.glsl"
layout(location=0)out vec4 o_light;
void main(){o_light=convolved(gl_FragCoord.xy*float(u_coarse));}
`;var Hr=`#include "passes/curved_lobe.glsl"
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
`;var qr=`#include "lib/fullscreen.glsl"
void main(){gl_Position=fullscreen_position(gl_VertexID);}
`;var Xr=`#include "lib/color.glsl"
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
`;var jr=`uniform sampler2D u_sky;
uniform vec3 u_color;
uniform mat4 u_direction_from_clip;
uniform vec4 u_eye;
uniform vec2 u_size;
const float kMost=49128.0;
uniform float u_alpha;
layout(location=0)out vec4 o_light;
void main(){
vec4 beyond=u_direction_from_clip*vec4(2.0*gl_FragCoord.xy / u_size - 1.0,0.0,1.0);
vec3 d=u_eye.w > 0.0 ? normalize(beyond.xyz / beyond.w): -u_eye.xyz;
vec2 uv=vec2(0.5 + atan(d.z,d.x)/ 6.28318531,atan(length(d.xz),d.y)/ 3.14159265);
o_light=vec4(min(u_color*textureLod(u_sky,uv,0.0).rgb,kMost),u_alpha);
}
`;var Kr=`#include "lib/fill.glsl"
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
`;var Yr=`#include "lib/normal_map.glsl"
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
centroid in vec3 v_normal;
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
`;var Qr=`layout(location=0)in vec3 a_position;
layout(location=1)in vec3 a_normal;
layout(location=2)in vec2 a_uv;
layout(location=3)in vec2 a_lightmap_uv;
layout(location=4)in vec4 a_color;
layout(location=5)in vec2 a_normal_uv;
layout(location=6)in vec4 a_tangent;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;
centroid out vec3 v_normal;
out vec2 v_uv;
centroid out vec3 v_lightmap_uv;
#ifdef SHARP
centroid out vec3 v_lit_position;
#endif
out vec4 v_color;
out vec2 v_normal_uv;
out vec4 v_tangent;
void main(){
gl_Position=u_clip_from_pack*vec4(a_position,1.0);
v_position=a_position;
v_normal=a_normal;
v_uv=a_uv;
v_lightmap_uv=vec3(a_lightmap_uv,1.0 + float(min(gl_VertexID,0)));
#ifdef SHARP
v_lit_position=a_position;
#endif
v_color=a_color;
v_normal_uv=a_normal_uv;
v_tangent=a_tangent;
}
`;var Zr=`#include "passes/lightmap.glsl"
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
`;var Jr=`#include "passes/surface_vertex.glsl"
`;var ei=`#include "lib/color.glsl"
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
`;var Kn={"lib/color.glsl":Kt,"lib/distance_alpha.glsl":Yt,"lib/fill.glsl":Qt,"lib/fullscreen.glsl":Zt,"lib/kernel.glsl":Jt,"lib/lightmap_uv.glsl":er,"lib/lobe_light.glsl":tr,"lib/lit_surface.glsl":rr,"lib/metalness.glsl":ir,"lib/mirrored.glsl":ar,"lib/normal_map.glsl":nr,"lib/octahedral.glsl":or,"lib/reflectance.glsl":sr,"lib/shading.glsl":lr,"lib/sharp_light.glsl":cr,"lib/surround.glsl":ur,"lib/taken_light.glsl":hr,"lib/texture_along.glsl":fr,"lib/tonemap.glsl":mr,"lib/transfer.glsl":dr,"passes/curved_light.frag":gr,"passes/curved_light.vert":_r,"passes/curved_lobe.glsl":br,"passes/curved_surface.frag":xr,"passes/curved_surface.vert":yr,"passes/depth.frag":wr,"passes/depth.vert":kr,"passes/lightmap.glsl":Mr,"passes/mover_light.frag":pr,"passes/mover_light.vert":vr,"passes/opaque.glsl":Fr,"passes/reflector_compose.frag":Sr,"passes/reflector_compose.vert":Tr,"passes/reflector_convolve.frag":Er,"passes/reflector_convolve.vert":Rr,"passes/reflector_emitters.frag":Ar,"passes/reflector_emitters.glsl":Lr,"passes/reflector_emitters_sharp.frag":Pr,"passes/reflector_emitters_sharp.vert":zr,"passes/reflector_emitters.vert":Gr,"passes/reflector_mask.frag":Vr,"passes/reflector_mask.vert":Dr,"passes/reflector_reflectance.glsl":Br,"passes/place_reflectance.glsl":Cr,"passes/reflector_surface.glsl":Ur,"passes/scene.frag":Ir,"passes/scene.vert":Or,"passes/screen_blur_width.glsl":Nr,"passes/screen_convolve.glsl":$r,"passes/screen_convolve.frag":Wr,"passes/screen_curved.frag":Hr,"passes/screen_fullscreen.vert":qr,"passes/screen_luminance.frag":Xr,"passes/screen_sky.frag":jr,"passes/screen_pull.frag":Kr,"passes/surface.glsl":Yr,"passes/surface_vertex.glsl":Qr,"passes/transparent.frag":Zr,"passes/transparent.vert":Jr,"passes/screen_average.frag":ei},Yn=["#version 300 es","precision highp float;","precision highp int;","precision highp sampler2D;","precision highp sampler2DArray;","precision highp isampler2D;","precision highp usampler2D;",""].join(`
`);function ti(t,e=""){let r=new Set,i=a=>{if(r.has(a))return"";r.add(a);let n=Kn[a];if(n===void 0)throw new Error(`found no shader ${a}`);return n.replace(/^#include "([^"]+)".*$/gm,(o,s)=>i(s))};return Yn+e.split(" ").filter(Boolean).map(a=>`#define ${a}
`).join("")+i(t)}var ri={u_base_texture:0,u_lightmap:1,u_reflectance:2,u_direction:3,u_normal_texture:4,u_change:5,u_cells:6,u_detail:7,u_surfaces:8,u_image:9,u_frame:9,u_source:9,u_blurred:10,u_before:10,u_taps:11,u_emission_texture:11,u_polygons:12,u_visibility:13,u_seen:14,u_lobes:15,u_codes:6,u_table:7,u_light:9,u_inverse_distance:10,u_places:12,u_normals:13,u_shaded:15,u_metal_texture:1,u_sky:1,u_sharp_at:16,u_sharp_words:17,u_sharp_triangles:18,u_sharp_lamps:19},C=class t{constructor(e,r,i){this.gl=e;this.name=r;this.define=i}at=new Map;program;linked=!1;static make(e,r,i=""){return new t(e,r,i)}start(){if(this.program)return;let{gl:e,name:r}=this,i=r.startsWith("screen_")?"screen_fullscreen":r;this.program=e.createProgram();for(let[a,n]of[[e.VERTEX_SHADER,`${i}.vert`],[e.FRAGMENT_SHADER,`${r}.frag`]]){let o=e.createShader(a);e.shaderSource(o,ti(`passes/${n}`,this.define)),e.compileShader(o),e.attachShader(this.program,o)}e.linkProgram(this.program)}finish(){this.start(),this.linked=!0;let{gl:e}=this,r=this.program;if(!e.getProgramParameter(r,e.LINK_STATUS)&&!e.isContextLost()){let a=e.getAttachedShaders(r).map(n=>e.getShaderInfoLog(n)).join("");throw new Error(`shader ${this.name} ${this.define}: ${a}${e.getProgramInfoLog(r)}`)}e.useProgram(r);let i=e.getProgramParameter(r,e.ACTIVE_UNIFORMS);for(let a=0;a<i;++a){let n=e.getActiveUniform(r,a),o=e.getUniformLocation(r,n.name);this.at.set(n.name,{place:o,type:n.type});let s=ri[n.name];[e.SAMPLER_2D,e.INT_SAMPLER_2D,e.UNSIGNED_INT_SAMPLER_2D].includes(n.type)&&s!==void 0&&e.uniform1i(o,s)}}use(){this.linked||this.finish(),this.gl.useProgram(this.program)}set(e,r){let i=this.at.get(e),a=this.gl;if(!i)return;let n=typeof r=="object"?Float32Array.from(r):void 0,o=Number(r);switch(i.type){case a.FLOAT:a.uniform1f(i.place,o);break;case a.INT:case a.BOOL:a.uniform1i(i.place,o);break;case a.INT_VEC2:a.uniform2i(i.place,n[0],n[1]);break;case a.FLOAT_VEC2:a.uniform2fv(i.place,n);break;case a.FLOAT_VEC3:a.uniform3fv(i.place,n);break;case a.FLOAT_VEC4:a.uniform4fv(i.place,n);break;case a.FLOAT_MAT4:a.uniformMatrix4fv(i.place,!1,n);break}}};function Qn(t,e){switch(e){case t.RGB16F:return[t.RGB,t.HALF_FLOAT];case t.RGBA16F:return[t.RGBA,t.HALF_FLOAT];case t.RGBA32F:return[t.RGBA,t.FLOAT];case t.RGB9_E5:return[t.RGB,t.UNSIGNED_INT_5_9_9_9_REV];case t.R32F:return[t.RED,t.FLOAT];case t.R32UI:return[t.RED_INTEGER,t.UNSIGNED_INT];case t.RGBA16I:return[t.RGBA_INTEGER,t.SHORT];case t.RGBA32UI:return[t.RGBA_INTEGER,t.UNSIGNED_INT];case t.DEPTH24_STENCIL8:return[t.DEPTH_STENCIL,t.UNSIGNED_INT_24_8];default:return[t.RGBA,t.UNSIGNED_BYTE]}}function T(t,e,r=null){let i=t.createTexture(),[a,n]=Qn(t,e.format);return t.activeTexture(t.TEXTURE0),t.bindTexture(t.TEXTURE_2D,i),t.pixelStorei(t.UNPACK_ALIGNMENT,1),t.texStorage2D(t.TEXTURE_2D,e.levels??1,e.format,e.width,e.height),r&&t.texSubImage2D(t.TEXTURE_2D,0,0,0,e.width,e.height,a,n,r),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,e.min??t.NEAREST),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MAG_FILTER,e.mag??t.NEAREST),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,e.wrapS??t.CLAMP_TO_EDGE),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,e.wrapT??t.CLAMP_TO_EDGE),i}function k(t,e,r){t.activeTexture(t.TEXTURE0+ri[e]),t.bindTexture(t.TEXTURE_2D,r)}function re(t,e,r,i){let a=t.createFramebuffer();return t.bindFramebuffer(t.FRAMEBUFFER,a),t.framebufferTexture2D(t.FRAMEBUFFER,t.COLOR_ATTACHMENT0,t.TEXTURE_2D,e,0),i&&(t.framebufferTexture2D(t.FRAMEBUFFER,t.COLOR_ATTACHMENT1,t.TEXTURE_2D,i,0),t.drawBuffers([t.COLOR_ATTACHMENT0,t.COLOR_ATTACHMENT1])),r&&t.framebufferTexture2D(t.FRAMEBUFFER,t.DEPTH_STENCIL_ATTACHMENT,t.TEXTURE_2D,r,0),a}function P(t,e){let r=(a,n)=>{n?t.enable(a):t.disable(a)};r(t.DEPTH_TEST,!!e.depthTest),t.depthFunc(t.LEQUAL),t.depthMask(!!e.depthWrite);let i=e.color??!0;t.colorMask(i,i,i,i&&(e.alpha??!0)),r(t.CULL_FACE,!!e.cull),t.cullFace(t.BACK),t.frontFace(e.mirrored?t.CW:t.CCW),r(t.BLEND,!!e.blend),e.blend==="add"&&t.blendFuncSeparate(t.ONE,t.ONE,t.ONE,t.ZERO),e.blend==="multiply"&&t.blendFuncSeparate(t.ZERO,t.SRC_COLOR,t.ZERO,t.ONE),e.blend==="cover"&&t.blendFuncSeparate(t.ONE,t.ONE_MINUS_SRC_ALPHA,t.ZERO,t.ONE),r(t.STENCIL_TEST,e.stencilFunc!==void 0||!!e.stencilWrite),t.stencilFunc(e.stencilFunc??t.ALWAYS,e.stencilRef??0,e.stencilRead??255),t.stencilMask(e.stencilWrite??0),t.stencilOp(t.KEEP,t.KEEP,t.REPLACE)}function Zn(t,e,r,i){let a=Math.max(xe(t),1e-12),n=S(F(le(t),e),r),o=n+a*1.01,s=n-a*1.01;return i?[s,Math.max(o,s+a*.001)]:(o=Math.max(o,a*.01),s=Math.max(s,Math.min(.1,a/64),o*1e-5),[s,Math.max(o,s*1.001)])}function Be(t,e){let r=Math.max(e,t.near+.001*Math.max(Math.abs(t.near),1e-20)),i=r-t.near,[a,n]=t.tangents,o=new Float64Array(16),s=[t.centre[0]/a,t.centre[1]/n];return o[0]=1/a,o[5]=1/n,t.ortho?(o[12]=-s[0],o[13]=-s[1],o[10]=-2/i,o[14]=-(r+t.near)/i,o[15]=1):(o[10]=-(r+t.near)/i,o[14]=-2*r*t.near/i,o[11]=-1,o[8]=s[0],o[9]=s[1]),o}function ct(t){let e=N(t.forward,[0,0,-1]),r=N(t.up,[0,1,0]);W(G(e,r))<1e-5&&(r=Math.abs(e[1])<.9?[0,1,0]:[0,0,-1]);let i=N(G(e,r),[1,0,0]);return{right:i,up:G(i,e),forward:e}}function ii(t,e,r,i,a=[0,0]){let{right:n,up:o,forward:s}=ct(t),l=t.fov===0,c=t.eye,u=new Float64Array([n[0],o[0],-s[0],0,n[1],o[1],-s[1],0,n[2],o[2],-s[2],0,-S(n,c),-S(o,c),S(s,c),1]),[h,f]=Zn(i,c,s,l),d=l?t.halfHeight>0?t.halfHeight:xe(i):Math.tan(.5*Math.min(Math.max(t.fov,.001),3.1)),m=[d*e/r,d],p={viewFromPack:u,clipFromView:u,clipFromPack:u,eye:l?[-s[0],-s[1],-s[2],0]:[...c,1],tangents:m,centre:[m[0]*2*a[0]/e,m[1]*2*a[1]/r],ortho:l,mirrored:!1,near:h,far:f,width:e,height:r};return p.clipFromView=Be(p,f),p.clipFromPack=J(p.clipFromView,u),p}function ai(t,e,r,i){let a={...t,width:r,height:i};return a.tangents=[t.tangents[0]*r/t.width,t.tangents[1]*i/t.height],a.centre=[t.centre[0]+t.tangents[0]*((2*e[0]+r)/t.width-1),t.centre[1]+t.tangents[1]*((2*e[1]+i)/t.height-1)],a.clipFromView=Be(a,a.far),a.clipFromPack=J(a.clipFromView,a.viewFromPack),a}function ni(t,e){let r=De(t,e),i=r[0]*(r[0]<0?-1:1)+r[1]*(r[1]<0?-1:1)+r[2]+r[3];if(!(i>0))return t;let a=t.slice();for(let n=0;n<4;++n)a[4*n+2]=e[n]*2/i-t[4*n+3];return a}function Ce(t,e){let r=e.map(s=>fe(t,[s[0],s[1],s[2],1])),i=[[0,0,1,1],[1,0,0,1],[-1,0,0,1],[0,1,0,1],[0,-1,0,1]];for(let s of i){let l=c=>s[0]*c[0]+s[1]*c[1]+s[2]*c[2]+s[3]*c[3];r=r.flatMap((c,u)=>{let h=r[(u+1)%r.length],f=l(c),d=l(h),m=f>=0?[c]:[];return f>=0!=d>=0&&m.push(c.map((p,v)=>p+(h[v]-p)*f/(f-d))),m})}let a=r.filter(s=>s[3]>0).map(s=>[s[0]/s[3],s[1]/s[3]].map(l=>Math.min(Math.max(l,-1),1)));if(a.length===0)return;let n=a.map(s=>s[0]),o=a.map(s=>s[1]);return{lower:[Math.min(...n),Math.min(...o)],upper:[Math.max(...n),Math.max(...o)]}}var ut=127,oi=128,Jn=.03,Ue=class{constructor(e,r){this.device=e;this.renderer=r}mask;surface;shade;light;shadedLight;made=!1;canvas;make(){let{gl:e}=this.device;this.made=!0,this.mask=C.make(e,"reflector_mask"),this.surface=C.make(e,"curved_surface"),this.shade=C.make(e,"screen_curved"),this.light=C.make(e,"curved_light"),this.shadedLight=C.make(e,"curved_light","SHADED")}draw(e,r,i){let a=[],n=[],o=[],{view:s}=r;if(i.largeOnly||e.surrounds.length===0)return{later:a,materials:n};this.made||this.make();for(let l of e.curved){if(l.count===0||!e.surrounds[l.map]||!te(s.clipFromPack,l.bounds))continue;let c=e.isTransparent(l.material);if(c?!r.inFrame:r.values+1>=ut)continue;let u=c?oi:++r.values;c||n.push(l.material),c||!r.inFrame?(this.drawMask(e,r,l,u,c?oi:ut),a.push(l)):o.push({curved:l,value:u})}return o.length>0&&this.drawShown(e,r,o,i),{later:a,materials:n}}add(e,r,i,a){for(let n of i)this.drawLight(e,r,n,this.light,{blend:"add",alpha:!1},a)}state(e,r){return{depthTest:!0,cull:!0,mirrored:e.view.mirrored,...r}}drawMask(e,r,i,a,n){P(this.device.gl,this.state(r,{color:!1,stencilRef:a,stencilWrite:n})),this.mask.use(),this.mask.set("u_clip_from_pack",r.view.clipFromPack),e.bindGeometry(),e.draw(i)}drawShown(e,r,i,a){let{gl:n,color:o}=this.device,s=o===n.RGBA32F;s&&this.shadeAll(e,r,i,a),r.begin();for(let{curved:l,value:c}of i){let u={stencilRef:c,stencilWrite:ut};s&&(this.shadedLight.use(),this.shadedLight.set("u_id",c),k(n,"u_shaded",this.canvas.light),k(n,"u_normals",this.canvas.normals)),this.drawLight(e,r,l,s?this.shadedLight:this.light,u,a)}}drawLight(e,r,i,a,n,o){P(this.device.gl,this.state(r,n)),a.use(),this.setLobe(a,e,r,i,o),this.setNormals(a,e,r,i),a.set("u_modulate",!0),e.setPlaceReflectance(a,i.material),e.bindGeometry(),e.draw(i)}ensure(e,r){let i=this.canvas,{gl:a}=this.device;if(i&&i.width>=e&&i.height>=r)return i;if(i){for(let f of[i.places,i.normals,i.depth,i.light])a.deleteTexture(f);for(let f of[i.surfaces,i.shaded])a.deleteFramebuffer(f)}let n=Math.max(e,i?.width??0),o=Math.max(r,i?.height??0),s=f=>T(a,{width:n,height:o,format:f}),l=s(a.RGBA32F),c=s(a.RGBA32F),u=s(a.DEPTH24_STENCIL8),h=s(a.RGBA16F);return this.canvas={width:n,height:o,places:l,normals:c,depth:u,light:h,surfaces:re(a,l,u,c),shaded:re(a,h,u)}}shadeAll(e,r,i,a){let{gl:n}=this.device,{view:o}=r,s=this.ensure(o.width,o.height);n.enable(n.SCISSOR_TEST);let l=(c,u)=>{n.bindFramebuffer(n.FRAMEBUFFER,c),n.viewport(0,0,o.width,o.height),n.scissor(0,0,o.width,o.height),P(n,{depthWrite:!0,stencilWrite:255}),n.clearColor(0,0,0,0),n.clear(u)};l(s.surfaces,n.DEPTH_BUFFER_BIT|n.STENCIL_BUFFER_BIT),this.surface.use();for(let{curved:c,value:u}of i)P(n,this.state(r,{depthWrite:!0,stencilRef:u,stencilWrite:255})),this.setNormals(this.surface,e,r,c),e.bindGeometry(),e.draw(c);l(s.shaded,n.COLOR_BUFFER_BIT),this.shade.use(),k(n,"u_places",s.places),k(n,"u_normals",s.normals);for(let{curved:c,value:u}of i)P(n,{stencilFunc:n.EQUAL,stencilRef:u}),this.setLobe(this.shade,e,r,c,a),this.shade.set("u_id",u),this.scissor(r,c),this.renderer.drawScreen();n.disable(n.SCISSOR_TEST)}scissor(e,r){let{lower:i,upper:a}=r.bounds,{view:n}=e,o={x0:1,y0:1,x1:-1,y1:-1};for(let u=0;u<6;++u){let h=u>>1,f=(h+1)%3,d=(h+2)%3,m=[0,1,2,3].map(v=>{let b=u%2===0?[...i]:[...a];return b[f]=v===1||v===2?a[f]:i[f],b[d]=v>=2?a[d]:i[d],b}),p=Ce(n.clipFromPack,m);p&&(o.x0=Math.min(o.x0,p.lower[0]),o.y0=Math.min(o.y0,p.lower[1]),o.x1=Math.max(o.x1,p.upper[0]),o.y1=Math.max(o.y1,p.upper[1]))}let s=(u,h,f)=>f((u*.5+.5)*h),l=s(o.x0,n.width,Math.floor),c=s(o.y0,n.height,Math.floor);this.device.gl.scissor(l,c,Math.max(0,s(o.x1,n.width,Math.ceil)-l),Math.max(0,s(o.y1,n.height,Math.ceil)-c))}setNormals(e,r,i,a){e.set("u_clip_from_pack",i.view.clipFromPack),e.set("u_eye",i.view.eye),r.setNormals(e,a.material)}setLobe(e,r,i,a,n){let{gl:o}=this.device,s=r.surrounds[a.map],l=r.kernel(a.material,n.taps);k(o,"u_light",s.light),k(o,"u_inverse_distance",s.inverseDistance),k(o,"u_taps",l.taps),e.set("u_eye",i.view.eye),e.set("u_centre",s.centre),e.set("u_size",s.size),e.set("u_light_scale",s.tint.map(c=>c*s.scale*r.unit)),e.set("u_range",s.range),e.set("u_tap_count",l.count),e.set("u_tap_rows",l.rows),e.set("u_wide",l.median>=Jn)}};var ht=127,si=128,eo=.01,to=.001,li=.5,ci=1e-5,ro=.02,ft=6,io=16/6,ui=t=>.25*(t.upper[0]-t.lower[0])*(t.upper[1]-t.lower[1]),Ie=class{constructor(e,r,i){this.device=e;this.renderer=r;this.none=i;let{gl:a}=e;this.mask=C.make(a,"reflector_mask"),this.compose=C.make(a,"reflector_compose"),this.convolve=C.make(a,"reflector_convolve"),this.emitters=C.make(a,"reflector_emitters"),this.glints=C.make(a,"reflector_emitters_sharp"),this.curved=new Ue(e,r),this.pull=C.make(a,"screen_pull"),this.blur=C.make(a,"screen_convolve")}mask;compose;convolve;emitters;glints;pull;blur;curved;images=[];get programs(){return[this.mask,this.compose,this.convolve,this.emitters,this.glints,this.pull,this.blur]}drawMasks(e,r,i){let a=[],{gl:n}=this.device,o=r.view;if(r.values=0,i.orders===0)return a;for(let s of e.reflectors){let l=fe(s.reflectorFromPack,o.eye);if(s.count===0||l[2]<=(o.ortho?ci:ci*s.size))continue;let c=Ce(o.clipFromPack,s.corners);if(!c||i.largeOnly&&r.share*ui(c)<ro)continue;let u=e.isTransparent(s.material),h=r.reflectance*e.reflectanceOf(s.material);if(!r.inFrame&&(u||h<eo||h*r.share*ui(c)<to)||r.mirrors>=i.orders&&(h<li||e.kernel(s.material,i.taps).count>1)||!u&&r.values+1>=ht)continue;let f=u?0:++r.values;if(this.drawMask(e,s,o,f,r.inFrame),r.inFrame&&!s.visible){u||this.drawMask(e,s,o,0,!1,!0);continue}a.push({reflector:s,screen:c,value:f})}return n.disable(n.STENCIL_TEST),a}drawMask(e,r,i,a,n,o=!1){let{gl:s}=this.device;n&&r.asked&&s.getQueryParameter(r.query,s.QUERY_RESULT_AVAILABLE)&&(r.visible=s.getQueryParameter(r.query,s.QUERY_RESULT)>0,r.asked=!1);let l=a===0&&!o;P(s,{depthTest:!0,color:!1,cull:!0,mirrored:i.mirrored,stencilRef:l?si:a,stencilWrite:l?si:ht}),this.mask.use(),this.mask.set("u_clip_from_pack",i.clipFromPack),e.bindGeometry();let c=n&&!r.asked;c&&s.beginQuery(s.ANY_SAMPLES_PASSED,r.query??=s.createQuery()),e.draw(r),c&&(s.endQuery(s.ANY_SAMPLES_PASSED),r.asked=!0)}chooseImage(e,r,i){let a=i.ortho?0:.5*r*.5*i.height/i.tangents[1],n=a>=io*ft?4:a>=ft?2:1,o=a>=ft?4:1,s=Math.max(i.width,i.height),l=Math.ceil(Math.min(Math.max(4*a,4),.15*s+4)),c=(m,p,v,b)=>o*b(((m*.5+.5)*p+v)/o),u=c(e.lower[0],i.width,-l,Math.floor),h=c(e.lower[1],i.height,-l,Math.floor),f=c(e.upper[0],i.width,l,Math.ceil),d=c(e.upper[1],i.height,l,Math.ceil);return{origin:[u,h],width:Math.max(f-u,1),height:Math.max(d-h,1),coarse:n}}image(e,r,i){let a=this.images[e];if(a&&a.width>=r&&a.height>=i)return a;let{gl:n,color:o,linear:s}=this.device,l=(p,v)=>2**Math.ceil(Math.log2(Math.max(p,v,16))),c=l(r,a?.width??0),u=l(i,a?.height??0);if(a){for(let p of[a.color,a.blurred,a.depth])n.deleteTexture(p);for(let p of[a.target,a.level])n.deleteFramebuffer(p)}let h=Math.log2(Math.max(c,u))+1,f=T(n,{width:c,height:u,levels:h,format:o,min:n.LINEAR_MIPMAP_NEAREST,mag:s}),d=T(n,{width:c,height:u,format:o,min:s,mag:s}),m=T(n,{width:c,height:u,format:n.DEPTH24_STENCIL8});return this.images[e]={width:c,height:u,color:f,blurred:d,depth:m,target:re(n,f,m),level:re(n,d)}}draw(e,r,i,a){let n=i.reflector,o=e.kernel(n.material,a.taps),s=o.count>1,l=this.chooseImage(i.screen,s?o.median:0,r.view),c=this.image(r.mirrors,l.width,l.height);this.drawMirrored(e,r,n,l,c,a),s&&this.makeLevels(l,c),s&&l.coarse>1&&this.drawBlurred(e,r.view,n,o,l,c),r.begin(),this.drawComposed(e,r,i,o,l,c),this.drawEmitters(e,r,i,o)}drawMirrored(e,r,i,a,n,o){let{gl:s,closest:l}=this.device,c=r.view,u=()=>{s.bindFramebuffer(s.FRAMEBUFFER,n.target),s.viewport(0,0,a.width,a.height)};u(),s.enable(s.SCISSOR_TEST),s.scissor(0,0,a.width,a.height),this.renderer.clear([...e.sky.map(p=>p*e.unit),l]),s.disable(s.SCISSOR_TEST);let h=this.mirroredView(e,i,c,a);this.renderer.drawSky(e,h,l);let f=e.opaque.filter(p=>te(h.clipFromPack,p.bounds)),d=i.dark.filter(p=>te(h.clipFromPack,p.bounds)),m={view:h,begin:u,inFrame:!1,mirrors:r.mirrors+1,texture:n.color,values:0,reflectance:r.reflectance*e.reflectanceOf(i.material),share:r.share*h.width*h.height/(c.width*c.height)};if(m.mirrors<o.mirrors){this.renderer.drawDepth(e,h,f);let p=this.drawMasks(e,m,o),v=this.curved.draw(e,m,o);this.renderer.drawReflected(e,h,f,d,new Set([...p.map(b=>b.reflector.material),...v.materials]));for(let b of p)this.draw(e,m,b,o);u(),this.curved.add(e,m,v.later,o)}else this.renderer.drawReflected(e,h,f,d,new Set);e.movers.some&&(e.movers.drawDepth(h),e.movers.drawLight(h,!0)),this.renderer.drawTransparent(e,h)}mirroredView(e,r,i,a){let n=Xt();n[10]=-1;let o=J(i.viewFromPack,r.packFromReflector),s=J(J(o,n),r.reflectorFromPack),l=fe(r.reflectorFromPack,i.eye);l[2]=-l[2];let c=0,u=e.bounds;for(let d=0;d<8;++d){let m=ee(s,[d&1?u.upper[0]:u.lower[0],d&2?u.upper[1]:u.lower[1],d&4?u.upper[2]:u.lower[2]]);c=Math.max(c,-1.01*m[2])}let h=ai(i,a.origin,a.width,a.height);h.far=Math.max(i.far,c),h.mirrored=!i.mirrored,h.viewFromPack=s,h.eye=fe(r.packFromReflector,l),h.clipFromView=Be(h,h.far);let f=r.reflectorFromPack;return h.clipFromPack=ni(J(h.clipFromView,s),[f[2],f[6],f[10],f[14]-r.flatness-1e-5*r.size]),h}makeLevels(e,r){let{gl:i}=this.device,a=Math.ceil(Math.log2(Math.max(e.width,e.height)))+1,n=(o,s)=>Math.max(1,o+(1<<s)-1>>s);P(i,{}),this.pull.use(),this.pull.set("u_reach",1e30),i.bindFramebuffer(i.FRAMEBUFFER,r.level);for(let o=1;o<a;++o)k(i,"u_source",r.color),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_BASE_LEVEL,o-1),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MAX_LEVEL,o-1),i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,r.color,o),this.pull.set("u_source_size",[n(e.width,o-1),n(e.height,o-1)]),i.viewport(0,0,n(e.width,o),n(e.height,o)),this.renderer.drawScreen();i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,r.blurred,0),k(i,"u_source",r.color),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_BASE_LEVEL,0),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MAX_LEVEL,a-1)}setConvolution(e,r,i,a,n,o,s){let{gl:l}=this.device,c=J(i.viewFromPack,a.packFromReflector),u=N([c[8],c[9],c[10]],[0,0,1]),h=[i.centre[0]/i.tangents[0],i.centre[1]/i.tangents[1]];e.set("u_ndc_from_image",[2/i.width,2/i.height,2*o.origin[0]/i.width-1+h[0],2*o.origin[1]/i.height-1+h[1]]),e.set("u_tangents",i.tangents),e.set("u_ortho",i.ortho?1:0),e.set("u_plane_normal",u),e.set("u_plane_offset",S(u,[c[12],c[13],c[14]])),e.set("u_farthest",1e4*Math.max(xe(r.bounds),1e-12)),e.set("u_constant_footprint",-1),e.set("u_median",n.median),e.set("u_coarse",o.coarse),e.set("u_pixels_per_tangent",.5*i.height/i.tangents[1]),k(l,"u_image",s.color),k(l,"u_taps",n.taps),e.set("u_image_size",[o.width,o.height]),e.set("u_texture_size",[s.width,s.height]),e.set("u_tap_count",n.count),e.set("u_tap_rows",n.rows)}drawBlurred(e,r,i,a,n,o){let{gl:s}=this.device;s.bindFramebuffer(s.FRAMEBUFFER,o.level),s.viewport(0,0,Math.floor(n.width/n.coarse),Math.floor(n.height/n.coarse)),P(s,{}),this.blur.use(),this.setConvolution(this.blur,e,r,i,a,n,o),s.bindVertexArray(this.none),this.renderer.drawScreen()}where(e,r,i){let a={depthTest:!0,cull:!0,mirrored:e.view.mirrored};return e.inFrame&&r.value>0?{...a,stencilFunc:this.device.gl.EQUAL,stencilRef:r.value,stencilRead:ht}:{...a,blend:"add",alpha:i}}setReflector(e,r,i,a){let n=a.packFromReflector;r.bindGeometry(),e.set("u_clip_from_pack",i.view.clipFromPack),e.set("u_eye",i.view.eye),e.set("u_normal",[n[8],n[9],n[10]]),r.setPlaceReflectance(e,a.material),e.set("u_modulate",!0)}drawComposed(e,r,i,a,n,o){let{gl:s}=this.device,l=i.reflector,c=!r.inFrame&&e.reflectanceOf(l.material)>li,u=a.count>1?this.convolve:this.compose;P(s,this.where(r,i,c)),u.use(),u.set("u_origin",n.origin),u.set("u_missing",[0,0,0]),u.set("u_with_distance",c),this.setReflector(u,e,r,l),k(s,"u_blurred",o.blurred),this.setConvolution(u,e,r.view,l,a,n,o),e.draw(l)}drawEmitters(e,r,i,a){let{gl:n}=this.device,o=i.reflector,s=o.emitters;if(!s)return;let l=e.data.reflectors[o.index],c=a.lobes?this.emitters:this.glints;c.use(),k(n,"u_polygons",s.polygons),k(n,"u_visibility",s.visibility),k(n,"u_seen",s.seen),a.lobes&&k(n,"u_lobes",a.lobes),c.set("u_cells",[s.cellsX,s.cellsY]),c.set("u_lower",l.lower.map(h=>h/o.size)),c.set("u_upper",l.upper.map(h=>h/o.size));let u=o.reflectorFromPack.slice();for(let h=0;h<4;++h)for(let f=0;f<3;++f)u[4*h+f]/=o.size;c.set("u_emitters_from_pack",u),a.lobes&&c.set("u_lobe_rows",33),this.setReflector(c,e,r,o),P(n,{...this.where(r,i,!1),blend:"add",alpha:!1}),e.draw(o)}};function ao(t,e,r){let i=t.corners.map(o=>E(ee(e,o),1/r)),a=i.flatMap((o,s)=>{let l=i[(s+1)%i.length],c=o[2]>=0?[o]:[];return o[2]>=0!=l[2]>=0&&c.push(B(o,E(F(l,o),o[2]/(o[2]-l[2])))),c}),n=[];return a.length>=3&&n.push([a[0],a[1],a[2],a[Math.min(a.length-1,3)]]),a.length===5&&n.push([a[0],a[3],a[4],a[4]]),n}function mt(t,e,r,i,a,n){if(e.emitters.length===0||!(a>0))return;let o=e.nodesX-1,s=e.nodesY-1,l=o*s,c=[],u=new Uint8Array(4*l*e.emitters.length),h=new Uint32Array(4*l);if(e.emitters.forEach((f,d)=>{let m=r[f],p=e.visibility.subarray(d*e.nodesX*e.nodesY),v=ao(m,i,a).map(b=>{let g=m.twoSided?-(d+1):d+1;return c.push(...b[0],...b[1],...b[2],...b[3],...m.radiance.map(_=>_*n),g),c.length/16-1});for(let b=0;b<s;++b)for(let g=0;g<o;++g){let _=b*e.nodesX+g,x=b*o+g,w=[p[_],p[_+1],p[_+e.nodesX],p[_+e.nodesX+1]];if(u.set(w,4*(d*l+x)),w.some(y=>y>0))for(let y of v)h[4*x+(y>>5)]|=1<<(y&31)}}),c.length!==0)return{cellsX:o,cellsY:s,polygons:T(t,{width:4,height:c.length/16,format:t.RGBA32F},new Float32Array(c)),visibility:T(t,{width:o,height:s*e.emitters.length,format:t.RGBA8},u),seen:T(t,{width:o,height:s,format:t.RGBA32UI},h)}}function hi(t,e,r){let i=t.corners,a=i.length,n=[0,0,0],o=0;i.forEach((f,d)=>{n=B(n,G(F(f,i[0]),F(i[(d+1)%a],i[0]))),o=Math.max(o,W(F(i[(d+1)%a],f)))});let s=N(n,[0,0,0]),l=W(s)>0?.001*o:-1,c=i.map((f,d)=>N(G(s,F(i[(d+1)%a],f)),[0,0,0])),u=f=>{let d=ae(e.positions,f);return Math.abs(S(F(d,i[0]),s))<=l&&i.every((m,p)=>S(F(d,m),c[p])>=-l)},h=[];for(let f of e.parts){if(r[f.material].emission.every(m=>m===0))continue;let d=[];for(let m=f.first;m<f.first+f.count;m+=3){let p=[...e.indices.subarray(m,m+3)];p.every(u)&&d.push(...p)}d.length>0&&h.push({part:f,indices:d})}return h}var no=Float32Array.from({length:256},(t,e)=>e/255<=.04045?e/255/12.92:((e/255+.055)/1.055)**2.4),oo=t=>t<=.0031308?12.92*t:1.055*t**(1/2.4)-.055,fi=t=>Math.round(255*Math.min(Math.max(t,0),1));function so(t,e){let r=t.width*t.height,i=new Float32Array(5*r),a=t.texels;for(let n=0;n<r;++n){let o=a[4*n+3]/255,s=e>0?+(o>=Math.fround(e)):o;for(let l=0;l<3;++l)i[5*n+l]=no[a[4*n+l]]*s;i[5*n+3]=s,i[5*n+4]=o}return{width:t.width,height:t.height,texels:i}}function mi(t,e){let r=t/e;return Array.from({length:e},(i,a)=>{let n=[];for(let o=Math.floor(a*r);o<t&&o<(a+1)*r;++o)n.push([o,(Math.min((a+1)*r,o+1)-Math.max(a*r,o))/r]);return n})}function lo(t){let e=Math.max(1,t.width>>1),r=Math.max(1,t.height>>1),i=new Float32Array(5*e*r),a=mi(t.width,e);return mi(t.height,r).forEach((o,s)=>a.forEach((l,c)=>{for(let[u,h]of o)for(let[f,d]of l)for(let m=0;m<5;++m)i[5*(s*e+c)+m]+=d*h*t.texels[5*(u*t.width+f)+m]})),{width:e,height:r,texels:i}}function co(t,e,r){let i=t.texels.length/5,a=Math.min(Math.round(e*i),i),n=new Float32Array(i);for(let h=0;h<i;++h)n[h]=t.texels[5*h+4];n.sort().reverse();let o=n.filter(h=>h>=Math.fround(r)).length;if(a===0||a===o)return 1;let s=n[a-1],l=n.indexOf(s),c=n.lastIndexOf(s)+1,u=l===0||c-a<=a-l?s:n[l-1];return u>0?(r+1/255)/u:1}function uo(t,e){let r=new Uint8Array(t.texels.length/5*4),i=t.texels;for(let a=0;a<r.length/4;++a){let n=i[5*a+3];for(let o=0;o<3;++o)r[4*a+o]=fi(n>0?oo(i[5*a+o]/n):0);r[4*a+3]=fi(e*i[5*a+4])}return r}function di(t,e){let r=[];for(let a=so(t,e);a.width>1||a.height>1;)r.push(a=lo(a));if(r.length===0)return[];let i=r[r.length-1].texels[3];for(let a=r.length-2;a>=0;--a){let n=r[a+1],o=r[a];for(let s=0,l=0;s<o.height;++s)for(let c=0;c<o.width;++c,++l){if(o.texels[5*l+3]>0)continue;let u=5*(Math.min(s>>1,n.height-1)*n.width+Math.min(c>>1,n.width-1));o.texels.set(n.texels.subarray(u,u+4),5*l)}}return r.map(a=>({width:a.width,height:a.height,texels:uo(a,e>0?co(a,i,e):1)}))}var vi=1667,gi=25e3,ho=100,fo=.01,mo=t=>.2126*t[0]+.7152*t[1]+.0722*t[2],dt=t=>t.map(e=>e/Math.max(mo(t),1e-6));function pt(t){let e=1e3/Math.min(Math.max(t,vi),gi),r=t<=4e3?((-.2661239*e-.2343589)*e+.8776956)*e+.17991:((-3.0258469*e+2.1070379)*e+.2226347)*e+.24039,i=t<=2222?((-1.1063814*r-1.3481102)*r+2.18555832)*r-.20219683:t<=4e3?((-.9549476*r-1.37418593)*r+2.09137015)*r-.16748867:((3.081758*r-5.8733867)*r+3.75112997)*r-.37001483,a=r/i,n=(1-r-i)/i;return dt([3.2404542*a-1.5371385-.4985314*n,-.969266*a+1.8760108+.041556*n,.0556434*a-.2040259+1.0572252*n].map(o=>Math.max(o,0)))}function po(t){if(!/^#[0-9a-f]{6}$/i.test(t))return;let e=[1,3,5].map(r=>{let i=parseInt(t.slice(r,r+2),16)/255;return i<=.04045?i/12.92:((i+.055)/1.055)**2.4});return Math.max(...e)>0?dt(e):void 0}function vo(t){let e=Math.max(...t);return`#${t.map(r=>{let i=r/e<=.0031308?12.92*r/e:1.055*(r/e)**.4166666666666667-.055;return Math.round(255*Math.min(Math.max(i,0),1)).toString(16).padStart(2,"0")}).join("")}`}var Oe=(t,e)=>t.map((r,i)=>{let a={on:!0,value:r.value};return e?.hours.some(n=>n.group===i)&&(a.value=1,a.hour=e.shown),r.color.some(n=>n!==1)&&(a.color=dt(r.color.map((n,o)=>n*r.ownColor[o]))),a});function go(t,e){let r=po(t),i=/^([0-9.]+)k$/i.exec(t),a=Number(t);t==="on"||t==="off"?e.on=t==="on":r?(e.color=r,delete e.kelvin):i&&Number(i[1])>=vi&&Number(i[1])<=gi?Ne(e,Number(i[1])):t!==""&&a>=0&&a<=ho&&(e.value=a,e.on=!0)}function Ne(t,e){t.kelvin=e,t.color=pt(e)}function _i(t,e,r,i){for(let a of e){let n=a.lastIndexOf("="),o=a.slice(0,n);i&&o==="hour"&&t.every(s=>s.name!==o)&&vt(i,Number(a.slice(n+1)),r),t.forEach((s,l)=>{let c=o==="*"||(r[l].hour===void 0?o===s.name:o==="day");n>0&&c&&a.slice(n+1).split(/\s+/).forEach(u=>go(u,r[l]))})}}function vt(t,e,r){if(e>=t.hours[0].hour&&e<=t.hours.at(-1).hour)for(let i of r)i.hour!==void 0&&(i.hour=e)}function _o(t,e){let r=t.find(u=>u.hour!==void 0)?.hour;if(!e||r===void 0)return t.map(()=>1);let{hours:i}=e,a=i.filter(u=>u.group<t.length).length,n=Math.max(i.findIndex(u=>u.hour>=r),0),o=Math.max(n-1,0),s=i[o].hour,l=i[n].hour,c=l>s?(r-s)/(l-s):1;return t.map((u,h)=>u.hour===void 0?1:a*((i[n].group===h?c:0)+(o<n&&i[o].group===h?1-c:0)))}function bi(t,e,r){let i=s=>[String(+s.value.toFixed(3)),s.kelvin?`${Math.round(s.kelvin)}K`:s.color?vo(s.color):"",s.on?"":"off"].filter(Boolean).join(" "),a=Oe(t,r),n=e.find(s=>s.hour!==void 0)?.hour,o=e.flatMap((s,l)=>i(s)===i(a[l])?[]:[`${t[l].name}=${i(s)}`]);return n===void 0||n===r?.shown?o:[`hour=${n}`,...o]}var xi=(t,e,r,i=_o(e,r))=>e.map((a,n)=>[0,1,2].map(o=>a.on?i[n]*a.value*(a.color?a.color[o]/Math.max(t[n].ownColor[o],fo):1):0)),bo;function pi(t,e,r,i,a,n){let o=e?t.restOfDetail:t.rest,s=new Uint16Array(i.length),l=bo??=Float32Array.from({length:1984},(c,u)=>Z(u<<4));for(let c=0;c<o.length;++c){let u=o[c],h=r[u];for(let f=0;f<3;++f){let d=h[f]*Z(i[3*c+f])*a;for(let m of t.others)m.group!==u&&(d+=(r[m.group][f]-h[f])*t.scale*l[(e?m.detail:m.light)[3*c+f]]);s[3*c+f]=qt(Math.max(d,0)/n)}}return s}function yi(t,e,r){if(!e||e.width!==t.width||e.height!==t.height||r.every(n=>n.every(o=>o===1)))return t;let i=Math.max(1,...r.flat()),a=t.scale*2**Math.ceil(Math.log2(i));return{...t,scale:a,light:pi(e,!1,r,t.light,t.scale,a),detail:t.detail&&pi(e,!0,r,t.detail,t.scale,a)}}function wi(t,e){let r=t.hours.filter(i=>i.group<e.length);return[0,1,2].map(i=>r.reduce((a,n)=>a+e[n.group][i]/r.length*n.sky[i],0))}function ye(t,e,r,i){return[0,1,2].map(a=>Math.max(0,t.reduce((n,o,s)=>n+(e[s][a]-1)*(o[r][3*i+a]??0),1)))}var xo=.001,gt=.2,$e=16;function We(t,e){let r=new Float64Array(e*e),i=Math.sqrt(.25/Math.PI),a=1,n=0;for(let o=0;o<e;++o){o>0&&(i*=Math.sqrt((2*o+1)/(2*o)),[a,n]=[t[0]*a-t[1]*n,t[0]*n+t[1]*a]);let s=0,l=i*(o>0?Math.SQRT2:1);for(let c=o;c<e;++c){if(c>o){let u=Math.sqrt((4*c*c-1)/(c*c-o*o)),h=c===o+1?0:-u*Math.sqrt(((c-1)**2-o*o)/(4*(c-1)**2-1));[s,l]=[l,u*t[2]*l+h*s]}r[c*(c+1)+o]=l*a,o>0&&(r[c*(c+1)-o]=l*n)}}return r}function Mi(t,e,r){let i=t.lights.map(a=>a.intensity);return e.forEach((a,n)=>{for(let o of a.brightLights)i[o]=t.lights[o].intensity.map((s,l)=>s*r[n][l])}),{field:t,bright:i,probes:t.valid.length===0?[]:Array.from(t.valid,(a,n)=>ye(e,r,"probes",n))}}function yo(t,e,r){let i=Math.sqrt(Math.max(0,1-Math.abs(r[2]))),a=i*Math.atan2(Math.abs(r[1]),Math.abs(r[0]))*(2/Math.PI),n=i-a,[o,s]=r[2]<0?[1-a,1-n]:[n,a],l=t.depthSide,c=g=>g<0||Object.is(g,-0)?-1:1,u=(.5*o*c(r[0])+.5)*l-.5,h=(.5*s*c(r[1])+.5)*l-.5,f=Math.floor(u),d=Math.floor(h),m=u-f,p=h-d,v=l*l,b=[0,0];for(let g=0;g<4;++g){let _=[f+(g&1),d+(g>>1)];for(let y of[0,1])(_[y]<0||_[y]>=l)&&(_[y]=_[y]<0?-1-_[y]:2*l-1-_[y],_[1-y]=l-1-_[1-y]);let x=(g&1?m:1-m)*(g>>1?p:1-p),w=e*v+_[1]*l+_[0];b[0]+=x*t.depth[w]/65535,b[1]+=x*t.depthSquared[w]/65535}return b}function wo(t,e,r){let i=F(r,ae(t.positions,e)),a=W(i);if(!(a>0))return 1;let[n,o]=yo(t,e,E(i,1/a)),s=a/t.depthCap-n;if(s<=0)return 1;let l=Math.max(o-n*n,1e-6);return(l/(l+s*s))**3}function ko(t,e){let r=[0,0,0],i=0,a=1;for(let n=0;n<3;++n){let o=t.size[n],s=Math.min(Math.max((e[n]-t.lower[n])/t.cell[n],0),o),l=Math.min(Math.floor(s),o-1);r[n]=s-l,i+=l*a,a*=o}for(;t.cells[9*i]!==0;){i=t.cells[9*i];for(let n=0;n<3;++n){let o=r[n]>=.5;r[n]=2*r[n]-Number(o),o&&(i+=1<<n)}}return{cell:i,inCell:r}}var ki=(t,e,r)=>(t[2*e+(r>>5)]>>>(r&31)&1)>0;function Mo(t){if(t.kind===1||t.kind===2)return[{at:t.position,w:1}];let e=[];if(t.kind===3){let n=Math.tan(Math.min(t.angularRadius,1.5)),o=E(t.direction,-1),s=n>0?$e:1,l=N(G(Math.abs(o[0])<.9?[1,0,0]:[0,1,0],o),[1,0,0]),c=G(o,l);for(let u=0;u<s;++u){let h=s>1?n*Math.sqrt((u+.5)/s):0,f=2.3999632*u;e.push({at:N(B(o,B(E(l,h*Math.cos(f)),E(c,h*Math.sin(f)))),o),w:0})}return e}let r=[],i=t.corners,a=0;for(let n=0;n+2<i.length;n+=3)r.push(a+=.5*W(G(F(i[n+1],i[n]),F(i[n+2],i[n]))));for(let n=0;n<$e&&a>0;++n){let o=.5/$e,s=0;for(let m=n,p=.5;m>0;m>>=1,p*=.5)o+=(m&1)*p;let l=(n+.5)/$e*a;for(;s+1<r.length&&r[s]<=l;)++s;let c=s>0?r[s-1]:0,u=Math.sqrt(Math.min(Math.max((l-c)/Math.max(r[s]-c,1e-30),0),1)),[h,f,d]=[i[3*s],i[3*s+1],i[3*s+2]];e.push({at:B(E(h,1-u),B(E(f,u*(1-o)),E(d,u*o))),w:1})}return e}function Fo(t,e,r,i,a,n){let o=Mo(t),s=a*a,l=1;if(t.kind===0){l=0;for(let h=0,f=t.corners;h+2<f.length;h+=3)l+=.5*W(G(F(f[h+1],f[h]),F(f[h+2],f[h])))}let c=Math.cos(t.outerCone),u=c+Math.max(.001,Math.cos(t.innerCone)-c);for(let{at:h,w:f}of o){let d=F(h,E(i,f)),m=Math.max(S(d,d),1e-12),p=E(d,1/Math.sqrt(m)),v=-S(p,t.direction),b=1;t.kind===0&&(b=t.twoSided?Math.abs(v):Math.max(v,0)),t.kind===2&&(b=Math.min(Math.max((v-c)/(u-c),0),1)**2);let g=f===0?1:l*b/m,_=We(p,a),x=g*r/o.length;for(let w=0;w<3;++w)for(let y=0;y<s;++y)n[w*s+y]+=x*e[w]*_[y]}}function Fi(t,e){let{field:r}=t,i=r.bands*r.bands,a=new Float64Array(3*i),{cell:n,inCell:o}=ko(r,e),s=[...r.cells.subarray(9*n+1,9*n+9)],l=[],c=[],u=[];s.forEach((b,g)=>{let _=o.reduce((y,z,I)=>y*(g>>I&1?z:1-z),1),x=r.valid[b]>0,w=x?wo(r,b,e):0;w<gt&&(w*=w*w/(gt*gt)),u.push(_),c.push(x?_:0),l.push(w*_)});let h=b=>b.reduce((g,_)=>g+_,0),f=Math.min(1,h(l)),d=f>xo?l:h(c)>0?c:u,m=h(d),p=r.lights.map(()=>0),v=r.lights.map(()=>!1);return s.forEach((b,g)=>{let _=d[g]/m;if(_>0){for(let x=0;x<3;++x){let w=_*(t.probes[b]?.[x]??1);for(let y=0;y<i;++y)a[x*i+y]+=w*r.harmonics[(x*i+y)*r.valid.length+b]}r.lights.forEach((x,w)=>{v[w]||=ki(r.bright,b,w),ki(r.kept,b,w)&&(p[w]+=_)})}}),r.lights.forEach((b,g)=>{v[g]&&Fo(b,t.bright[g],Math.max(0,1-p[g]),e,r.bands,a)}),{sh:a,trust:f}}var pe=.7,So=.02,To=.05;function Eo(t,e,r){let i=t.reduce((o,s,l)=>o+s*e[l],0),a=e;if(i<0&&(i=-i,a=e.map(o=>-o)),i>1-1e-7)return t.map((o,s)=>o+(a[s]-o)*r);let n=Math.acos(i);return t.map((o,s)=>(Math.sin((1-r)*n)*o+Math.sin(r*n)*a[s])/Math.sin(n))}function Si(t,e){let r=t.keys,i=r[r.length-1];if(!i)return t.rest;let a=e>i.time?i.time>0?e%i.time:i.time:e,n=r.findIndex(c=>c.time>a);if(n<=0)return(n===0?r[0]:i).pose;let o=r[n-1],s=r[n],l=(a-o.time)/(s.time-o.time);return{position:B(o.pose.position,E(F(s.pose.position,o.pose.position),l)),rotation:Eo(o.pose.rotation,s.pose.rotation,l)}}function bt(t){let e=Math.hypot(...t.rotation)||1,[r,i,a,n]=t.rotation.map(o=>o/e);return new Float64Array([1-2*(i*i+a*a),2*(r*i+n*a),2*(r*a-n*i),0,2*(r*i-n*a),1-2*(r*r+a*a),2*(i*a+n*r),0,2*(r*a+n*i),2*(i*a-n*r),1-2*(r*r+i*i),0,...t.position,1])}var He=t=>[1,t&1?pe:-pe,t&2?pe:-pe,t&4?pe:-pe];function Ro(t){let e=Array.from({length:4},(i,a)=>Array.from({length:4},(n,o)=>t.reduce((s,l,c)=>s+l*He(c)[a]*He(c)[o],0)));for(let i=1;i<4;++i)e[i][i]+=To*e[0][0];let r=new Float64Array(e.flat());return t.map((i,a)=>De(r,He(a)).map(n=>i*n))}var Ao=[[.1252334085114689,.2491470458134028],[.3678314989981802,.2334925365383548],[.5873179542866175,.2031674267230659],[.7699026741943047,.1600783285433462],[.9041172563704749,.1069393259953184],[.9815606342467192,.0471753363865118]],_t;function Lo(){if(_t)return _t;let t=[],e=12;for(let[r,i]of Ao)for(let a of[r,-r])for(let n=0;n<e;++n){let o=2*Math.PI*n/e,s=Math.sqrt(1-a*a);t.push({way:[s*Math.cos(o),s*Math.sin(o),a],weight:i*2*Math.PI/e})}return _t=t}function Po(t,e,r,i){let a=r*r,n=new Float64Array(t.length);for(let{way:o,weight:s}of Lo()){let l=We(o,r),c=[0,1,2].map(h=>i[h]*o[0]+i[4+h]*o[1]+i[8+h]*o[2]),u=We(c,r);for(let h=0;h<e;++h){let f=0;for(let d=0;d<a;++d)f+=t[h*a+d]*u[d];for(let d=0;d<a;++d)n[h*a+d]+=s*f*l[d]}}return n}function Ti(t,e,r,i){let a=e.components+1,n=new Float32Array(e.clusters*a*3*4),{bands:o}=t.field,s=o*o,l=Array.from({length:8},(m,p)=>{let v=He(p),b=[0,1,2].map(g=>.5*(r.lower[g]+r.upper[g])+.5*v[g+1]*(r.upper[g]-r.lower[g]));return Fi(t,ee(i,b))}),c=Ro(l.map(m=>Math.max(m.trust,So))),u=new Float64Array(12*s);for(let m=0;m<3;++m)for(let p=0;p<4;++p)for(let v=0;v<s;++v)u[(4*m+p)*s+v]=l.reduce((b,g,_)=>b+c[_][p]*g.sh[m*s+v],0);let h=Po(u,12,o,i),f=Math.min(e.bands*e.bands,s),d=e.channels*e.bands*e.bands;for(let m=0;m<e.clusters*a;++m){let p=Math.floor(m/a),v=m%a,b=v===0?1:e.weightScale[p*(a-1)+v-1];for(let g=0;g<3;++g){let _=m*d+(e.channels===3?g*e.bands*e.bands:0);for(let x=0;x<4;++x){let w=0;for(let y=0;y<f;++y)w+=e.basis[_+y]*h[(4*g+x)*s+y];n[4*(3*m+g)+x]=b*w}}}return n}var xt=2048,Ei=127;function zo(t,e){let{mesh:r,transfer:i}=e,a=0,n=(o,s,l,c=t.FLOAT,u=!1)=>{s&&(t.bindBuffer(t.ARRAY_BUFFER,t.createBuffer()),t.bufferData(t.ARRAY_BUFFER,s,t.STATIC_DRAW),t.enableVertexAttribArray(o),t.vertexAttribPointer(o,l,c,u,0,0),a+=s.byteLength)};return n(0,r.positions,3),n(1,r.normals,3),n(2,r.uvs,2),n(4,r.colors,4,t.UNSIGNED_BYTE,!0),n(5,r.normalUvs,2),n(6,r.tangents,4),n(7,i.cluster,1,t.UNSIGNED_BYTE),t.vertexAttrib4f(4,1,1,1,1),t.bindBuffer(t.ELEMENT_ARRAY_BUFFER,t.createBuffer()),t.bufferData(t.ELEMENT_ARRAY_BUFFER,r.indices,t.STATIC_DRAW),a+r.indices.byteLength}var qe=class{constructor(e,r){this.device=e;this.scene=r}movers=[];depth;light;field;shining;get animated(){return this.movers.some(e=>(e?.mover.keys.length??0)>1)}get some(){return this.movers.some(e=>e?.table)}setField(e){this.field=e,this.relight()}relight(){if(this.field){this.shining=Mi(this.field,this.scene.data.groups,this.scene.factors);for(let e of this.movers)e&&delete e.placedAt}}add(e,r){let{gl:i}=this.device,a=r.mesh.positions;this.depth??=C.make(i,"depth"),this.light??=C.make(i,"mover_light");let n=de(),o=[];for(let m of r.mesh.parts){if(m.count===0)continue;let p=this.scene.data.materials[m.material];p.alphaMode===2&&(p.alphaMode=0);let v={...m,page:-1,bounds:de()};for(let b=m.first;b<m.first+m.count;++b){let g=3*r.mesh.indices[b];ne(v.bounds,a[g],a[g+1],a[g+2])}ne(n,...v.bounds.lower),ne(n,...v.bounds.upper),o.push(v)}if(o.length===0)return;let s=i.createVertexArray(),l=r.transfer.components,c=Math.ceil(l/4),u=a.length/3;i.bindVertexArray(s),this.scene.bytes+=zo(i,r),i.bindVertexArray(null);let h=Math.max(1,Math.ceil(u*c/xt)),f=new Int16Array(h*xt*4);for(let m=0;m<u;++m)f.set(r.transfer.weight.subarray(m*l,m*l+l),m*c*4);let d=T(i,{width:xt,height:h,format:i.RGBA16I},f);this.movers[e]={mover:r,array:s,ranges:o,bounds:n,weights:d,packFromObject:bt(r.rest)},this.scene.bytes+=f.byteLength}place(e){let{gl:r}=this.device;for(let i of this.movers){if(!i||!this.shining)continue;let a=i.mover.keys.length>1?e:0;if(i.placedAt===a)continue;i.placedAt=a,i.packFromObject=bt(Si(i.mover,a)),i.table&&r.deleteTexture(i.table);let{components:n,clusters:o}=i.mover.transfer,s=Ti(this.shining,i.mover.transfer,i.bounds,i.packFromObject);i.table=T(r,{width:3*(n+1),height:o,format:r.RGBA32F},s.map(l=>l*this.scene.unit))}}bounds(){let e=this.scene.bounds,r={lower:[...e.lower],upper:[...e.upper]};for(let i of this.movers)for(let a=0;i?.table&&a<8;++a){let{lower:n,upper:o}=i.bounds,s=[a&1?o[0]:n[0],a&2?o[1]:n[1],a&4?o[2]:n[2]];ne(r,...ee(i.packFromObject,s))}return r}drawDepth(e){this.each(e,this.depth,r=>{let i=this.scene.data.materials[r.material];P(this.device.gl,{depthTest:!0,depthWrite:!0,color:!1,cull:!i.doubleSided,mirrored:e.mirrored}),this.depth.set("u_alpha",i.alpha),this.depth.set("u_alpha_cutoff",ce(i)),this.scene.bindBase(i.texture)})}drawLight(e,r){if(!this.some)return;let i=e.viewFromPack;this.light.use(),this.light.set("u_eye",e.eye),this.light.set("u_alpha_kind",r?e.ortho?2:1:0),this.light.set("u_depth_row",[-i[2],-i[6],-i[10],-i[14]]),this.light.set("u_closest",this.device.closest),this.light.set("u_changed",!1),this.light.set("u_weights",[1,1,1]),this.each(e,this.light,(a,n)=>{let o={depthTest:!0,stencilRef:Ei,stencilWrite:Ei,mirrored:e.mirrored};P(this.device.gl,{...o,cull:!this.scene.data.materials[a.material].doubleSided}),this.scene.setSurface(this.light,a,!!n.mesh.normalUvs)})}each(e,r,i){let{gl:a}=this.device;for(let n of this.movers){if(!n?.table)continue;let o=J(e.clipFromPack,n.packFromObject),s=n.bounds.upper.map((l,c)=>.5*(l-n.bounds.lower[c]));this.scene.bindGeometry(),a.bindVertexArray(n.array),r.use(),r.set("u_clip_from_pack",o),r.set("u_pack_from_object",n.packFromObject),r.set("u_box_center",le(n.bounds)),r.set("u_box_scale",s.map(l=>l>0?1/l:0)),r.set("u_components",n.mover.transfer.components);for(let l of n.ranges)te(o,l.bounds)&&(i(l,n.mover),k(a,"u_codes",n.weights),k(a,"u_table",n.table),this.scene.draw(l))}}};var Xe=64,H=32768,Ri=1983;function V(t){return t.floats(3)}function Ai(t,e){let r=new Float32Array(t.length*e);for(let i=0;i<t.length;++i){let a=t[i],n=Math.max(a<<16>>16,-32767)/32767,o=Math.max(a>>16,-32767)/32767,s=1-Math.abs(n)-Math.abs(o);s<0&&([n,o]=[(1-Math.abs(o))*(n<0?-1:1),(1-Math.abs(n))*(o<0?-1:1)]);let l=Math.hypot(n,o,s);r[e*i]=n/l,r[e*i+1]=o/l,r[e*i+2]=s/l}return r}function je(t){let e=[t.f64(),t.f64(),t.f64()],r=t.u32(),i=t.u32(),a=t.u32(),n=t.size(3,"mesh flags");i%3!==0&&t.fail(`found ${i} indices, expected triangles`);let o={origin:e,positions:t.planesF32(r,3),normals:Ai(t.planesU32(r),3),uvs:t.planesF32(r,2),lightmapUvs:t.planesF32(r,2),indices:new Uint32Array,parts:[]};if(n&1&&(o.colors=t.planes(r,4)),n&2){o.normalUvs=t.planesF32(r,2),o.tangents=Ai(t.planesU32(r),4);let s=new Int8Array(t.planes(r,1).buffer);for(let l=0;l<r;++l)o.tangents[4*l+3]=s[l]}o.indices=t.planesU32(i);for(let s=0,l=0;s<i;++s)l=l+o.indices[s]>>>0,l>=r&&t.fail(`found index ${l} of ${r} vertices`),o.indices[s]=l;for(let s=0;s<a;++s){let l={name:t.text(),first:t.u32(),count:t.u32(),material:t.u32(),page:t.i32()};(l.first%3||l.count%3||l.first+l.count>i)&&t.fail(`found part '${l.name}' outside the indices`),o.parts.push(l)}return o}var Pi=t=>({material:t.u32(),texture:t.i32(),dielectric:t.floats(3)}),zi=t=>({material:t.u32(),texture:t.u32(),mean:t.floats(3)});function Gi(t){let e=t.text(),r=t.floats(3),i=t.f32(),a=t.i32(),n=t.choice(2,"alpha mode"),o=t.choice(1,"flag")>0,s=t.choice(1,"flag")>0;t.choice(0,"reserved byte");let l=t.f32(),c=t.f32();t.floats(2);let u=t.floats(3);return{name:e,baseColor:r,alpha:i,texture:a,alphaMode:n,doubleSided:o,unlit:s,cutoff:l,metallic:c,f0:u,transmission:t.f32(),emission:t.floats(3),kernel:t.i32(),fresnel:t.i32(),normalTexture:t.i32(),normalScale:t.f32()}}function yt(t){t.text();let e=t.size(H,"width"),r=t.size(H,"height"),i=t.choice(2,"wrap"),a=t.choice(2,"wrap"),n=t.choice(1,"filter")>0;return t.choice(0,"reserved byte"),(!e||!r)&&t.fail("found a texture without texels"),{width:e,height:r,wrapS:i,wrapT:a,nearest:n,texels:t.planes(e*r,4)}}function we(t,e,r){let i=t.planesU16(e,3);for(let a of i)((a&31744)===31744||!r&&a>32768)&&t.fail("found light that is negative or no number");return i}function ue(t){let e=t.i32();return(e<-94||e>112)&&t.fail(`found exponent ${e}, expected -94 to 112`),e}function Vi(t){let e=t.size(H,"width"),r=t.size(H,"height"),i=t.size(3,"lightmap flags"),a=t.size(16384,"details"),n=t.size(16384,"details"),o={width:e,height:r,detailWidth:a,detailHeight:n,scale:2**ue(t),light:we(t,e*r,!1)};if((!e||!r)&&t.fail("found a page without texels"),i&1&&(o.direction=we(t,e*r,!0)),a>0){o.cells=t.planesU32(e*r);for(let s of o.cells){let l=s>>>28;s!==0&&(l<1||l>5||(s&16383)+(1<<l)>=a||(s>>>14&16383)+(1<<l)>=n)&&t.fail("found a cell outside of the image of details")}o.detail=we(t,a*n,!1)}return i&2&&(o.sharpAt=t.planesU32(e*r),ue(t),we(t,e*r,!1)),ue(t),we(t,e*r,!1),t.planes(e*r,1),o}function Di(t){let e=t.text(),r=t.u32(),i=new Float64Array(t.floats(16)),a=t.floats(2),n=t.floats(2);t.f32();let o=t.f32();t.u32s(4);let s=t.u32s(t.count(4)),l=t.size(64,"emitters"),c=t.size(H,"nodes"),u=t.size(H,"nodes");return l>0&&(c<2||u<2)&&t.fail("found emitters without nodes"),{name:e,material:r,packFromReflector:i,lower:a,upper:n,flatness:o,indices:s,nodesX:c,nodesY:u,emitters:t.u32s(l),visibility:t.planes(c*u*l,1)}}function Bi(t){let e=t.choice(4,"corners"),r=t.choice(1,"flag")>0;return e<3&&t.fail(`found ${e} corners, expected 3 or 4`),{twoSided:r,radiance:t.floats(3),corners:Array.from({length:e},()=>V(t))}}function Go(t,e){let r=t.f32();t.floats(3);let i=t.f32(),a=t.floats(2),n=t.floats(2),o=t.floats(2);t.f32(),t.planesU16(t.count(2));let s=t.planesU16(e*(e+1)/2),l=new Float32Array(e*e),c=0;for(let u=0;u<e;++u)for(let h=(e-1)/2;h<e;++h){let f=Z(s[c++]);f>=0&&f<=1||t.fail("found a weight outside 0 to 1"),l[u*e+h]=l[u*e+e-1-h]=f}return{cosTheta:r,shift:i,width:a,lower:n,upper:o,weights:l}}function Ci(t){t.choice(2,"kernel model"),t.u8(),t.u8(),t.u8(),t.floats(2);let e=t.f32();t.f32();let r=t.size(H,"kernel size"),i=t.planesF32(r*r),a=t.size(H,"slice size"),n=t.count(4);(n>256||n>0&&a%2===0)&&t.fail(`found ${n} slices of ${a}`);let o=Array.from({length:n},()=>Go(t,a)),s=t.count(20);return s!==0&&s!==n&&t.fail(`found ${s} cosine lobes of ${n} slices`),{size:r,halfExtent:e,weights:i,sliceSize:a,slices:o,fits:Array.from({length:s},()=>t.floats(5))}}function Ui(t){t.f32();let e=t.u32(),r=t.u32(),i=t.size(H,"sphere");e<2&&t.fail("found a reflectance of fewer than two angles");let a={table:t.planesF32(e,3),factor:t.planesF32(r,3)};return t.planesF32(i*i,3),a}function Ii(t){return{name:t.text(),eye:V(t),forward:V(t),up:V(t),fov:t.f32(),halfHeight:t.f32()}}function Oi(t){let e=t.text(),r=t.f32(),i=t.count(28);return{name:e,fov:r,keys:Array.from({length:i},()=>({time:t.f32(),eye:V(t),forward:V(t)}))}}function Ni(t){let e=t.floats(2),r=t.f32(),i=t.f32(),a=t.size(H,"width"),n=t.size(H,"height");return r>0||t.fail("found a walk grid without cells"),{lower:e,cell:r,eyeHeight:i,width:a,height:n,walkable:t.planes(a*n,1),floor:t.planesF32(a*n)}}function wt(t,e){let r=()=>({position:V(t),rotation:t.floats(4)}),i=r(),a=R(t,t.count(32),()=>({time:t.f32(),pose:r()}));return a.forEach((n,o)=>{o>0&&n.time<a[o-1].time&&t.fail(`found keys of '${e}' whose times fall`)}),{rest:i,keys:a}}function $i(t){let e=()=>Float32Array.from(t.floats(3*t.count(12))),r=()=>t.u32s(t.count(4)),i={name:t.text(),lamps:R(t,t.count(4),()=>t.text()),value:t.f32(),color:V(t),ownColor:V(t),materials:r(),emitters:r(),brightLights:r(),sky:t.choice(1,"sky flag")>0},a=t.choice(1,"motion flag")>0;for(let o=0;o<2;++o)t.choice(0,"reserved byte");(!(i.value>=0)||[...i.color,...i.ownColor].some(o=>o<0))&&t.fail(`found negative light in group '${i.name}'`);let n={...i,reflectors:e(),surrounds:e(),probes:e()};return a&&wt(t,i.name),n}function Wi(t){t.text(),t.floats(3);let e=t.choice(1,"clock")>0;t.choice(16,"sky type");for(let s=0;s<2;++s)t.choice(0,"reserved byte");let r=t.f32(),i=t.f32(),a=Math.round(Math.abs(r)*60),n=e?"solar time":`UTC${r<0?"-":"+"}${kt(a/60)}`,o=R(t,t.count(40),()=>{let s=t.f32(),l=t.u32();return t.floats(5),{hour:s,group:l,sky:t.floats(3)}});return o.some((s,l)=>l>0&&!(s.hour>o[l-1].hour))&&t.fail("found hours that do not rise"),{clock:n,shown:i,hours:o}}function kt(t){let e=Math.round(t*60),r=i=>String(i).padStart(2,"0");return`${r(Math.floor(e/60))}:${r(e%60)}`}function Li(t,e){let r=t.planesU16(e,3);for(let i=0;i<r.length;i+=3){r[i]+=r[i+1],r[i+2]+=r[i+1];for(let a=0;a<3;++a)r[i+a]>Ri&&t.fail(`found code ${r[i+a]} of light, expected at most ${Ri}`)}return r}function Hi(t){let e=t.u32(),r=t.size(H,"width"),i=t.size(H,"height"),a=t.size(16384,"details"),n=t.size(16384,"details"),o=2**ue(t),s=t.size(Xe,"groups"),l=r*i,c=a*n;return{page:e,width:r,height:i,detailWidth:a,detailHeight:n,scale:o,rest:t.planes(l,1),restOfDetail:t.planes(c,1),others:R(t,s,()=>({group:t.u32(),light:Li(t,l),detail:Li(t,c)}))}}function qi(t){let e={name:t.text(),material:t.u32(),map:t.u32(),indices:t.u32s(t.count(4))};return e.indices.length%3&&t.fail(`found ${e.indices.length} indices, expected triangles`),e}function Xi(t){let e=V(t),r=t.size(H,"texels"),i=2**ue(t),a=t.f32(),n=r*r;(r===0||(r&r-1)>0)&&t.fail(`found ${r} texels a side, expected a power of two`),a>=0&&a<=1e18||t.fail(`found inverse distance ${a}`);let o=t.planesU32(n),s=t.planesU16(n);return{centre:e,size:r,scale:i,light:o,inverseDistance:Float32Array.from(s,l=>l/65535*a),valid:t.planes(n,1)}}function ji(t){let e=t.size(H,"width"),r=t.size(H,"height"),i=2**ue(t);return{width:e,height:r,scale:i,light:t.planesU32(e*r)}}function R(t,e,r){let i=[];for(let a=0;a<e;++a)i.push(r(t));return i}var Yi=4294967295,Vo=5,Do=16,Bo=64,Qi=1024,Ki=720;function Co(t){let e=t.choice(2,"kind of lamp");for(let i=0;i<3;++i)t.choice(0,"reserved byte");let r={sun:e===1,position:V(t),direction:V(t),intensity:V(t),cosOuter:t.f32(),inverseFalloff:t.f32(),angularRadius:t.f32(),group:t.u32(),...e===2?{profile:t.u32(),right:V(t),over:V(t)}:{profile:-1,right:[1,0,0],over:[0,1,0]}};return(r.intensity.some(i=>i<0)||!(r.angularRadius>=0&&r.angularRadius<Math.PI/2))&&t.fail("found a lamp of negative light or size"),r.profile>=Qi&&t.fail(`found profile ${r.profile}`),r}function Uo(t){let e=t.f32(),r=t.f32(),i=t.size(Ki+1,"rows"),a=t.size(Ki,"columns");e>=0&&e<r&&r<=180&&i>1&&a>0||t.fail("found a profile without angles");let n=t.planesF32(i*a,1);return n.some(o=>!(o>=0))&&t.fail("found a profile with intensities below 0"),{first:e,last:r,rows:i,columns:a,candela:n}}function Io(t,e,r,i){let a=new Uint8Array(e.length),n=()=>t.fail("found a record of sharp light that makes no sense");for(let o=0;o<e.length;){let s=1,l=o+1;if(e[o]===Yi)for(let c=l+4;l<c;++l){let u=e[l]<o?a[e[l]]:0;(u===0||u>Vo)&&n(),s=Math.max(s,u+1)}else{e[o]>(o===0?0:Do)&&n();for(let c=e[o];c>0;--c){let u=e[l],h=l+1+(u>>>10&1);l=h+(u>>>11),((u&1023)>=r||u>>>11>Bo||!(l<=e.length))&&n();for(let f=h;f<l;++f)(e[f]&536870911)>=i&&n()}}a[o]=s,o=l}return a}function Zi(t){let e=t.size(Qi,"lamps"),r=t.size(2**25,"words"),i=t.size(2**24,"triangles");(e===0||r===0)&&t.fail("found no lamps");let a={lamps:R(t,e,Co),words:t.planesU32(r),triangles:t.planesF32(i,9)},n=R(t,Math.max(...a.lamps.map(o=>o.profile))+1,Uo);return{...a,profiles:n,records:Io(t,a.words,e,i)}}function Ji(t,e){if(t.sharpAt?.some(r=>!e?.records[r]))throw new D("light: found a place of sharp light where there is none")}var Mt=(t,e)=>t.intensity.map((r,i)=>r*(e[t.group]?.[i]??1)),Ft=Array.from({length:64},(t,e)=>{let r=Math.sqrt((e+.5)/64),i=e*Math.PI*(3-Math.sqrt(5));return[r*Math.cos(i),r*Math.sin(i)]}),Oo=1e-7;function No(t,e,r,i){let[a,n,o]=r,s=Math.sign(S(G(F(n,a),F(o,a)),a)),l=[[a,n],[n,o],[o,a]].map(([c,u],h)=>{let f=G(c,u),d=Math.max(W(f),1e-20);return{inwards:E(f,s/d),hard:1e-6*(S(c,c)+S(u,u))/d,ends:(i>>>29+h&1)>0}});e.forEach((c,u)=>{let h=l.map(f=>{let d=S(f.inwards,c);return f.ends?Math.min(Math.max(d/Oo+.5,0),1):+(d>=-f.hard)});t[u]=Math.max(t[u],Math.min(...h))})}function $o(t,e,r,i){let{towards:a,distance:n,spread:o}=e,s=a,l=N(Math.abs(s[0])<.7?[0,s[2],-s[1]]:[-s[2],0,s[0]],[1,0,0]),c=G(s,l),u=o>0?Ft.map(([f,d])=>B(s,B(E(l,o*f),E(c,o*d)))):[s],h=u.map(()=>0);for(let f of r){let d=9*(f&536870911),m=[0,3,6].map(g=>F(Array.from(t.triangles.subarray(d+g,d+g+3)),i)),p=G(F(m[1],m[0]),F(m[2],m[0])),v=S(p,m[0]),b=S(p,s)*n;v*(b-v)>0&&No(h,u,m,f)}return 1-h.reduce((f,d)=>f+d/u.length,0)}function Wo(t,e,r,i){let a=Math.min(Math.max(r,0),1)*e.width,n=Math.min(Math.max(i,0),1)*e.height,o=Math.min(Math.floor(a),e.width-1),s=Math.min(Math.floor(n),e.height-1),l=e.sharpAt[s*e.width+o],c=a-o,u=n-s;for(;t.words[l]===Yi;){let h=+(c>=.5),f=+(u>=.5);c=2*c-h,u=2*u-f,l=t.words[l+1+h+2*f]}return l}function Ho(t,e,r){let{first:i,last:a,rows:n,columns:o,candela:s}=t,l=S(e.right,r),c=S(e.over,r),u=Math.atan2(Math.hypot(l,c),S(e.direction,r))*180/Math.PI;if(u<i-1e-4||u>a+1e-4)return 0;let h=Math.min(Math.max((u-i)/(a-i),0),1)*(n-1),f=Math.atan2(c,l)/(2*Math.PI),d=(f-Math.floor(f))*o,m=Math.min(Math.floor(h),n-2),p=Math.min(Math.floor(d),o-1),v=b=>s[m*o+b%o]*(1+m-h)+s[(m+1)*o+b%o]*(h-m);return v(p)*(1+p-d)+v(p+1)*(d-p)}function ea(t,e,r,i,a,n){let o=Wo(t,e,...r),s=0,{words:l}=t;for(let c=l[o++];c>0;--c){let u=l[o++],h=t.lamps[u&1023],f=u>>>11,d=u&1024?l[o++]:0,m=h.sun?E(h.direction,-1):F(h.position,i),p=Math.max(W(m),1e-6),v=E(m,1/p),b=S(a,v),g=Math.min(Math.max((-S(h.direction,v)-h.cosOuter)*h.inverseFalloff,0),1),_=Math.max(b,0)*(h.sun?1:(h.profile<0?g**2:Ho(t.profiles[h.profile],h,E(v,-1)))/p**2),x=Mt(h,n).reduce((y,z,I)=>y+[.2126,.7152,.0722][I]*z*(u&1024?(d>>>9*I&511)*2**((d>>>27)-24):1),0),w={towards:v,distance:h.sun?1e20:p,spread:h.sun?Math.tan(h.angularRadius):0};_*x>0&&(s+=_*x*$o(t,w,l.subarray(o,o+f),i)),o+=f}return s}var oe=4096,Ye=t=>Math.max(Math.ceil(t/oe),1),Ke=2*oe;function St(t){let e=[Ye(t.triangles.length/9*4)];for(let r of t.profiles)e.push(e.at(-1)+Ye(r.candela.length));return e}var ta=t=>Math.max(Ye(t.words.length+Ke),St(t).at(-1));function ra(t,e,r,i){let a=e.triangles.length/3,n=Ye(e.words.length+Ke),o=St(e),s=o.at(-1),l=new Uint32Array(n*oe),c=new Float32Array(4*s*oe);l.set(e.words,Ke);for(let u=0;u<Ke/2;++u){let h=(Math.floor(u/64)+.5)/16,f=h<2?1-h:h-3,d=(h<2?1:-1)*(1-Math.abs(f)),m=Math.hypot(f,d);Ft.forEach(([p,v],b)=>{(p*f+v*d)/m+(u%64+.5)/32-1>=0&&(l[2*u+(b>>5)]|=1<<(b&31))})}for(let u=0;u<a;++u)c.set(e.triangles.subarray(3*u,3*u+3),4*(u+Math.floor(u/3)));return e.profiles.forEach(({rows:u,columns:h,candela:f},d)=>f.forEach((m,p)=>{let v=Math.floor(p/h),b=v*h+(p+1)%h,g=v+1<u?h:0;c.set([m,f[p+g],f[b],f[b+g]],4*(o[d]*oe+p))})),{suns:e.lamps.some(u=>u.sun),words:T(t,{width:oe,height:n,format:t.R32UI},l),triangles:T(t,{width:oe,height:s,format:t.RGBA32F},c),lamps:Tt(t,e,r,i)}}function Tt(t,e,r,i){let a=St(e),n=Math.PI/180,o=Float32Array.from(e.lamps.flatMap(s=>{let l=E(Mt(s,r),i),c=e.profiles[s.profile],u=Array(8).fill(0);return s.sun?[...E(s.direction,-1),1,0,0,0,0,...l,Math.tan(s.angularRadius),...u]:c?[...s.position,-c.columns,...s.direction,c.first*n,...l,(c.rows-1)/((c.last-c.first)*n),...s.right,c.rows-1,...s.over,a[s.profile]]:[...s.position,0,...s.direction,s.cosOuter,...l,s.inverseFalloff,...u]}));return T(t,{width:5,height:e.lamps.length,format:t.RGBA32F},o)}function qo(t){let e=new Float32Array(4*t.light.length);return t.light.forEach((r,i)=>{if(t.valid[i]===0)return;let a=t.scale*2**((r>>>27)-24),n=(2*(i%t.size)+1)/t.size-1,o=(2*Math.floor(i/t.size)+1)/t.size-1,s=1-Math.abs(n)-Math.abs(o),l=s<0?1-Math.abs(o):n,c=s<0?1-Math.abs(n):o;e.set([(r&511)*a,(r>>>9&511)*a,(r>>>18&511)*a,Math.hypot(l,c,s)**-3],4*i)}),{size:t.size,texels:e}}function Xo(t){let e=t.size/2,r={size:e,texels:new Float32Array(4*e*e)};for(let i=0;i<e;++i)for(let a=0;a<e;++a){let n=[0,0,0,0];for(let o=0;o<4;++o){let s=4*((2*i+(o>>1))*t.size+2*a+(o&1)),l=t.texels[s+3];for(let c=0;c<3;++c)n[c]+=l*t.texels[s+c];n[3]+=l}n[3]>0&&r.texels.set([n[0]/n[3],n[1]/n[3],n[2]/n[3],.25*n[3]],4*(i*e+a))}return r}function jo(t){for(let e=t.length-2;e>=0;--e){let r=t[e],i=t[e+1];for(let a=0;a<r.size*r.size;++a){if(r.texels[4*a+3]>0)continue;let n=4*((a/r.size>>1)*i.size+(a%r.size>>1));r.texels.set(i.texels.subarray(n,n+4),4*a)}}}function ia(t,e){for(let r=-1;r<=t;++r)for(let i=-1;i<=t;++i){let a=[i,r];for(let n of[0,1])(a[n]<0||a[n]>=t)&&(a[n]=a[n]<0?-1-a[n]:2*t-1-a[n],a[1-n]=t-1-a[1-n]);e(i+1,r+1,a[1]*t+a[0])}}function Ko(t,e,r){let i=u=>u>0?Math.min(u,65408):0,a=[i(t),i(e),i(r)],n=Math.max(...a);if(n<=0)return 0;let o=Math.max(-16,Math.floor(Math.log2(n)))+16;Math.floor(n*2**(24-o)+.5)>=512&&++o;let[s,l,c]=a.map(u=>Math.floor(u*2**(24-o)+.5));return(s|l<<9|c<<18|o<<27)>>>0}var aa=(t,e)=>e===0?[0,0]:[t+2,t-(t>>e-1)+2*(e-1)];function na(t,e){let r=[qo(e)],i=e.size;for(;r[r.length-1].size>1;)r.push(Xo(r[r.length-1]));jo(r);let a=0,n=0,o=1/0;for(let m=0;m<i*i;++m){for(let p=0;p<3;++p)a=Math.max(a,r[0].texels[4*m+p]);n=Math.max(n,e.inverseDistance[m]),o=Math.min(o,e.inverseDistance[m])}let s=a>0?2**Math.min(Math.max(Math.floor(Math.log2(a))-14,-120),120):1,l=r.length-1,c=Math.max(i+2,l>0?i+i/2+4:0),u=Math.max(i+2,l>0?aa(i,l)[1]+3:3),h=new Uint32Array(c*u),f=new Float32Array((i+2)**2);r.forEach((m,p)=>{let[v,b]=aa(i,p),g=m.texels;ia(m.size,(_,x,w)=>{h[(b+x)*c+v+_]=Ko(g[4*w]/s,g[4*w+1]/s,g[4*w+2]/s)})}),ia(i,(m,p,v)=>{f[p*(i+2)+m]=e.inverseDistance[v]});let d=t.getExtension("OES_texture_float_linear")?t.LINEAR:t.NEAREST;return{centre:e.centre,size:i,scale:s,range:[n,o],tint:[1,1,1],light:T(t,{width:c,height:u,format:t.RGB9_E5,min:t.LINEAR,mag:t.LINEAR},h),inverseDistance:T(t,{width:i+2,height:i+2,format:t.R32F,min:d,mag:d},f)}}function oa(t,e){let r=0;for(let a=0;a<t.length;++a)r+=t[a];let i=e*r;for(let a=0;a<t.length;++a){if(i<t[a])return a+i/t[a];i-=t[a]}return t.length}function Yo(t){let e=0;for(let r=.5;t!==0;t>>>=1,r*=.5)e+=(t&1)*r;return e}function sa(t,e,r,i){let a=new Float64Array(e);for(let c=0;c<e;++c)for(let u=0;u<e;++u)a[c]+=t[c*e+u];let n=[],o=i(1,1),s=i(0,0),l=(o[0]-s[0])*(o[1]-s[1]);for(let c=0;c<r;++c){let u=oa(a,(c+.5)/r),h=Math.min(Math.floor(u),e-1),f=oa(t.subarray(h*e,h*e+e),Yo(c)+.5/r),d=Math.min(Math.floor(f),e-1),m=i(d/e,h/e),p=i((d+1)/e,(h+1)/e),v=i(f/e,u/e),b=Math.max(t[h*e+d],1e-12)*r;n.push({x:v[0],y:v[1],width:Math.sqrt(Math.min((p[0]-m[0])*(p[1]-m[1])/b,l)),weight:1})}return n}var Qo=t=>(e,r)=>[t.width[0]*Math.sinh(t.lower[0]+e*(t.upper[0]-t.lower[0])),t.shift+t.width[1]*Math.sinh(t.lower[1]+r*(t.upper[1]-t.lower[1]))];function Zo(t,e){return(r,i)=>{let a=(2*r-1)*t.halfExtent*e,n=(2*i-1)*t.halfExtent,o=2/(1+Math.sqrt(1+a*a+n*n));return[a*o,n*o]}}function la(t,e){if(t.length===1)return[0,0,0];let r=o=>Math.sqrt(t[o].cosTheta),i=Math.sqrt(e),a=1;for(;a+1<t.length&&r(a)<i;)++a;let n=r(a-1);return[a-1,a,Math.min(Math.max((i-n)/(r(a)-n),0),1)]}function ca(t,e){let r=t?.factor;if(!r||r.length===0)return 1;let i=r.length/3-1,a=Math.sqrt(Math.min(Math.max(e,0),1))*i,n=Math.min(Math.floor(a),i),o=s=>.2126*r[3*s]+.7152*r[3*s+1]+.0722*r[3*s+2];return o(n)+(o(Math.min(n+1,i))-o(n))*(a-n)}function Jo(t,e,r){let i=e*e,a=Math.sqrt(Math.max(0,1-i*i)),n=0,o=0;for(let l of t){let c=.25*(l.x*l.x+l.y*l.y),u=[l.x/(1+c),l.y/(1+c),(1-c)/(1+c)],h=[0,2*i*a,2*i*i-1];l.weight=ca(r,Math.sqrt(Math.max(0,.5*(1+h[1]*u[1]+h[2]*u[2])))),a*u[1]+i*u[2]>0&&(n+=l.weight,++o)}let s=o>0?n/o:1;for(let l of t)l.weight=s>0?l.weight/s:1;return s}function ua(t,e,r){if(!t||t.size<=1||!(t.halfExtent>0))return{count:1,rows:1,median:0,texels:new Float32Array([0,0,0,1]),means:[1]};let i=t.slices.map(l=>sa(l.weights,t.sliceSize,e,Qo(l))),a=i.length===0?9:Math.max(i.length,2),n=new Float32Array(4*e*a),o=[],s=0;for(let l=0;l<a;++l){let c=l/(a-1),u;if(i.length===0)u=sa(t.weights,t.size,e,Zo(t,Math.max(c*c,.001)));else{let[h,f,d]=la(t.slices,c*c);u=i[h].map((m,p)=>{let v=i[f][p],b=(g,_)=>g+(_-g)*d;return{x:b(m.x,v.x),y:b(m.y,v.y),width:b(m.width,v.width),weight:1}})}o.push(Jo(u,c,r)),u.forEach((h,f)=>n.set([h.x,h.y,h.width,h.weight],4*(l*e+f))),l===a-1&&(s=u.map(h=>Math.hypot(h.x,h.y)).sort((h,f)=>h-f)[e>>1])}return{count:e,rows:a,median:s,texels:n,means:o}}var ve=33;function ha(t,e,r){let i=new Float32Array(8*ve),a=n=>{let[o,s,l,c]=t.fits[n],u=t.slices[n].cosTheta,h=Math.sqrt(Math.max(0,1-u*u));return[o*u+s*h,s*u-o*h,l,c*u+h].map(f=>f/(u-c*h))};for(let n=0;n<ve;++n){let o=n/(ve-1),[s,l,c]=la(t.slices,o*o),u=a(s),h=a(l),f=u.map((v,b)=>v+(h[b]-v)*c);f[2]=u[2]*h[2]/(h[2]+(u[2]-h[2])*c),i.set(f,4*n);let d=o*(r.length-1),m=Math.min(Math.floor(d),Math.max(r.length-2,0)),p=Math.min(m+1,r.length-1);i.set([ca(e,o*o),r[m]+(r[p]-r[m])*(d-m)],4*(ve+n))}return i}function Et(t){let e=t.getExtension("EXT_color_buffer_float")&&t.getExtension("EXT_float_blend")&&t.getExtension("OES_texture_float_linear");if(!e&&!t.getExtension("EXT_color_buffer_float")&&!t.getExtension("EXT_color_buffer_half_float"))throw new Error("This device cannot draw light of more than eight bits.");return{gl:t,color:e?t.RGBA32F:t.RGBA16F,linear:t.LINEAR,closest:e?1e-15:1e-7}}var Qe=class{constructor(e,r){this.device=e;this.data=r;let i=e.gl,a=r.mesh,n=Math.max(1,...r.materials.flatMap(c=>c.emission),...r.sky);this.emission=r.materials.map(c=>c.unlit&&!c.emission.some(u=>u>0)?[1,1,1]:c.emission),this.sky=r.sky,this.unlitWhite=Math.max(...this.emission.filter((c,u)=>r.materials[u].unlit).flat(),0)||1,this.factors=r.groups.map(()=>[1,1,1]),this.unit=e.color===i.RGBA32F?1:Math.min(1,8192/n);let o=this.sortRanges();r.reflectors.forEach((c,u)=>this.addReflector(u,o)),this.movers=new qe(e,this),this.curved=r.curved.map(c=>({...this.rangeOf(o,c.indices,c.material,-1),map:c.map})),this.array=i.createVertexArray(),i.bindVertexArray(this.array);let s=(c,u,h,f=i.FLOAT)=>{u&&(i.bindBuffer(i.ARRAY_BUFFER,i.createBuffer()),i.bufferData(i.ARRAY_BUFFER,u,i.STATIC_DRAW),i.enableVertexAttribArray(c),i.vertexAttribPointer(c,h,f,f===i.UNSIGNED_BYTE,0,0),this.bytes+=u.byteLength)};s(0,a.positions,3),s(1,a.normals,3),s(2,a.uvs,2),s(3,a.lightmapUvs,2),s(4,a.colors,4,i.UNSIGNED_BYTE),s(5,a.normalUvs,2),s(6,a.tangents,4),i.vertexAttrib4f(4,1,1,1,1),i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,i.createBuffer()),i.bufferData(i.ELEMENT_ARRAY_BUFFER,new Uint32Array(o),i.STATIC_DRAW),i.bindVertexArray(null),this.bytes+=4*o.length;let l=(c,u)=>T(i,{width:1,height:1,format:c},u);this.white=l(i.SRGB8_ALPHA8,new Uint8Array([255,255,255,255])),this.flat=l(i.RGBA8,new Uint8Array([128,128,255,255])),this.zero=l(i.R32UI,new Uint32Array([0])),this.reflectance=this.uploadReflectance(),r.pages.forEach((c,u)=>this.setPage(u,c)),k(i,"u_surfaces",this.zero),k(i,"u_cells",this.zero),k(i,"u_seen",this.zero)}bounds=de();opaque=[];transparent=[];reflectors=[];curved;surrounds=[];movers;unit;bytes=0;array;textures=[];normals=[];pages=[];shown=[];pageGroups=[];sharp;factors;emission;unlitWhite;sky;skyMap;white;flat;zero;reflectance;kernels=new Map;isTransparent(e){let r=this.data.materials[e];return r.alphaMode===2||r.transmission>0}rangeOf(e,r,i,a){let n={first:e.length,count:r.length,material:i,page:a,bounds:de()},o=this.data.mesh.positions;for(let s=0;s<r.length;++s){let l=r[s];e.push(l),ne(n.bounds,o[3*l],o[3*l+1],o[3*l+2])}return n}facesInward(e,r){let i=this.data.mesh.positions,a=le(r.bounds),n=s=>F(ae(i,e[s]),a),o=0;for(let s=r.first;s<r.first+r.count;s+=3)o+=S(n(s),G(n(s+1),n(s+2)));return o<0}sortRanges(){let e=this.data.mesh,r=[],i=e.parts.filter(n=>n.count>0).sort((n,o)=>n.material-o.material||n.page-o.page);for(let n of i){let o=this.rangeOf(r,e.indices.subarray(n.first,n.first+n.count),n.material,n.page),s=this.isTransparent(n.material);s&&this.transparent.push({...o,from:n.first}),(!s||Ze(this.data.materials[n.material]))&&this.opaque.push(o),ne(this.bounds,...o.bounds.lower),ne(this.bounds,...o.bounds.upper)}let a=new Map(this.transparent.map(n=>[n,this.facesInward(r,n)]));return this.transparent.sort((n,o)=>Number(a.get(o))-Number(a.get(n))),r}addReflector(e,r){let{gl:i}=this.device,a=this.data.reflectors[e],n=a.packFromReflector,o=jt(n),s=Math.hypot(a.upper[0]-a.lower[0],a.upper[1]-a.lower[1]),l=[a.lower[0],a.upper[0],a.upper[0],a.lower[0]],c=[a.lower[1],a.lower[1],a.upper[1],a.upper[1]],u=this.rangeOf(r,a.indices,a.material,-1),h=[];for(let f of a.emitters)for(let d of hi(this.data.emitters[f],this.data.mesh,this.data.materials))this.isTransparent(d.part.material)||h.push(this.rangeOf(r,d.indices,d.part.material,d.part.page));this.reflectors.push({index:e,material:a.material,first:u.first,count:u.count,packFromReflector:n,reflectorFromPack:o,corners:l.map((f,d)=>ee(n,[f,c[d],0])),size:s,flatness:a.flatness,dark:h,emitters:mt(i,a,this.data.emitters,o,s,this.unit),asked:!1,visible:!0})}uploadReflectance(){let e=this.data.fresnels,r=Math.max(1,...e.map(n=>n.table.length/3)),i=Math.max(e.length,1),a=new Float32Array(4*r*i);return e.forEach((n,o)=>{for(let s=0;s<n.table.length/3;++s)a.set(n.table.subarray(3*s,3*s+3),4*(o*r+s))}),T(this.device.gl,{width:r,height:i,format:this.device.gl.RGBA32F},a)}setPage(e,r){this.data.pages[e]=r,this.uploadPage(e)}setPageGroups(e){this.pageGroups[e.page]=e,this.uploadPage(e.page)}setSharp(e){let{gl:r}=this.device;this.sharp={light:e,...ra(r,e,this.factors,this.unit)},k(r,"u_sharp_words",this.sharp.words),k(r,"u_sharp_triangles",this.sharp.triangles),k(r,"u_sharp_lamps",this.sharp.lamps),this.bytes+=4*e.words.length+16/3*e.triangles.length}get hasSharp(){return!!this.sharp}get hasSuns(){return!!this.sharp?.suns}isSharp(e){return!!this.pages[e.page]?.sharpAt}setLights(e){let{groups:r,emitters:i}=this.data,a=i.slice(),n=(o,s)=>o.map((l,c)=>l*s[c]);this.factors=e,r.forEach((o,s)=>{for(let l of o.materials)this.emission[l]=n(this.data.materials[l].emission,e[s]);for(let l of o.emitters)a[l]={...i[l],radiance:n(i[l].radiance,e[s])};o.sky&&(this.sky=n(this.data.sky,e[s]))}),this.data.day&&(this.sky=wi(this.data.day,e));for(let o of this.reflectors){let s=o.emitters;if(s){for(let l of[s.polygons,s.visibility,s.seen])this.device.gl.deleteTexture(l);o.emitters=mt(this.device.gl,this.data.reflectors[o.index],a,o.reflectorFromPack,o.size,this.unit)}}this.sharp&&(this.device.gl.deleteTexture(this.sharp.lamps),k(this.device.gl,"u_sharp_lamps",this.sharp.lamps=Tt(this.device.gl,this.sharp.light,e,this.unit))),this.data.pages.forEach((o,s)=>this.uploadPage(s)),this.surrounds.forEach((o,s)=>{o.tint=ye(r,e,"surrounds",s)}),this.movers.relight()}uploadPage(e){let r=yi(this.data.pages[e],this.pageGroups[e],this.factors);if(r===this.shown[e])return;this.shown[e]=r;let{gl:i}=this.device,a=this.pages[e];for(let l of[a?.light,a?.direction,a?.cells,a?.detail,a?.sharpAt])l&&i.deleteTexture(l);this.bytes-=a?.bytes??0;let n=this.bytes,o=(l,c,u)=>(this.bytes+=l.byteLength,T(i,{width:c,height:u,format:i.RGB16F,min:i.LINEAR,mag:i.LINEAR},l)),s={light:o(r.light,r.width,r.height),scale:r.scale,bytes:0};r.direction&&(s.direction=o(r.direction,r.width,r.height)),r.detail&&r.cells&&(s.cells=T(i,{width:r.width,height:r.height,format:i.R32UI},r.cells),s.detail=o(r.detail,r.detailWidth,r.detailHeight),this.bytes+=r.cells.byteLength),r.sharpAt&&(s.sharpAt=T(i,{width:r.width,height:r.height,format:i.R32UI},r.sharpAt),this.bytes+=r.sharpAt.byteLength),s.bytes=this.bytes-n,this.pages[e]=s}setTexture(e,r,i){let{gl:a}=this.device,n=[a.REPEAT,a.CLAMP_TO_EDGE,a.MIRRORED_REPEAT],o=Math.floor(Math.log2(Math.max(r.width,r.height)))+1,s=T(a,{width:r.width,height:r.height,levels:o,format:i?a.RGBA8:a.SRGB8_ALPHA8,min:a.LINEAR_MIPMAP_LINEAR,mag:r.nearest?a.NEAREST:a.LINEAR,wrapS:n[r.wrapS],wrapT:n[r.wrapT]},r.texels),l=i?void 0:this.cutoffIn(e),c=r.texels,u=!1;for(let h=3;h<c.length&&l!==void 0&&!u;h+=4)u=c[h]<255;u?di(r,l).forEach((h,f)=>{a.texSubImage2D(a.TEXTURE_2D,f+1,0,0,h.width,h.height,a.RGBA,a.UNSIGNED_BYTE,h.texels)}):a.generateMipmap(a.TEXTURE_2D),(i?this.normals:this.textures)[e]=s,this.bytes+=r.texels.byteLength*4/3}cutoffIn(e){let r;for(let i of this.data.materials)if(i.texture===e){if(i.alphaMode===0)return;if(i.alphaMode===2)r??=0;else if(!r){if(!(i.cutoff>0))return;r=i.alpha>0?i.cutoff/i.alpha:2}}return r}setSky(e){let{gl:r}=this.device,i={width:e.width,height:e.height,format:r.RGB9_E5,min:r.LINEAR,mag:r.LINEAR,wrapS:r.REPEAT};this.skyMap={texture:T(r,i,e.light),scale:e.scale},this.bytes+=e.light.byteLength}setSurround(e,r){this.surrounds[e]=na(this.device.gl,r),this.surrounds[e].tint=ye(this.data.groups,this.factors,"surrounds",e),this.bytes+=10*r.light.length}setNormals(e,r,i=!!this.data.mesh.normalUvs){let a=this.data.materials[r],n=a.normalTexture>=0&&i?this.normals[a.normalTexture]:void 0;e.set("u_normal_mapped",!!n),e.set("u_normal_scale",a.normalScale),k(this.device.gl,"u_normal_texture",n??this.flat)}kernel(e,r){let i=this.data.materials[e],a=`${i.kernel} ${i.fresnel} ${r}`,n=this.kernels.get(a);if(n)return n;let{gl:o}=this.device,s=this.data.kernels[i.kernel],l=this.data.fresnels[i.fresnel],c=ua(s,r,l),u={taps:T(o,{width:c.count,height:c.rows,format:o.RGBA32F},c.texels),count:c.count,rows:c.rows,median:c.median};return s&&s.fits.length>0&&(u.lobes=T(o,{width:ve,height:2,format:o.RGBA32F},ha(s,l,c.means))),this.kernels.set(a,u),u}reflectanceOf(e){let r=this.data.fresnels[this.data.materials[e].fresnel]?.table;if(!r)return 0;let i=3*(r.length/6|0);return Math.max(r[i],r[i+1],r[i+2])}bindGeometry(){this.device.gl.bindVertexArray(this.array),k(this.device.gl,"u_reflectance",this.reflectance)}orderFarToNear(e,r){if(e.ordered===r.join())return;let{gl:i}=this.device,{positions:a,indices:n}=this.data.mesh,o=new Uint32Array(e.count),s=c=>[0,1,2].reduce((u,h)=>u+S(r,ae(a,n[c+h])),0);Array.from({length:e.count/3},(c,u)=>({i:e.from+3*u,depth:s(e.from+3*u)})).sort((c,u)=>c.depth-u.depth).forEach(({i:c},u)=>o.set(n.subarray(c,c+3),3*u)),i.bufferSubData(i.ELEMENT_ARRAY_BUFFER,4*e.first,o),e.ordered=r.join()}draw(e){let{gl:r}=this.device;r.drawElements(r.TRIANGLES,e.count,r.UNSIGNED_INT,4*e.first)}bindBase(e){k(this.device.gl,"u_base_texture",this.textures[e]??this.white)}picture(e){return this.data.emissionTextures.find(r=>r.material===e)}metalness(e){let r=this.data.materials[e];return r.fresnel<0||r.alphaMode===2||r.transmission>0?void 0:this.data.metalness.find(i=>i.material===e)}setMetalness(e,r){let i=this.metalness(r),a=this.data.materials[r];return e.set("u_metal_varies",!!i),i?(e.set("u_metal",i.texture>=0?1:a.metallic),e.set("u_dielectric",i.dielectric),e.set("u_f0",a.f0),!0):!1}setPlaceReflectance(e,r){let i=this.data.materials[r];this.setReflectance(e,r),this.setMetalness(e,r),e.set("u_base_color",fa(i)),this.bindBase(i.texture),k(this.device.gl,"u_metal_texture",this.textures[this.metalness(r)?.texture??-1]??this.white)}setReflectance(e,r){let i=this.data.materials[r].fresnel;e.set("u_reflectance_row",i),e.set("u_reflectance_count",i<0?1:this.data.fresnels[i].table.length/3)}setSurface(e,r,i=!!this.data.mesh.normalUvs){let{gl:a}=this.device,n=this.data.materials[r.material],o=this.pages[r.page];e.set("u_base_color",fa(n)),e.set("u_alpha_cutoff",ce(n)),e.set("u_covers",n.alphaMode===2),e.set("u_transmission",n.transmission);let s=this.picture(r.material),l=s&&this.textures[s.texture];e.set("u_emission",this.emission[r.material].map((u,h)=>u*this.unit*(l?es(s.mean[h]):1))),k(a,"u_emission_texture",this.textures[this.metalness(r.material)?.texture??-1]??l??this.white);let c=this.setMetalness(e,r.material);e.set("u_diffuse_share",(c?1:1-n.metallic)*(1-n.transmission)),e.set("u_unlit",n.unlit),this.setReflectance(e,r.material),this.bindBase(n.texture),this.setNormals(e,r.material,i),k(a,"u_lightmap",o?.light??this.white),e.set("u_lightmap_scale",o?o.scale*this.unit:0),e.set("u_directional",!!o?.direction),k(a,"u_direction",o?.direction??o?.light??this.white),e.set("u_detailed",!!o?.detail),k(a,"u_cells",o?.cells??this.zero),k(a,"u_detail",o?.detail??this.white),k(a,"u_sharp_at",o?.sharpAt??this.zero)}luxAt(e,r,i,a,n){let o=this.shown[e];if(!o)return 0;let s=Math.min(Math.floor(r*o.width),o.width-1),l=Math.min(Math.floor(i*o.height),o.height-1),c=3*(l*o.width+s);return(o.sharpAt&&this.sharp?ea(this.sharp.light,o,[r,i],a,n,this.factors):0)+o.scale*(.2126*Z(o.light[c])+.7152*Z(o.light[c+1])+.0722*Z(o.light[c+2]))}},fa=t=>[...t.baseColor.map(e=>Math.min(Math.max(e,0),1)),t.alpha],es=t=>t>0?1/t:0,ma=254.5/255,Ze=t=>t.alphaMode===2&&t.alpha>=ma&&t.transmission<=0,ce=t=>Ze(t)?ma:t.alphaMode===1?Math.max(t.cutoff,0):-1;var ts=127,da=128,pa={orders:2,mirrors:16,taps:48,largeOnly:!1},va={orders:0,mirrors:0,taps:12,largeOnly:!0},ga={orders:1,mirrors:1,taps:12,largeOnly:!0},rs=[[-.125,-.375],[.375,-.125],[-.375,.125],[.125,.375]],Rt=16,ke=class{constructor(e){this.device=e;let r=e.gl,i=(a,n="")=>C.make(r,a,n);this.depth=i("depth"),this.plainDepth=i("depth","PLAIN"),this.opaque=i("scene"),this.plain=i("scene","PLAIN"),this.reflected=i("scene","REFLECTED"),this.transparent=i("transparent"),this.luminance=i("screen_luminance"),this.sky=i("screen_sky"),this.average=i("screen_average"),this.sharp=["SHARP","SHARP SUNS"].map(a=>new Map([[this.opaque,i("scene",a)],[this.plain,i("scene",`PLAIN ${a}`)],[this.reflected,i("scene",`REFLECTED ${a}`)],[this.transparent,i("transparent",a)]])),this.none=r.createVertexArray(),this.reflections=new Ie(e,this,this.none)}frame;sums;mean;blocks;depth;plainDepth;opaque;plain;reflected;transparent;sharp;luminance;sky;average;reflections;none;start(){for(let e of[this.plainDepth,this.plain,this.luminance,this.average])e.start()}startRest(){for(let e of[...this.reflections.programs,this.reflected,this.opaque,this.depth,this.transparent,this.sky])e.start()}drawScreen(){let{gl:e}=this.device;e.bindVertexArray(this.none),e.drawArrays(e.TRIANGLES,0,3)}ensure(e,r){if(this.frame?.width===e&&this.frame.height===r)return this.frame;let{gl:i,color:a}=this.device;for(let l of[this.frame?.light,this.frame?.depth,...[...this.sums??[],this.mean].map(c=>c?.texture)])l&&i.deleteTexture(l);for(let l of[this.frame?.target,...[...this.sums??[],this.mean].map(c=>c?.target)])l&&i.deleteFramebuffer(l);let n=T(i,{width:e,height:r,format:a}),o=T(i,{width:e,height:r,format:i.DEPTH24_STENCIL8}),s=l=>{let c=T(i,{width:e,height:r,format:l});return{texture:c,target:re(i,c)}};return this.sums=[s(i.RGBA16F),s(i.RGBA16F)],this.mean=s(a),this.frame={width:e,height:r,light:n,depth:o,target:re(i,n,o)},this.frame}draw(e,r,i,a,n,o){let{gl:s}=this.device,l=this.ensure(i,a),c=ii(r,i,a,e.movers.bounds(),n===void 0?[0,0]:rs[n%4]),u=()=>{s.bindFramebuffer(s.FRAMEBUFFER,l.target),s.viewport(0,0,i,a)};u(),this.clear([...e.sky.map(p=>p*e.unit),1]);let h=e.opaque.filter(p=>te(c.clipFromPack,p.bounds));this.drawDepth(e,c,h),e.movers.drawDepth(c);let f={view:c,begin:u,inFrame:!0,mirrors:0,reflectance:1,share:1,texture:l.light,values:0},d=this.reflections.drawMasks(e,f,o);for(let p of d)p.value>0&&this.reflections.draw(e,f,p,o);let m=this.reflections.curved.draw(e,f,o);u(),this.drawSky(e,c,1),this.drawOpaque(e,c,h,new Set([...d.filter(p=>p.value>0).map(p=>p.reflector.material),...m.materials])),e.movers.drawLight(c,!1),this.drawTransparent(e,c);for(let p of d)p.value===0&&this.reflections.draw(e,f,p,o);u(),this.reflections.curved.add(e,f,m.later,o)}clear(e){let{gl:r}=this.device;P(r,{depthWrite:!0,stencilWrite:255}),r.clearColor(e[0],e[1],e[2],e[3]),r.clear(r.COLOR_BUFFER_BIT|r.DEPTH_BUFFER_BIT|r.STENCIL_BUFFER_BIT)}drawSky(e,r,i){if(!e.skyMap)return;let{gl:a}=this.device,n=r.clipFromView,o=r.viewFromPack,s=(l,c,u,h)=>[...[0,1,2].map(f=>o[4*f]*l+o[4*f+1]*c+o[4*f+2]*u),h];P(a,{depthTest:!0}),this.sky.use(),k(a,"u_sky",e.skyMap.texture),this.sky.set("u_color",e.sky.map(l=>l*e.unit*e.skyMap.scale)),this.sky.set("u_direction_from_clip",[...s(1/n[0],0,0,0),...s(0,1/n[5],0,0),0,0,0,0,...s(n[8]/n[0],n[9]/n[5],-1,1)]),this.sky.set("u_eye",r.eye),this.sky.set("u_size",[r.width,r.height]),this.sky.set("u_alpha",i),a.depthRange(1,1),this.drawScreen(),a.depthRange(0,1)}drawDepth(e,r,i){e.bindGeometry();for(let a of i){let n=e.data.materials[a.material],o=ce(n)<0?this.plainDepth:this.depth;P(this.device.gl,{depthTest:!0,depthWrite:!0,color:!1,cull:!n.doubleSided,mirrored:r.mirrored}),o.use(),o.set("u_clip_from_pack",r.clipFromPack),o.set("u_alpha",n.alpha),o.set("u_alpha_cutoff",ce(n)),e.bindBase(n.texture),e.draw(a)}}programFor(e,r,i){return r.isSharp(e)?this.sharp[Number(r.hasSuns)].get(i):i}setFrame(e,r,i,a){let n=r.hasSharp?this.sharp[Number(r.hasSuns)].get(e):void 0;n&&this.setFrame(n,r,i,a),e.use(),e.set("u_clip_from_pack",i.clipFromPack),e.set("u_eye",i.eye),e.set("u_change_scale",[0,0]),e.set("u_alpha_kind",a?i.ortho?2:1:0);let o=i.viewFromPack;e.set("u_depth_row",[-o[2],-o[6],-o[10],-o[14]]),e.set("u_closest",this.device.closest),r.bindGeometry()}drawRanges(e,r,i,a,n,o,s){let{gl:l}=this.device;for(let c of[a,this.opaque])this.setFrame(c,e,r,s);for(let c of i){let u=e.data.materials[c.material],h=Ze(u),f=n.has(c.material)||h&&!s,d=h?da:ts,m=this.programFor(c,e,u.normalTexture<0&&ce(u)<0&&!u.unlit&&!e.picture(c.material)&&!e.metalness(c.material)?a:this.opaque);m.use(),e.setSurface(m,c),m.set("u_weights",[1,1,1]),P(l,{...o,cull:!u.doubleSided,stencilRead:d,stencilFunc:f?l.EQUAL:void 0}),e.draw(c),f&&(m.set("u_weights",[1,0,1]),P(l,{...o,cull:!u.doubleSided,stencilRead:d,stencilFunc:l.NOTEQUAL,blend:s?void 0:"add"}),e.draw(c))}}drawOpaque(e,r,i,a){this.drawRanges(e,r,i,this.plain,a,{depthTest:!0},!1)}drawReflected(e,r,i,a,n){let o={depthTest:!0,depthWrite:!0,mirrored:r.mirrored};this.drawRanges(e,r,i,this.reflected,n,o,!0);for(let s of a){let l=e.data.materials[s.material],c=this.programFor(s,e,l.normalTexture<0&&ce(l)<0&&!l.unlit&&!e.metalness(s.material)?this.reflected:this.opaque);c.use(),e.setSurface(c,s),c.set("u_weights",[1,1,0]),P(this.device.gl,{...o,cull:!l.doubleSided}),e.draw(s)}}drawTransparent(e,r){let{gl:i}=this.device,a=r.viewFromPack,n=[a[2],a[6],a[10]],o=l=>S(n,le(l.bounds)),s=e.transparent.filter(l=>te(r.clipFromPack,l.bounds)).sort((l,c)=>o(l)-o(c));if(s.length!==0){this.setFrame(this.transparent,e,r,!1);for(let l of s){let c=this.programFor(l,e,this.transparent);c.use(),e.setSurface(c,l);let u=e.data.materials[l.material],h=u.alphaMode===2&&u.transmission<=0,f={depthTest:!0,alpha:!1,mirrored:r.mirrored,stencilRead:da,cull:!u.doubleSided},d=(p,v,b)=>{P(i,{...f,...p}),c.set("u_dimming",v),c.set("u_weights",[1,b,1]),e.draw(l)};h?e.orderFarToNear(l,n):d({blend:"multiply"},!0,0);let m=h?"cover":"add";d({blend:m,stencilFunc:r.mirrored?void 0:i.EQUAL},!1,1),r.mirrored||d({blend:m,stencilFunc:i.NOTEQUAL},!1,0)}}}white=1.2;addToMean(e,r){let{gl:i}=this.device,a=this.frame;i.bindFramebuffer(i.FRAMEBUFFER,this.mean.target),i.viewport(0,0,a.width,a.height),P(i,r?{}:{blend:"add"}),r||i.blendFunc(i.ONE,i.ONE),this.average.use(),this.average.set("u_share",e),this.average.set("u_encode",!1),this.average.set("u_before_weight",0),this.average.set("u_scale",[1,1]),k(i,"u_frame",a.light),this.drawScreen(),this.average.set("u_share",0)}show(e,r,i,a,n=!0){let o=this.frame.width!==i||this.frame.height!==a,{gl:s}=this.device,l=this.frame,[c,u]=this.sums;P(s,{}),this.average.use(),this.average.set("u_exposure",1/(this.white*e.unit)),this.average.set("u_unlit_exposure",1/(e.unlitWhite*e.unit)),this.average.set("u_count",r+1),k(s,"u_frame",l.light),k(s,"u_before",c.texture),this.average.set("u_before_weight",r),this.average.set("u_encode",!1),this.average.set("u_scale",[1,1]),s.bindFramebuffer(s.FRAMEBUFFER,u.target),s.viewport(0,0,l.width,l.height),this.drawScreen(),this.sums=[u,c],n&&(k(s,"u_before",u.texture),this.average.set("u_scale",o?[l.width/i,l.height/a]:[1,1]),this.average.set("u_before_weight",1),this.average.set("u_encode",!0),s.bindFramebuffer(s.FRAMEBUFFER,null),s.viewport(0,0,i,a),this.drawScreen())}meter(e,r=!1){let{gl:i}=this.device,a=this.frame,n=Math.ceil(a.width/Rt),o=Math.ceil(a.height/Rt);if(this.blocks?.width!==n||this.blocks.height!==o){let c=T(i,{width:n,height:o,format:this.device.color});this.blocks={width:n,height:o,texture:c,target:re(i,c)}}i.bindFramebuffer(i.FRAMEBUFFER,this.blocks.target),i.viewport(0,0,n,o),P(i,{}),this.luminance.use(),k(i,"u_frame",r?this.mean.texture:a.light),this.luminance.set("u_frame_size",[a.width,a.height]),this.luminance.set("u_block",Rt),this.drawScreen();let s=new Float32Array(4*n*o);i.readPixels(0,0,n,o,i.RGBA,i.FLOAT,s);let l=is(s,n,o);return l===void 0?void 0:l-Math.log2(e.unit)}};function is(t,e,r){let i=[],a=0;for(let c=0;c<e*r;++c){let u=t[4*c],h=t[4*c+1];if(!(h>0)||!Number.isFinite(u))continue;let f=(2*(c%e)+1)/e-1,d=(2*Math.floor(c/e)+1)/r-1,m=h*(.1+Math.exp(-.5*(f*f+d*d)/.25));i.push({log:u/h,weight:m}),a+=m}if(i.length===0)return;i.sort((c,u)=>c.log-u.log);let n=0,o=i[i.length-1].log;for(let c of i)if(n+=c.weight,n>=.9*a){o=c.log;break}let s=0,l=0;for(let c of i)c.log>=o-7&&(s+=c.log*c.weight,l+=c.weight);return s/l}var Je=class{constructor(e){this.grids=e;this.eyeHeight=e[0]?.eyeHeight??1.6,this.step=.4*this.eyeHeight/1.6,this.beside=this.eyeHeight/1.6}eyeHeight;step;beside;eyeOf(e,r){let i=this.grids[e];return[i.lower[0]+(r%i.width+.5)*i.cell,i.floor[r]+i.eyeHeight,i.lower[1]+(Math.floor(r/i.width)+.5)*i.cell]}stand(e,r,i,a=this.step){let n;return this.grids.forEach((o,s)=>{let l=Math.floor((e-o.lower[0])/o.cell),c=Math.floor((r-o.lower[1])/o.cell),u=c*o.width+l;if(!(l>=0&&c>=0&&l<o.width&&c<o.height)||!o.walkable[u])return;let h=this.eyeOf(s,u);h[1]<=i+a&&(!n||h[1]>n.eye[1])&&(n={grid:s,cell:u,eye:h})}),n}nearest(e,r,i=(a,n)=>e[1]>a&&e[1]<=n+2*this.step){let a,n=r;return this.grids.forEach((o,s)=>{for(let l=0;l<o.floor.length;++l){if(!o.walkable[l]||!i(o.floor[l],o.floor[l]+o.eyeHeight))continue;let c=this.eyeOf(s,l),u=Math.hypot(c[0]-e[0],c[2]-e[2]);u<n&&(n=u,a={grid:s,cell:l,eye:c})}}),a}distance(e){let r=this.nearest(e,this.beside);return r?Math.hypot(r.eye[0]-e[0],r.eye[2]-e[2]):1/0}walk(e,r,i,a){let n=(this.stand(e[0],e[2],e[1])??this.stand(e[0],e[2],e[1]+this.eyeHeight,0))?.eye[1];if(n===void 0){let _=this.distance(e);if(a.fall=0,_===1/0||this.stand(r[0],r[2],e[1])||this.distance(r)<_)return r;for(let x of[[r[0],e[1],e[2]],[e[0],e[1],r[2]]])if((x[0]!==e[0]||x[2]!==e[2])&&this.distance(x)<=_)return x;return e}let o=1/0,s=this.step;for(let _ of this.grids)o=Math.min(o,_.cell),s=Math.max(s,_.cell);let l=[r[0]-e[0],r[2]-e[2]],c=Math.hypot(...l)/(.5*o),u=Math.min(Math.max(Math.ceil(c),1),64),h=Math.max(u,c),f=e[0],d=e[2],m=n,p=(_,x)=>{let w=this.stand(f+_,d+x,m,s);return!w||m-w.eye[1]>s?!1:(f+=_,d+=x,m=w.eye[1],!0)},v=l[0]/h,b=l[1]/h;for(let _=0;_<u&&!(!p(v,b)&&!p(v,0)&&!p(0,b));++_);let g=e[1];return g-m>2*this.step?(a.fall+=9.81*this.beside*i,g=Math.max(g-a.fall*i,m)):(a.fall=0,g+=(m-g)*(1-Math.exp(-i/.08)),Math.abs(m-g)<.001*this.step&&(g=m)),[f,g,d]}way(e,r){let i=this.stand(e[0],e[2],e[1])??this.nearest(e,this.beside);if(!i)return[];let a=u=>u.grid*2**30+u.cell,n=new Map([[a(i),void 0]]),o=[i],s=i,l=1/0;for(let u=0;u<o.length;++u){let h=o[u],f=this.grids[h.grid],d=Math.hypot(h.eye[0]-r[0],h.eye[1]-this.grids[h.grid].eyeHeight-r[1],h.eye[2]-r[2]);d<l&&(l=d,s=h);for(let[m,p]of[[1,0],[-1,0],[0,1],[0,-1],[1,1],[1,-1],[-1,1],[-1,-1]]){let v=this.stand(h.eye[0]+m*f.cell,h.eye[2]+p*f.cell,h.eye[1],Math.max(this.step,f.cell));!v||h.eye[1]-v.eye[1]>Math.max(this.step,f.cell)||n.has(a(v))||m&&p&&(!this.stand(h.eye[0]+m*f.cell,h.eye[2],h.eye[1])||!this.stand(h.eye[0],h.eye[2]+p*f.cell,h.eye[1]))||(n.set(a(v),h),o.push(v))}}let c=[];for(let u=s;u&&a(u)!==a(i);u=n.get(a(u)))c.push(u.eye);return c}};var as=2,ns=3,_a=1.55,At=t=>Math.atan2(-t[0],-t[2]),ba=t=>Math.asin(Math.min(Math.max(t[1]/Math.max(W(t),1e-12),-1),1)),xa=(t,e)=>[-Math.sin(t)*Math.cos(e),Math.sin(e),-Math.cos(t)*Math.cos(e)],et=class{camera;cameras;path;floors;origin;state={fall:0};way=[];tour;place=0;clock;constructor(e){this.floors=new Je(e.grids),this.origin=e.mesh.origin,this.path=e.paths.find(a=>a.keys.length>1),this.cameras=e.cameras.length>0?e.cameras:[this.somewhere(e)],this.camera={...this.fromHash()??this.cameras[0]};let r=Number(new URLSearchParams(location.hash.slice(1)).get("time")??NaN),i=Number.isFinite(r);this.clock={seconds:i?Math.max(r,0):0,runs:!i&&!matchMedia("(prefers-reduced-motion: reduce)").matches}}somewhere(e){let r=e.grids.findIndex(a=>a.walkable.some(n=>n>0));return{name:"start",eye:r<0?[0,1.6,0]:this.floors.eyeOf(r,e.grids[r].walkable.indexOf(1)),forward:[0,0,-1],up:[0,1,0],fov:1.05,halfHeight:0}}fromHash(){let e=new URLSearchParams(location.hash.slice(1)).get("camera");if(!e)return;let r=this.cameras.find(o=>o.name===e);if(r)return r;let i=e.split(",").map(Number);if(i.length<5||i.length>6||!i.every(Number.isFinite))return;let a=i[5]===void 0?60:Math.min(Math.max(i[5],10),120),n=Math.PI/180;return{name:"",eye:F(i.slice(0,3),this.origin),forward:xa(i[3]*n,i[4]*n),up:[0,1,0],fov:a*n,halfHeight:0}}toHash(){let e=this.camera,r=B(e.eye,this.origin),i=180/Math.PI;return`#camera=${[...r.map(n=>n.toFixed(3)),...[At(e.forward),ba(e.forward),e.fov].map(n=>(n*i).toFixed(2))].join(",")}`}jump(e){this.camera={...e},this.way=[],this.tour=void 0,this.state.fall=0}goTo(e,r){return this.tour=void 0,this.way=this.floors.way(this.camera.eye,e),r&&this.way[0]&&this.jump({...this.camera,eye:this.way[0]}),this.way.length>0||r}get touring(){return this.tour!==void 0}toggleTour(){this.tour=this.touring||!this.path?void 0:this.path.keys[0].time,this.way=[]}step(e,r){let i={...this.camera},a=e.right!==0||e.ahead!==0,n=e.yaw!==0||e.pitch!==0;if(a&&(this.way=[]),(a||n)&&(this.tour=void 0),this.touring&&this.alongPath(r),n){let s=Math.min(Math.max(ba(this.camera.forward)-e.pitch,-_a),_a);this.camera.forward=xa(At(this.camera.forward)-e.yaw,s),this.camera.up=[0,1,0]}!this.touring&&(a||this.way.length>0||this.state.fall>0||this.settling)&&this.walk(e,r);let o=(s,l)=>s.some((c,u)=>c!==l[u]);return o(i.eye,this.camera.eye)||o(i.forward,this.camera.forward)}settling=!1;walk(e,r){let i=as*this.floors.eyeHeight*(e.fast?ns:1)/1.6,a=this.camera.eye,n=[...a];if(this.way.length>0){let o=i*1.5*r;for(;this.way.length>0&&o>0;){let s=this.way[this.way.length-1],l=[s[0]-n[0],s[2]-n[2]],c=Math.hypot(...l),u=c>o?o/c:1;n=[n[0]+l[0]*u,n[1],n[2]+l[1]*u],o-=c,u===1&&this.way.pop()}}else{let o=At(this.camera.forward),s=Math.max(Math.hypot(e.right,e.ahead),1),l=i*r/s;n[0]+=(Math.cos(o)*e.right-Math.sin(o)*e.ahead)*l,n[2]+=(-Math.sin(o)*e.right-Math.cos(o)*e.ahead)*l}this.camera.eye=this.floors.grids.length>0?this.floors.walk(a,n,r,this.state):n,this.settling=this.camera.eye[1]!==a[1]}alongPath(e){let r=this.path.keys,i=r[r.length-1];this.tour+=e,this.tour>=i.time&&(this.tour=void 0);let a=this.tour??i.time,n=Math.max(1,r.findIndex(u=>u.time>=a)),o=r[n-1],s=r[n],l=Math.min(Math.max((a-o.time)/Math.max(s.time-o.time,1e-9),0),1),c=(u,h)=>u.map((f,d)=>f+(h[d]-f)*l);this.camera={name:"",eye:c(o.eye,s.eye),forward:N(c(o.forward,s.forward),o.forward),up:[0,1,0],fov:this.path.fov,halfHeight:0}}};var os=ArrayBuffer,U=Uint8Array,tt=Uint16Array,ss=Int16Array;var rt=Int32Array,Lt=function(t,e,r){if(U.prototype.slice)return U.prototype.slice.call(t,e,r);(e==null||e<0)&&(e=0),(r==null||r>t.length)&&(r=t.length);var i=new U(r-e);return i.set(t.subarray(e,r)),i},Fe=function(t,e,r,i){if(U.prototype.fill)return U.prototype.fill.call(t,e,r,i);for((r==null||r<0)&&(r=0),(i==null||i>t.length)&&(i=t.length);r<i;++r)t[r]=e;return t},ls=function(t,e,r,i){if(U.prototype.copyWithin)return U.prototype.copyWithin.call(t,e,r,i);for((r==null||r<0)&&(r=0),(i==null||i>t.length)&&(i=t.length);r<i;)t[e++]=t[r++]};var cs=["invalid zstd data","window size too large (>2046MB)","invalid block type","FSE accuracy too high","match distance too far back","unexpected EOF"],O=function(t,e,r){var i=new Error(e||cs[t]);if(i.code=t,Error.captureStackTrace&&Error.captureStackTrace(i,O),!r)throw i;return i},ya=function(t,e,r){for(var i=0,a=0;i<r;++i)a|=t[e++]<<(i<<3);return a},us=function(t,e){return(t[e]|t[e+1]<<8|t[e+2]<<16|t[e+3]<<24)>>>0},hs=function(t,e){var r=t[0]|t[1]<<8|t[2]<<16;if(r==3126568&&t[3]==253){var i=t[4],a=i>>5&1,n=i>>2&1,o=i&3,s=i>>6;i&8&&O(0);var l=6-a,c=o==3?4:o,u=ya(t,l,c);l+=c;var h=s?1<<s:a,f=ya(t,l,h)+(s==1&&256),d=f;if(!a){var m=1<<10+(t[5]>>3);d=m+(m>>3)*(t[5]&7)}d>2145386496&&O(1);var p=new U((e==1?f||d:e?0:d)+12);return p[0]=1,p[4]=4,p[8]=8,{b:l+h,y:0,l:0,d:u,w:e&&e!=1?e:p.subarray(12),e:d,o:new rt(p.buffer,0,3),u:f,c:n,m:Math.min(131072,d)}}else if((r>>4|t[3]<<20)==25481893)return us(t,4)+8;O(0)},me=function(t){for(var e=0;1<<e<=t;++e);return e-1},Se=function(t,e,r){var i=(e<<3)+4,a=(t[e]&15)+5;a>r&&O(3);for(var n=1<<a,o=n,s=-1,l=-1,c=-1,u=n,h=new os(512+(n<<2)),f=new ss(h,0,256),d=new tt(h,0,256),m=new tt(h,512,n),p=512+(n<<1),v=new U(h,p,n),b=new U(h,p+n);s<255&&o>0;){var g=me(o+1),_=i>>3,x=(1<<g+1)-1,w=(t[_]|t[_+1]<<8|t[_+2]<<16)>>(i&7)&x,y=(1<<g)-1,z=x-o-1,I=w&y;if(I<z?(i+=g,w=I):(i+=g+1,w>y&&(w-=z)),f[++s]=--w,w==-1?(o+=w,v[--u]=s):o-=w,!w)do{var q=i>>3;l=(t[q]|t[q+1]<<8)>>(i&7)&3,i+=2,s+=l}while(l==3)}(s>255||o)&&O(0);for(var $=0,X=(n>>1)+(n>>3)+3,j=n-1,Q=0;Q<=s;++Q){var L=f[Q];if(L<1){d[Q]=-L;continue}for(c=0;c<L;++c){v[$]=Q;do $=$+X&j;while($>=u)}}for($&&O(0),c=0;c<n;++c){var M=d[v[c]]++,K=b[c]=a-me(M);m[c]=(M<<K)-n}return[i+7>>3,{b:a,s:v,n:b,t:m}]},fs=function(t,e){var r=0,i=-1,a=new U(292),n=t[e],o=a.subarray(0,256),s=a.subarray(256,268),l=new tt(a.buffer,268);if(n<128){var c=Se(t,e+1,6),u=c[0],h=c[1];e+=n;var f=u<<3,d=t[e];d||O(0);for(var m=0,p=0,v=h.b,b=v,g=(++e<<3)-8+me(d);g-=v,!(g<f);){var _=g>>3;if(m+=(t[_]|t[_+1]<<8)>>(g&7)&(1<<v)-1,o[++i]=h.s[m],g-=b,g<f)break;_=g>>3,p+=(t[_]|t[_+1]<<8)>>(g&7)&(1<<b)-1,o[++i]=h.s[p],v=h.n[m],m=h.t[m],b=h.n[p],p=h.t[p]}++i>255&&O(0)}else{for(i=n-127;r<i;r+=2){var x=t[++e];o[r]=x>>4,o[r+1]=x&15}++e}var w=0;for(r=0;r<i;++r){var y=o[r];y>11&&O(0),w+=y&&1<<y-1}var z=me(w)+1,I=1<<z,q=I-w;for(q&q-1&&O(0),o[i++]=me(q)+1,r=0;r<i;++r){var y=o[r];++s[o[r]=y&&z+1-y]}var $=new U(I<<1),X=$.subarray(0,I),j=$.subarray(I);for(l[z]=0,r=z;r>0;--r){var Q=l[r];Fe(j,r,Q,l[r-1]=Q+s[r]*(1<<z-r))}for(l[0]!=I&&O(0),r=0;r<i;++r){var L=o[r];if(L){var M=l[L];Fe(X,r,M,l[L]=M+(1<<z-L))}}return[e,{n:j,b:z,s:X}]},ms=Se(new U([81,16,99,140,49,198,24,99,12,33,196,24,99,102,102,134,70,146,4]),0,6)[1],ds=Se(new U([33,20,196,24,99,140,33,132,16,66,8,33,132,16,66,8,33,68,68,68,68,68,68,68,68,36,9]),0,6)[1],ps=Se(new U([32,132,16,66,102,70,68,68,68,68,36,73,2]),0,5)[1],wa=function(t,e){for(var r=t.length,i=new rt(r),a=0;a<r;++a)i[a]=e,e+=1<<t[a];return i},Pt=new U(new rt([0,0,0,0,16843009,50528770,134678020,202050057,269422093]).buffer,0,36),vs=wa(Pt,0),zt=new U(new rt([0,0,0,0,0,0,0,0,16843009,50528770,117769220,185207048,252579084,16]).buffer,0,53),gs=wa(zt,3),Me=function(t,e,r){var i=t.length,a=e.length,n=t[i-1],o=(1<<r.b)-1,s=-r.b;n||O(0);for(var l=0,c=r.b,u=(i<<3)-8+me(n)-c,h=-1;u>s&&h<a;){var f=u>>3,d=(t[f]|t[f+1]<<8|t[f+2]<<16)>>(u&7);l=(l<<c|d)&o,e[++h]=r.s[l],u-=c=r.n[l]}(u!=s||h+1!=a)&&O(0)},_s=function(t,e,r){var i=6,a=e.length,n=a+3>>2,o=n<<1,s=n+o;Me(t.subarray(i,i+=t[0]|t[1]<<8),e.subarray(0,n),r),Me(t.subarray(i,i+=t[2]|t[3]<<8),e.subarray(n,o),r),Me(t.subarray(i,i+=t[4]|t[5]<<8),e.subarray(o,s),r),Me(t.subarray(i),e.subarray(s),r)},bs=function(t,e,r){var i,a=e.b,n=t[a],o=n>>1&3;e.l=n&1;var s=n>>3|t[a+1]<<5|t[a+2]<<13,l=(a+=3)+s;if(o==1)return a>=t.length?void 0:(e.b=a+1,r?(Fe(r,t[a],e.y,e.y+=s),r):Fe(new U(s),t[a]));if(!(l>t.length)){if(o==0)return e.b=l,r?(r.set(t.subarray(a,l),e.y),e.y+=s,r):Lt(t,a,l);if(o==2){var c=t[a],u=c&3,h=c>>2&3,f=c>>4,d=0,m=0;u<2?h&1?f|=t[++a]<<4|(h&2&&t[++a]<<12):f=c>>3:(m=h,h<2?(f|=(t[++a]&63)<<4,d=t[a]>>6|t[++a]<<2):h==2?(f|=t[++a]<<4|(t[++a]&3)<<12,d=t[a]>>2|t[++a]<<6):(f|=t[++a]<<4|(t[++a]&63)<<12,d=t[a]>>6|t[++a]<<2|t[++a]<<10)),++a;var p=r?r.subarray(e.y,e.y+e.m):new U(e.m),v=p.length-f;if(u==0)p.set(t.subarray(a,a+=f),v);else if(u==1)Fe(p,t[a++],v);else{var b=e.h;if(u==2){var g=fs(t,a);d+=a-(a=g[0]),e.h=b=g[1]}else b||O(0);(m?_s:Me)(t.subarray(a,a+=d),p.subarray(v),b)}var _=t[a++];if(_){_==255?_=(t[a++]|t[a++]<<8)+32512:_>127&&(_=_-128<<8|t[a++]);var x=t[a++];x&3&&O(0);for(var w=[ds,ps,ms],y=2;y>-1;--y){var z=x>>(y<<1)+2&3;if(z==1){var I=new U([0,0,t[a++]]);w[y]={s:I.subarray(2,3),n:I.subarray(0,1),t:new tt(I.buffer,0,1),b:0}}else z==2?(i=Se(t,a,9-(y&1)),a=i[0],w[y]=i[1]):z==3&&(e.t||O(0),w[y]=e.t[y])}var q=e.t=w,$=q[0],X=q[1],j=q[2],Q=t[l-1];Q||O(0);var L=(l<<3)-8+me(Q)-j.b,M=L>>3,K=0,Re=(t[M]|t[M+1]<<8)>>(L&7)&(1<<j.b)-1;M=(L-=X.b)>>3;var Ae=(t[M]|t[M+1]<<8)>>(L&7)&(1<<X.b)-1;M=(L-=$.b)>>3;var Le=(t[M]|t[M+1]<<8)>>(L&7)&(1<<$.b)-1;for(++_;--_;){var st=j.s[Re],It=j.n[Re],lt=$.s[Le],Ot=$.n[Le],Nt=X.s[Ae],$t=X.n[Ae];M=(L-=Nt)>>3;var Wt=1<<Nt,he=Wt+((t[M]|t[M+1]<<8|t[M+2]<<16|t[M+3]<<24)>>>(L&7)&Wt-1);M=(L-=zt[lt])>>3;var ge=gs[lt]+((t[M]|t[M+1]<<8|t[M+2]<<16)>>(L&7)&(1<<zt[lt])-1);M=(L-=Pt[st])>>3;var Pe=vs[st]+((t[M]|t[M+1]<<8|t[M+2]<<16)>>(L&7)&(1<<Pt[st])-1);if(M=(L-=It)>>3,Re=j.t[Re]+((t[M]|t[M+1]<<8)>>(L&7)&(1<<It)-1),M=(L-=Ot)>>3,Le=$.t[Le]+((t[M]|t[M+1]<<8)>>(L&7)&(1<<Ot)-1),M=(L-=$t)>>3,Ae=X.t[Ae]+((t[M]|t[M+1]<<8)>>(L&7)&(1<<$t)-1),he>3)e.o[2]=e.o[1],e.o[1]=e.o[0],e.o[0]=he-=3;else{var ze=he-(Pe!=0);ze?(he=ze==3?e.o[0]-1:e.o[ze],ze>1&&(e.o[2]=e.o[1]),e.o[1]=e.o[0],e.o[0]=he):he=e.o[0]}for(var y=0;y<Pe;++y)p[K+y]=p[v+y];K+=Pe,v+=Pe;var _e=K-he;if(_e<0){var be=-_e,Ia=e.e+_e;be>ge&&(be=ge);for(var y=0;y<be;++y)p[K+y]=e.w[Ia+y];K+=be,ge-=be,_e=0}for(var y=0;y<ge;++y)p[K+y]=p[_e+y];K+=ge}if(K!=v)for(;v<p.length;)p[K++]=p[v++];else K=p.length;r?e.y+=K:p=Lt(p,0,K)}else if(r){if(e.y+=f,v)for(var y=0;y<f;++y)p[y]=p[v+y]}else v&&(p=Lt(p,v));return e.b=l,p}O(2)}},xs=function(t,e){if(t.length==1)return t[0];for(var r=new U(e),i=0,a=0;i<t.length;++i){var n=t[i];r.set(n,a),a+=n.length}return r};function ka(t,e){for(var r=[],i=+!e,a=0,n=0;t.length;){var o=hs(t,i||e);if(typeof o=="object"){for(i?(e=null,o.w.length==o.u&&(r.push(e=o.w),n+=o.u)):(r.push(e),o.e=0);!o.l;){var s=bs(t,o,e);s||O(5),e?o.e=o.y:(r.push(s),n+=s.length,ls(o.w,0,s.length),o.w.set(s,o.w.length-s.length))}a=o.b+o.c*4}else a=o;t=t.subarray(a)}return xs(r,n)}var ys=64;function ws(t,e){let r=t.u16(),i=t.u16(),a=t.u16(),n=t.u16();(r<2||r>6||i!==1&&i!==3||a<1||a>256||n<1||n>64)&&t.fail(`found a transfer of ${r} bands, ${i} channels, ${a} clusters and ${n} components`),t.f32();let o=t.f32s(a*(n+1)*i*r*r),s=t.f32s(a*n),l=t.planes(e,1),c=new Int16Array(t.planes(e*n,2).buffer);for(let u of l)u>=a&&t.fail(`found cluster ${u} of ${a}`);return{bands:r,channels:i,clusters:a,components:n,basis:o,weightScale:s,cluster:l,weight:c}}function Ma(t){let e=t.text(),r=wt(t,e),i=je(t);return{name:e,...r,mesh:i,transfer:ws(t,i.positions.length/3)}}function ks(t){return t.text(),{kind:t.choice(3,"kind of light"),twoSided:t.choice(1,"flag")>0,intensity:V(t),position:V(t),direction:V(t),innerCone:t.f32(),outerCone:t.f32(),angularRadius:t.f32(),corners:R(t,t.count(12),V)}}function Fa(t){let e=t.u32(),r=t.u32();(e<2||e>6||r<2||r>64)&&t.fail(`found ${e} bands and depth maps of ${r} texels a side`);let i=t.f32();t.f32();let a=V(t),n=V(t),o=[t.u32(),t.u32(),t.u32()],s=t.count(36),l=t.count(12),c=t.size(ys,"lights");(!(i>0)||n.some(x=>!(x>0))||o.some(x=>x<1)||o[0]*o[1]*o[2]>s)&&t.fail(`found a grid of ${o.join(" x ")} cells of ${s}`);let u=new Uint32Array(t.planes(s,36).buffer);for(let x=0;x<s;++x){let w=u[9*x];w!==0&&(w<=x||w+8>s)&&t.fail(`found parts ${w} of cell ${x} of ${s}`);for(let y=1;y<9;++y)u[9*x+y]>=l&&t.fail(`found probe ${u[9*x+y]} of ${l}`)}let h=t.planesF32(l,3),f=t.planes(l,1),d=()=>new Uint32Array(t.planes(l,8).buffer),m=d(),p=d(),v=2**ue(t),b=t.planesU16(3*e*e*l),g=r*r*l,_=Float32Array.from(b,x=>Z(x)*v);return _.some(x=>!Number.isFinite(x))&&t.fail("found a coefficient that is not finite"),{bands:e,depthSide:r,depthCap:i,lower:a,cell:n,size:o,cells:u,positions:h,valid:f,bright:m,kept:p,harmonics:_,depth:t.planesU16(g),depthSquared:t.planesU16(g),lights:R(t,c,ks)}}var Ms=2**30;function Fs(t,e,r,i){switch(t){case"SCNE":i.sky=r.floats(3);break;case"MESH":i.mesh=je(r);break;case"MATL":i.materials=R(r,e,Gi);break;case"ETEX":i.emissionTextures=R(r,e,zi);break;case"METL":i.metalness=R(r,e,Pi);break;case"TEXR":i.textures.push(...R(r,e,yt));break;case"NTEX":i.normals.push(...R(r,e,yt));break;case"LMAP":i.pages.push(...R(r,e,Vi));break;case"SHRP":i.sharp=Zi(r);break;case"RFLT":i.reflectors=R(r,e,Di);break;case"EMIT":i.emitters=R(r,e,Bi);break;case"KERN":i.kernels=R(r,e,Ci);break;case"FRES":i.fresnels=R(r,e,Ui);break;case"CAMS":i.cameras=R(r,e,Ii);break;case"PATH":i.paths=R(r,e,Oi);break;case"CRFL":i.curved=R(r,e,qi);break;case"SMAP":i.surrounds.push(...R(r,e,Xi));break;case"MOVR":i.movers.push(...R(r,e,Ma));break;case"PROB":i.field=Fa(r);break;case"LGRP":i.groups=R(r,e,$i);break;case"GLMP":i.pageGroups.push(...R(r,e,Hi));break;case"DAYH":i.day=Wi(r);break;case"SKYM":i.skyMap=ji(r);break;case"WALK":i.grids=R(r,e,Ni);break;default:r.fail("found a section that a piece does not have")}r.end()}var Ss=[143,79,82,73,13,10,26,10];function Gt(t,e){let r=s=>{throw new D(`${e}: ${s}`)},i=new DataView(t.buffer,t.byteOffset,t.byteLength),a={sky:[0,0,0],materials:[],emissionTextures:[],metalness:[],textures:[],normals:[],pages:[],reflectors:[],emitters:[],kernels:[],fresnels:[],cameras:[],paths:[],grids:[],groups:[],pageGroups:[],curved:[],surrounds:[],movers:[]};(t.length<64||Ss.some((s,l)=>t[l]!==s))&&r("is no piece of a pack"),i.getUint32(8,!0)!==1&&r(`found format version ${i.getUint32(8,!0)}, expected 1`);let n=i.getUint32(16,!0);64+n*64>t.length&&r("ends inside its table");let o=s=>Number(i.getBigUint64(s,!0));for(let s=0;s<n;++s){let l=64+64*s,c=String.fromCharCode(...t.subarray(l,l+4)),u=i.getUint32(l+4,!0),h=o(l+16),f=o(l+24),d=o(l+32),m=o(l+40),p=`${e}, ${c}`;h+f>t.length&&r(`section ${c} ends outside`),(d>Ms||d>f*65536+65536||m>d+1)&&r(`found ${d} bytes in section ${c}`);let v=t.subarray(h,h+f);if(u===1)try{v=ka(v,new Uint8Array(d))}catch{r(`section ${c} cannot be decompressed`)}else u!==0&&r(`found codec ${u}`);v.length!==d&&r(`section ${c}: found ${v.length} bytes, expected ${d}`),Fs(c,m,new Ge(v,p),a)}return a}function Sa(t,e,r,i){let a=s=>{throw new D(`scene: ${s}`)},n=(s,l,c,u=-1)=>{(s<u||s>=l)&&a(`found ${c} ${s} of ${l}`)},o=t.mesh;if(!o)return a("found no mesh");t.pages.some(s=>s.sharpAt)&&a("found sharp light on coarse pages");for(let s of o.parts)n(s.material,t.materials.length,"material",0),n(s.page,t.pages.length,"lightmap page");for(let s of t.materials)n(s.texture,e,"texture"),n(s.normalTexture,r,"normal texture"),n(s.kernel,t.kernels.length,"kernel"),n(s.fresnel,t.fresnels.length,"Fresnel map");for(let s of t.emissionTextures)n(s.material,t.materials.length,"material",0),n(s.texture,e,"texture",0);for(let s of t.metalness)n(s.material,t.materials.length,"material",0),n(s.texture,e,"texture");for(let s of t.reflectors){n(s.material,t.materials.length,"material",0);for(let l of s.indices)n(l,o.positions.length/3,"vertex",0);for(let l of s.emitters)n(l,t.emitters.length,"emitter",0)}for(let s of t.curved){n(s.material,t.materials.length,"material",0),n(s.map,i,"surround map",0);for(let l of s.indices)n(l,o.positions.length/3,"vertex",0)}t.groups.length>Xe&&a(`found ${t.groups.length} light groups, expected at most ${Xe}`);for(let s of t.groups){for(let l of s.materials)n(l,t.materials.length,"material",0);for(let l of s.emitters)n(l,t.emitters.length,"emitter",0)}}function Ta(t,e){for(let r of e.groups)for(let i of r.brightLights)if(i>=t.lights.length)throw new D(`group '${r.name}': found bright light ${i} of ${t.lights.length}`)}function Ea(t,e){for(let r of t.mesh.parts)if(r.material>=e.materials.length)throw new D(`mover '${t.name}': found material ${r.material} of ${e.materials.length}`)}function Ra(t,e,r){let i=n=>{throw new D(`light of groups on page ${t.page}: ${n}`)},a=e.groups.length;if(!r)return i(`found no such page among ${e.pages.length}`);(t.width!==r.width||t.height!==r.height||t.detailWidth!==r.detailWidth||t.detailHeight!==r.detailHeight)&&i(`found ${t.width} x ${t.height} texels, expected ${r.width} x ${r.height} and as many details`);for(let n of[t.rest,t.restOfDetail])for(let o of n)o>=a&&i(`found group ${o} of ${a}`);for(let n of t.others)n.group>=a&&i(`found group ${n.group} of ${a}`)}var Ts=2,Es=1800,Rs=1e4,Aa=2700,ie=t=>document.getElementById(t);function Te(t,e,r){let i=document.createElement("input");return i.type=t,i.setAttribute("aria-label",e),i.addEventListener("input",()=>r(i)),i}function Vt(t,e,r,i){return t.min=String(e),t.max=String(r),t.step=String(i),t}function As(t){let e=t.hours.slice(1).map((r,i)=>r.hour-t.hours[i].hour);return e.length>0?Math.min(...e)/4:.25}var it=class{constructor(e,r,i){this.groups=e;this.day=r;this.wanted=i;this.settings=Oe(e,r),e.length!==0&&(ie("lamps").hidden=!1,ie("lamps").addEventListener("click",()=>this.toggle()),ie("lights-close").addEventListener("click",()=>this.toggle()),ie("lights-baked").addEventListener("click",()=>this.all(({hour:a})=>({on:!0,value:1,hour:a}))),ie("lights-off").addEventListener("click",()=>this.all(a=>({...a,on:!1}))),this.dialog.addEventListener("keydown",a=>{(a.key==="Escape"||a.key==="o"&&!(a.ctrlKey||a.altKey||a.metaKey))&&(this.toggle(),a.preventDefault())}),r&&ie("lights-groups").append(this.rowOfHour(r)),e.forEach((a,n)=>{this.settings[n].hour===void 0&&ie("lights-groups").append(this.rowsOf(n))}),this.fromHash())}settings;refreshes=[];dialog=ie("lights");get factors(){return xi(this.groups,this.settings,this.day)}get changed(){return this.factors.some(e=>e.some(r=>r!==1))}toggle(){this.groups.length!==0&&(this.dialog.open?(this.dialog.close(),ie("view").focus()):this.dialog.show(),ie("lamps").setAttribute("aria-expanded",String(this.dialog.open)))}fromHash(){let e=new URLSearchParams(location.hash.slice(1)).getAll("light");e.length!==0&&(this.settings=Oe(this.groups,this.day),_i(this.groups,e,this.settings,this.day),this.refresh())}toHash(){return bi(this.groups,this.settings,this.day).map(e=>`&light=${encodeURIComponent(e)}`).join("")}all(e){this.settings=this.settings.map(e),this.refresh()}refresh(){for(let e of this.refreshes)e();this.wanted()}rowOfHour(e){let r=document.createElement("label"),i=document.createElement("output"),a=()=>this.settings.find(o=>o.hour!==void 0).hour,n=Vt(Te("range",`hour, ${e.clock}`,()=>{vt(e,Number(n.value),this.settings),this.refresh()}),e.hours[0].hour,e.hours.at(-1).hour,As(e));return r.append("hour",n,i),this.refreshes.push(()=>{n.value=String(a()),i.textContent=`${kt(a())} ${e.clock}`}),this.refreshes.at(-1)(),r}rowsOf(e){let{name:r,lamps:i}=this.groups[e],a=document.createElement("div"),n=()=>this.settings[e],o=v=>()=>{v(),this.refresh()},s=(v,...b)=>{let g=document.createElement("label");return g.append(...b.slice(0,1),v,...b.slice(1)),a.append(g),g};a.setAttribute("role","group"),a.setAttribute("aria-label",r),a.title=i.join(", ");let l=Te("checkbox",r,o(()=>{n().on=l.checked})),c=Vt(Te("range",`${r}: light, times what was baked`,o(()=>{n().value=Number(c.value)})),0,Ts,.05),u=Te("checkbox",`${r}: a colour of its own`,o(()=>{delete n().color,delete n().kelvin,u.checked&&Ne(n(),Aa)})),h=Vt(Te("range",`${r}: colour temperature, kelvin`,o(()=>Ne(n(),Number(h.value)))),Es,Rs,100),f=document.createElement("output"),d=document.createElement("output");s(r,l);let m=s("",c,f),p=s("colour",u,h,d);return this.refreshes.push(()=>{let v=n();l.checked=v.on,c.value=String(v.value),u.checked=!!v.color,h.value=String(v.kelvin??Aa),m.hidden=p.hidden=!v.on,h.hidden=d.hidden=v.kelvin===void 0,f.textContent=`× ${v.value.toFixed(2)}`,d.textContent=`${Math.round(v.kelvin??0)} K`,h.style.setProperty("accent-color",v.kelvin?Ls(v.kelvin):"")}),this.refreshes.at(-1)(),a}};function Ls(t){let e=pt(t),r=Math.max(...e);return`rgb(${e.map(i=>Math.round(255*(i/r)**(1/2.2))).join(" ")})`}function La(t,e,r,i){let{right:a,up:n,forward:o}=ct(t),s=t.fov===0?t.halfHeight:Math.tan(.5*t.fov),l=B(E(a,(2*e-1)*s*i),E(n,(1-2*r)*s));return t.fov===0?{from:B(t.eye,l),way:o}:{from:t.eye,way:N(B(o,l),o)}}function Pa(t,e,r){let i=t.data.mesh,a=i.positions,n=v=>ae(a,v),o;for(let v of i.parts){let b=t.data.materials[v.material].doubleSided;for(let g=v.first;g<v.first+v.count;g+=3){let _=n(i.indices[g]),x=F(n(i.indices[g+1]),_),w=F(n(i.indices[g+2]),_),y=G(r,w),z=S(x,y);if(z===0||z<0&&!b)continue;let I=F(e,_),q=S(I,y)/z,$=G(I,x),X=S(r,$)/z,j=S(w,$)/z;q<0||X<0||q+X>1||j<=1e-4||o&&j>=o.t||(o={t:j,index:g,u:q,w:X,page:v.page,normal:N(G(x,w),[0,1,0])})}}if(!o)return;let{t:s,index:l,u:c,w:u,page:h,normal:f}=o,d=i.lightmapUvs,m=v=>[0,1,2].reduce((b,g)=>b+d[2*i.indices[l+g]+v]*[1-c-u,c,u][g],0),p=B(e,E(r,s));return{at:p,normal:f,distance:s,lux:h<0?0:t.luxAt(h,m(0),m(1),p,f)}}var at=4,Ps=120,Dt=50,zs=25,Gs=.25,Vs=.5,Ds=.002,Bs=5e3,Cs=200,Us=4,nt=class{constructor(e,r,i,a,n,o){this.canvas=e;this.renderer=r;this.scene=i;this.walk=a;this.panel=n;this.lights=o;o.changed&&this.dim()}count=0;movedAt=-1e9;scale=1;hurries=!1;began=!1;presented=!1;meteredAt=-1e9;byHand;luxShown=!1;pointer=[.5,.5];frames=0;changed(){this.count=0,this.settled=!1}settled=!1;loading=!0;came=!1;drawnAt=-1e9;took=0;pieceCame(){this.came=!0}allCame(){this.loading=!1,delete document.body.dataset.rest,this.changed()}waits(e){let r=this.loading&&this.took>Cs&&this.count>0;return this.came&&(!r||e-this.drawnAt>Us*this.took)?(this.came=!1,this.changed(),!1):r||this.count>=at}dimmed=!1;dim(){this.dimmed=!0}brighter(e){this.byHand=(this.byHand??0)-e/3,this.meteredAt=-1e9,this.changed()}automatic(){this.byHand=void 0,this.meteredAt=-1e9,this.changed()}frame(e,r,i){let a=this.walk.step(e.take(r),r),n=this.walk.clock.runs&&this.scene.movers.animated,o=a||n;n&&(this.walk.clock.seconds+=r),this.scene.movers.place(this.walk.clock.seconds),this.panel.moversAre(this.scene.movers.animated,n),this.panel.stick(e.stick),this.dimmed&&(this.dimmed=!1,this.scene.setLights(this.lights.factors),this.changed());let s=Math.max(1,Math.round(this.canvas.clientWidth*Math.min(devicePixelRatio,2))),l=Math.max(1,Math.round(this.canvas.clientHeight*Math.min(devicePixelRatio,2)));(this.canvas.width!==s||this.canvas.height!==l)&&(this.canvas.width=s,this.canvas.height=l,this.changed()),o&&(i-this.movedAt<500&&this.adapt(r*1e3),this.movedAt=i,this.changed(),delete document.body.dataset.rest),!o&&i-this.movedAt>500&&(this.hurries=!1);let c=this.began&&i-this.movedAt<Ps;if(this.frames===1&&!this.presented){this.presented=!0;return}(c?!o:this.waits(i))||(this.began?this.draw(c,s,l,i):this.drawFirst(s,l,i),++this.frames)}adapt(e){e>Dt&&!this.hurries?this.hurries=!0:e>Dt?this.scale=Math.max(this.scale*Math.max(Math.sqrt(Dt/e),.5),Gs):e<zs&&(this.scale=Math.min(this.scale*1.05,1))}drawFirst(e,r,i){let a=n=>Math.max(1,Math.round(n*Vs));this.renderer.draw(this.scene,this.walk.camera,a(e),a(r),void 0,va),this.meter(!1,i),this.renderer.show(this.scene,0,e,r),this.renderer.startRest(),this.began=!0,this.changed()}draw(e,r,i,a){let n=e?this.scale:1,o=Math.max(1,Math.round(r*n)),s=Math.max(1,Math.round(i*n)),l=performance.now(),c=e?a-this.meteredAt>200:this.count===0&&!this.settled;this.renderer.draw(this.scene,this.walk.camera,o,s,e?void 0:this.count,e&&this.hurries?ga:pa),c&&this.meter(e,a),c&&!e&&(this.took=performance.now()-l),this.drawnAt=performance.now(),!e&&!this.settled&&this.renderer.addToMean(1/at,this.count===0);let u=this.count===at-1;this.renderer.show(this.scene,e?0:this.count,r,i,e||!this.settled||u),this.count=e?0:this.count+1,!(this.count<at)&&(!this.settled&&this.settle(a)||(document.body.dataset.rest=String(this.frames),this.panel.lux(this.luxShown?this.luxThere():void 0)))}settle(e){let r=this.renderer.white;return this.settled=!0,this.meter(!1,e,!0),this.took>Bs||Math.abs(Math.log2(this.renderer.white/r))<Ds?!1:(this.count=0,!0)}meter(e,r,i=!1){let a=this.renderer.meter(this.scene,i);if(this.meteredAt=r,a===void 0)return;let n=Math.min(Math.max(a-Math.log2(1.2*.18),-4),17)+(this.byHand??0),o=Math.log2(this.renderer.white/1.2),s=e?.45:1;this.renderer.white=1.2*2**(o+(n-o)*s)}get aspect(){return this.canvas.width/this.canvas.height}hitAt(e,r){let i=La(this.walk.camera,e,r,this.aspect);return Pa(this.scene,i.from,i.way)}go(e,r){let i=this.hitAt(e,r);if(!i)return;let a=i.normal[1]>.7?0:.5,n=[i.at[0]+i.normal[0]*a,i.at[1],i.at[2]+i.normal[2]*a];a>0&&(n[1]=this.walk.floors.nearest(this.walk.camera.eye,1e9)?.eye[1]??n[1]),this.walk.goTo(n,matchMedia("(prefers-reduced-motion: reduce)").matches)||this.panel.say("Nobody can walk there."),this.changed()}hover(e,r){this.pointer=[e,r],this.luxShown&&this.panel.lux(this.luxThere())}luxThere(){let e=this.hitAt(...this.pointer);return e?`${e.lux<10?e.lux.toFixed(1):Math.round(e.lux)} lux`:"no surface"}toggleLux(){this.luxShown=!this.luxShown,this.panel.lux(this.luxShown?this.luxThere():void 0)}};var za=2;async function Ga(t,e){let r;try{r=await fetch(t,{integrity:e})}catch{throw new D(`${t} did not come, or is not the one that this page was made with`)}if(!r.ok)throw new D(`${t}: ${r.status} ${r.statusText}`);return new Uint8Array(await r.arrayBuffer())}async function Va(t,e){let r=JSON.parse(new TextDecoder().decode(await Ga(t,e)));if(r.version!==za)throw new D(`${t} is of version ${r.version}, this viewer of ${za}: write the folder anew`);for(let i of r.pieces)if(!/^pieces\/[a-z]+-[0-9a-f]+\.oriel$/.test(i.file)||!(i.bytes>0)||!(i.index>=0))throw new D(`${t}: found piece '${i.file}'`);return r}async function Bt(t){let e=await Ga(t.file,t.integrity);if(e.length!==t.bytes)throw new D(`${t.file}: found ${e.length} bytes, expected ${t.bytes}`);return e}function A(t){let e=document.getElementById(t);if(!e)throw new Error(`the page has no ${t}`);return e}var ot=class{walk;lights;show=()=>{};timer=0;begin(e,r,i){this.walk=e,this.lights=r,this.show=i;let a=A("places");e.cameras.forEach((n,o)=>a.append(new Option(n.name||`place ${o+1}`,String(o)))),a.addEventListener("change",()=>{a.value!==""&&this.jump(Number(a.value)),a.value="",A("view").focus()}),A("tour").hidden=!e.path,A("tour").addEventListener("click",()=>this.key("p")),A("movers").addEventListener("click",()=>this.key("m")),A("link").addEventListener("click",()=>void this.copyLink()),A("screen").hidden=!document.fullscreenEnabled,A("screen").addEventListener("click",()=>{(document.fullscreenElement?document.exitFullscreen():document.documentElement.requestFullscreen()).catch(()=>this.say("The browser does not give the whole screen."))}),A("help").addEventListener("click",()=>this.key("?")),addEventListener("hashchange",()=>{let n=e.fromHash();n&&(this.walk.jump(n),this.show()?.changed()),r.fromHash()})}sizes(e,r){A("sheet-sizes").textContent=`Loaded: ${(e/1e6).toFixed(1)} MB. Held on the graphics device: ${(r/1e6).toFixed(1)} MB, and the frame.`,document.body.dataset.held=String(r)}movers="";moversAre(e,r){let i=`${e} ${r}`;i!==this.movers&&(this.movers=i,A("movers").hidden=!e,A("movers").setAttribute("aria-pressed",String(r)))}progress(e){A("progress").value=e,A("bar").hidden=e>=1}say(e,r=!1){A("line").textContent=e,clearTimeout(this.timer),r||(this.timer=window.setTimeout(()=>{A("line").textContent=""},4e3))}lux(e){A("lux").hidden=e===void 0,A("lux").textContent=e??""}stick(e){let r=A("stick");r.hidden=!e,e&&(r.style.setProperty("left",`${e.startX}px`),r.style.setProperty("top",`${e.startY}px`)),A("tour").setAttribute("aria-pressed",String(!!this.walk?.touring))}jump(e){let r=this.walk,i=r.cameras[e];i&&(r.place=e,r.jump(i),this.show()?.changed(),this.say(i.name))}async copyLink(){let e=this.walk.toHash()+this.lights.toHash(),r=location.href.split("#")[0]+e;history.replaceState(null,"",e);try{await navigator.clipboard.writeText(r),this.say("A link to this view is on the clipboard.")}catch{this.say("The address now leads to this view.")}}key(e){let r=this.walk,i=this.show();if(!(!r||!i))switch(e){case"c":this.jump((r.place+1)%r.cameras.length);break;case"Home":this.jump(0);break;case"o":this.lights.toggle();break;case"m":r.clock.runs=!r.clock.runs;break;case"p":r.toggleTour();break;case"g":i.go(.5,.5);break;case"l":i.toggleLux();break;case"+":case"=":i.brighter(1);break;case"-":i.brighter(-1);break;case"x":i.automatic();break;case"?":A("sheet").showModal();break;default:/^[1-9]$/.test(e)&&this.jump(Number(e)-1)}}};var Ct=t=>{document.body.dataset.state=t};function Ba(t){A("fallback").hidden=!1,A("fallback-text").textContent=t,A("tools").hidden=A("bar").hidden=!0,A("view").hidden=!0,Ct("refused")}var Da=3,Ca=!1,Ee=A("view"),se=new ot;function Is(){return Ee.getContext("webgl2",{antialias:!1,alpha:!1,depth:!1,powerPreference:"high-performance"})}var Ut=class{constructor(e,r,i){this.gl=e;this.scene=r;this.walk=i;this.lights=new it(r.groups,r.day,()=>this.show?.dim())}pieces=new Map;show;lights;begin(e=new ke(Et(this.gl))){let r=new Qe(e.device,{...this.scene,pages:this.scene.pages.slice()});this.show=new nt(Ee,e,r,this.walk,se,this.lights);for(let[i,a]of this.pieces)this.take(i,a)}take(e,r){this.pieces.set(e,r);let i=this.show,[a,n]=e.split(" "),o=Number(n);i&&(a==="light"&&r.pages[0]&&i.scene.setPage(o,r.pages[0]),a==="sharp"&&r.sharp&&i.scene.setSharp(r.sharp),a==="texture"&&r.textures[0]&&i.scene.setTexture(o,r.textures[0],!1),a==="normal"&&r.normals[0]&&i.scene.setTexture(o,r.normals[0],!0),a==="surround"&&r.surrounds[0]&&i.scene.setSurround(o,r.surrounds[0]),a==="sky"&&r.skyMap&&i.scene.setSky(r.skyMap),a==="field"&&r.field&&i.scene.movers.setField(r.field),a==="mover"&&r.movers[0]&&i.scene.movers.add(o,r.movers[0]),a==="lamps"&&r.pageGroups[0]&&i.scene.setPageGroups(r.pageGroups[0]),i.pieceCame())}};async function Os(t){if(!("serviceWorker"in navigator)||!isSecureContext)return;let e=/pieces-([0-9a-f]+)\.json/.exec(document.body.dataset.pieces)?.[1];try{let r=await caches.open(`oriel ${new URL("./",location.href).pathname} ${e}`),i=[...document.querySelectorAll("script[src], link[href]")].map(a=>a.getAttribute("src")??a.getAttribute("href"));await r.addAll(["./",document.body.dataset.pieces,...i,...t.pieces.map(a=>a.file)]),await navigator.serviceWorker.register("offline.js"),document.body.dataset.offline="kept"}catch{}}var Ns=t=>`${t.kind} ${t.index}`;async function $s(){let t=await Va(document.body.dataset.pieces,document.body.dataset.integrity),e=t.pieces.reduce((_,x)=>_+x.bytes,0),r=t.pieces.find(_=>_.kind==="scene");if(!r)throw new D("found no scene among the pieces");let i=Bt(r);i.catch(()=>{});let a=Is();if(!a)return Ba("This page shows a building in three dimensions. Your browser cannot draw it: it lacks WebGL 2.");let n=new ke(Et(a));n.start();let o=r.bytes;se.progress(.05);let s=Gt(await i,r.file),l=a.getParameter(a.MAX_TEXTURE_SIZE);Ua(s,r.file,l);let c=_=>t.pieces.filter(x=>x.kind===_).length;Sa(s,c("texture"),c("normal"),c("surround"));let u=new et(s),h=new Ut(a,s,u);h.begin(n),Ca=!0,se.begin(u,h.lights,()=>h.show);let f=new Ve(Ee,{key:_=>se.key(_),go:(_,x)=>h.show?.go(_,x),hover:(_,x)=>h.show?.hover(_,x)}),d=!1,m=performance.now();Ee.addEventListener("webglcontextlost",_=>{_.preventDefault(),d=!0,h.show=void 0}),Ee.addEventListener("webglcontextrestored",()=>{d=!1,h.begin(),document.body.dataset.state==="whole"&&h.show.allCame()});let p=_=>{requestAnimationFrame(p);let x=Math.min((_-m)/1e3,.25);m=_,!d&&(h.show?.frame(f,x,_),h.show?.frames&&document.body.dataset.state==="loading"&&(a.finish(),performance.mark("first frame"),Ct("first")))},v=t.pieces.filter(_=>_!==r),b=[],g=_=>{for(let x=b.length;x<Math.min(_,v.length);++x)(b[x]=Bt(v[x])).catch(()=>{})};g(Da),p(m),se.progress(o/e);for(let[_,x]of v.entries()){g(_+Da);let w=Gt(await b[_],x.file);Ws(w,x,l),x.kind==="light"&&Ji(w.pages[0],h.pieces.get("sharp 0")?.sharp),x.kind==="mover"&&Ea(w.movers[0],s),x.kind==="field"&&Ta(w.field,s),x.kind==="lamps"&&Ra(w.pageGroups[0],s,h.pieces.get(`light ${w.pageGroups[0].page}`)?.pages[0]),h.take(Ns(x),w),se.progress((o+=x.bytes)/e)}h.show?.allCame(),Ct("whole"),se.progress(1),se.sizes(e,h.show?.scene.bytes??0),await Os(t)}function Ws(t,e,r){let a={light:t.pages,texture:t.textures,normal:t.normals,surround:t.surrounds,lamps:t.pageGroups,mover:t.movers,field:t.field?[t.field]:[],sharp:t.sharp?[t.sharp]:[],sky:t.skyMap?[t.skyMap]:[]}[e.kind]?.length??0;if(a!==1)throw new D(`${e.file}: found ${a} of kind '${e.kind}', expected one`);Ua(t,e.file,r)}function Ua(t,e,r){let i=[...t.textures,...t.normals,...t.pages].map(a=>[a.width,a.height]);for(let a of t.pages)i.push([a.detailWidth,a.detailHeight]);t.skyMap&&i.push([t.skyMap.width,t.skyMap.height]);for(let a of t.surrounds)i.push([1.5*a.size+4,a.size+64]);t.sharp&&i.push([oe,ta(t.sharp)]);for(let[a,n]of i)if(Math.max(a,n)>r)throw new D(`${e}: found an image of ${a} x ${n} texels, but this device holds at most ${r} a side`)}$s().catch(t=>{Ca?se.say(`A part is missing: ${t.message}`,!0):Ba(`This walkthrough cannot be shown: ${t.message}`),t instanceof D||console.error(t)});
