var V=class extends Error{},Ge=class{constructor(e,r){this.bytes=e;this.name=r;this.view=new DataView(e.buffer,e.byteOffset,e.byteLength)}at=0;view;get left(){return this.bytes.length-this.at}fail(e){throw new V(`${this.name}: ${e}`)}take(e){return e>this.left&&this.fail(`found ${this.left} bytes more, expected ${e}`),this.at+=e,this.at-e}u8(){return this.view.getUint8(this.take(1))}u32(){return this.view.getUint32(this.take(4),!0)}u16(){return this.view.getUint16(this.take(2),!0)}i32(){return this.view.getInt32(this.take(4),!0)}f64(){return this.view.getFloat64(this.take(8),!0)}f32(){let e=this.view.getFloat32(this.take(4),!0);return Number.isFinite(e)||this.fail("found a number that is not finite"),e}floats(e){let r=[];for(let i=0;i<e;++i)r.push(this.f32());return r}count(e){let r=this.u32();return r*e>this.left&&this.fail(`found ${r} elements in ${this.left} bytes`),r}text(){let e=this.count(1),r=this.take(e);return new TextDecoder().decode(this.bytes.subarray(r,r+e))}choice(e,r){let i=this.u8();return i>e&&this.fail(`found ${r} ${i}, expected 0 to ${e}`),i}size(e,r){let i=this.u32();return i>e&&this.fail(`found ${r} ${i}, expected at most ${e}`),i}planes(e,r){e*r>this.left&&this.fail(`found ${this.left} bytes, expected ${e*r}`);let i=this.take(e*r),n=new Uint8Array(e*r);for(let a=0;a<r;++a){let o=0;for(let s=0,l=a,c=i+a*e;s<e;++s,l+=r)o=o+this.bytes[c+s]&255,n[l]=o}return n}planesF32(e,r=1){let i=new Float32Array(this.planes(e,4*r).buffer);for(let n=0;n<i.length;++n)Number.isFinite(i[n])||this.fail("found a number that is not finite");return i}planesU32(e){return new Uint32Array(this.planes(e,4).buffer)}planesU16(e,r=1){return new Uint16Array(this.planes(e,2*r).buffer)}f32s(e){return 4*e>this.left&&this.fail(`found ${this.left} bytes, expected ${4*e}`),Float32Array.from(this.floats(e))}u32s(e){4*e>this.left&&this.fail(`found ${this.left} bytes, expected ${4*e}`);let r=this.take(4*e),i=new Uint32Array(e);for(let n=0;n<e;++n)i[n]=this.view.getUint32(r+4*n,!0);return i}end(){this.left>0&&this.fail(`found ${this.left} bytes more than expected`)}};function Z(t){let e=t>>10&31,r=t&1023,i=t&32768?-1:1;return e===0?i*r*2**-24:e===31?NaN:i*(1+r/1024)*2**(e-15)}var Ht=new Float32Array(1),Gn=new Uint32Array(Ht.buffer);function qt(t){if(!(t<65504))return 31743;if(t<2**-14)return Math.round(t*2**24);Ht[0]=t;let e=Gn[0]-939524096,r=e>>>13,i=e&8191;return r+ +(i>4096||i===4096&&(r&1)>0)}var Ve=class{constructor(e,r){this.canvas=e;this.events=r;addEventListener("keydown",i=>this.key(i)),addEventListener("keyup",i=>this.down.delete(i.code)),addEventListener("blur",()=>this.reset()),e.addEventListener("pointerdown",i=>this.begin(i)),e.addEventListener("pointermove",i=>this.move(i)),e.addEventListener("pointerup",i=>this.end(i)),e.addEventListener("pointercancel",i=>this.fingers.delete(i.pointerId)),e.addEventListener("contextmenu",i=>i.preventDefault())}down=new Set;fingers=new Map;yaw=0;pitch=0;pressed=[];reset(){this.down.clear(),this.fingers.clear()}key(e){e.ctrlKey||e.altKey||e.metaKey||e.target instanceof Element&&e.target.closest("button, select, dialog, a")&&!/^Key[WASD]$/.test(e.code)||e.target instanceof HTMLSelectElement||(/^Arrow|^Space$/.test(e.code)&&e.preventDefault(),e.repeat||this.events.key(e.key.length===1?e.key.toLowerCase():e.key),this.down.add(e.code))}begin(e){if(e.button!==0)return;this.canvas.focus({preventScroll:!0});try{this.canvas.setPointerCapture(e.pointerId)}catch{}let r=e.pointerType==="touch"&&e.clientX<.5*innerWidth&&![...this.fingers.values()].some(i=>i.moves);this.fingers.set(e.pointerId,{x:e.clientX,y:e.clientY,startX:e.clientX,startY:e.clientY,begin:e.timeStamp,moves:r,far:!1})}move(e){let r=this.fingers.get(e.pointerId);if(!r){e.pointerType==="mouse"&&this.events.hover(...this.place(e));return}if(r.far||=Math.hypot(e.clientX-r.startX,e.clientY-r.startY)>12,!r.moves){let i=e.pointerType==="touch"?.006:.004;this.yaw+=(e.clientX-r.x)*i,this.pitch+=(e.clientY-r.y)*i}r.x=e.clientX,r.y=e.clientY}end(e){let r=this.fingers.get(e.pointerId);this.fingers.delete(e.pointerId),!(!r||r.far||e.timeStamp-r.begin>800)&&(e.pointerType!=="mouse"||e.detail>=2||this.doubled(e))&&this.events.go(...this.place(e))}lastClick=-1e9;doubled(e){let r=e.timeStamp-this.lastClick<400;return this.lastClick=e.timeStamp,r}place(e){let r=this.canvas.getBoundingClientRect();return[(e.clientX-r.left)/r.width,(e.clientY-r.top)/r.height]}get stick(){return[...this.fingers.values()].find(e=>e.moves&&e.far)}gamepad(e,r){let i=(navigator.getGamepads?.()??[]).find(o=>o?.connected);if(!i)return;let n=o=>{let s=i.axes[o]??0;return Math.abs(s)<.15?0:(s-Math.sign(s)*.15)/(1-.15)};e.right+=n(0),e.ahead-=n(1),e.yaw+=n(2)*2*r,e.pitch+=n(3)*2*r;let a=["g",void 0,"p",void 0,"Shift","c",void 0,void 0,"?","Home",void 0,void 0,"+","-"];e.fast||=!!i.buttons[4]?.pressed,i.buttons.forEach((o,s)=>{let l=a[s];o.pressed&&!this.pressed[s]&&l&&s!==4&&this.events.key(l),this.pressed[s]=o.pressed})}take(e){let r=a=>Number(this.down.has(a)),i={right:r("KeyD")-r("KeyA"),ahead:r("KeyW")-r("KeyS"),fast:!!(r("ShiftLeft")+r("ShiftRight")),yaw:-this.yaw+(r("ArrowRight")-r("ArrowLeft"))*1.5*e,pitch:-this.pitch+(r("ArrowDown")-r("ArrowUp"))*1.2*e};this.yaw=this.pitch=0;for(let a of this.fingers.values())!a.moves||!a.far||(i.right+=(a.x-a.startX)/60,i.ahead-=(a.y-a.startY)/60);this.gamepad(i,e);let n=a=>Math.min(Math.max(a,-1),1);return i.right=n(i.right),i.ahead=n(i.ahead),i}};var ne=(t,e)=>[t[3*e],t[3*e+1],t[3*e+2]],D=(t,e)=>[t[0]+e[0],t[1]+e[1],t[2]+e[2]],F=(t,e)=>[t[0]-e[0],t[1]-e[1],t[2]-e[2]],E=(t,e)=>[t[0]*e,t[1]*e,t[2]*e],T=(t,e)=>t[0]*e[0]+t[1]*e[1]+t[2]*e[2],G=(t,e)=>[t[1]*e[2]-t[2]*e[1],t[2]*e[0]-t[0]*e[2],t[0]*e[1]-t[1]*e[0]],W=t=>Math.hypot(t[0],t[1],t[2]),N=(t,e)=>{let r=W(t);return r>0&&Number.isFinite(r)?E(t,1/r):e};function Xt(){let t=new Float64Array(16);return t[0]=t[5]=t[10]=t[15]=1,t}function J(t,e){let r=new Float64Array(16);for(let i=0;i<4;++i)for(let n=0;n<4;++n){let a=0;for(let o=0;o<4;++o)a+=t[4*o+n]*e[4*i+o];r[4*i+n]=a}return r}function he(t,e){let r=[0,0,0,0];for(let i=0;i<4;++i)r[i]=t[i]*e[0]+t[4+i]*e[1]+t[8+i]*e[2]+t[12+i]*e[3];return r}var ee=(t,e)=>he(t,[e[0],e[1],e[2],1]).slice(0,3);function jt(t){let e=new Float64Array(16);for(let r=0;r<3;++r)for(let i=0;i<3;++i)e[4*i+r]=t[4*r+i];for(let r=0;r<3;++r)e[12+r]=-(t[4*r]*t[12]+t[4*r+1]*t[13]+t[4*r+2]*t[14]);return e[15]=1,e}function De(t,e){let r=Array.from({length:4},(i,n)=>[...Array.from({length:4},(a,o)=>t[4*n+o]),e[n]]);for(let i=0;i<4;++i){let n=i;for(let a=i+1;a<4;++a)Math.abs(r[a][i])>Math.abs(r[n][i])&&(n=a);[r[i],r[n]]=[r[n],r[i]];for(let a=0;a<4;++a){if(a===i)continue;let o=r[a][i]/r[i][i];for(let s=i;s<5;++s)r[a][s]-=o*r[i][s]}}return r.map((i,n)=>i[4]/i[n])}var de=()=>({lower:[1/0,1/0,1/0],upper:[-1/0,-1/0,-1/0]});function ae(t,e,r,i){t.lower[0]=Math.min(t.lower[0],e),t.lower[1]=Math.min(t.lower[1],r),t.lower[2]=Math.min(t.lower[2],i),t.upper[0]=Math.max(t.upper[0],e),t.upper[1]=Math.max(t.upper[1],r),t.upper[2]=Math.max(t.upper[2],i)}var se=t=>E(D(t.lower,t.upper),.5),xe=t=>.5*W(F(t.upper,t.lower));function te(t,e){for(let r=0;r<6;++r){let i=r>>1,n=r&1?-1:1,a=t[15]+n*t[12+i];for(let o=0;o<3;++o){let s=t[4*o+3]+n*t[4*o+i];a+=s*(s>0?e.upper[o]:e.lower[o])}if(a<0)return!1}return!0}var Kt=`float luminance(vec3 rgb){return dot(rgb,vec3(0.2126,0.7152,0.0722));}
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
`;var ir=`vec3 mirrored(vec3 tilted,vec3 view,out vec3 normal,out float cos_theta){
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
`;var ar=`vec2 octahedral_from_direction(vec3 d){
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
`;var or=`vec3 reflectance_from_table(sampler2D tables,int row,int count,float cos_theta){
float at=sqrt(clamp(cos_theta,0.0,1.0))*float(count - 1);
int low=min(int(at),max(count - 2,0));
vec3 a=texelFetch(tables,ivec2(low,row),0).rgb;
vec3 b=texelFetch(tables,ivec2(min(low + 1,count - 1),row),0).rgb;
return mix(a,b,at - float(low));
}
`;var sr=`const float kPi=3.14159265358979323846;
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
`;var lr=`uniform highp usampler2D u_sharp_at;
uniform highp usampler2D u_sharp_words;
uniform highp sampler2D u_sharp_triangles;
uniform highp sampler2D u_sharp_lamps;
const uint kSharpSplit=0xffffffffu;
const int kMostSharpSplits=5;
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
return SharpLamp(to,1.0,0.0,power.rgb*(cone*cone*max(dot(normal,towards),0.0)/ distance2));
}
float extent(vec3 v){return dot(abs(v),vec3(1.0));}
#ifdef SUNS
#define COVER uvec2
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
for(uint k=0u;k < count;++k){
uint word=sharp_word(first + k);
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
}
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
for(int k=0;head==kSharpSplit;++k){
if(k==kMostSharpSplits)return vec3(0.0);
within*=2.0;
vec2 quarter=step(1.0,within);
within -=quarter;
place=sharp_word(place + 1u + uint(quarter.x + 2.0*quarter.y));
head=sharp_word(place);
}
vec3 sum=vec3(0.0);
uint next=place + 1u;
for(uint k=0u;k < head;++k){
uint shine=sharp_word(next++);
vec3 tint=(shine & 0x400u)!=0u ? color_of_word(sharp_word(next++)): vec3(1.0);
uint count=shine >> 11u;
SharpLamp lamp=lamp_at(int(shine & 0x3ffu),p,normal);
if(lamp.light.r + lamp.light.g + lamp.light.b > 0.0){
float visible=count > 0u ? sharp_visible(lamp,next,count,p,dx,dy): 1.0;
sum +=lamp.light*tint*visible;
}
next +=count;
}
return min(sum,kMostSharpLux);
}
`;var cr=`#include "lib/octahedral.glsl"
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
`;var ur=`vec3 taken_light(sampler2D change,usampler2D surfaces,vec2 at,vec3 p,vec3 n){
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
`;var hr=`const float kMostPlaces=8.0;
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
`;var fr=`vec3 tonemap_none(vec3 light){return clamp(light,0.0,1.0);}
vec3 tonemap_aces(vec3 light){
vec3 x=clamp(light,0.0,1e4);
return clamp(x*(2.51*x + 0.03)/(x*(2.43*x + 0.59)+ 0.14),0.0,1.0);
}
float dither(vec2 pixel){
return fract(52.9829189*fract(dot(pixel,vec2(0.06711056,0.00583715))))- 0.5;
}
`;var mr=`const int kWeightsWidth=2048;
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
`;var dr=`#include "passes/surface.glsl"
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
`;var pr=`#include "lib/transfer.glsl"
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
`;var vr=`#include "passes/surface.glsl"
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
`;var gr=`#include "passes/surface_vertex.glsl"
`;var _r=`#include "lib/kernel.glsl"
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
`;var br=`#include "passes/surface.glsl"
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
`;var xr=`#include "passes/surface_vertex.glsl"
`;var yr=`uniform sampler2D u_base_texture;
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
`;var wr=`layout(location=0)in vec3 a_position;
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
`;var kr=`#include "passes/surface.glsl"
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
`;var Mr=`uniform sampler2D u_base_texture;
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
`;var Fr=`#include "passes/reflector_reflectance.glsl"
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
`;var Sr=`#include "passes/reflector_surface.glsl"
`;var Tr=`#include "passes/reflector_reflectance.glsl"
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
`;var Er=`#include "passes/reflector_surface.glsl"
`;var Rr=`#include "lib/kernel.glsl"
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
`;var Ar=`float share_of_polygon(vec4 lobe,vec3 corners[4]);
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
`;var Lr=`#include "lib/lobe_light.glsl"
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
`;var Pr=`#include "passes/reflector_surface.glsl"
`;var zr=`#include "passes/reflector_surface.glsl"
`;var Gr=`void main(){}
`;var Vr=`layout(location=0)in vec3 a_position;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
void main(){gl_Position=u_clip_from_pack*vec4(a_position,1.0);}
`;var Dr=`#include "lib/reflectance.glsl"
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
`;var Br=`layout(location=0)in vec3 a_position;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;
void main(){
gl_Position=u_clip_from_pack*vec4(a_position,1.0);
v_position=a_position;
}
`;var Cr=`#include "passes/lightmap.glsl"
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
`;var Ur=`#include "passes/surface_vertex.glsl"
`;var Or=`uniform vec4 u_ndc_from_image;
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
`;var Ir=`#include "lib/kernel.glsl"
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
`;var Nr=`#include "passes/screen_convolve.glsl"
layout(location=0)out vec4 o_light;
void main(){o_light=convolved(gl_FragCoord.xy*float(u_coarse));}
`;var $r=`#include "passes/curved_lobe.glsl"
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
`;var Wr=`#include "lib/fullscreen.glsl"
void main(){gl_Position=fullscreen_position(gl_VertexID);}
`;var Hr=`#include "lib/color.glsl"
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
`;var qr=`#include "lib/fill.glsl"
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
`;var Xr=`#include "lib/normal_map.glsl"
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
`;var jr=`layout(location=0)in vec3 a_position;
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
`;var Kr=`#include "passes/lightmap.glsl"
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
`;var Yr=`#include "passes/surface_vertex.glsl"
`;var Qr=`#include "lib/color.glsl"
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
`;var Ca={"lib/color.glsl":Kt,"lib/distance_alpha.glsl":Yt,"lib/fill.glsl":Qt,"lib/fullscreen.glsl":Zt,"lib/kernel.glsl":Jt,"lib/lightmap_uv.glsl":er,"lib/lobe_light.glsl":tr,"lib/lit_surface.glsl":rr,"lib/mirrored.glsl":ir,"lib/normal_map.glsl":nr,"lib/octahedral.glsl":ar,"lib/reflectance.glsl":or,"lib/shading.glsl":sr,"lib/sharp_light.glsl":lr,"lib/surround.glsl":cr,"lib/taken_light.glsl":ur,"lib/texture_along.glsl":hr,"lib/tonemap.glsl":fr,"lib/transfer.glsl":mr,"passes/curved_light.frag":vr,"passes/curved_light.vert":gr,"passes/curved_lobe.glsl":_r,"passes/curved_surface.frag":br,"passes/curved_surface.vert":xr,"passes/depth.frag":yr,"passes/depth.vert":wr,"passes/lightmap.glsl":kr,"passes/mover_light.frag":dr,"passes/mover_light.vert":pr,"passes/opaque.glsl":Mr,"passes/reflector_compose.frag":Fr,"passes/reflector_compose.vert":Sr,"passes/reflector_convolve.frag":Tr,"passes/reflector_convolve.vert":Er,"passes/reflector_emitters.frag":Rr,"passes/reflector_emitters.glsl":Ar,"passes/reflector_emitters_sharp.frag":Lr,"passes/reflector_emitters_sharp.vert":Pr,"passes/reflector_emitters.vert":zr,"passes/reflector_mask.frag":Gr,"passes/reflector_mask.vert":Vr,"passes/reflector_reflectance.glsl":Dr,"passes/reflector_surface.glsl":Br,"passes/scene.frag":Cr,"passes/scene.vert":Ur,"passes/screen_blur_width.glsl":Or,"passes/screen_convolve.glsl":Ir,"passes/screen_convolve.frag":Nr,"passes/screen_curved.frag":$r,"passes/screen_fullscreen.vert":Wr,"passes/screen_luminance.frag":Hr,"passes/screen_pull.frag":qr,"passes/surface.glsl":Xr,"passes/surface_vertex.glsl":jr,"passes/transparent.frag":Kr,"passes/transparent.vert":Yr,"passes/screen_average.frag":Qr},Ua=["#version 300 es","precision highp float;","precision highp int;","precision highp sampler2D;","precision highp sampler2DArray;","precision highp isampler2D;","precision highp usampler2D;",""].join(`
`);function Zr(t,e=""){let r=new Set,i=n=>{if(r.has(n))return"";r.add(n);let a=Ca[n];if(a===void 0)throw new Error(`found no shader ${n}`);return a.replace(/^#include "([^"]+)".*$/gm,(o,s)=>i(s))};return Ua+e.split(" ").filter(Boolean).map(n=>`#define ${n}
`).join("")+i(t)}var Jr={u_base_texture:0,u_lightmap:1,u_reflectance:2,u_direction:3,u_normal_texture:4,u_change:5,u_cells:6,u_detail:7,u_surfaces:8,u_image:9,u_frame:9,u_source:9,u_blurred:10,u_before:10,u_taps:11,u_emission_texture:11,u_polygons:12,u_visibility:13,u_seen:14,u_lobes:15,u_codes:6,u_table:7,u_light:9,u_inverse_distance:10,u_places:12,u_normals:13,u_shaded:15,u_sharp_at:16,u_sharp_words:17,u_sharp_triangles:18,u_sharp_lamps:19},B=class t{constructor(e,r,i){this.gl=e;this.name=r;this.define=i}at=new Map;program;linked=!1;static make(e,r,i=""){return new t(e,r,i)}start(){if(this.program)return;let{gl:e,name:r}=this,i=r.startsWith("screen_")?"screen_fullscreen":r;this.program=e.createProgram();for(let[n,a]of[[e.VERTEX_SHADER,`${i}.vert`],[e.FRAGMENT_SHADER,`${r}.frag`]]){let o=e.createShader(n);e.shaderSource(o,Zr(`passes/${a}`,this.define)),e.compileShader(o),e.attachShader(this.program,o)}e.linkProgram(this.program)}finish(){this.start(),this.linked=!0;let{gl:e}=this,r=this.program;if(!e.getProgramParameter(r,e.LINK_STATUS)&&!e.isContextLost()){let n=e.getAttachedShaders(r).map(a=>e.getShaderInfoLog(a)).join("");throw new Error(`shader ${this.name} ${this.define}: ${n}${e.getProgramInfoLog(r)}`)}e.useProgram(r);let i=e.getProgramParameter(r,e.ACTIVE_UNIFORMS);for(let n=0;n<i;++n){let a=e.getActiveUniform(r,n),o=e.getUniformLocation(r,a.name);this.at.set(a.name,{place:o,type:a.type});let s=Jr[a.name];[e.SAMPLER_2D,e.INT_SAMPLER_2D,e.UNSIGNED_INT_SAMPLER_2D].includes(a.type)&&s!==void 0&&e.uniform1i(o,s)}}use(){this.linked||this.finish(),this.gl.useProgram(this.program)}set(e,r){let i=this.at.get(e),n=this.gl;if(!i)return;let a=typeof r=="object"?Float32Array.from(r):void 0,o=Number(r);switch(i.type){case n.FLOAT:n.uniform1f(i.place,o);break;case n.INT:case n.BOOL:n.uniform1i(i.place,o);break;case n.INT_VEC2:n.uniform2i(i.place,a[0],a[1]);break;case n.FLOAT_VEC2:n.uniform2fv(i.place,a);break;case n.FLOAT_VEC3:n.uniform3fv(i.place,a);break;case n.FLOAT_VEC4:n.uniform4fv(i.place,a);break;case n.FLOAT_MAT4:n.uniformMatrix4fv(i.place,!1,a);break}}};function Oa(t,e){switch(e){case t.RGB16F:return[t.RGB,t.HALF_FLOAT];case t.RGBA16F:return[t.RGBA,t.HALF_FLOAT];case t.RGBA32F:return[t.RGBA,t.FLOAT];case t.RGB9_E5:return[t.RGB,t.UNSIGNED_INT_5_9_9_9_REV];case t.R32F:return[t.RED,t.FLOAT];case t.R32UI:return[t.RED_INTEGER,t.UNSIGNED_INT];case t.RGBA16I:return[t.RGBA_INTEGER,t.SHORT];case t.RGBA32UI:return[t.RGBA_INTEGER,t.UNSIGNED_INT];case t.DEPTH24_STENCIL8:return[t.DEPTH_STENCIL,t.UNSIGNED_INT_24_8];default:return[t.RGBA,t.UNSIGNED_BYTE]}}function S(t,e,r=null){let i=t.createTexture(),[n,a]=Oa(t,e.format);return t.activeTexture(t.TEXTURE0),t.bindTexture(t.TEXTURE_2D,i),t.pixelStorei(t.UNPACK_ALIGNMENT,1),t.texStorage2D(t.TEXTURE_2D,e.levels??1,e.format,e.width,e.height),r&&t.texSubImage2D(t.TEXTURE_2D,0,0,0,e.width,e.height,n,a,r),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,e.min??t.NEAREST),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MAG_FILTER,e.mag??t.NEAREST),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,e.wrapS??t.CLAMP_TO_EDGE),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,e.wrapT??t.CLAMP_TO_EDGE),i}function k(t,e,r){t.activeTexture(t.TEXTURE0+Jr[e]),t.bindTexture(t.TEXTURE_2D,r)}function re(t,e,r,i){let n=t.createFramebuffer();return t.bindFramebuffer(t.FRAMEBUFFER,n),t.framebufferTexture2D(t.FRAMEBUFFER,t.COLOR_ATTACHMENT0,t.TEXTURE_2D,e,0),i&&(t.framebufferTexture2D(t.FRAMEBUFFER,t.COLOR_ATTACHMENT1,t.TEXTURE_2D,i,0),t.drawBuffers([t.COLOR_ATTACHMENT0,t.COLOR_ATTACHMENT1])),r&&t.framebufferTexture2D(t.FRAMEBUFFER,t.DEPTH_STENCIL_ATTACHMENT,t.TEXTURE_2D,r,0),n}function z(t,e){let r=(n,a)=>{a?t.enable(n):t.disable(n)};r(t.DEPTH_TEST,!!e.depthTest),t.depthFunc(t.LEQUAL),t.depthMask(!!e.depthWrite);let i=e.color??!0;t.colorMask(i,i,i,i&&(e.alpha??!0)),r(t.CULL_FACE,!!e.cull),t.cullFace(t.BACK),t.frontFace(e.mirrored?t.CW:t.CCW),r(t.BLEND,!!e.blend),e.blend==="add"&&t.blendFuncSeparate(t.ONE,t.ONE,t.ONE,t.ZERO),e.blend==="multiply"&&t.blendFuncSeparate(t.ZERO,t.SRC_COLOR,t.ZERO,t.ONE),e.blend==="cover"&&t.blendFuncSeparate(t.ONE,t.ONE_MINUS_SRC_ALPHA,t.ZERO,t.ONE),r(t.STENCIL_TEST,e.stencilFunc!==void 0||!!e.stencilWrite),t.stencilFunc(e.stencilFunc??t.ALWAYS,e.stencilRef??0,e.stencilRead??255),t.stencilMask(e.stencilWrite??0),t.stencilOp(t.KEEP,t.KEEP,t.REPLACE)}function Ia(t,e,r,i){let n=Math.max(xe(t),1e-12),a=T(F(se(t),e),r),o=a+n*1.01,s=a-n*1.01;return i?[s,Math.max(o,s+n*.001)]:(o=Math.max(o,n*.01),s=Math.max(s,Math.min(.02,n*.001),o*1e-5),[s,Math.max(o,s*1.001)])}function Be(t,e){let r=Math.max(e,t.near+.001*Math.max(Math.abs(t.near),1e-20)),i=r-t.near,[n,a]=t.tangents,o=new Float64Array(16),s=[t.centre[0]/n,t.centre[1]/a];return o[0]=1/n,o[5]=1/a,t.ortho?(o[12]=-s[0],o[13]=-s[1],o[10]=-2/i,o[14]=-(r+t.near)/i,o[15]=1):(o[10]=-(r+t.near)/i,o[14]=-2*r*t.near/i,o[11]=-1,o[8]=s[0],o[9]=s[1]),o}function ct(t){let e=N(t.forward,[0,0,-1]),r=N(t.up,[0,1,0]);W(G(e,r))<1e-5&&(r=Math.abs(e[1])<.9?[0,1,0]:[0,0,-1]);let i=N(G(e,r),[1,0,0]);return{right:i,up:G(i,e),forward:e}}function ei(t,e,r,i,n=[0,0]){let{right:a,up:o,forward:s}=ct(t),l=t.fov===0,c=t.eye,u=new Float64Array([a[0],o[0],-s[0],0,a[1],o[1],-s[1],0,a[2],o[2],-s[2],0,-T(a,c),-T(o,c),T(s,c),1]),[h,f]=Ia(i,c,s,l),m=l?t.halfHeight>0?t.halfHeight:xe(i):Math.tan(.5*Math.min(Math.max(t.fov,.001),3.1)),d=[m*e/r,m],p={viewFromPack:u,clipFromView:u,clipFromPack:u,eye:l?[-s[0],-s[1],-s[2],0]:[...c,1],tangents:d,centre:[d[0]*2*n[0]/e,d[1]*2*n[1]/r],ortho:l,mirrored:!1,near:h,far:f,width:e,height:r};return p.clipFromView=Be(p,f),p.clipFromPack=J(p.clipFromView,u),p}function ti(t,e,r,i){let n={...t,width:r,height:i};return n.tangents=[t.tangents[0]*r/t.width,t.tangents[1]*i/t.height],n.centre=[t.centre[0]+t.tangents[0]*((2*e[0]+r)/t.width-1),t.centre[1]+t.tangents[1]*((2*e[1]+i)/t.height-1)],n.clipFromView=Be(n,n.far),n.clipFromPack=J(n.clipFromView,n.viewFromPack),n}function ri(t,e){let r=De(t,e),i=r[0]*(r[0]<0?-1:1)+r[1]*(r[1]<0?-1:1)+r[2]+r[3];if(!(i>0))return t;let n=t.slice();for(let a=0;a<4;++a)n[4*a+2]=e[a]*2/i-t[4*a+3];return n}function Ce(t,e){let r=e.map(s=>he(t,[s[0],s[1],s[2],1])),i=[[0,0,1,1],[1,0,0,1],[-1,0,0,1],[0,1,0,1],[0,-1,0,1]];for(let s of i){let l=c=>s[0]*c[0]+s[1]*c[1]+s[2]*c[2]+s[3]*c[3];r=r.flatMap((c,u)=>{let h=r[(u+1)%r.length],f=l(c),m=l(h),d=f>=0?[c]:[];return f>=0!=m>=0&&d.push(c.map((p,v)=>p+(h[v]-p)*f/(f-m))),d})}let n=r.filter(s=>s[3]>0).map(s=>[s[0]/s[3],s[1]/s[3]].map(l=>Math.min(Math.max(l,-1),1)));if(n.length===0)return;let a=n.map(s=>s[0]),o=n.map(s=>s[1]);return{lower:[Math.min(...a),Math.min(...o)],upper:[Math.max(...a),Math.max(...o)]}}var ut=127,ii=128,Na=.03,Ue=class{constructor(e,r){this.device=e;this.renderer=r}mask;surface;shade;light;shadedLight;made=!1;canvas;make(){let{gl:e}=this.device;this.made=!0,this.mask=B.make(e,"reflector_mask"),this.surface=B.make(e,"curved_surface"),this.shade=B.make(e,"screen_curved"),this.light=B.make(e,"curved_light"),this.shadedLight=B.make(e,"curved_light","SHADED")}draw(e,r,i){let n=[],a=[],o=[],{view:s}=r;if(i.largeOnly||e.surrounds.length===0)return{later:n,materials:a};this.made||this.make();for(let l of e.curved){if(l.count===0||!e.surrounds[l.map]||!te(s.clipFromPack,l.bounds))continue;let c=e.isTransparent(l.material);if(c?!r.inFrame:r.values+1>=ut)continue;let u=c?ii:++r.values;c||a.push(l.material),c||!r.inFrame?(this.drawMask(e,r,l,u,c?ii:ut),n.push(l)):o.push({curved:l,value:u})}return o.length>0&&this.drawShown(e,r,o,i),{later:n,materials:a}}add(e,r,i,n){for(let a of i)this.drawLight(e,r,a,this.light,{blend:"add",alpha:!1},n)}state(e,r){return{depthTest:!0,cull:!0,mirrored:e.view.mirrored,...r}}drawMask(e,r,i,n,a){z(this.device.gl,this.state(r,{color:!1,stencilRef:n,stencilWrite:a})),this.mask.use(),this.mask.set("u_clip_from_pack",r.view.clipFromPack),e.bindGeometry(),e.draw(i)}drawShown(e,r,i,n){let{gl:a,color:o}=this.device,s=o===a.RGBA32F;s&&this.shadeAll(e,r,i,n),r.begin();for(let{curved:l,value:c}of i){let u={stencilRef:c,stencilWrite:ut};s&&(this.shadedLight.use(),this.shadedLight.set("u_id",c),k(a,"u_shaded",this.canvas.light)),this.drawLight(e,r,l,s?this.shadedLight:this.light,u,n)}}drawLight(e,r,i,n,a,o){z(this.device.gl,this.state(r,a)),n.use(),this.setLobe(n,e,r,i,o),this.setNormals(n,e,r,i),n.set("u_modulate",!0),e.setReflectance(n,i.material),e.bindGeometry(),e.draw(i)}ensure(e,r){let i=this.canvas,{gl:n}=this.device;if(i&&i.width>=e&&i.height>=r)return i;if(i){for(let f of[i.places,i.normals,i.depth,i.light])n.deleteTexture(f);for(let f of[i.surfaces,i.shaded])n.deleteFramebuffer(f)}let a=Math.max(e,i?.width??0),o=Math.max(r,i?.height??0),s=f=>S(n,{width:a,height:o,format:f}),l=s(n.RGBA32F),c=s(n.RGBA32F),u=s(n.DEPTH24_STENCIL8),h=s(n.RGBA16F);return this.canvas={width:a,height:o,places:l,normals:c,depth:u,light:h,surfaces:re(n,l,u,c),shaded:re(n,h,u)}}shadeAll(e,r,i,n){let{gl:a}=this.device,{view:o}=r,s=this.ensure(o.width,o.height);a.enable(a.SCISSOR_TEST);let l=(c,u)=>{a.bindFramebuffer(a.FRAMEBUFFER,c),a.viewport(0,0,o.width,o.height),a.scissor(0,0,o.width,o.height),z(a,{depthWrite:!0,stencilWrite:255}),a.clearColor(0,0,0,0),a.clear(u)};l(s.surfaces,a.DEPTH_BUFFER_BIT|a.STENCIL_BUFFER_BIT),this.surface.use();for(let{curved:c,value:u}of i)z(a,this.state(r,{depthWrite:!0,stencilRef:u,stencilWrite:255})),this.setNormals(this.surface,e,r,c),e.bindGeometry(),e.draw(c);l(s.shaded,a.COLOR_BUFFER_BIT),this.shade.use(),k(a,"u_places",s.places),k(a,"u_normals",s.normals);for(let{curved:c,value:u}of i)z(a,{stencilFunc:a.EQUAL,stencilRef:u}),this.setLobe(this.shade,e,r,c,n),this.shade.set("u_id",u),this.scissor(r,c),this.renderer.drawScreen();a.disable(a.SCISSOR_TEST)}scissor(e,r){let{lower:i,upper:n}=r.bounds,{view:a}=e,o={x0:1,y0:1,x1:-1,y1:-1};for(let u=0;u<6;++u){let h=u>>1,f=(h+1)%3,m=(h+2)%3,d=[0,1,2,3].map(v=>{let b=u%2===0?[...i]:[...n];return b[f]=v===1||v===2?n[f]:i[f],b[m]=v>=2?n[m]:i[m],b}),p=Ce(a.clipFromPack,d);p&&(o.x0=Math.min(o.x0,p.lower[0]),o.y0=Math.min(o.y0,p.lower[1]),o.x1=Math.max(o.x1,p.upper[0]),o.y1=Math.max(o.y1,p.upper[1]))}let s=(u,h,f)=>f((u*.5+.5)*h),l=s(o.x0,a.width,Math.floor),c=s(o.y0,a.height,Math.floor);this.device.gl.scissor(l,c,Math.max(0,s(o.x1,a.width,Math.ceil)-l),Math.max(0,s(o.y1,a.height,Math.ceil)-c))}setNormals(e,r,i,n){e.set("u_clip_from_pack",i.view.clipFromPack),e.set("u_eye",i.view.eye),r.setNormals(e,n.material)}setLobe(e,r,i,n,a){let{gl:o}=this.device,s=r.surrounds[n.map],l=r.kernel(n.material,a.taps);k(o,"u_light",s.light),k(o,"u_inverse_distance",s.inverseDistance),k(o,"u_taps",l.taps),e.set("u_eye",i.view.eye),e.set("u_centre",s.centre),e.set("u_size",s.size),e.set("u_light_scale",s.tint.map(c=>c*s.scale*r.unit)),e.set("u_range",s.range),e.set("u_tap_count",l.count),e.set("u_tap_rows",l.rows),e.set("u_wide",l.median>=Na)}};var ht=127,ni=128,$a=.01,Wa=.001,ai=.5,oi=1e-5,Ha=.02,ft=6,qa=16/6,si=t=>.25*(t.upper[0]-t.lower[0])*(t.upper[1]-t.lower[1]),Oe=class{constructor(e,r,i){this.device=e;this.renderer=r;this.none=i;let{gl:n}=e;this.mask=B.make(n,"reflector_mask"),this.compose=B.make(n,"reflector_compose"),this.convolve=B.make(n,"reflector_convolve"),this.emitters=B.make(n,"reflector_emitters"),this.glints=B.make(n,"reflector_emitters_sharp"),this.curved=new Ue(e,r),this.pull=B.make(n,"screen_pull"),this.blur=B.make(n,"screen_convolve")}mask;compose;convolve;emitters;glints;pull;blur;curved;images=[];get programs(){return[this.mask,this.compose,this.convolve,this.emitters,this.glints,this.pull,this.blur]}drawMasks(e,r,i){let n=[],{gl:a}=this.device,o=r.view;if(r.values=0,i.orders===0)return n;for(let s of e.reflectors){let l=he(s.reflectorFromPack,o.eye);if(s.count===0||l[2]<=(o.ortho?oi:oi*s.size))continue;let c=Ce(o.clipFromPack,s.corners);if(!c||i.largeOnly&&r.share*si(c)<Ha)continue;let u=e.isTransparent(s.material),h=r.reflectance*e.reflectanceOf(s.material);if(!r.inFrame&&(u||h<$a||h*r.share*si(c)<Wa)||r.mirrors>=i.orders&&(h<ai||e.kernel(s.material,i.taps).count>1)||!u&&r.values+1>=ht)continue;let f=u?0:++r.values;if(this.drawMask(e,s,o,f,r.inFrame),r.inFrame&&!s.visible){u||this.drawMask(e,s,o,0,!1,!0);continue}n.push({reflector:s,screen:c,value:f})}return a.disable(a.STENCIL_TEST),n}drawMask(e,r,i,n,a,o=!1){let{gl:s}=this.device;a&&r.asked&&s.getQueryParameter(r.query,s.QUERY_RESULT_AVAILABLE)&&(r.visible=s.getQueryParameter(r.query,s.QUERY_RESULT)>0,r.asked=!1);let l=n===0&&!o;z(s,{depthTest:!0,color:!1,cull:!0,mirrored:i.mirrored,stencilRef:l?ni:n,stencilWrite:l?ni:ht}),this.mask.use(),this.mask.set("u_clip_from_pack",i.clipFromPack),e.bindGeometry();let c=a&&!r.asked;c&&s.beginQuery(s.ANY_SAMPLES_PASSED,r.query??=s.createQuery()),e.draw(r),c&&(s.endQuery(s.ANY_SAMPLES_PASSED),r.asked=!0)}chooseImage(e,r,i){let n=i.ortho?0:.5*r*.5*i.height/i.tangents[1],a=n>=qa*ft?4:n>=ft?2:1,o=n>=ft?4:1,s=Math.max(i.width,i.height),l=Math.ceil(Math.min(Math.max(4*n,4),.15*s+4)),c=(d,p,v,b)=>o*b(((d*.5+.5)*p+v)/o),u=c(e.lower[0],i.width,-l,Math.floor),h=c(e.lower[1],i.height,-l,Math.floor),f=c(e.upper[0],i.width,l,Math.ceil),m=c(e.upper[1],i.height,l,Math.ceil);return{origin:[u,h],width:Math.max(f-u,1),height:Math.max(m-h,1),coarse:a}}image(e,r,i){let n=this.images[e];if(n&&n.width>=r&&n.height>=i)return n;let{gl:a,color:o,linear:s}=this.device,l=(p,v)=>2**Math.ceil(Math.log2(Math.max(p,v,16))),c=l(r,n?.width??0),u=l(i,n?.height??0);if(n){for(let p of[n.color,n.blurred,n.depth])a.deleteTexture(p);for(let p of[n.target,n.level])a.deleteFramebuffer(p)}let h=Math.log2(Math.max(c,u))+1,f=S(a,{width:c,height:u,levels:h,format:o,min:a.LINEAR_MIPMAP_NEAREST,mag:s}),m=S(a,{width:c,height:u,format:o,min:s,mag:s}),d=S(a,{width:c,height:u,format:a.DEPTH24_STENCIL8});return this.images[e]={width:c,height:u,color:f,blurred:m,depth:d,target:re(a,f,d),level:re(a,m)}}draw(e,r,i,n){let a=i.reflector,o=e.kernel(a.material,n.taps),s=o.count>1,l=this.chooseImage(i.screen,s?o.median:0,r.view),c=this.image(r.mirrors,l.width,l.height);this.drawMirrored(e,r,a,l,c,n),s&&this.makeLevels(l,c),s&&l.coarse>1&&this.drawBlurred(e,r.view,a,o,l,c),r.begin(),this.drawComposed(e,r,i,o,l,c),this.drawEmitters(e,r,i,o)}drawMirrored(e,r,i,n,a,o){let{gl:s,closest:l}=this.device,c=r.view,u=()=>{s.bindFramebuffer(s.FRAMEBUFFER,a.target),s.viewport(0,0,n.width,n.height)};u(),s.enable(s.SCISSOR_TEST),s.scissor(0,0,n.width,n.height),this.renderer.clear([...e.sky.map(p=>p*e.unit),l]),s.disable(s.SCISSOR_TEST);let h=this.mirroredView(e,i,c,n),f=e.opaque.filter(p=>te(h.clipFromPack,p.bounds)),m=i.dark.filter(p=>te(h.clipFromPack,p.bounds)),d={view:h,begin:u,inFrame:!1,mirrors:r.mirrors+1,texture:a.color,values:0,reflectance:r.reflectance*e.reflectanceOf(i.material),share:r.share*h.width*h.height/(c.width*c.height)};if(d.mirrors<o.mirrors){this.renderer.drawDepth(e,h,f);let p=this.drawMasks(e,d,o),v=this.curved.draw(e,d,o);this.renderer.drawReflected(e,h,f,m,new Set([...p.map(b=>b.reflector.material),...v.materials]));for(let b of p)this.draw(e,d,b,o);u(),this.curved.add(e,d,v.later,o)}else this.renderer.drawReflected(e,h,f,m,new Set);e.movers.some&&(e.movers.drawDepth(h),e.movers.drawLight(h,!0)),this.renderer.drawTransparent(e,h)}mirroredView(e,r,i,n){let a=Xt();a[10]=-1;let o=J(i.viewFromPack,r.packFromReflector),s=J(J(o,a),r.reflectorFromPack),l=he(r.reflectorFromPack,i.eye);l[2]=-l[2];let c=0,u=e.bounds;for(let m=0;m<8;++m){let d=ee(s,[m&1?u.upper[0]:u.lower[0],m&2?u.upper[1]:u.lower[1],m&4?u.upper[2]:u.lower[2]]);c=Math.max(c,-1.01*d[2])}let h=ti(i,n.origin,n.width,n.height);h.far=Math.max(i.far,c),h.mirrored=!i.mirrored,h.viewFromPack=s,h.eye=he(r.packFromReflector,l),h.clipFromView=Be(h,h.far);let f=r.reflectorFromPack;return h.clipFromPack=ri(J(h.clipFromView,s),[f[2],f[6],f[10],f[14]-r.flatness-1e-5*r.size]),h}makeLevels(e,r){let{gl:i}=this.device,n=Math.ceil(Math.log2(Math.max(e.width,e.height)))+1,a=(o,s)=>Math.max(1,o+(1<<s)-1>>s);z(i,{}),this.pull.use(),this.pull.set("u_reach",1e30),i.bindFramebuffer(i.FRAMEBUFFER,r.level);for(let o=1;o<n;++o)k(i,"u_source",r.color),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_BASE_LEVEL,o-1),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MAX_LEVEL,o-1),i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,r.color,o),this.pull.set("u_source_size",[a(e.width,o-1),a(e.height,o-1)]),i.viewport(0,0,a(e.width,o),a(e.height,o)),this.renderer.drawScreen();i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,r.blurred,0),k(i,"u_source",r.color),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_BASE_LEVEL,0),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MAX_LEVEL,n-1)}setConvolution(e,r,i,n,a,o,s){let{gl:l}=this.device,c=J(i.viewFromPack,n.packFromReflector),u=N([c[8],c[9],c[10]],[0,0,1]),h=[i.centre[0]/i.tangents[0],i.centre[1]/i.tangents[1]];e.set("u_ndc_from_image",[2/i.width,2/i.height,2*o.origin[0]/i.width-1+h[0],2*o.origin[1]/i.height-1+h[1]]),e.set("u_tangents",i.tangents),e.set("u_ortho",i.ortho?1:0),e.set("u_plane_normal",u),e.set("u_plane_offset",T(u,[c[12],c[13],c[14]])),e.set("u_farthest",1e4*Math.max(xe(r.bounds),1e-12)),e.set("u_constant_footprint",-1),e.set("u_median",a.median),e.set("u_coarse",o.coarse),e.set("u_pixels_per_tangent",.5*i.height/i.tangents[1]),k(l,"u_image",s.color),k(l,"u_taps",a.taps),e.set("u_image_size",[o.width,o.height]),e.set("u_texture_size",[s.width,s.height]),e.set("u_tap_count",a.count),e.set("u_tap_rows",a.rows)}drawBlurred(e,r,i,n,a,o){let{gl:s}=this.device;s.bindFramebuffer(s.FRAMEBUFFER,o.level),s.viewport(0,0,Math.floor(a.width/a.coarse),Math.floor(a.height/a.coarse)),z(s,{}),this.blur.use(),this.setConvolution(this.blur,e,r,i,n,a,o),s.bindVertexArray(this.none),this.renderer.drawScreen()}where(e,r,i){let n={depthTest:!0,cull:!0,mirrored:e.view.mirrored};return e.inFrame&&r.value>0?{...n,stencilFunc:this.device.gl.EQUAL,stencilRef:r.value,stencilRead:ht}:{...n,blend:"add",alpha:i}}setReflector(e,r,i,n){let a=n.packFromReflector;r.bindGeometry(),e.set("u_clip_from_pack",i.view.clipFromPack),e.set("u_eye",i.view.eye),e.set("u_normal",[a[8],a[9],a[10]]),r.setReflectance(e,n.material),e.set("u_modulate",!0)}drawComposed(e,r,i,n,a,o){let{gl:s}=this.device,l=i.reflector,c=!r.inFrame&&e.reflectanceOf(l.material)>ai,u=n.count>1?this.convolve:this.compose;z(s,this.where(r,i,c)),u.use(),u.set("u_origin",a.origin),u.set("u_missing",[0,0,0]),u.set("u_with_distance",c),this.setReflector(u,e,r,l),k(s,"u_blurred",o.blurred),this.setConvolution(u,e,r.view,l,n,a,o),e.draw(l)}drawEmitters(e,r,i,n){let{gl:a}=this.device,o=i.reflector,s=o.emitters;if(!s)return;let l=e.data.reflectors[o.index],c=n.lobes?this.emitters:this.glints;c.use(),k(a,"u_polygons",s.polygons),k(a,"u_visibility",s.visibility),k(a,"u_seen",s.seen),n.lobes&&k(a,"u_lobes",n.lobes),c.set("u_cells",[s.cellsX,s.cellsY]),c.set("u_lower",l.lower.map(h=>h/o.size)),c.set("u_upper",l.upper.map(h=>h/o.size));let u=o.reflectorFromPack.slice();for(let h=0;h<4;++h)for(let f=0;f<3;++f)u[4*h+f]/=o.size;c.set("u_emitters_from_pack",u),n.lobes&&c.set("u_lobe_rows",33),this.setReflector(c,e,r,o),z(a,{...this.where(r,i,!1),blend:"add",alpha:!1}),e.draw(o)}};function Xa(t,e,r){let i=t.corners.map(o=>E(ee(e,o),1/r)),n=i.flatMap((o,s)=>{let l=i[(s+1)%i.length],c=o[2]>=0?[o]:[];return o[2]>=0!=l[2]>=0&&c.push(D(o,E(F(l,o),o[2]/(o[2]-l[2])))),c}),a=[];return n.length>=3&&a.push([n[0],n[1],n[2],n[Math.min(n.length-1,3)]]),n.length===5&&a.push([n[0],n[3],n[4],n[4]]),a}function mt(t,e,r,i,n,a){if(e.emitters.length===0||!(n>0))return;let o=e.nodesX-1,s=e.nodesY-1,l=o*s,c=[],u=new Uint8Array(4*l*e.emitters.length),h=new Uint32Array(4*l);if(e.emitters.forEach((f,m)=>{let d=r[f],p=e.visibility.subarray(m*e.nodesX*e.nodesY),v=Xa(d,i,n).map(b=>{let g=d.twoSided?-(m+1):m+1;return c.push(...b[0],...b[1],...b[2],...b[3],...d.radiance.map(_=>_*a),g),c.length/16-1});for(let b=0;b<s;++b)for(let g=0;g<o;++g){let _=b*e.nodesX+g,x=b*o+g,w=[p[_],p[_+1],p[_+e.nodesX],p[_+e.nodesX+1]];if(u.set(w,4*(m*l+x)),w.some(y=>y>0))for(let y of v)h[4*x+(y>>5)]|=1<<(y&31)}}),c.length!==0)return{cellsX:o,cellsY:s,polygons:S(t,{width:4,height:c.length/16,format:t.RGBA32F},new Float32Array(c)),visibility:S(t,{width:o,height:s*e.emitters.length,format:t.RGBA8},u),seen:S(t,{width:o,height:s,format:t.RGBA32UI},h)}}function li(t,e,r){let i=t.corners,n=i.length,a=[0,0,0],o=0;i.forEach((f,m)=>{a=D(a,G(F(f,i[0]),F(i[(m+1)%n],i[0]))),o=Math.max(o,W(F(i[(m+1)%n],f)))});let s=N(a,[0,0,0]),l=W(s)>0?.001*o:-1,c=i.map((f,m)=>N(G(s,F(i[(m+1)%n],f)),[0,0,0])),u=f=>{let m=ne(e.positions,f);return Math.abs(T(F(m,i[0]),s))<=l&&i.every((d,p)=>T(F(m,d),c[p])>=-l)},h=[];for(let f of e.parts){if(r[f.material].emission.every(d=>d===0))continue;let m=[];for(let d=f.first;d<f.first+f.count;d+=3){let p=[...e.indices.subarray(d,d+3)];p.every(u)&&m.push(...p)}m.length>0&&h.push({part:f,indices:m})}return h}var ja=Float32Array.from({length:256},(t,e)=>e/255<=.04045?e/255/12.92:((e/255+.055)/1.055)**2.4),Ka=t=>t<=.0031308?12.92*t:1.055*t**(1/2.4)-.055,ci=t=>Math.round(255*Math.min(Math.max(t,0),1));function Ya(t,e){let r=t.width*t.height,i=new Float32Array(5*r),n=t.texels;for(let a=0;a<r;++a){let o=n[4*a+3]/255,s=e>0?+(o>=Math.fround(e)):o;for(let l=0;l<3;++l)i[5*a+l]=ja[n[4*a+l]]*s;i[5*a+3]=s,i[5*a+4]=o}return{width:t.width,height:t.height,texels:i}}function ui(t,e){let r=t/e;return Array.from({length:e},(i,n)=>{let a=[];for(let o=Math.floor(n*r);o<t&&o<(n+1)*r;++o)a.push([o,(Math.min((n+1)*r,o+1)-Math.max(n*r,o))/r]);return a})}function Qa(t){let e=Math.max(1,t.width>>1),r=Math.max(1,t.height>>1),i=new Float32Array(5*e*r),n=ui(t.width,e);return ui(t.height,r).forEach((o,s)=>n.forEach((l,c)=>{for(let[u,h]of o)for(let[f,m]of l)for(let d=0;d<5;++d)i[5*(s*e+c)+d]+=m*h*t.texels[5*(u*t.width+f)+d]})),{width:e,height:r,texels:i}}function Za(t,e,r){let i=t.texels.length/5,n=Math.min(Math.round(e*i),i),a=new Float32Array(i);for(let h=0;h<i;++h)a[h]=t.texels[5*h+4];a.sort().reverse();let o=a.filter(h=>h>=Math.fround(r)).length;if(n===0||n===o)return 1;let s=a[n-1],l=a.indexOf(s),c=a.lastIndexOf(s)+1,u=l===0||c-n<=n-l?s:a[l-1];return u>0?(r+1/255)/u:1}function Ja(t,e){let r=new Uint8Array(t.texels.length/5*4),i=t.texels;for(let n=0;n<r.length/4;++n){let a=i[5*n+3];for(let o=0;o<3;++o)r[4*n+o]=ci(a>0?Ka(i[5*n+o]/a):0);r[4*n+3]=ci(e*i[5*n+4])}return r}function hi(t,e){let r=[];for(let n=Ya(t,e);n.width>1||n.height>1;)r.push(n=Qa(n));if(r.length===0)return[];let i=r[r.length-1].texels[3];for(let n=r.length-2;n>=0;--n){let a=r[n+1],o=r[n];for(let s=0,l=0;s<o.height;++s)for(let c=0;c<o.width;++c,++l){if(o.texels[5*l+3]>0)continue;let u=5*(Math.min(s>>1,a.height-1)*a.width+Math.min(c>>1,a.width-1));o.texels.set(a.texels.subarray(u,u+4),5*l)}}return r.map(n=>({width:n.width,height:n.height,texels:Ja(n,e>0?Za(n,i,e):1)}))}var mi=1667,di=25e3,eo=100,to=.01,ro=t=>.2126*t[0]+.7152*t[1]+.0722*t[2],dt=t=>t.map(e=>e/Math.max(ro(t),1e-6));function pt(t){let e=1e3/Math.min(Math.max(t,mi),di),r=t<=4e3?((-.2661239*e-.2343589)*e+.8776956)*e+.17991:((-3.0258469*e+2.1070379)*e+.2226347)*e+.24039,i=t<=2222?((-1.1063814*r-1.3481102)*r+2.18555832)*r-.20219683:t<=4e3?((-.9549476*r-1.37418593)*r+2.09137015)*r-.16748867:((3.081758*r-5.8733867)*r+3.75112997)*r-.37001483,n=r/i,a=(1-r-i)/i;return dt([3.2404542*n-1.5371385-.4985314*a,-.969266*n+1.8760108+.041556*a,.0556434*n-.2040259+1.0572252*a].map(o=>Math.max(o,0)))}function io(t){if(!/^#[0-9a-f]{6}$/i.test(t))return;let e=[1,3,5].map(r=>{let i=parseInt(t.slice(r,r+2),16)/255;return i<=.04045?i/12.92:((i+.055)/1.055)**2.4});return Math.max(...e)>0?dt(e):void 0}function no(t){let e=Math.max(...t);return`#${t.map(r=>{let i=r/e<=.0031308?12.92*r/e:1.055*(r/e)**.4166666666666667-.055;return Math.round(255*Math.min(Math.max(i,0),1)).toString(16).padStart(2,"0")}).join("")}`}var Ie=(t,e)=>t.map((r,i)=>{let n={on:!0,value:r.value};return e?.hours.some(a=>a.group===i)&&(n.value=1,n.hour=e.shown),r.color.some(a=>a!==1)&&(n.color=dt(r.color.map((a,o)=>a*r.ownColor[o]))),n});function ao(t,e){let r=io(t),i=/^([0-9.]+)k$/i.exec(t),n=Number(t);t==="on"||t==="off"?e.on=t==="on":r?(e.color=r,delete e.kelvin):i&&Number(i[1])>=mi&&Number(i[1])<=di?Ne(e,Number(i[1])):t!==""&&n>=0&&n<=eo&&(e.value=n,e.on=!0)}function Ne(t,e){t.kelvin=e,t.color=pt(e)}function pi(t,e,r,i){for(let n of e){let a=n.lastIndexOf("="),o=n.slice(0,a);i&&o==="hour"&&t.every(s=>s.name!==o)&&vt(i,Number(n.slice(a+1)),r),t.forEach((s,l)=>{let c=o==="*"||(r[l].hour===void 0?o===s.name:o==="day");a>0&&c&&n.slice(a+1).split(/\s+/).forEach(u=>ao(u,r[l]))})}}function vt(t,e,r){if(e>=t.hours[0].hour&&e<=t.hours.at(-1).hour)for(let i of r)i.hour!==void 0&&(i.hour=e)}function oo(t,e){let r=t.find(u=>u.hour!==void 0)?.hour;if(!e||r===void 0)return t.map(()=>1);let{hours:i}=e,n=i.filter(u=>u.group<t.length).length,a=Math.max(i.findIndex(u=>u.hour>=r),0),o=Math.max(a-1,0),s=i[o].hour,l=i[a].hour,c=l>s?(r-s)/(l-s):1;return t.map((u,h)=>u.hour===void 0?1:n*((i[a].group===h?c:0)+(o<a&&i[o].group===h?1-c:0)))}function vi(t,e,r){let i=s=>[String(+s.value.toFixed(3)),s.kelvin?`${Math.round(s.kelvin)}K`:s.color?no(s.color):"",s.on?"":"off"].filter(Boolean).join(" "),n=Ie(t,r),a=e.find(s=>s.hour!==void 0)?.hour,o=e.flatMap((s,l)=>i(s)===i(n[l])?[]:[`${t[l].name}=${i(s)}`]);return a===void 0||a===r?.shown?o:[`hour=${a}`,...o]}var gi=(t,e,r,i=oo(e,r))=>e.map((n,a)=>[0,1,2].map(o=>n.on?i[a]*n.value*(n.color?n.color[o]/Math.max(t[a].ownColor[o],to):1):0)),so;function fi(t,e,r,i,n,a){let o=e?t.restOfDetail:t.rest,s=new Uint16Array(i.length),l=so??=Float32Array.from({length:1984},(c,u)=>Z(u<<4));for(let c=0;c<o.length;++c){let u=o[c],h=r[u];for(let f=0;f<3;++f){let m=h[f]*Z(i[3*c+f])*n;for(let d of t.others)d.group!==u&&(m+=(r[d.group][f]-h[f])*t.scale*l[(e?d.detail:d.light)[3*c+f]]);s[3*c+f]=qt(Math.max(m,0)/a)}}return s}function _i(t,e,r){if(!e||e.width!==t.width||e.height!==t.height||r.every(a=>a.every(o=>o===1)))return t;let i=Math.max(1,...r.flat()),n=t.scale*2**Math.ceil(Math.log2(i));return{...t,scale:n,light:fi(e,!1,r,t.light,t.scale,n),detail:t.detail&&fi(e,!0,r,t.detail,t.scale,n)}}function bi(t,e){let r=t.hours.filter(i=>i.group<e.length);return[0,1,2].map(i=>r.reduce((n,a)=>n+e[a.group][i]/r.length*a.sky[i],0))}function ye(t,e,r,i){return[0,1,2].map(n=>Math.max(0,t.reduce((a,o,s)=>a+(e[s][n]-1)*(o[r][3*i+n]??0),1)))}var lo=.001,gt=.2,$e=16;function We(t,e){let r=new Float64Array(e*e),i=Math.sqrt(.25/Math.PI),n=1,a=0;for(let o=0;o<e;++o){o>0&&(i*=Math.sqrt((2*o+1)/(2*o)),[n,a]=[t[0]*n-t[1]*a,t[0]*a+t[1]*n]);let s=0,l=i*(o>0?Math.SQRT2:1);for(let c=o;c<e;++c){if(c>o){let u=Math.sqrt((4*c*c-1)/(c*c-o*o)),h=c===o+1?0:-u*Math.sqrt(((c-1)**2-o*o)/(4*(c-1)**2-1));[s,l]=[l,u*t[2]*l+h*s]}r[c*(c+1)+o]=l*n,o>0&&(r[c*(c+1)-o]=l*a)}}return r}function yi(t,e,r){let i=t.lights.map(n=>n.intensity);return e.forEach((n,a)=>{for(let o of n.brightLights)i[o]=t.lights[o].intensity.map((s,l)=>s*r[a][l])}),{field:t,bright:i,probes:t.valid.length===0?[]:Array.from(t.valid,(n,a)=>ye(e,r,"probes",a))}}function co(t,e,r){let i=Math.sqrt(Math.max(0,1-Math.abs(r[2]))),n=i*Math.atan2(Math.abs(r[1]),Math.abs(r[0]))*(2/Math.PI),a=i-n,[o,s]=r[2]<0?[1-n,1-a]:[a,n],l=t.depthSide,c=g=>g<0||Object.is(g,-0)?-1:1,u=(.5*o*c(r[0])+.5)*l-.5,h=(.5*s*c(r[1])+.5)*l-.5,f=Math.floor(u),m=Math.floor(h),d=u-f,p=h-m,v=l*l,b=[0,0];for(let g=0;g<4;++g){let _=[f+(g&1),m+(g>>1)];for(let y of[0,1])(_[y]<0||_[y]>=l)&&(_[y]=_[y]<0?-1-_[y]:2*l-1-_[y],_[1-y]=l-1-_[1-y]);let x=(g&1?d:1-d)*(g>>1?p:1-p),w=e*v+_[1]*l+_[0];b[0]+=x*t.depth[w]/65535,b[1]+=x*t.depthSquared[w]/65535}return b}function uo(t,e,r){let i=F(r,ne(t.positions,e)),n=W(i);if(!(n>0))return 1;let[a,o]=co(t,e,E(i,1/n)),s=n/t.depthCap-a;if(s<=0)return 1;let l=Math.max(o-a*a,1e-6);return(l/(l+s*s))**3}function ho(t,e){let r=[0,0,0],i=0,n=1;for(let a=0;a<3;++a){let o=t.size[a],s=Math.min(Math.max((e[a]-t.lower[a])/t.cell[a],0),o),l=Math.min(Math.floor(s),o-1);r[a]=s-l,i+=l*n,n*=o}for(;t.cells[9*i]!==0;){i=t.cells[9*i];for(let a=0;a<3;++a){let o=r[a]>=.5;r[a]=2*r[a]-Number(o),o&&(i+=1<<a)}}return{cell:i,inCell:r}}var xi=(t,e,r)=>(t[2*e+(r>>5)]>>>(r&31)&1)>0;function fo(t){if(t.kind===1||t.kind===2)return[{at:t.position,w:1}];let e=[];if(t.kind===3){let a=Math.tan(Math.min(t.angularRadius,1.5)),o=E(t.direction,-1),s=a>0?$e:1,l=N(G(Math.abs(o[0])<.9?[1,0,0]:[0,1,0],o),[1,0,0]),c=G(o,l);for(let u=0;u<s;++u){let h=s>1?a*Math.sqrt((u+.5)/s):0,f=2.3999632*u;e.push({at:N(D(o,D(E(l,h*Math.cos(f)),E(c,h*Math.sin(f)))),o),w:0})}return e}let r=[],i=t.corners,n=0;for(let a=0;a+2<i.length;a+=3)r.push(n+=.5*W(G(F(i[a+1],i[a]),F(i[a+2],i[a]))));for(let a=0;a<$e&&n>0;++a){let o=.5/$e,s=0;for(let d=a,p=.5;d>0;d>>=1,p*=.5)o+=(d&1)*p;let l=(a+.5)/$e*n;for(;s+1<r.length&&r[s]<=l;)++s;let c=s>0?r[s-1]:0,u=Math.sqrt(Math.min(Math.max((l-c)/Math.max(r[s]-c,1e-30),0),1)),[h,f,m]=[i[3*s],i[3*s+1],i[3*s+2]];e.push({at:D(E(h,1-u),D(E(f,u*(1-o)),E(m,u*o))),w:1})}return e}function mo(t,e,r,i,n,a){let o=fo(t),s=n*n,l=1;if(t.kind===0){l=0;for(let h=0,f=t.corners;h+2<f.length;h+=3)l+=.5*W(G(F(f[h+1],f[h]),F(f[h+2],f[h])))}let c=Math.cos(t.outerCone),u=c+Math.max(.001,Math.cos(t.innerCone)-c);for(let{at:h,w:f}of o){let m=F(h,E(i,f)),d=Math.max(T(m,m),1e-12),p=E(m,1/Math.sqrt(d)),v=-T(p,t.direction),b=1;t.kind===0&&(b=t.twoSided?Math.abs(v):Math.max(v,0)),t.kind===2&&(b=Math.min(Math.max((v-c)/(u-c),0),1)**2);let g=f===0?1:l*b/d,_=We(p,n),x=g*r/o.length;for(let w=0;w<3;++w)for(let y=0;y<s;++y)a[w*s+y]+=x*e[w]*_[y]}}function wi(t,e){let{field:r}=t,i=r.bands*r.bands,n=new Float64Array(3*i),{cell:a,inCell:o}=ho(r,e),s=[...r.cells.subarray(9*a+1,9*a+9)],l=[],c=[],u=[];s.forEach((b,g)=>{let _=o.reduce((y,P,O)=>y*(g>>O&1?P:1-P),1),x=r.valid[b]>0,w=x?uo(r,b,e):0;w<gt&&(w*=w*w/(gt*gt)),u.push(_),c.push(x?_:0),l.push(w*_)});let h=b=>b.reduce((g,_)=>g+_,0),f=Math.min(1,h(l)),m=f>lo?l:h(c)>0?c:u,d=h(m),p=r.lights.map(()=>0),v=r.lights.map(()=>!1);return s.forEach((b,g)=>{let _=m[g]/d;if(_>0){for(let x=0;x<3;++x){let w=_*(t.probes[b]?.[x]??1);for(let y=0;y<i;++y)n[x*i+y]+=w*r.harmonics[(x*i+y)*r.valid.length+b]}r.lights.forEach((x,w)=>{v[w]||=xi(r.bright,b,w),xi(r.kept,b,w)&&(p[w]+=_)})}}),r.lights.forEach((b,g)=>{v[g]&&mo(b,t.bright[g],Math.max(0,1-p[g]),e,r.bands,n)}),{sh:n,trust:f}}var pe=.7,po=.02,vo=.05;function go(t,e,r){let i=t.reduce((o,s,l)=>o+s*e[l],0),n=e;if(i<0&&(i=-i,n=e.map(o=>-o)),i>1-1e-7)return t.map((o,s)=>o+(n[s]-o)*r);let a=Math.acos(i);return t.map((o,s)=>(Math.sin((1-r)*a)*o+Math.sin(r*a)*n[s])/Math.sin(a))}function ki(t,e){let r=t.keys,i=r[r.length-1];if(!i)return t.rest;let n=e>i.time?i.time>0?e%i.time:i.time:e,a=r.findIndex(c=>c.time>n);if(a<=0)return(a===0?r[0]:i).pose;let o=r[a-1],s=r[a],l=(n-o.time)/(s.time-o.time);return{position:D(o.pose.position,E(F(s.pose.position,o.pose.position),l)),rotation:go(o.pose.rotation,s.pose.rotation,l)}}function bt(t){let e=Math.hypot(...t.rotation)||1,[r,i,n,a]=t.rotation.map(o=>o/e);return new Float64Array([1-2*(i*i+n*n),2*(r*i+a*n),2*(r*n-a*i),0,2*(r*i-a*n),1-2*(r*r+n*n),2*(i*n+a*r),0,2*(r*n+a*i),2*(i*n-a*r),1-2*(r*r+i*i),0,...t.position,1])}var He=t=>[1,t&1?pe:-pe,t&2?pe:-pe,t&4?pe:-pe];function _o(t){let e=Array.from({length:4},(i,n)=>Array.from({length:4},(a,o)=>t.reduce((s,l,c)=>s+l*He(c)[n]*He(c)[o],0)));for(let i=1;i<4;++i)e[i][i]+=vo*e[0][0];let r=new Float64Array(e.flat());return t.map((i,n)=>De(r,He(n)).map(a=>i*a))}var bo=[[.1252334085114689,.2491470458134028],[.3678314989981802,.2334925365383548],[.5873179542866175,.2031674267230659],[.7699026741943047,.1600783285433462],[.9041172563704749,.1069393259953184],[.9815606342467192,.0471753363865118]],_t;function xo(){if(_t)return _t;let t=[],e=12;for(let[r,i]of bo)for(let n of[r,-r])for(let a=0;a<e;++a){let o=2*Math.PI*a/e,s=Math.sqrt(1-n*n);t.push({way:[s*Math.cos(o),s*Math.sin(o),n],weight:i*2*Math.PI/e})}return _t=t}function yo(t,e,r,i){let n=r*r,a=new Float64Array(t.length);for(let{way:o,weight:s}of xo()){let l=We(o,r),c=[0,1,2].map(h=>i[h]*o[0]+i[4+h]*o[1]+i[8+h]*o[2]),u=We(c,r);for(let h=0;h<e;++h){let f=0;for(let m=0;m<n;++m)f+=t[h*n+m]*u[m];for(let m=0;m<n;++m)a[h*n+m]+=s*f*l[m]}}return a}function Mi(t,e,r,i){let n=e.components+1,a=new Float32Array(e.clusters*n*3*4),{bands:o}=t.field,s=o*o,l=Array.from({length:8},(d,p)=>{let v=He(p),b=[0,1,2].map(g=>.5*(r.lower[g]+r.upper[g])+.5*v[g+1]*(r.upper[g]-r.lower[g]));return wi(t,ee(i,b))}),c=_o(l.map(d=>Math.max(d.trust,po))),u=new Float64Array(12*s);for(let d=0;d<3;++d)for(let p=0;p<4;++p)for(let v=0;v<s;++v)u[(4*d+p)*s+v]=l.reduce((b,g,_)=>b+c[_][p]*g.sh[d*s+v],0);let h=yo(u,12,o,i),f=Math.min(e.bands*e.bands,s),m=e.channels*e.bands*e.bands;for(let d=0;d<e.clusters*n;++d){let p=Math.floor(d/n),v=d%n,b=v===0?1:e.weightScale[p*(n-1)+v-1];for(let g=0;g<3;++g){let _=d*m+(e.channels===3?g*e.bands*e.bands:0);for(let x=0;x<4;++x){let w=0;for(let y=0;y<f;++y)w+=e.basis[_+y]*h[(4*g+x)*s+y];a[4*(3*d+g)+x]=b*w}}}return a}var xt=2048,Fi=127;function wo(t,e){let{mesh:r,transfer:i}=e,n=0,a=(o,s,l,c=t.FLOAT,u=!1)=>{s&&(t.bindBuffer(t.ARRAY_BUFFER,t.createBuffer()),t.bufferData(t.ARRAY_BUFFER,s,t.STATIC_DRAW),t.enableVertexAttribArray(o),t.vertexAttribPointer(o,l,c,u,0,0),n+=s.byteLength)};return a(0,r.positions,3),a(1,r.normals,3),a(2,r.uvs,2),a(4,r.colors,4,t.UNSIGNED_BYTE,!0),a(5,r.normalUvs,2),a(6,r.tangents,4),a(7,i.cluster,1,t.UNSIGNED_BYTE),t.vertexAttrib4f(4,1,1,1,1),t.bindBuffer(t.ELEMENT_ARRAY_BUFFER,t.createBuffer()),t.bufferData(t.ELEMENT_ARRAY_BUFFER,r.indices,t.STATIC_DRAW),n+r.indices.byteLength}var qe=class{constructor(e,r){this.device=e;this.scene=r}movers=[];depth;light;field;shining;get animated(){return this.movers.some(e=>(e?.mover.keys.length??0)>1)}get some(){return this.movers.some(e=>e?.table)}setField(e){this.field=e,this.relight()}relight(){if(this.field){this.shining=yi(this.field,this.scene.data.groups,this.scene.factors);for(let e of this.movers)e&&delete e.placedAt}}add(e,r){let{gl:i}=this.device,n=r.mesh.positions;this.depth??=B.make(i,"depth"),this.light??=B.make(i,"mover_light");let a=de(),o=[];for(let d of r.mesh.parts){if(d.count===0)continue;let p=this.scene.data.materials[d.material];p.alphaMode===2&&(p.alphaMode=0);let v={...d,page:-1,bounds:de()};for(let b=d.first;b<d.first+d.count;++b){let g=3*r.mesh.indices[b];ae(v.bounds,n[g],n[g+1],n[g+2])}ae(a,...v.bounds.lower),ae(a,...v.bounds.upper),o.push(v)}if(o.length===0)return;let s=i.createVertexArray(),l=r.transfer.components,c=Math.ceil(l/4),u=n.length/3;i.bindVertexArray(s),this.scene.bytes+=wo(i,r),i.bindVertexArray(null);let h=Math.max(1,Math.ceil(u*c/xt)),f=new Int16Array(h*xt*4);for(let d=0;d<u;++d)f.set(r.transfer.weight.subarray(d*l,d*l+l),d*c*4);let m=S(i,{width:xt,height:h,format:i.RGBA16I},f);this.movers[e]={mover:r,array:s,ranges:o,bounds:a,weights:m,packFromObject:bt(r.rest)},this.scene.bytes+=f.byteLength}place(e){let{gl:r}=this.device;for(let i of this.movers){if(!i||!this.shining)continue;let n=i.mover.keys.length>1?e:0;if(i.placedAt===n)continue;i.placedAt=n,i.packFromObject=bt(ki(i.mover,n)),i.table&&r.deleteTexture(i.table);let{components:a,clusters:o}=i.mover.transfer,s=Mi(this.shining,i.mover.transfer,i.bounds,i.packFromObject);i.table=S(r,{width:3*(a+1),height:o,format:r.RGBA32F},s.map(l=>l*this.scene.unit))}}bounds(){let e=this.scene.bounds,r={lower:[...e.lower],upper:[...e.upper]};for(let i of this.movers)for(let n=0;i?.table&&n<8;++n){let{lower:a,upper:o}=i.bounds,s=[n&1?o[0]:a[0],n&2?o[1]:a[1],n&4?o[2]:a[2]];ae(r,...ee(i.packFromObject,s))}return r}drawDepth(e){this.each(e,this.depth,r=>{let i=this.scene.data.materials[r.material];z(this.device.gl,{depthTest:!0,depthWrite:!0,color:!1,cull:!i.doubleSided,mirrored:e.mirrored}),this.depth.set("u_alpha",i.alpha),this.depth.set("u_alpha_cutoff",le(i)),this.scene.bindBase(i.texture)})}drawLight(e,r){if(!this.some)return;let i=e.viewFromPack;this.light.use(),this.light.set("u_eye",e.eye),this.light.set("u_alpha_kind",r?e.ortho?2:1:0),this.light.set("u_depth_row",[-i[2],-i[6],-i[10],-i[14]]),this.light.set("u_closest",this.device.closest),this.light.set("u_changed",!1),this.light.set("u_weights",[1,1,1]),this.each(e,this.light,(n,a)=>{let o={depthTest:!0,stencilRef:Fi,stencilWrite:Fi,mirrored:e.mirrored};z(this.device.gl,{...o,cull:!this.scene.data.materials[n.material].doubleSided}),this.scene.setSurface(this.light,n,!!a.mesh.normalUvs)})}each(e,r,i){let{gl:n}=this.device;for(let a of this.movers){if(!a?.table)continue;let o=J(e.clipFromPack,a.packFromObject),s=a.bounds.upper.map((l,c)=>.5*(l-a.bounds.lower[c]));this.scene.bindGeometry(),n.bindVertexArray(a.array),r.use(),r.set("u_clip_from_pack",o),r.set("u_pack_from_object",a.packFromObject),r.set("u_box_center",se(a.bounds)),r.set("u_box_scale",s.map(l=>l>0?1/l:0)),r.set("u_components",a.mover.transfer.components);for(let l of a.ranges)te(o,l.bounds)&&(i(l,a.mover),k(n,"u_codes",a.weights),k(n,"u_table",a.table),this.scene.draw(l))}}};var Xe=64,K=32768,Si=1983;function C(t){return t.floats(3)}function Ti(t,e){let r=new Float32Array(t.length*e);for(let i=0;i<t.length;++i){let n=t[i],a=Math.max(n<<16>>16,-32767)/32767,o=Math.max(n>>16,-32767)/32767,s=1-Math.abs(a)-Math.abs(o);s<0&&([a,o]=[(1-Math.abs(o))*(a<0?-1:1),(1-Math.abs(a))*(o<0?-1:1)]);let l=Math.hypot(a,o,s);r[e*i]=a/l,r[e*i+1]=o/l,r[e*i+2]=s/l}return r}function je(t){let e=[t.f64(),t.f64(),t.f64()],r=t.u32(),i=t.u32(),n=t.u32(),a=t.size(3,"mesh flags");i%3!==0&&t.fail(`found ${i} indices, expected triangles`);let o={origin:e,positions:t.planesF32(r,3),normals:Ti(t.planesU32(r),3),uvs:t.planesF32(r,2),lightmapUvs:t.planesF32(r,2),indices:new Uint32Array,parts:[]};if(a&1&&(o.colors=t.planes(r,4)),a&2){o.normalUvs=t.planesF32(r,2),o.tangents=Ti(t.planesU32(r),4);let s=new Int8Array(t.planes(r,1).buffer);for(let l=0;l<r;++l)o.tangents[4*l+3]=s[l]}o.indices=t.planesU32(i);for(let s=0,l=0;s<i;++s)l=l+o.indices[s]>>>0,l>=r&&t.fail(`found index ${l} of ${r} vertices`),o.indices[s]=l;for(let s=0;s<n;++s){let l={name:t.text(),first:t.u32(),count:t.u32(),material:t.u32(),page:t.i32()};(l.first%3||l.count%3||l.first+l.count>i)&&t.fail(`found part '${l.name}' outside the indices`),o.parts.push(l)}return o}var Ri=t=>({material:t.u32(),texture:t.u32(),mean:t.floats(3)});function Ai(t){let e=t.text(),r=t.floats(3),i=t.f32(),n=t.i32(),a=t.choice(2,"alpha mode"),o=t.choice(1,"flag")>0,s=t.choice(1,"flag")>0;t.choice(0,"reserved byte");let l=t.f32(),c=t.f32();return t.floats(5),{name:e,baseColor:r,alpha:i,texture:n,alphaMode:a,doubleSided:o,unlit:s,cutoff:l,metallic:c,transmission:t.f32(),emission:t.floats(3),kernel:t.i32(),fresnel:t.i32(),normalTexture:t.i32(),normalScale:t.f32()}}function yt(t){t.text();let e=t.size(K,"width"),r=t.size(K,"height"),i=t.choice(2,"wrap"),n=t.choice(2,"wrap"),a=t.choice(1,"filter")>0;return t.choice(0,"reserved byte"),(!e||!r)&&t.fail("found a texture without texels"),{width:e,height:r,wrapS:i,wrapT:n,nearest:a,texels:t.planes(e*r,4)}}function we(t,e,r){let i=t.planesU16(e,3);for(let n of i)((n&31744)===31744||!r&&n>32768)&&t.fail("found light that is negative or no number");return i}function fe(t){let e=t.i32();return(e<-94||e>112)&&t.fail(`found exponent ${e}, expected -94 to 112`),e}function Li(t){let e=t.size(K,"width"),r=t.size(K,"height"),i=t.size(3,"lightmap flags"),n=t.size(16384,"details"),a=t.size(16384,"details"),o={width:e,height:r,detailWidth:n,detailHeight:a,scale:2**fe(t),light:we(t,e*r,!1)};if((!e||!r)&&t.fail("found a page without texels"),i&1&&(o.direction=we(t,e*r,!0)),n>0){o.cells=t.planesU32(e*r);for(let s of o.cells){let l=s>>>28;s!==0&&(l<1||l>5||(s&16383)+(1<<l)>=n||(s>>>14&16383)+(1<<l)>=a)&&t.fail("found a cell outside of the image of details")}o.detail=we(t,n*a,!1)}return i&2&&(o.sharpAt=t.planesU32(e*r),fe(t),we(t,e*r,!1)),fe(t),we(t,e*r,!1),t.planes(e*r,1),o}function Pi(t){let e=t.text(),r=t.u32(),i=new Float64Array(t.floats(16)),n=t.floats(2),a=t.floats(2);t.f32();let o=t.f32();t.u32s(4);let s=t.u32s(t.count(4)),l=t.size(64,"emitters"),c=t.size(K,"nodes"),u=t.size(K,"nodes");return l>0&&(c<2||u<2)&&t.fail("found emitters without nodes"),{name:e,material:r,packFromReflector:i,lower:n,upper:a,flatness:o,indices:s,nodesX:c,nodesY:u,emitters:t.u32s(l),visibility:t.planes(c*u*l,1)}}function zi(t){let e=t.choice(4,"corners"),r=t.choice(1,"flag")>0;return e<3&&t.fail(`found ${e} corners, expected 3 or 4`),{twoSided:r,radiance:t.floats(3),corners:Array.from({length:e},()=>C(t))}}function ko(t,e){let r=t.f32();t.floats(3);let i=t.f32(),n=t.floats(2),a=t.floats(2),o=t.floats(2);t.f32(),t.planesU16(t.count(2));let s=t.planesU16(e*(e+1)/2),l=new Float32Array(e*e),c=0;for(let u=0;u<e;++u)for(let h=(e-1)/2;h<e;++h){let f=Z(s[c++]);f>=0&&f<=1||t.fail("found a weight outside 0 to 1"),l[u*e+h]=l[u*e+e-1-h]=f}return{cosTheta:r,shift:i,width:n,lower:a,upper:o,weights:l}}function Gi(t){t.choice(2,"kernel model"),t.u8(),t.u8(),t.u8(),t.floats(2);let e=t.f32();t.f32();let r=t.size(K,"kernel size"),i=t.planesF32(r*r),n=t.size(K,"slice size"),a=t.count(4);(a>256||a>0&&n%2===0)&&t.fail(`found ${a} slices of ${n}`);let o=Array.from({length:a},()=>ko(t,n)),s=t.count(20);return s!==0&&s!==a&&t.fail(`found ${s} cosine lobes of ${a} slices`),{size:r,halfExtent:e,weights:i,sliceSize:n,slices:o,fits:Array.from({length:s},()=>t.floats(5))}}function Vi(t){t.f32();let e=t.u32(),r=t.u32(),i=t.size(K,"sphere");e<2&&t.fail("found a reflectance of fewer than two angles");let n={table:t.planesF32(e,3),factor:t.planesF32(r,3)};return t.planesF32(i*i,3),n}function Di(t){return{name:t.text(),eye:C(t),forward:C(t),up:C(t),fov:t.f32(),halfHeight:t.f32()}}function Bi(t){let e=t.text(),r=t.f32(),i=t.count(28);return{name:e,fov:r,keys:Array.from({length:i},()=>({time:t.f32(),eye:C(t),forward:C(t)}))}}function Ci(t){let e=t.floats(2),r=t.f32(),i=t.f32(),n=t.size(K,"width"),a=t.size(K,"height");return r>0||t.fail("found a walk grid without cells"),{lower:e,cell:r,eyeHeight:i,width:n,height:a,walkable:t.planes(n*a,1),floor:t.planesF32(n*a)}}function wt(t,e){let r=()=>({position:C(t),rotation:t.floats(4)}),i=r(),n=L(t,t.count(32),()=>({time:t.f32(),pose:r()}));return n.forEach((a,o)=>{o>0&&a.time<n[o-1].time&&t.fail(`found keys of '${e}' whose times fall`)}),{rest:i,keys:n}}function Ui(t){let e=()=>Float32Array.from(t.floats(3*t.count(12))),r=()=>t.u32s(t.count(4)),i={name:t.text(),lamps:L(t,t.count(4),()=>t.text()),value:t.f32(),color:C(t),ownColor:C(t),materials:r(),emitters:r(),brightLights:r(),sky:t.choice(1,"sky flag")>0},n=t.choice(1,"motion flag")>0;for(let o=0;o<2;++o)t.choice(0,"reserved byte");(!(i.value>=0)||[...i.color,...i.ownColor].some(o=>o<0))&&t.fail(`found negative light in group '${i.name}'`);let a={...i,reflectors:e(),surrounds:e(),probes:e()};return n&&wt(t,i.name),a}function Oi(t){t.text(),t.floats(3);let e=t.choice(1,"clock")>0;t.choice(16,"sky type");for(let s=0;s<2;++s)t.choice(0,"reserved byte");let r=t.f32(),i=t.f32(),n=Math.round(Math.abs(r)*60),a=e?"solar time":`UTC${r<0?"-":"+"}${kt(n/60)}`,o=L(t,t.count(40),()=>{let s=t.f32(),l=t.u32();return t.floats(5),{hour:s,group:l,sky:t.floats(3)}});return o.some((s,l)=>l>0&&!(s.hour>o[l-1].hour))&&t.fail("found hours that do not rise"),{clock:a,shown:i,hours:o}}function kt(t){let e=Math.round(t*60),r=i=>String(i).padStart(2,"0");return`${r(Math.floor(e/60))}:${r(e%60)}`}function Ei(t,e){let r=t.planesU16(e,3);for(let i=0;i<r.length;i+=3){r[i]+=r[i+1],r[i+2]+=r[i+1];for(let n=0;n<3;++n)r[i+n]>Si&&t.fail(`found code ${r[i+n]} of light, expected at most ${Si}`)}return r}function Ii(t){let e=t.u32(),r=t.size(K,"width"),i=t.size(K,"height"),n=t.size(16384,"details"),a=t.size(16384,"details"),o=2**fe(t),s=t.size(Xe,"groups"),l=r*i,c=n*a;return{page:e,width:r,height:i,detailWidth:n,detailHeight:a,scale:o,rest:t.planes(l,1),restOfDetail:t.planes(c,1),others:L(t,s,()=>({group:t.u32(),light:Ei(t,l),detail:Ei(t,c)}))}}function Ni(t){let e={name:t.text(),material:t.u32(),map:t.u32(),indices:t.u32s(t.count(4))};return e.indices.length%3&&t.fail(`found ${e.indices.length} indices, expected triangles`),e}function $i(t){let e=C(t),r=t.size(K,"texels"),i=2**fe(t),n=t.f32(),a=r*r;(r===0||(r&r-1)>0)&&t.fail(`found ${r} texels a side, expected a power of two`),n>=0&&n<=1e18||t.fail(`found inverse distance ${n}`);let o=t.planesU32(a),s=t.planesU16(a);return{centre:e,size:r,scale:i,light:o,inverseDistance:Float32Array.from(s,l=>l/65535*n),valid:t.planes(a,1)}}function L(t,e,r){let i=[];for(let n=0;n<e;++n)i.push(r(t));return i}var Mt=4294967295,Wi=5,Mo=16,Fo=64;function So(t){let e=t.choice(1,"sun flag")>0;for(let i=0;i<3;++i)t.choice(0,"reserved byte");let r={sun:e,position:C(t),direction:C(t),intensity:C(t),cosOuter:t.f32(),inverseFalloff:t.f32(),angularRadius:t.f32(),group:t.u32()};return(r.intensity.some(i=>i<0)||!(r.angularRadius>=0&&r.angularRadius<Math.PI/2))&&t.fail("found a lamp of negative light or size"),r}function To(t,e,r,i){let n=new Uint8Array(e.length),a=()=>t.fail("found a record of sharp light that makes no sense");for(let o=0;o<e.length;){let s=1,l=o+1;if(e[o]===Mt)for(let c=l+4;l<c;++l){let u=e[l]<o?n[e[l]]:0;(u===0||u>Wi)&&a(),s=Math.max(s,u+1)}else{e[o]>(o===0?0:Mo)&&a();for(let c=e[o];c>0;--c){let u=e[l],h=l+1+(u>>>10&1);l=h+(u>>>11),((u&1023)>=r||u>>>11>Fo||!(l<=e.length))&&a();for(let f=h;f<l;++f)(e[f]&536870911)>=i&&a()}}n[o]=s,o=l}return n}function Hi(t){let e=t.size(1024,"lamps"),r=t.size(2**25,"words"),i=t.size(2**24,"triangles");(e===0||r===0)&&t.fail("found no lamps");let n={lamps:L(t,e,So),words:t.planesU32(r),triangles:t.planesF32(i,9)};return{...n,records:To(t,n.words,e,i)}}function qi(t,e){if(t.sharpAt?.some(r=>!e?.records[r]))throw new V("light: found a place of sharp light where there is none")}var Ft=(t,e)=>t.intensity.map((r,i)=>r*(e[t.group]?.[i]??1)),St=Array.from({length:64},(t,e)=>{let r=Math.sqrt((e+.5)/64),i=e*Math.PI*(3-Math.sqrt(5));return[r*Math.cos(i),r*Math.sin(i)]}),Eo=1e-7;function Ro(t,e,r,i){let[n,a,o]=r,s=Math.sign(T(G(F(a,n),F(o,n)),n)),l=[[n,a],[a,o],[o,n]].map(([c,u],h)=>{let f=G(c,u),m=Math.max(W(f),1e-20);return{inwards:E(f,s/m),hard:1e-6*(T(c,c)+T(u,u))/m,ends:(i>>>29+h&1)>0}});e.forEach((c,u)=>{let h=l.map(f=>{let m=T(f.inwards,c);return f.ends?Math.min(Math.max(m/Eo+.5,0),1):+(m>=-f.hard)});t[u]=Math.max(t[u],Math.min(...h))})}function Ao(t,e,r,i){let{towards:n,distance:a,spread:o}=e,s=n,l=N(Math.abs(s[0])<.7?[0,s[2],-s[1]]:[-s[2],0,s[0]],[1,0,0]),c=G(s,l),u=o>0?St.map(([f,m])=>D(s,D(E(l,o*f),E(c,o*m)))):[s],h=u.map(()=>0);for(let f of r){let m=9*(f&536870911),d=[0,3,6].map(g=>F(Array.from(t.triangles.subarray(m+g,m+g+3)),i)),p=G(F(d[1],d[0]),F(d[2],d[0])),v=T(p,d[0]),b=T(p,s)*a;v*(b-v)>0&&Ro(h,u,d,f)}return 1-h.reduce((f,m)=>f+m/u.length,0)}function Lo(t,e,r,i){let n=Math.min(Math.max(r,0),1)*e.width,a=Math.min(Math.max(i,0),1)*e.height,o=Math.min(Math.floor(n),e.width-1),s=Math.min(Math.floor(a),e.height-1),l=e.sharpAt[s*e.width+o],c=n-o,u=a-s;for(let h=0;h<Wi&&t.words[l]===Mt;++h){let f=+(c>=.5),m=+(u>=.5);c=2*c-f,u=2*u-m,l=t.words[l+1+f+2*m]}return t.words[l]===Mt?0:l}function Xi(t,e,r,i,n,a){let o=Lo(t,e,...r),s=0,{words:l}=t;for(let c=l[o++];c>0;--c){let u=l[o++],h=t.lamps[u&1023],f=u>>>11,m=u&1024?l[o++]:0,d=h.sun?E(h.direction,-1):F(h.position,i),p=Math.max(W(d),1e-6),v=E(d,1/p),b=T(n,v),g=Math.min(Math.max((-T(h.direction,v)-h.cosOuter)*h.inverseFalloff,0),1),_=Math.max(b,0)*(h.sun?1:(g/p)**2),x=Ft(h,a).reduce((y,P,O)=>y+[.2126,.7152,.0722][O]*P*(u&1024?(m>>>9*O&511)*2**((m>>>27)-24):1),0),w={towards:v,distance:h.sun?1e20:p,spread:h.sun?Math.tan(h.angularRadius):0};_*x>0&&(s+=_*x*Ao(t,w,l.subarray(o,o+f),i)),o+=f}return s}var ce=4096,Ye=t=>Math.max(Math.ceil(t/ce),1),Ke=2*ce,ji=t=>Math.max(Ye(t.words.length+Ke),Ye(t.triangles.length/9*4));function Ki(t,e,r,i){let n=e.triangles.length/3,a=Ye(e.words.length+Ke),o=Ye(n/3*4),s=new Uint32Array(a*ce),l=new Float32Array(4*o*ce);s.set(e.words,Ke);for(let c=0;c<Ke/2;++c){let u=(Math.floor(c/64)+.5)/16,h=u<2?1-u:u-3,f=(u<2?1:-1)*(1-Math.abs(h)),m=Math.hypot(h,f);St.forEach(([d,p],v)=>{(d*h+p*f)/m+(c%64+.5)/32-1>=0&&(s[2*c+(v>>5)]|=1<<(v&31))})}for(let c=0;c<n;++c)l.set(e.triangles.subarray(3*c,3*c+3),4*(c+Math.floor(c/3)));return{suns:e.lamps.some(c=>c.sun),words:S(t,{width:ce,height:a,format:t.R32UI},s),triangles:S(t,{width:ce,height:o,format:t.RGBA32F},l),lamps:Tt(t,e,r,i)}}function Tt(t,e,r,i){let n=Float32Array.from(e.lamps.flatMap(a=>{let o=E(Ft(a,r),i),s=[...E(a.direction,-1),1,0,0,0,0,...o,Math.tan(a.angularRadius)];return a.sun?s:[...a.position,0,...a.direction,a.cosOuter,...o,a.inverseFalloff]}));return S(t,{width:3,height:e.lamps.length,format:t.RGBA32F},n)}function Po(t){let e=new Float32Array(4*t.light.length);return t.light.forEach((r,i)=>{if(t.valid[i]===0)return;let n=t.scale*2**((r>>>27)-24);e.set([(r&511)*n,(r>>>9&511)*n,(r>>>18&511)*n,1],4*i)}),{size:t.size,texels:e}}function zo(t){let e=t.size/2,r={size:e,texels:new Float32Array(4*e*e)};for(let i=0;i<e;++i)for(let n=0;n<e;++n){let a=[0,0,0,0];for(let o=0;o<4;++o){let s=4*((2*i+(o>>1))*t.size+2*n+(o&1)),l=t.texels[s+3];for(let c=0;c<3;++c)a[c]+=l*t.texels[s+c];a[3]+=l}a[3]>0&&r.texels.set([a[0]/a[3],a[1]/a[3],a[2]/a[3],.25*a[3]],4*(i*e+n))}return r}function Go(t){for(let e=t.length-2;e>=0;--e){let r=t[e],i=t[e+1];for(let n=0;n<r.size*r.size;++n){if(r.texels[4*n+3]>0)continue;let a=4*((n/r.size>>1)*i.size+(n%r.size>>1));r.texels.set(i.texels.subarray(a,a+4),4*n)}}}function Yi(t,e){for(let r=-1;r<=t;++r)for(let i=-1;i<=t;++i){let n=[i,r];for(let a of[0,1])(n[a]<0||n[a]>=t)&&(n[a]=n[a]<0?-1-n[a]:2*t-1-n[a],n[1-a]=t-1-n[1-a]);e(i+1,r+1,n[1]*t+n[0])}}function Vo(t,e,r){let i=u=>u>0?Math.min(u,65408):0,n=[i(t),i(e),i(r)],a=Math.max(...n);if(a<=0)return 0;let o=Math.max(-16,Math.floor(Math.log2(a)))+16;Math.floor(a*2**(24-o)+.5)>=512&&++o;let[s,l,c]=n.map(u=>Math.floor(u*2**(24-o)+.5));return(s|l<<9|c<<18|o<<27)>>>0}var Qi=(t,e)=>e===0?[0,0]:[t+2,t-(t>>e-1)+2*(e-1)];function Zi(t,e){let r=[Po(e)],i=e.size;for(;r[r.length-1].size>1;)r.push(zo(r[r.length-1]));Go(r);let n=0,a=0,o=1/0;for(let d=0;d<i*i;++d){for(let p=0;p<3;++p)n=Math.max(n,r[0].texels[4*d+p]);a=Math.max(a,e.inverseDistance[d]),o=Math.min(o,e.inverseDistance[d])}let s=n>0?2**Math.min(Math.max(Math.floor(Math.log2(n))-14,-120),120):1,l=r.length-1,c=Math.max(i+2,l>0?i+i/2+4:0),u=Math.max(i+2,l>0?Qi(i,l)[1]+3:3),h=new Uint32Array(c*u),f=new Float32Array((i+2)**2);r.forEach((d,p)=>{let[v,b]=Qi(i,p),g=d.texels;Yi(d.size,(_,x,w)=>{h[(b+x)*c+v+_]=Vo(g[4*w]/s,g[4*w+1]/s,g[4*w+2]/s)})}),Yi(i,(d,p,v)=>{f[p*(i+2)+d]=e.inverseDistance[v]});let m=t.getExtension("OES_texture_float_linear")?t.LINEAR:t.NEAREST;return{centre:e.centre,size:i,scale:s,range:[a,o],tint:[1,1,1],light:S(t,{width:c,height:u,format:t.RGB9_E5,min:t.LINEAR,mag:t.LINEAR},h),inverseDistance:S(t,{width:i+2,height:i+2,format:t.R32F,min:m,mag:m},f)}}function Ji(t,e){let r=0;for(let n=0;n<t.length;++n)r+=t[n];let i=e*r;for(let n=0;n<t.length;++n){if(i<t[n])return n+i/t[n];i-=t[n]}return t.length}function Do(t){let e=0;for(let r=.5;t!==0;t>>>=1,r*=.5)e+=(t&1)*r;return e}function en(t,e,r,i){let n=new Float64Array(e);for(let c=0;c<e;++c)for(let u=0;u<e;++u)n[c]+=t[c*e+u];let a=[],o=i(1,1),s=i(0,0),l=(o[0]-s[0])*(o[1]-s[1]);for(let c=0;c<r;++c){let u=Ji(n,(c+.5)/r),h=Math.min(Math.floor(u),e-1),f=Ji(t.subarray(h*e,h*e+e),Do(c)+.5/r),m=Math.min(Math.floor(f),e-1),d=i(m/e,h/e),p=i((m+1)/e,(h+1)/e),v=i(f/e,u/e),b=Math.max(t[h*e+m],1e-12)*r;a.push({x:v[0],y:v[1],width:Math.sqrt(Math.min((p[0]-d[0])*(p[1]-d[1])/b,l)),weight:1})}return a}var Bo=t=>(e,r)=>[t.width[0]*Math.sinh(t.lower[0]+e*(t.upper[0]-t.lower[0])),t.shift+t.width[1]*Math.sinh(t.lower[1]+r*(t.upper[1]-t.lower[1]))];function Co(t,e){return(r,i)=>{let n=(2*r-1)*t.halfExtent*e,a=(2*i-1)*t.halfExtent,o=2/(1+Math.sqrt(1+n*n+a*a));return[n*o,a*o]}}function tn(t,e){if(t.length===1)return[0,0,0];let r=o=>Math.sqrt(t[o].cosTheta),i=Math.sqrt(e),n=1;for(;n+1<t.length&&r(n)<i;)++n;let a=r(n-1);return[n-1,n,Math.min(Math.max((i-a)/(r(n)-a),0),1)]}function rn(t,e){let r=t?.factor;if(!r||r.length===0)return 1;let i=r.length/3-1,n=Math.sqrt(Math.min(Math.max(e,0),1))*i,a=Math.min(Math.floor(n),i),o=s=>.2126*r[3*s]+.7152*r[3*s+1]+.0722*r[3*s+2];return o(a)+(o(Math.min(a+1,i))-o(a))*(n-a)}function Uo(t,e,r){let i=e*e,n=Math.sqrt(Math.max(0,1-i*i)),a=0,o=0;for(let l of t){let c=.25*(l.x*l.x+l.y*l.y),u=[l.x/(1+c),l.y/(1+c),(1-c)/(1+c)],h=[0,2*i*n,2*i*i-1];l.weight=rn(r,Math.sqrt(Math.max(0,.5*(1+h[1]*u[1]+h[2]*u[2])))),n*u[1]+i*u[2]>0&&(a+=l.weight,++o)}let s=o>0?a/o:1;for(let l of t)l.weight=s>0?l.weight/s:1;return s}function nn(t,e,r){if(!t||t.size<=1||!(t.halfExtent>0))return{count:1,rows:1,median:0,texels:new Float32Array([0,0,0,1]),means:[1]};let i=t.slices.map(l=>en(l.weights,t.sliceSize,e,Bo(l))),n=i.length===0?9:Math.max(i.length,2),a=new Float32Array(4*e*n),o=[],s=0;for(let l=0;l<n;++l){let c=l/(n-1),u;if(i.length===0)u=en(t.weights,t.size,e,Co(t,Math.max(c*c,.001)));else{let[h,f,m]=tn(t.slices,c*c);u=i[h].map((d,p)=>{let v=i[f][p],b=(g,_)=>g+(_-g)*m;return{x:b(d.x,v.x),y:b(d.y,v.y),width:b(d.width,v.width),weight:1}})}o.push(Uo(u,c,r)),u.forEach((h,f)=>a.set([h.x,h.y,h.width,h.weight],4*(l*e+f))),l===n-1&&(s=u.map(h=>Math.hypot(h.x,h.y)).sort((h,f)=>h-f)[e>>1])}return{count:e,rows:n,median:s,texels:a,means:o}}var ve=33;function an(t,e,r){let i=new Float32Array(8*ve),n=a=>{let[o,s,l,c]=t.fits[a],u=t.slices[a].cosTheta,h=Math.sqrt(Math.max(0,1-u*u));return[o*u+s*h,s*u-o*h,l,c*u+h].map(f=>f/(u-c*h))};for(let a=0;a<ve;++a){let o=a/(ve-1),[s,l,c]=tn(t.slices,o*o),u=n(s),h=n(l),f=u.map((v,b)=>v+(h[b]-v)*c);f[2]=u[2]*h[2]/(h[2]+(u[2]-h[2])*c),i.set(f,4*a);let m=o*(r.length-1),d=Math.min(Math.floor(m),Math.max(r.length-2,0)),p=Math.min(d+1,r.length-1);i.set([rn(e,o*o),r[d]+(r[p]-r[d])*(m-d)],4*(ve+a))}return i}function Et(t){let e=t.getExtension("EXT_color_buffer_float")&&t.getExtension("EXT_float_blend")&&t.getExtension("OES_texture_float_linear");if(!e&&!t.getExtension("EXT_color_buffer_float")&&!t.getExtension("EXT_color_buffer_half_float"))throw new Error("This device cannot draw light of more than eight bits.");return{gl:t,color:e?t.RGBA32F:t.RGBA16F,linear:t.LINEAR,closest:e?1e-15:1e-7}}var Qe=class{constructor(e,r){this.device=e;this.data=r;let i=e.gl,n=r.mesh,a=Math.max(1,...r.materials.flatMap(c=>c.emission),...r.sky);this.emission=r.materials.map(c=>c.unlit&&!c.emission.some(u=>u>0)?[1,1,1]:c.emission),this.sky=r.sky,this.unlitWhite=Math.max(...this.emission.filter((c,u)=>r.materials[u].unlit).flat(),0)||1,this.factors=r.groups.map(()=>[1,1,1]),this.unit=e.color===i.RGBA32F?1:Math.min(1,8192/a);let o=this.sortRanges();r.reflectors.forEach((c,u)=>this.addReflector(u,o)),this.movers=new qe(e,this),this.curved=r.curved.map(c=>({...this.rangeOf(o,c.indices,c.material,-1),map:c.map})),this.array=i.createVertexArray(),i.bindVertexArray(this.array);let s=(c,u,h,f=i.FLOAT)=>{u&&(i.bindBuffer(i.ARRAY_BUFFER,i.createBuffer()),i.bufferData(i.ARRAY_BUFFER,u,i.STATIC_DRAW),i.enableVertexAttribArray(c),i.vertexAttribPointer(c,h,f,f===i.UNSIGNED_BYTE,0,0),this.bytes+=u.byteLength)};s(0,n.positions,3),s(1,n.normals,3),s(2,n.uvs,2),s(3,n.lightmapUvs,2),s(4,n.colors,4,i.UNSIGNED_BYTE),s(5,n.normalUvs,2),s(6,n.tangents,4),i.vertexAttrib4f(4,1,1,1,1),i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,i.createBuffer()),i.bufferData(i.ELEMENT_ARRAY_BUFFER,new Uint32Array(o),i.STATIC_DRAW),i.bindVertexArray(null),this.bytes+=4*o.length;let l=(c,u)=>S(i,{width:1,height:1,format:c},u);this.white=l(i.SRGB8_ALPHA8,new Uint8Array([255,255,255,255])),this.flat=l(i.RGBA8,new Uint8Array([128,128,255,255])),this.zero=l(i.R32UI,new Uint32Array([0])),this.reflectance=this.uploadReflectance(),r.pages.forEach((c,u)=>this.setPage(u,c)),k(i,"u_surfaces",this.zero),k(i,"u_cells",this.zero),k(i,"u_seen",this.zero)}bounds=de();opaque=[];transparent=[];reflectors=[];curved;surrounds=[];movers;unit;bytes=0;array;textures=[];normals=[];pages=[];shown=[];pageGroups=[];sharp;factors;emission;unlitWhite;sky;white;flat;zero;reflectance;kernels=new Map;isTransparent(e){let r=this.data.materials[e];return r.alphaMode===2||r.transmission>0}rangeOf(e,r,i,n){let a={first:e.length,count:r.length,material:i,page:n,bounds:de()},o=this.data.mesh.positions;for(let s=0;s<r.length;++s){let l=r[s];e.push(l),ae(a.bounds,o[3*l],o[3*l+1],o[3*l+2])}return a}facesInward(e,r){let i=this.data.mesh.positions,n=se(r.bounds),a=s=>F(ne(i,e[s]),n),o=0;for(let s=r.first;s<r.first+r.count;s+=3)o+=T(a(s),G(a(s+1),a(s+2)));return o<0}sortRanges(){let e=this.data.mesh,r=[],i=e.parts.filter(a=>a.count>0).sort((a,o)=>a.material-o.material||a.page-o.page);for(let a of i){let o=this.rangeOf(r,e.indices.subarray(a.first,a.first+a.count),a.material,a.page),s=this.isTransparent(a.material);s&&this.transparent.push({...o,from:a.first}),(!s||Ze(this.data.materials[a.material]))&&this.opaque.push(o),ae(this.bounds,...o.bounds.lower),ae(this.bounds,...o.bounds.upper)}let n=new Map(this.transparent.map(a=>[a,this.facesInward(r,a)]));return this.transparent.sort((a,o)=>Number(n.get(o))-Number(n.get(a))),r}addReflector(e,r){let{gl:i}=this.device,n=this.data.reflectors[e],a=n.packFromReflector,o=jt(a),s=Math.hypot(n.upper[0]-n.lower[0],n.upper[1]-n.lower[1]),l=[n.lower[0],n.upper[0],n.upper[0],n.lower[0]],c=[n.lower[1],n.lower[1],n.upper[1],n.upper[1]],u=this.rangeOf(r,n.indices,n.material,-1),h=[];for(let f of n.emitters)for(let m of li(this.data.emitters[f],this.data.mesh,this.data.materials))this.isTransparent(m.part.material)||h.push(this.rangeOf(r,m.indices,m.part.material,m.part.page));this.reflectors.push({index:e,material:n.material,first:u.first,count:u.count,packFromReflector:a,reflectorFromPack:o,corners:l.map((f,m)=>ee(a,[f,c[m],0])),size:s,flatness:n.flatness,dark:h,emitters:mt(i,n,this.data.emitters,o,s,this.unit),asked:!1,visible:!0})}uploadReflectance(){let e=this.data.fresnels,r=Math.max(1,...e.map(a=>a.table.length/3)),i=Math.max(e.length,1),n=new Float32Array(4*r*i);return e.forEach((a,o)=>{for(let s=0;s<a.table.length/3;++s)n.set(a.table.subarray(3*s,3*s+3),4*(o*r+s))}),S(this.device.gl,{width:r,height:i,format:this.device.gl.RGBA32F},n)}setPage(e,r){this.data.pages[e]=r,this.uploadPage(e)}setPageGroups(e){this.pageGroups[e.page]=e,this.uploadPage(e.page)}setSharp(e){let{gl:r}=this.device;this.sharp={light:e,...Ki(r,e,this.factors,this.unit)},k(r,"u_sharp_words",this.sharp.words),k(r,"u_sharp_triangles",this.sharp.triangles),k(r,"u_sharp_lamps",this.sharp.lamps),this.bytes+=4*e.words.length+16/3*e.triangles.length}get hasSharp(){return!!this.sharp}get hasSuns(){return!!this.sharp?.suns}isSharp(e){return!!this.pages[e.page]?.sharpAt}setLights(e){let{groups:r,emitters:i}=this.data,n=i.slice(),a=(o,s)=>o.map((l,c)=>l*s[c]);this.factors=e,r.forEach((o,s)=>{for(let l of o.materials)this.emission[l]=a(this.data.materials[l].emission,e[s]);for(let l of o.emitters)n[l]={...i[l],radiance:a(i[l].radiance,e[s])};o.sky&&(this.sky=a(this.data.sky,e[s]))}),this.data.day&&(this.sky=bi(this.data.day,e));for(let o of this.reflectors){let s=o.emitters;if(s){for(let l of[s.polygons,s.visibility,s.seen])this.device.gl.deleteTexture(l);o.emitters=mt(this.device.gl,this.data.reflectors[o.index],n,o.reflectorFromPack,o.size,this.unit)}}this.sharp&&(this.device.gl.deleteTexture(this.sharp.lamps),k(this.device.gl,"u_sharp_lamps",this.sharp.lamps=Tt(this.device.gl,this.sharp.light,e,this.unit))),this.data.pages.forEach((o,s)=>this.uploadPage(s)),this.surrounds.forEach((o,s)=>{o.tint=ye(r,e,"surrounds",s)}),this.movers.relight()}uploadPage(e){let r=_i(this.data.pages[e],this.pageGroups[e],this.factors);if(r===this.shown[e])return;this.shown[e]=r;let{gl:i}=this.device,n=this.pages[e];for(let l of[n?.light,n?.direction,n?.cells,n?.detail,n?.sharpAt])l&&i.deleteTexture(l);this.bytes-=n?.bytes??0;let a=this.bytes,o=(l,c,u)=>(this.bytes+=l.byteLength,S(i,{width:c,height:u,format:i.RGB16F,min:i.LINEAR,mag:i.LINEAR},l)),s={light:o(r.light,r.width,r.height),scale:r.scale,bytes:0};r.direction&&(s.direction=o(r.direction,r.width,r.height)),r.detail&&r.cells&&(s.cells=S(i,{width:r.width,height:r.height,format:i.R32UI},r.cells),s.detail=o(r.detail,r.detailWidth,r.detailHeight),this.bytes+=r.cells.byteLength),r.sharpAt&&(s.sharpAt=S(i,{width:r.width,height:r.height,format:i.R32UI},r.sharpAt),this.bytes+=r.sharpAt.byteLength),s.bytes=this.bytes-a,this.pages[e]=s}setTexture(e,r,i){let{gl:n}=this.device,a=[n.REPEAT,n.CLAMP_TO_EDGE,n.MIRRORED_REPEAT],o=Math.floor(Math.log2(Math.max(r.width,r.height)))+1,s=S(n,{width:r.width,height:r.height,levels:o,format:i?n.RGBA8:n.SRGB8_ALPHA8,min:n.LINEAR_MIPMAP_LINEAR,mag:r.nearest?n.NEAREST:n.LINEAR,wrapS:a[r.wrapS],wrapT:a[r.wrapT]},r.texels),l=i?void 0:this.cutoffIn(e),c=r.texels,u=!1;for(let h=3;h<c.length&&l!==void 0&&!u;h+=4)u=c[h]<255;u?hi(r,l).forEach((h,f)=>{n.texSubImage2D(n.TEXTURE_2D,f+1,0,0,h.width,h.height,n.RGBA,n.UNSIGNED_BYTE,h.texels)}):n.generateMipmap(n.TEXTURE_2D),(i?this.normals:this.textures)[e]=s,this.bytes+=r.texels.byteLength*4/3}cutoffIn(e){let r;for(let i of this.data.materials)if(i.texture===e){if(i.alphaMode===0)return;if(i.alphaMode===2)r??=0;else if(!r){if(!(i.cutoff>0))return;r=i.alpha>0?i.cutoff/i.alpha:2}}return r}setSurround(e,r){this.surrounds[e]=Zi(this.device.gl,r),this.surrounds[e].tint=ye(this.data.groups,this.factors,"surrounds",e),this.bytes+=10*r.light.length}setNormals(e,r,i=!!this.data.mesh.normalUvs){let n=this.data.materials[r],a=n.normalTexture>=0&&i?this.normals[n.normalTexture]:void 0;e.set("u_normal_mapped",!!a),e.set("u_normal_scale",n.normalScale),k(this.device.gl,"u_normal_texture",a??this.flat)}kernel(e,r){let i=this.data.materials[e],n=`${i.kernel} ${i.fresnel} ${r}`,a=this.kernels.get(n);if(a)return a;let{gl:o}=this.device,s=this.data.kernels[i.kernel],l=this.data.fresnels[i.fresnel],c=nn(s,r,l),u={taps:S(o,{width:c.count,height:c.rows,format:o.RGBA32F},c.texels),count:c.count,rows:c.rows,median:c.median};return s&&s.fits.length>0&&(u.lobes=S(o,{width:ve,height:2,format:o.RGBA32F},an(s,l,c.means))),this.kernels.set(n,u),u}reflectanceOf(e){let r=this.data.fresnels[this.data.materials[e].fresnel]?.table;if(!r)return 0;let i=3*(r.length/6|0);return Math.max(r[i],r[i+1],r[i+2])}bindGeometry(){this.device.gl.bindVertexArray(this.array),k(this.device.gl,"u_reflectance",this.reflectance)}orderFarToNear(e,r){if(e.ordered===r.join())return;let{gl:i}=this.device,{positions:n,indices:a}=this.data.mesh,o=new Uint32Array(e.count),s=c=>[0,1,2].reduce((u,h)=>u+T(r,ne(n,a[c+h])),0);Array.from({length:e.count/3},(c,u)=>({i:e.from+3*u,depth:s(e.from+3*u)})).sort((c,u)=>c.depth-u.depth).forEach(({i:c},u)=>o.set(a.subarray(c,c+3),3*u)),i.bufferSubData(i.ELEMENT_ARRAY_BUFFER,4*e.first,o),e.ordered=r.join()}draw(e){let{gl:r}=this.device;r.drawElements(r.TRIANGLES,e.count,r.UNSIGNED_INT,4*e.first)}bindBase(e){k(this.device.gl,"u_base_texture",this.textures[e]??this.white)}picture(e){return this.data.emissionTextures.find(r=>r.material===e)}setReflectance(e,r){let i=this.data.materials[r].fresnel;e.set("u_reflectance_row",i),e.set("u_reflectance_count",i<0?1:this.data.fresnels[i].table.length/3)}setSurface(e,r,i=!!this.data.mesh.normalUvs){let{gl:n}=this.device,a=this.data.materials[r.material],o=this.pages[r.page];e.set("u_base_color",[...a.baseColor.map(c=>Math.min(Math.max(c,0),1)),a.alpha]),e.set("u_alpha_cutoff",le(a)),e.set("u_covers",a.alphaMode===2),e.set("u_diffuse_share",(1-a.metallic)*(1-a.transmission)),e.set("u_transmission",a.transmission);let s=this.picture(r.material),l=s&&this.textures[s.texture];e.set("u_emission",this.emission[r.material].map((c,u)=>c*this.unit*(l?Oo(s.mean[u]):1))),k(n,"u_emission_texture",l??this.white),e.set("u_unlit",a.unlit),this.setReflectance(e,r.material),this.bindBase(a.texture),this.setNormals(e,r.material,i),k(n,"u_lightmap",o?.light??this.white),e.set("u_lightmap_scale",o?o.scale*this.unit:0),e.set("u_directional",!!o?.direction),k(n,"u_direction",o?.direction??o?.light??this.white),e.set("u_detailed",!!o?.detail),k(n,"u_cells",o?.cells??this.zero),k(n,"u_detail",o?.detail??this.white),k(n,"u_sharp_at",o?.sharpAt??this.zero)}luxAt(e,r,i,n,a){let o=this.shown[e];if(!o)return 0;let s=Math.min(Math.floor(r*o.width),o.width-1),l=Math.min(Math.floor(i*o.height),o.height-1),c=3*(l*o.width+s);return(o.sharpAt&&this.sharp?Xi(this.sharp.light,o,[r,i],n,a,this.factors):0)+o.scale*(.2126*Z(o.light[c])+.7152*Z(o.light[c+1])+.0722*Z(o.light[c+2]))}},Oo=t=>t>0?1/t:0,on=254.5/255,Ze=t=>t.alphaMode===2&&t.alpha>=on&&t.transmission<=0,le=t=>Ze(t)?on:t.alphaMode===1?Math.max(t.cutoff,0):-1;var Io=127,sn=128,ln={orders:2,mirrors:16,taps:48,largeOnly:!1},cn={orders:0,mirrors:0,taps:12,largeOnly:!0},un={orders:1,mirrors:1,taps:12,largeOnly:!0},No=[[-.125,-.375],[.375,-.125],[-.375,.125],[.125,.375]],Rt=16,ke=class{constructor(e){this.device=e;let r=e.gl,i=(n,a="")=>B.make(r,n,a);this.depth=i("depth"),this.plainDepth=i("depth","PLAIN"),this.opaque=i("scene"),this.plain=i("scene","PLAIN"),this.reflected=i("scene","REFLECTED"),this.transparent=i("transparent"),this.luminance=i("screen_luminance"),this.average=i("screen_average"),this.sharp=["SHARP","SHARP SUNS"].map(n=>new Map([[this.opaque,i("scene",n)],[this.plain,i("scene",`PLAIN ${n}`)],[this.reflected,i("scene",`REFLECTED ${n}`)],[this.transparent,i("transparent",n)]])),this.none=r.createVertexArray(),this.reflections=new Oe(e,this,this.none)}frame;sums;mean;blocks;depth;plainDepth;opaque;plain;reflected;transparent;sharp;luminance;average;reflections;none;start(){for(let e of[this.plainDepth,this.plain,this.luminance,this.average])e.start()}startRest(){for(let e of[...this.reflections.programs,this.reflected,this.opaque,this.depth,this.transparent])e.start()}drawScreen(){let{gl:e}=this.device;e.bindVertexArray(this.none),e.drawArrays(e.TRIANGLES,0,3)}ensure(e,r){if(this.frame?.width===e&&this.frame.height===r)return this.frame;let{gl:i,color:n}=this.device;for(let l of[this.frame?.light,this.frame?.depth,...[...this.sums??[],this.mean].map(c=>c?.texture)])l&&i.deleteTexture(l);for(let l of[this.frame?.target,...[...this.sums??[],this.mean].map(c=>c?.target)])l&&i.deleteFramebuffer(l);let a=S(i,{width:e,height:r,format:n}),o=S(i,{width:e,height:r,format:i.DEPTH24_STENCIL8}),s=l=>{let c=S(i,{width:e,height:r,format:l});return{texture:c,target:re(i,c)}};return this.sums=[s(i.RGBA16F),s(i.RGBA16F)],this.mean=s(n),this.frame={width:e,height:r,light:a,depth:o,target:re(i,a,o)},this.frame}draw(e,r,i,n,a,o){let{gl:s}=this.device,l=this.ensure(i,n),c=ei(r,i,n,e.movers.bounds(),a===void 0?[0,0]:No[a%4]),u=()=>{s.bindFramebuffer(s.FRAMEBUFFER,l.target),s.viewport(0,0,i,n)};u(),this.clear([...e.sky.map(p=>p*e.unit),1]);let h=e.opaque.filter(p=>te(c.clipFromPack,p.bounds));this.drawDepth(e,c,h),e.movers.drawDepth(c);let f={view:c,begin:u,inFrame:!0,mirrors:0,reflectance:1,share:1,texture:l.light,values:0},m=this.reflections.drawMasks(e,f,o);for(let p of m)p.value>0&&this.reflections.draw(e,f,p,o);let d=this.reflections.curved.draw(e,f,o);u(),this.drawOpaque(e,c,h,new Set([...m.filter(p=>p.value>0).map(p=>p.reflector.material),...d.materials])),e.movers.drawLight(c,!1),this.drawTransparent(e,c);for(let p of m)p.value===0&&this.reflections.draw(e,f,p,o);u(),this.reflections.curved.add(e,f,d.later,o)}clear(e){let{gl:r}=this.device;z(r,{depthWrite:!0,stencilWrite:255}),r.clearColor(e[0],e[1],e[2],e[3]),r.clear(r.COLOR_BUFFER_BIT|r.DEPTH_BUFFER_BIT|r.STENCIL_BUFFER_BIT)}drawDepth(e,r,i){e.bindGeometry();for(let n of i){let a=e.data.materials[n.material],o=le(a)<0?this.plainDepth:this.depth;z(this.device.gl,{depthTest:!0,depthWrite:!0,color:!1,cull:!a.doubleSided,mirrored:r.mirrored}),o.use(),o.set("u_clip_from_pack",r.clipFromPack),o.set("u_alpha",a.alpha),o.set("u_alpha_cutoff",le(a)),e.bindBase(a.texture),e.draw(n)}}programFor(e,r,i){return r.isSharp(e)?this.sharp[Number(r.hasSuns)].get(i):i}setFrame(e,r,i,n){let a=r.hasSharp?this.sharp[Number(r.hasSuns)].get(e):void 0;a&&this.setFrame(a,r,i,n),e.use(),e.set("u_clip_from_pack",i.clipFromPack),e.set("u_eye",i.eye),e.set("u_change_scale",[0,0]),e.set("u_alpha_kind",n?i.ortho?2:1:0);let o=i.viewFromPack;e.set("u_depth_row",[-o[2],-o[6],-o[10],-o[14]]),e.set("u_closest",this.device.closest),r.bindGeometry()}drawRanges(e,r,i,n,a,o,s){let{gl:l}=this.device;for(let c of[n,this.opaque])this.setFrame(c,e,r,s);for(let c of i){let u=e.data.materials[c.material],h=Ze(u),f=a.has(c.material)||h&&!s,m=h?sn:Io,d=this.programFor(c,e,u.normalTexture<0&&le(u)<0&&!u.unlit&&!e.picture(c.material)?n:this.opaque);d.use(),e.setSurface(d,c),d.set("u_weights",[1,1,1]),z(l,{...o,cull:!u.doubleSided,stencilRead:m,stencilFunc:f?l.EQUAL:void 0}),e.draw(c),f&&(d.set("u_weights",[1,0,1]),z(l,{...o,cull:!u.doubleSided,stencilRead:m,stencilFunc:l.NOTEQUAL,blend:s?void 0:"add"}),e.draw(c))}}drawOpaque(e,r,i,n){this.drawRanges(e,r,i,this.plain,n,{depthTest:!0},!1)}drawReflected(e,r,i,n,a){let o={depthTest:!0,depthWrite:!0,mirrored:r.mirrored};this.drawRanges(e,r,i,this.reflected,a,o,!0);for(let s of n){let l=e.data.materials[s.material],c=this.programFor(s,e,l.normalTexture<0&&le(l)<0&&!l.unlit?this.reflected:this.opaque);c.use(),e.setSurface(c,s),c.set("u_weights",[1,1,0]),z(this.device.gl,{...o,cull:!l.doubleSided}),e.draw(s)}}drawTransparent(e,r){let{gl:i}=this.device,n=r.viewFromPack,a=[n[2],n[6],n[10]],o=l=>T(a,se(l.bounds)),s=e.transparent.filter(l=>te(r.clipFromPack,l.bounds)).sort((l,c)=>o(l)-o(c));if(s.length!==0){this.setFrame(this.transparent,e,r,!1);for(let l of s){let c=this.programFor(l,e,this.transparent);c.use(),e.setSurface(c,l);let u=e.data.materials[l.material],h=u.alphaMode===2&&u.transmission<=0,f={depthTest:!0,alpha:!1,mirrored:r.mirrored,stencilRead:sn,cull:!u.doubleSided},m=(p,v,b)=>{z(i,{...f,...p}),c.set("u_dimming",v),c.set("u_weights",[1,b,1]),e.draw(l)};h?e.orderFarToNear(l,a):m({blend:"multiply"},!0,0);let d=h?"cover":"add";m({blend:d,stencilFunc:r.mirrored?void 0:i.EQUAL},!1,1),r.mirrored||m({blend:d,stencilFunc:i.NOTEQUAL},!1,0)}}}white=1.2;addToMean(e,r){let{gl:i}=this.device,n=this.frame;i.bindFramebuffer(i.FRAMEBUFFER,this.mean.target),i.viewport(0,0,n.width,n.height),z(i,r?{}:{blend:"add"}),r||i.blendFunc(i.ONE,i.ONE),this.average.use(),this.average.set("u_share",e),this.average.set("u_encode",!1),this.average.set("u_before_weight",0),this.average.set("u_scale",[1,1]),k(i,"u_frame",n.light),this.drawScreen(),this.average.set("u_share",0)}show(e,r,i,n,a=!0){let o=this.frame.width!==i||this.frame.height!==n,{gl:s}=this.device,l=this.frame,[c,u]=this.sums;z(s,{}),this.average.use(),this.average.set("u_exposure",1/(this.white*e.unit)),this.average.set("u_unlit_exposure",1/(e.unlitWhite*e.unit)),this.average.set("u_count",r+1),k(s,"u_frame",l.light),k(s,"u_before",c.texture),this.average.set("u_before_weight",r),this.average.set("u_encode",!1),this.average.set("u_scale",[1,1]),s.bindFramebuffer(s.FRAMEBUFFER,u.target),s.viewport(0,0,l.width,l.height),this.drawScreen(),this.sums=[u,c],a&&(k(s,"u_before",u.texture),this.average.set("u_scale",o?[l.width/i,l.height/n]:[1,1]),this.average.set("u_before_weight",1),this.average.set("u_encode",!0),s.bindFramebuffer(s.FRAMEBUFFER,null),s.viewport(0,0,i,n),this.drawScreen())}meter(e,r=!1){let{gl:i}=this.device,n=this.frame,a=Math.ceil(n.width/Rt),o=Math.ceil(n.height/Rt);if(this.blocks?.width!==a||this.blocks.height!==o){let c=S(i,{width:a,height:o,format:this.device.color});this.blocks={width:a,height:o,texture:c,target:re(i,c)}}i.bindFramebuffer(i.FRAMEBUFFER,this.blocks.target),i.viewport(0,0,a,o),z(i,{}),this.luminance.use(),k(i,"u_frame",r?this.mean.texture:n.light),this.luminance.set("u_frame_size",[n.width,n.height]),this.luminance.set("u_block",Rt),this.drawScreen();let s=new Float32Array(4*a*o);i.readPixels(0,0,a,o,i.RGBA,i.FLOAT,s);let l=$o(s,a,o);return l===void 0?void 0:l-Math.log2(e.unit)}};function $o(t,e,r){let i=[],n=0;for(let c=0;c<e*r;++c){let u=t[4*c],h=t[4*c+1];if(!(h>0)||!Number.isFinite(u))continue;let f=(2*(c%e)+1)/e-1,m=(2*Math.floor(c/e)+1)/r-1,d=h*(.1+Math.exp(-.5*(f*f+m*m)/.25));i.push({log:u/h,weight:d}),n+=d}if(i.length===0)return;i.sort((c,u)=>c.log-u.log);let a=0,o=i[i.length-1].log;for(let c of i)if(a+=c.weight,a>=.9*n){o=c.log;break}let s=0,l=0;for(let c of i)c.log>=o-7&&(s+=c.log*c.weight,l+=c.weight);return s/l}var Je=class{constructor(e){this.grids=e;this.eyeHeight=e[0]?.eyeHeight??1.6,this.step=.4*this.eyeHeight/1.6,this.beside=this.eyeHeight/1.6}eyeHeight;step;beside;eyeOf(e,r){let i=this.grids[e];return[i.lower[0]+(r%i.width+.5)*i.cell,i.floor[r]+i.eyeHeight,i.lower[1]+(Math.floor(r/i.width)+.5)*i.cell]}stand(e,r,i,n=this.step){let a;return this.grids.forEach((o,s)=>{let l=Math.floor((e-o.lower[0])/o.cell),c=Math.floor((r-o.lower[1])/o.cell),u=c*o.width+l;if(!(l>=0&&c>=0&&l<o.width&&c<o.height)||!o.walkable[u])return;let h=this.eyeOf(s,u);h[1]<=i+n&&(!a||h[1]>a.eye[1])&&(a={grid:s,cell:u,eye:h})}),a}nearest(e,r,i=(n,a)=>e[1]>n&&e[1]<=a+2*this.step){let n,a=r;return this.grids.forEach((o,s)=>{for(let l=0;l<o.floor.length;++l){if(!o.walkable[l]||!i(o.floor[l],o.floor[l]+o.eyeHeight))continue;let c=this.eyeOf(s,l),u=Math.hypot(c[0]-e[0],c[2]-e[2]);u<a&&(a=u,n={grid:s,cell:l,eye:c})}}),n}distance(e){let r=this.nearest(e,this.beside);return r?Math.hypot(r.eye[0]-e[0],r.eye[2]-e[2]):1/0}walk(e,r,i,n){let a=(this.stand(e[0],e[2],e[1])??this.stand(e[0],e[2],e[1]+this.eyeHeight,0))?.eye[1];if(a===void 0){let _=this.distance(e);if(n.fall=0,_===1/0||this.stand(r[0],r[2],e[1])||this.distance(r)<_)return r;for(let x of[[r[0],e[1],e[2]],[e[0],e[1],r[2]]])if((x[0]!==e[0]||x[2]!==e[2])&&this.distance(x)<=_)return x;return e}let o=1/0,s=this.step;for(let _ of this.grids)o=Math.min(o,_.cell),s=Math.max(s,_.cell);let l=[r[0]-e[0],r[2]-e[2]],c=Math.hypot(...l)/(.5*o),u=Math.min(Math.max(Math.ceil(c),1),64),h=Math.max(u,c),f=e[0],m=e[2],d=a,p=(_,x)=>{let w=this.stand(f+_,m+x,d,s);return!w||d-w.eye[1]>s?!1:(f+=_,m+=x,d=w.eye[1],!0)},v=l[0]/h,b=l[1]/h;for(let _=0;_<u&&!(!p(v,b)&&!p(v,0)&&!p(0,b));++_);let g=e[1];return g-d>2*this.step?(n.fall+=9.81*this.beside*i,g=Math.max(g-n.fall*i,d)):(n.fall=0,g+=(d-g)*(1-Math.exp(-i/.08)),Math.abs(d-g)<.001*this.step&&(g=d)),[f,g,m]}way(e,r){let i=this.stand(e[0],e[2],e[1])??this.nearest(e,this.beside);if(!i)return[];let n=u=>u.grid*2**30+u.cell,a=new Map([[n(i),void 0]]),o=[i],s=i,l=1/0;for(let u=0;u<o.length;++u){let h=o[u],f=this.grids[h.grid],m=Math.hypot(h.eye[0]-r[0],h.eye[1]-this.grids[h.grid].eyeHeight-r[1],h.eye[2]-r[2]);m<l&&(l=m,s=h);for(let[d,p]of[[1,0],[-1,0],[0,1],[0,-1],[1,1],[1,-1],[-1,1],[-1,-1]]){let v=this.stand(h.eye[0]+d*f.cell,h.eye[2]+p*f.cell,h.eye[1],Math.max(this.step,f.cell));!v||h.eye[1]-v.eye[1]>Math.max(this.step,f.cell)||a.has(n(v))||d&&p&&(!this.stand(h.eye[0]+d*f.cell,h.eye[2],h.eye[1])||!this.stand(h.eye[0],h.eye[2]+p*f.cell,h.eye[1]))||(a.set(n(v),h),o.push(v))}}let c=[];for(let u=s;u&&n(u)!==n(i);u=a.get(n(u)))c.push(u.eye);return c}};var Wo=2,Ho=3,hn=1.55,At=t=>Math.atan2(-t[0],-t[2]),fn=t=>Math.asin(Math.min(Math.max(t[1]/Math.max(W(t),1e-12),-1),1)),mn=(t,e)=>[-Math.sin(t)*Math.cos(e),Math.sin(e),-Math.cos(t)*Math.cos(e)],et=class{camera;cameras;path;floors;origin;state={fall:0};way=[];tour;place=0;clock;constructor(e){this.floors=new Je(e.grids),this.origin=e.mesh.origin,this.path=e.paths.find(n=>n.keys.length>1),this.cameras=e.cameras.length>0?e.cameras:[this.somewhere(e)],this.camera={...this.fromHash()??this.cameras[0]};let r=Number(new URLSearchParams(location.hash.slice(1)).get("time")??NaN),i=Number.isFinite(r);this.clock={seconds:i?Math.max(r,0):0,runs:!i&&!matchMedia("(prefers-reduced-motion: reduce)").matches}}somewhere(e){let r=e.grids.findIndex(n=>n.walkable.some(a=>a>0));return{name:"start",eye:r<0?[0,1.6,0]:this.floors.eyeOf(r,e.grids[r].walkable.indexOf(1)),forward:[0,0,-1],up:[0,1,0],fov:1.05,halfHeight:0}}fromHash(){let e=new URLSearchParams(location.hash.slice(1)).get("camera");if(!e)return;let r=this.cameras.find(o=>o.name===e);if(r)return r;let i=e.split(",").map(Number);if(i.length<5||i.length>6||!i.every(Number.isFinite))return;let n=i[5]===void 0?60:Math.min(Math.max(i[5],10),120),a=Math.PI/180;return{name:"",eye:F(i.slice(0,3),this.origin),forward:mn(i[3]*a,i[4]*a),up:[0,1,0],fov:n*a,halfHeight:0}}toHash(){let e=this.camera,r=D(e.eye,this.origin),i=180/Math.PI;return`#camera=${[...r.map(a=>a.toFixed(3)),...[At(e.forward),fn(e.forward),e.fov].map(a=>(a*i).toFixed(2))].join(",")}`}jump(e){this.camera={...e},this.way=[],this.tour=void 0,this.state.fall=0}goTo(e,r){return this.tour=void 0,this.way=this.floors.way(this.camera.eye,e),r&&this.way[0]&&this.jump({...this.camera,eye:this.way[0]}),this.way.length>0||r}get touring(){return this.tour!==void 0}toggleTour(){this.tour=this.touring||!this.path?void 0:this.path.keys[0].time,this.way=[]}step(e,r){let i={...this.camera},n=e.right!==0||e.ahead!==0,a=e.yaw!==0||e.pitch!==0;if(n&&(this.way=[]),(n||a)&&(this.tour=void 0),this.touring&&this.alongPath(r),a){let s=Math.min(Math.max(fn(this.camera.forward)-e.pitch,-hn),hn);this.camera.forward=mn(At(this.camera.forward)-e.yaw,s),this.camera.up=[0,1,0]}!this.touring&&(n||this.way.length>0||this.state.fall>0||this.settling)&&this.walk(e,r);let o=(s,l)=>s.some((c,u)=>c!==l[u]);return o(i.eye,this.camera.eye)||o(i.forward,this.camera.forward)}settling=!1;walk(e,r){let i=Wo*this.floors.eyeHeight*(e.fast?Ho:1)/1.6,n=this.camera.eye,a=[...n];if(this.way.length>0){let o=i*1.5*r;for(;this.way.length>0&&o>0;){let s=this.way[this.way.length-1],l=[s[0]-a[0],s[2]-a[2]],c=Math.hypot(...l),u=c>o?o/c:1;a=[a[0]+l[0]*u,a[1],a[2]+l[1]*u],o-=c,u===1&&this.way.pop()}}else{let o=At(this.camera.forward),s=Math.max(Math.hypot(e.right,e.ahead),1),l=i*r/s;a[0]+=(Math.cos(o)*e.right-Math.sin(o)*e.ahead)*l,a[2]+=(-Math.sin(o)*e.right-Math.cos(o)*e.ahead)*l}this.camera.eye=this.floors.grids.length>0?this.floors.walk(n,a,r,this.state):a,this.settling=this.camera.eye[1]!==n[1]}alongPath(e){let r=this.path.keys,i=r[r.length-1];this.tour+=e,this.tour>=i.time&&(this.tour=void 0);let n=this.tour??i.time,a=Math.max(1,r.findIndex(u=>u.time>=n)),o=r[a-1],s=r[a],l=Math.min(Math.max((n-o.time)/Math.max(s.time-o.time,1e-9),0),1),c=(u,h)=>u.map((f,m)=>f+(h[m]-f)*l);this.camera={name:"",eye:c(o.eye,s.eye),forward:N(c(o.forward,s.forward),o.forward),up:[0,1,0],fov:this.path.fov,halfHeight:0}}};var qo=ArrayBuffer,U=Uint8Array,tt=Uint16Array,Xo=Int16Array;var rt=Int32Array,Lt=function(t,e,r){if(U.prototype.slice)return U.prototype.slice.call(t,e,r);(e==null||e<0)&&(e=0),(r==null||r>t.length)&&(r=t.length);var i=new U(r-e);return i.set(t.subarray(e,r)),i},Fe=function(t,e,r,i){if(U.prototype.fill)return U.prototype.fill.call(t,e,r,i);for((r==null||r<0)&&(r=0),(i==null||i>t.length)&&(i=t.length);r<i;++r)t[r]=e;return t},jo=function(t,e,r,i){if(U.prototype.copyWithin)return U.prototype.copyWithin.call(t,e,r,i);for((r==null||r<0)&&(r=0),(i==null||i>t.length)&&(i=t.length);r<i;)t[e++]=t[r++]};var Ko=["invalid zstd data","window size too large (>2046MB)","invalid block type","FSE accuracy too high","match distance too far back","unexpected EOF"],I=function(t,e,r){var i=new Error(e||Ko[t]);if(i.code=t,Error.captureStackTrace&&Error.captureStackTrace(i,I),!r)throw i;return i},dn=function(t,e,r){for(var i=0,n=0;i<r;++i)n|=t[e++]<<(i<<3);return n},Yo=function(t,e){return(t[e]|t[e+1]<<8|t[e+2]<<16|t[e+3]<<24)>>>0},Qo=function(t,e){var r=t[0]|t[1]<<8|t[2]<<16;if(r==3126568&&t[3]==253){var i=t[4],n=i>>5&1,a=i>>2&1,o=i&3,s=i>>6;i&8&&I(0);var l=6-n,c=o==3?4:o,u=dn(t,l,c);l+=c;var h=s?1<<s:n,f=dn(t,l,h)+(s==1&&256),m=f;if(!n){var d=1<<10+(t[5]>>3);m=d+(d>>3)*(t[5]&7)}m>2145386496&&I(1);var p=new U((e==1?f||m:e?0:m)+12);return p[0]=1,p[4]=4,p[8]=8,{b:l+h,y:0,l:0,d:u,w:e&&e!=1?e:p.subarray(12),e:m,o:new rt(p.buffer,0,3),u:f,c:a,m:Math.min(131072,m)}}else if((r>>4|t[3]<<20)==25481893)return Yo(t,4)+8;I(0)},me=function(t){for(var e=0;1<<e<=t;++e);return e-1},Se=function(t,e,r){var i=(e<<3)+4,n=(t[e]&15)+5;n>r&&I(3);for(var a=1<<n,o=a,s=-1,l=-1,c=-1,u=a,h=new qo(512+(a<<2)),f=new Xo(h,0,256),m=new tt(h,0,256),d=new tt(h,512,a),p=512+(a<<1),v=new U(h,p,a),b=new U(h,p+a);s<255&&o>0;){var g=me(o+1),_=i>>3,x=(1<<g+1)-1,w=(t[_]|t[_+1]<<8|t[_+2]<<16)>>(i&7)&x,y=(1<<g)-1,P=x-o-1,O=w&y;if(O<P?(i+=g,w=O):(i+=g+1,w>y&&(w-=P)),f[++s]=--w,w==-1?(o+=w,v[--u]=s):o-=w,!w)do{var H=i>>3;l=(t[H]|t[H+1]<<8)>>(i&7)&3,i+=2,s+=l}while(l==3)}(s>255||o)&&I(0);for(var $=0,q=(a>>1)+(a>>3)+3,X=a-1,Q=0;Q<=s;++Q){var A=f[Q];if(A<1){m[Q]=-A;continue}for(c=0;c<A;++c){v[$]=Q;do $=$+q&X;while($>=u)}}for($&&I(0),c=0;c<a;++c){var M=m[v[c]]++,j=b[c]=n-me(M);d[c]=(M<<j)-a}return[i+7>>3,{b:n,s:v,n:b,t:d}]},Zo=function(t,e){var r=0,i=-1,n=new U(292),a=t[e],o=n.subarray(0,256),s=n.subarray(256,268),l=new tt(n.buffer,268);if(a<128){var c=Se(t,e+1,6),u=c[0],h=c[1];e+=a;var f=u<<3,m=t[e];m||I(0);for(var d=0,p=0,v=h.b,b=v,g=(++e<<3)-8+me(m);g-=v,!(g<f);){var _=g>>3;if(d+=(t[_]|t[_+1]<<8)>>(g&7)&(1<<v)-1,o[++i]=h.s[d],g-=b,g<f)break;_=g>>3,p+=(t[_]|t[_+1]<<8)>>(g&7)&(1<<b)-1,o[++i]=h.s[p],v=h.n[d],d=h.t[d],b=h.n[p],p=h.t[p]}++i>255&&I(0)}else{for(i=a-127;r<i;r+=2){var x=t[++e];o[r]=x>>4,o[r+1]=x&15}++e}var w=0;for(r=0;r<i;++r){var y=o[r];y>11&&I(0),w+=y&&1<<y-1}var P=me(w)+1,O=1<<P,H=O-w;for(H&H-1&&I(0),o[i++]=me(H)+1,r=0;r<i;++r){var y=o[r];++s[o[r]=y&&P+1-y]}var $=new U(O<<1),q=$.subarray(0,O),X=$.subarray(O);for(l[P]=0,r=P;r>0;--r){var Q=l[r];Fe(X,r,Q,l[r-1]=Q+s[r]*(1<<P-r))}for(l[0]!=O&&I(0),r=0;r<i;++r){var A=o[r];if(A){var M=l[A];Fe(q,r,M,l[A]=M+(1<<P-A))}}return[e,{n:X,b:P,s:q}]},Jo=Se(new U([81,16,99,140,49,198,24,99,12,33,196,24,99,102,102,134,70,146,4]),0,6)[1],es=Se(new U([33,20,196,24,99,140,33,132,16,66,8,33,132,16,66,8,33,68,68,68,68,68,68,68,68,36,9]),0,6)[1],ts=Se(new U([32,132,16,66,102,70,68,68,68,68,36,73,2]),0,5)[1],pn=function(t,e){for(var r=t.length,i=new rt(r),n=0;n<r;++n)i[n]=e,e+=1<<t[n];return i},Pt=new U(new rt([0,0,0,0,16843009,50528770,134678020,202050057,269422093]).buffer,0,36),rs=pn(Pt,0),zt=new U(new rt([0,0,0,0,0,0,0,0,16843009,50528770,117769220,185207048,252579084,16]).buffer,0,53),is=pn(zt,3),Me=function(t,e,r){var i=t.length,n=e.length,a=t[i-1],o=(1<<r.b)-1,s=-r.b;a||I(0);for(var l=0,c=r.b,u=(i<<3)-8+me(a)-c,h=-1;u>s&&h<n;){var f=u>>3,m=(t[f]|t[f+1]<<8|t[f+2]<<16)>>(u&7);l=(l<<c|m)&o,e[++h]=r.s[l],u-=c=r.n[l]}(u!=s||h+1!=n)&&I(0)},ns=function(t,e,r){var i=6,n=e.length,a=n+3>>2,o=a<<1,s=a+o;Me(t.subarray(i,i+=t[0]|t[1]<<8),e.subarray(0,a),r),Me(t.subarray(i,i+=t[2]|t[3]<<8),e.subarray(a,o),r),Me(t.subarray(i,i+=t[4]|t[5]<<8),e.subarray(o,s),r),Me(t.subarray(i),e.subarray(s),r)},as=function(t,e,r){var i,n=e.b,a=t[n],o=a>>1&3;e.l=a&1;var s=a>>3|t[n+1]<<5|t[n+2]<<13,l=(n+=3)+s;if(o==1)return n>=t.length?void 0:(e.b=n+1,r?(Fe(r,t[n],e.y,e.y+=s),r):Fe(new U(s),t[n]));if(!(l>t.length)){if(o==0)return e.b=l,r?(r.set(t.subarray(n,l),e.y),e.y+=s,r):Lt(t,n,l);if(o==2){var c=t[n],u=c&3,h=c>>2&3,f=c>>4,m=0,d=0;u<2?h&1?f|=t[++n]<<4|(h&2&&t[++n]<<12):f=c>>3:(d=h,h<2?(f|=(t[++n]&63)<<4,m=t[n]>>6|t[++n]<<2):h==2?(f|=t[++n]<<4|(t[++n]&3)<<12,m=t[n]>>2|t[++n]<<6):(f|=t[++n]<<4|(t[++n]&63)<<12,m=t[n]>>6|t[++n]<<2|t[++n]<<10)),++n;var p=r?r.subarray(e.y,e.y+e.m):new U(e.m),v=p.length-f;if(u==0)p.set(t.subarray(n,n+=f),v);else if(u==1)Fe(p,t[n++],v);else{var b=e.h;if(u==2){var g=Zo(t,n);m+=n-(n=g[0]),e.h=b=g[1]}else b||I(0);(d?ns:Me)(t.subarray(n,n+=m),p.subarray(v),b)}var _=t[n++];if(_){_==255?_=(t[n++]|t[n++]<<8)+32512:_>127&&(_=_-128<<8|t[n++]);var x=t[n++];x&3&&I(0);for(var w=[es,ts,Jo],y=2;y>-1;--y){var P=x>>(y<<1)+2&3;if(P==1){var O=new U([0,0,t[n++]]);w[y]={s:O.subarray(2,3),n:O.subarray(0,1),t:new tt(O.buffer,0,1),b:0}}else P==2?(i=Se(t,n,9-(y&1)),n=i[0],w[y]=i[1]):P==3&&(e.t||I(0),w[y]=e.t[y])}var H=e.t=w,$=H[0],q=H[1],X=H[2],Q=t[l-1];Q||I(0);var A=(l<<3)-8+me(Q)-X.b,M=A>>3,j=0,Re=(t[M]|t[M+1]<<8)>>(A&7)&(1<<X.b)-1;M=(A-=q.b)>>3;var Ae=(t[M]|t[M+1]<<8)>>(A&7)&(1<<q.b)-1;M=(A-=$.b)>>3;var Le=(t[M]|t[M+1]<<8)>>(A&7)&(1<<$.b)-1;for(++_;--_;){var st=X.s[Re],Ot=X.n[Re],lt=$.s[Le],It=$.n[Le],Nt=q.s[Ae],$t=q.n[Ae];M=(A-=Nt)>>3;var Wt=1<<Nt,ue=Wt+((t[M]|t[M+1]<<8|t[M+2]<<16|t[M+3]<<24)>>>(A&7)&Wt-1);M=(A-=zt[lt])>>3;var ge=is[lt]+((t[M]|t[M+1]<<8|t[M+2]<<16)>>(A&7)&(1<<zt[lt])-1);M=(A-=Pt[st])>>3;var Pe=rs[st]+((t[M]|t[M+1]<<8|t[M+2]<<16)>>(A&7)&(1<<Pt[st])-1);if(M=(A-=Ot)>>3,Re=X.t[Re]+((t[M]|t[M+1]<<8)>>(A&7)&(1<<Ot)-1),M=(A-=It)>>3,Le=$.t[Le]+((t[M]|t[M+1]<<8)>>(A&7)&(1<<It)-1),M=(A-=$t)>>3,Ae=q.t[Ae]+((t[M]|t[M+1]<<8)>>(A&7)&(1<<$t)-1),ue>3)e.o[2]=e.o[1],e.o[1]=e.o[0],e.o[0]=ue-=3;else{var ze=ue-(Pe!=0);ze?(ue=ze==3?e.o[0]-1:e.o[ze],ze>1&&(e.o[2]=e.o[1]),e.o[1]=e.o[0],e.o[0]=ue):ue=e.o[0]}for(var y=0;y<Pe;++y)p[j+y]=p[v+y];j+=Pe,v+=Pe;var _e=j-ue;if(_e<0){var be=-_e,zn=e.e+_e;be>ge&&(be=ge);for(var y=0;y<be;++y)p[j+y]=e.w[zn+y];j+=be,ge-=be,_e=0}for(var y=0;y<ge;++y)p[j+y]=p[_e+y];j+=ge}if(j!=v)for(;v<p.length;)p[j++]=p[v++];else j=p.length;r?e.y+=j:p=Lt(p,0,j)}else if(r){if(e.y+=f,v)for(var y=0;y<f;++y)p[y]=p[v+y]}else v&&(p=Lt(p,v));return e.b=l,p}I(2)}},os=function(t,e){if(t.length==1)return t[0];for(var r=new U(e),i=0,n=0;i<t.length;++i){var a=t[i];r.set(a,n),n+=a.length}return r};function vn(t,e){for(var r=[],i=+!e,n=0,a=0;t.length;){var o=Qo(t,i||e);if(typeof o=="object"){for(i?(e=null,o.w.length==o.u&&(r.push(e=o.w),a+=o.u)):(r.push(e),o.e=0);!o.l;){var s=as(t,o,e);s||I(5),e?o.e=o.y:(r.push(s),a+=s.length,jo(o.w,0,s.length),o.w.set(s,o.w.length-s.length))}n=o.b+o.c*4}else n=o;t=t.subarray(n)}return os(r,a)}var ss=64;function ls(t,e){let r=t.u16(),i=t.u16(),n=t.u16(),a=t.u16();(r<2||r>6||i!==1&&i!==3||n<1||n>256||a<1||a>64)&&t.fail(`found a transfer of ${r} bands, ${i} channels, ${n} clusters and ${a} components`),t.f32();let o=t.f32s(n*(a+1)*i*r*r),s=t.f32s(n*a),l=t.planes(e,1),c=new Int16Array(t.planes(e*a,2).buffer);for(let u of l)u>=n&&t.fail(`found cluster ${u} of ${n}`);return{bands:r,channels:i,clusters:n,components:a,basis:o,weightScale:s,cluster:l,weight:c}}function gn(t){let e=t.text(),r=wt(t,e),i=je(t);return{name:e,...r,mesh:i,transfer:ls(t,i.positions.length/3)}}function cs(t){return t.text(),{kind:t.choice(3,"kind of light"),twoSided:t.choice(1,"flag")>0,intensity:C(t),position:C(t),direction:C(t),innerCone:t.f32(),outerCone:t.f32(),angularRadius:t.f32(),corners:L(t,t.count(12),C)}}function _n(t){let e=t.u32(),r=t.u32();(e<2||e>6||r<2||r>64)&&t.fail(`found ${e} bands and depth maps of ${r} texels a side`);let i=t.f32();t.f32();let n=C(t),a=C(t),o=[t.u32(),t.u32(),t.u32()],s=t.count(36),l=t.count(12),c=t.size(ss,"lights");(!(i>0)||a.some(x=>!(x>0))||o.some(x=>x<1)||o[0]*o[1]*o[2]>s)&&t.fail(`found a grid of ${o.join(" x ")} cells of ${s}`);let u=new Uint32Array(t.planes(s,36).buffer);for(let x=0;x<s;++x){let w=u[9*x];w!==0&&(w<=x||w+8>s)&&t.fail(`found parts ${w} of cell ${x} of ${s}`);for(let y=1;y<9;++y)u[9*x+y]>=l&&t.fail(`found probe ${u[9*x+y]} of ${l}`)}let h=t.planesF32(l,3),f=t.planes(l,1),m=()=>new Uint32Array(t.planes(l,8).buffer),d=m(),p=m(),v=2**fe(t),b=t.planesU16(3*e*e*l),g=r*r*l,_=Float32Array.from(b,x=>Z(x)*v);return _.some(x=>!Number.isFinite(x))&&t.fail("found a coefficient that is not finite"),{bands:e,depthSide:r,depthCap:i,lower:n,cell:a,size:o,cells:u,positions:h,valid:f,bright:d,kept:p,harmonics:_,depth:t.planesU16(g),depthSquared:t.planesU16(g),lights:L(t,c,cs)}}var us=2**30;function hs(t,e,r,i){switch(t){case"SCNE":i.sky=r.floats(3);break;case"MESH":i.mesh=je(r);break;case"MATL":i.materials=L(r,e,Ai);break;case"ETEX":i.emissionTextures=L(r,e,Ri);break;case"TEXR":i.textures.push(...L(r,e,yt));break;case"NTEX":i.normals.push(...L(r,e,yt));break;case"LMAP":i.pages.push(...L(r,e,Li));break;case"SHRP":i.sharp=Hi(r);break;case"RFLT":i.reflectors=L(r,e,Pi);break;case"EMIT":i.emitters=L(r,e,zi);break;case"KERN":i.kernels=L(r,e,Gi);break;case"FRES":i.fresnels=L(r,e,Vi);break;case"CAMS":i.cameras=L(r,e,Di);break;case"PATH":i.paths=L(r,e,Bi);break;case"CRFL":i.curved=L(r,e,Ni);break;case"SMAP":i.surrounds.push(...L(r,e,$i));break;case"MOVR":i.movers.push(...L(r,e,gn));break;case"PROB":i.field=_n(r);break;case"LGRP":i.groups=L(r,e,Ui);break;case"GLMP":i.pageGroups.push(...L(r,e,Ii));break;case"DAYH":i.day=Oi(r);break;case"WALK":i.grids=L(r,e,Ci);break;default:r.fail("found a section that a piece does not have")}r.end()}var fs=[143,79,82,73,13,10,26,10];function Gt(t,e){let r=s=>{throw new V(`${e}: ${s}`)},i=new DataView(t.buffer,t.byteOffset,t.byteLength),n={sky:[0,0,0],materials:[],emissionTextures:[],textures:[],normals:[],pages:[],reflectors:[],emitters:[],kernels:[],fresnels:[],cameras:[],paths:[],grids:[],groups:[],pageGroups:[],curved:[],surrounds:[],movers:[]};(t.length<64||fs.some((s,l)=>t[l]!==s))&&r("is no piece of a pack"),i.getUint32(8,!0)!==1&&r(`found format version ${i.getUint32(8,!0)}, expected 1`);let a=i.getUint32(16,!0);64+a*64>t.length&&r("ends inside its table");let o=s=>Number(i.getBigUint64(s,!0));for(let s=0;s<a;++s){let l=64+64*s,c=String.fromCharCode(...t.subarray(l,l+4)),u=i.getUint32(l+4,!0),h=o(l+16),f=o(l+24),m=o(l+32),d=o(l+40),p=`${e}, ${c}`;h+f>t.length&&r(`section ${c} ends outside`),(m>us||m>f*65536+65536||d>m+1)&&r(`found ${m} bytes in section ${c}`);let v=t.subarray(h,h+f);if(u===1)try{v=vn(v,new Uint8Array(m))}catch{r(`section ${c} cannot be decompressed`)}else u!==0&&r(`found codec ${u}`);v.length!==m&&r(`section ${c}: found ${v.length} bytes, expected ${m}`),hs(c,d,new Ge(v,p),n)}return n}function bn(t,e,r,i){let n=s=>{throw new V(`scene: ${s}`)},a=(s,l,c,u=-1)=>{(s<u||s>=l)&&n(`found ${c} ${s} of ${l}`)},o=t.mesh;if(!o)return n("found no mesh");t.pages.some(s=>s.sharpAt)&&n("found sharp light on coarse pages");for(let s of o.parts)a(s.material,t.materials.length,"material",0),a(s.page,t.pages.length,"lightmap page");for(let s of t.materials)a(s.texture,e,"texture"),a(s.normalTexture,r,"normal texture"),a(s.kernel,t.kernels.length,"kernel"),a(s.fresnel,t.fresnels.length,"Fresnel map");for(let s of t.emissionTextures)a(s.material,t.materials.length,"material",0),a(s.texture,e,"texture",0);for(let s of t.reflectors){a(s.material,t.materials.length,"material",0);for(let l of s.indices)a(l,o.positions.length/3,"vertex",0);for(let l of s.emitters)a(l,t.emitters.length,"emitter",0)}for(let s of t.curved){a(s.material,t.materials.length,"material",0),a(s.map,i,"surround map",0);for(let l of s.indices)a(l,o.positions.length/3,"vertex",0)}t.groups.length>Xe&&n(`found ${t.groups.length} light groups, expected at most ${Xe}`);for(let s of t.groups){for(let l of s.materials)a(l,t.materials.length,"material",0);for(let l of s.emitters)a(l,t.emitters.length,"emitter",0)}}function xn(t,e){for(let r of e.groups)for(let i of r.brightLights)if(i>=t.lights.length)throw new V(`group '${r.name}': found bright light ${i} of ${t.lights.length}`)}function yn(t,e){for(let r of t.mesh.parts)if(r.material>=e.materials.length)throw new V(`mover '${t.name}': found material ${r.material} of ${e.materials.length}`)}function wn(t,e,r){let i=a=>{throw new V(`light of groups on page ${t.page}: ${a}`)},n=e.groups.length;if(!r)return i(`found no such page among ${e.pages.length}`);(t.width!==r.width||t.height!==r.height||t.detailWidth!==r.detailWidth||t.detailHeight!==r.detailHeight)&&i(`found ${t.width} x ${t.height} texels, expected ${r.width} x ${r.height} and as many details`);for(let a of[t.rest,t.restOfDetail])for(let o of a)o>=n&&i(`found group ${o} of ${n}`);for(let a of t.others)a.group>=n&&i(`found group ${a.group} of ${n}`)}var ms=2,ds=1800,ps=1e4,kn=2700,ie=t=>document.getElementById(t);function Te(t,e,r){let i=document.createElement("input");return i.type=t,i.setAttribute("aria-label",e),i.addEventListener("input",()=>r(i)),i}function Vt(t,e,r,i){return t.min=String(e),t.max=String(r),t.step=String(i),t}function vs(t){let e=t.hours.slice(1).map((r,i)=>r.hour-t.hours[i].hour);return e.length>0?Math.min(...e)/4:.25}var it=class{constructor(e,r,i){this.groups=e;this.day=r;this.wanted=i;this.settings=Ie(e,r),e.length!==0&&(ie("lamps").hidden=!1,ie("lamps").addEventListener("click",()=>this.toggle()),ie("lights-close").addEventListener("click",()=>this.toggle()),ie("lights-baked").addEventListener("click",()=>this.all(({hour:n})=>({on:!0,value:1,hour:n}))),ie("lights-off").addEventListener("click",()=>this.all(n=>({...n,on:!1}))),this.dialog.addEventListener("keydown",n=>{(n.key==="Escape"||n.key==="o"&&!(n.ctrlKey||n.altKey||n.metaKey))&&(this.toggle(),n.preventDefault())}),r&&ie("lights-groups").append(this.rowOfHour(r)),e.forEach((n,a)=>{this.settings[a].hour===void 0&&ie("lights-groups").append(this.rowsOf(a))}),this.fromHash())}settings;refreshes=[];dialog=ie("lights");get factors(){return gi(this.groups,this.settings,this.day)}get changed(){return this.factors.some(e=>e.some(r=>r!==1))}toggle(){this.groups.length!==0&&(this.dialog.open?(this.dialog.close(),ie("view").focus()):this.dialog.show(),ie("lamps").setAttribute("aria-expanded",String(this.dialog.open)))}fromHash(){let e=new URLSearchParams(location.hash.slice(1)).getAll("light");e.length!==0&&(this.settings=Ie(this.groups,this.day),pi(this.groups,e,this.settings,this.day),this.refresh())}toHash(){return vi(this.groups,this.settings,this.day).map(e=>`&light=${encodeURIComponent(e)}`).join("")}all(e){this.settings=this.settings.map(e),this.refresh()}refresh(){for(let e of this.refreshes)e();this.wanted()}rowOfHour(e){let r=document.createElement("label"),i=document.createElement("output"),n=()=>this.settings.find(o=>o.hour!==void 0).hour,a=Vt(Te("range",`hour, ${e.clock}`,()=>{vt(e,Number(a.value),this.settings),this.refresh()}),e.hours[0].hour,e.hours.at(-1).hour,vs(e));return r.append("hour",a,i),this.refreshes.push(()=>{a.value=String(n()),i.textContent=`${kt(n())} ${e.clock}`}),this.refreshes.at(-1)(),r}rowsOf(e){let{name:r,lamps:i}=this.groups[e],n=document.createElement("div"),a=()=>this.settings[e],o=v=>()=>{v(),this.refresh()},s=(v,...b)=>{let g=document.createElement("label");return g.append(...b.slice(0,1),v,...b.slice(1)),n.append(g),g};n.setAttribute("role","group"),n.setAttribute("aria-label",r),n.title=i.join(", ");let l=Te("checkbox",r,o(()=>{a().on=l.checked})),c=Vt(Te("range",`${r}: light, times what was baked`,o(()=>{a().value=Number(c.value)})),0,ms,.05),u=Te("checkbox",`${r}: a colour of its own`,o(()=>{delete a().color,delete a().kelvin,u.checked&&Ne(a(),kn)})),h=Vt(Te("range",`${r}: colour temperature, kelvin`,o(()=>Ne(a(),Number(h.value)))),ds,ps,100),f=document.createElement("output"),m=document.createElement("output");s(r,l);let d=s("",c,f),p=s("colour",u,h,m);return this.refreshes.push(()=>{let v=a();l.checked=v.on,c.value=String(v.value),u.checked=!!v.color,h.value=String(v.kelvin??kn),d.hidden=p.hidden=!v.on,h.hidden=m.hidden=v.kelvin===void 0,f.textContent=`× ${v.value.toFixed(2)}`,m.textContent=`${Math.round(v.kelvin??0)} K`,h.style.setProperty("accent-color",v.kelvin?gs(v.kelvin):"")}),this.refreshes.at(-1)(),n}};function gs(t){let e=pt(t),r=Math.max(...e);return`rgb(${e.map(i=>Math.round(255*(i/r)**(1/2.2))).join(" ")})`}function Mn(t,e,r,i){let{right:n,up:a,forward:o}=ct(t),s=t.fov===0?t.halfHeight:Math.tan(.5*t.fov),l=D(E(n,(2*e-1)*s*i),E(a,(1-2*r)*s));return t.fov===0?{from:D(t.eye,l),way:o}:{from:t.eye,way:N(D(o,l),o)}}function Fn(t,e,r){let i=t.data.mesh,n=i.positions,a=v=>ne(n,v),o;for(let v of i.parts){let b=t.data.materials[v.material].doubleSided;for(let g=v.first;g<v.first+v.count;g+=3){let _=a(i.indices[g]),x=F(a(i.indices[g+1]),_),w=F(a(i.indices[g+2]),_),y=G(r,w),P=T(x,y);if(P===0||P<0&&!b)continue;let O=F(e,_),H=T(O,y)/P,$=G(O,x),q=T(r,$)/P,X=T(w,$)/P;H<0||q<0||H+q>1||X<=1e-4||o&&X>=o.t||(o={t:X,index:g,u:H,w:q,page:v.page,normal:N(G(x,w),[0,1,0])})}}if(!o)return;let{t:s,index:l,u:c,w:u,page:h,normal:f}=o,m=i.lightmapUvs,d=v=>[0,1,2].reduce((b,g)=>b+m[2*i.indices[l+g]+v]*[1-c-u,c,u][g],0),p=D(e,E(r,s));return{at:p,normal:f,distance:s,lux:h<0?0:t.luxAt(h,d(0),d(1),p,f)}}var nt=4,_s=120,Dt=50,bs=25,xs=.25,ys=.5,ws=.002,ks=5e3,Ms=200,Fs=4,at=class{constructor(e,r,i,n,a,o){this.canvas=e;this.renderer=r;this.scene=i;this.walk=n;this.panel=a;this.lights=o;o.changed&&this.dim()}count=0;movedAt=-1e9;scale=1;hurries=!1;began=!1;presented=!1;meteredAt=-1e9;byHand;luxShown=!1;pointer=[.5,.5];frames=0;changed(){this.count=0,this.settled=!1}settled=!1;loading=!0;came=!1;drawnAt=-1e9;took=0;pieceCame(){this.came=!0}allCame(){this.loading=!1,delete document.body.dataset.rest,this.changed()}waits(e){let r=this.loading&&this.took>Ms&&this.count>0;return this.came&&(!r||e-this.drawnAt>Fs*this.took)?(this.came=!1,this.changed(),!1):r||this.count>=nt}dimmed=!1;dim(){this.dimmed=!0}brighter(e){this.byHand=(this.byHand??0)-e/3,this.meteredAt=-1e9,this.changed()}automatic(){this.byHand=void 0,this.meteredAt=-1e9,this.changed()}frame(e,r,i){let n=this.walk.step(e.take(r),r),a=this.walk.clock.runs&&this.scene.movers.animated,o=n||a;a&&(this.walk.clock.seconds+=r),this.scene.movers.place(this.walk.clock.seconds),this.panel.moversAre(this.scene.movers.animated,a),this.panel.stick(e.stick),this.dimmed&&(this.dimmed=!1,this.scene.setLights(this.lights.factors),this.changed());let s=Math.max(1,Math.round(this.canvas.clientWidth*Math.min(devicePixelRatio,2))),l=Math.max(1,Math.round(this.canvas.clientHeight*Math.min(devicePixelRatio,2)));(this.canvas.width!==s||this.canvas.height!==l)&&(this.canvas.width=s,this.canvas.height=l,this.changed()),o&&(i-this.movedAt<500&&this.adapt(r*1e3),this.movedAt=i,this.changed(),delete document.body.dataset.rest),!o&&i-this.movedAt>500&&(this.hurries=!1);let c=this.began&&i-this.movedAt<_s;if(this.frames===1&&!this.presented){this.presented=!0;return}(c?!o:this.waits(i))||(this.began?this.draw(c,s,l,i):this.drawFirst(s,l,i),++this.frames)}adapt(e){e>Dt&&!this.hurries?this.hurries=!0:e>Dt?this.scale=Math.max(this.scale*Math.max(Math.sqrt(Dt/e),.5),xs):e<bs&&(this.scale=Math.min(this.scale*1.05,1))}drawFirst(e,r,i){let n=a=>Math.max(1,Math.round(a*ys));this.renderer.draw(this.scene,this.walk.camera,n(e),n(r),void 0,cn),this.meter(!1,i),this.renderer.show(this.scene,0,e,r),this.renderer.startRest(),this.began=!0,this.changed()}draw(e,r,i,n){let a=e?this.scale:1,o=Math.max(1,Math.round(r*a)),s=Math.max(1,Math.round(i*a)),l=performance.now(),c=e?n-this.meteredAt>200:this.count===0&&!this.settled;this.renderer.draw(this.scene,this.walk.camera,o,s,e?void 0:this.count,e&&this.hurries?un:ln),c&&this.meter(e,n),c&&!e&&(this.took=performance.now()-l),this.drawnAt=performance.now(),!e&&!this.settled&&this.renderer.addToMean(1/nt,this.count===0);let u=this.count===nt-1;this.renderer.show(this.scene,e?0:this.count,r,i,e||!this.settled||u),this.count=e?0:this.count+1,!(this.count<nt)&&(!this.settled&&this.settle(n)||(document.body.dataset.rest=String(this.frames),this.panel.lux(this.luxShown?this.luxThere():void 0)))}settle(e){let r=this.renderer.white;return this.settled=!0,this.meter(!1,e,!0),this.took>ks||Math.abs(Math.log2(this.renderer.white/r))<ws?!1:(this.count=0,!0)}meter(e,r,i=!1){let n=this.renderer.meter(this.scene,i);if(this.meteredAt=r,n===void 0)return;let a=Math.min(Math.max(n-Math.log2(1.2*.18),-4),17)+(this.byHand??0),o=Math.log2(this.renderer.white/1.2),s=e?.45:1;this.renderer.white=1.2*2**(o+(a-o)*s)}get aspect(){return this.canvas.width/this.canvas.height}hitAt(e,r){let i=Mn(this.walk.camera,e,r,this.aspect);return Fn(this.scene,i.from,i.way)}go(e,r){let i=this.hitAt(e,r);if(!i)return;let n=i.normal[1]>.7?0:.5,a=[i.at[0]+i.normal[0]*n,i.at[1],i.at[2]+i.normal[2]*n];n>0&&(a[1]=this.walk.floors.nearest(this.walk.camera.eye,1e9)?.eye[1]??a[1]),this.walk.goTo(a,matchMedia("(prefers-reduced-motion: reduce)").matches)||this.panel.say("Nobody can walk there."),this.changed()}hover(e,r){this.pointer=[e,r],this.luxShown&&this.panel.lux(this.luxThere())}luxThere(){let e=this.hitAt(...this.pointer);return e?`${e.lux<10?e.lux.toFixed(1):Math.round(e.lux)} lux`:"no surface"}toggleLux(){this.luxShown=!this.luxShown,this.panel.lux(this.luxShown?this.luxThere():void 0)}};var Sn=2;async function Tn(t,e){let r;try{r=await fetch(t,{integrity:e})}catch{throw new V(`${t} did not come, or is not the one that this page was made with`)}if(!r.ok)throw new V(`${t}: ${r.status} ${r.statusText}`);return new Uint8Array(await r.arrayBuffer())}async function En(t,e){let r=JSON.parse(new TextDecoder().decode(await Tn(t,e)));if(r.version!==Sn)throw new V(`${t} is of version ${r.version}, this viewer of ${Sn}: write the folder anew`);for(let i of r.pieces)if(!/^pieces\/[a-z]+-[0-9a-f]+\.oriel$/.test(i.file)||!(i.bytes>0)||!(i.index>=0))throw new V(`${t}: found piece '${i.file}'`);return r}async function Bt(t){let e=await Tn(t.file,t.integrity);if(e.length!==t.bytes)throw new V(`${t.file}: found ${e.length} bytes, expected ${t.bytes}`);return e}function R(t){let e=document.getElementById(t);if(!e)throw new Error(`the page has no ${t}`);return e}var ot=class{walk;lights;show=()=>{};timer=0;begin(e,r,i){this.walk=e,this.lights=r,this.show=i;let n=R("places");e.cameras.forEach((a,o)=>n.append(new Option(a.name||`place ${o+1}`,String(o)))),n.addEventListener("change",()=>{n.value!==""&&this.jump(Number(n.value)),n.value="",R("view").focus()}),R("tour").hidden=!e.path,R("tour").addEventListener("click",()=>this.key("p")),R("movers").addEventListener("click",()=>this.key("m")),R("link").addEventListener("click",()=>void this.copyLink()),R("screen").hidden=!document.fullscreenEnabled,R("screen").addEventListener("click",()=>{(document.fullscreenElement?document.exitFullscreen():document.documentElement.requestFullscreen()).catch(()=>this.say("The browser does not give the whole screen."))}),R("help").addEventListener("click",()=>this.key("?")),addEventListener("hashchange",()=>{let a=e.fromHash();a&&(this.walk.jump(a),this.show()?.changed()),r.fromHash()})}sizes(e,r){R("sheet-sizes").textContent=`Loaded: ${(e/1e6).toFixed(1)} MB. Held on the graphics device: ${(r/1e6).toFixed(1)} MB, and the frame.`,document.body.dataset.held=String(r)}movers="";moversAre(e,r){let i=`${e} ${r}`;i!==this.movers&&(this.movers=i,R("movers").hidden=!e,R("movers").setAttribute("aria-pressed",String(r)))}progress(e){R("progress").value=e,R("bar").hidden=e>=1}say(e,r=!1){R("line").textContent=e,clearTimeout(this.timer),r||(this.timer=window.setTimeout(()=>{R("line").textContent=""},4e3))}lux(e){R("lux").hidden=e===void 0,R("lux").textContent=e??""}stick(e){let r=R("stick");r.hidden=!e,e&&(r.style.setProperty("left",`${e.startX}px`),r.style.setProperty("top",`${e.startY}px`)),R("tour").setAttribute("aria-pressed",String(!!this.walk?.touring))}jump(e){let r=this.walk,i=r.cameras[e];i&&(r.place=e,r.jump(i),this.show()?.changed(),this.say(i.name))}async copyLink(){let e=this.walk.toHash()+this.lights.toHash(),r=location.href.split("#")[0]+e;history.replaceState(null,"",e);try{await navigator.clipboard.writeText(r),this.say("A link to this view is on the clipboard.")}catch{this.say("The address now leads to this view.")}}key(e){let r=this.walk,i=this.show();if(!(!r||!i))switch(e){case"c":this.jump((r.place+1)%r.cameras.length);break;case"Home":this.jump(0);break;case"o":this.lights.toggle();break;case"m":r.clock.runs=!r.clock.runs;break;case"p":r.toggleTour();break;case"g":i.go(.5,.5);break;case"l":i.toggleLux();break;case"+":case"=":i.brighter(1);break;case"-":i.brighter(-1);break;case"x":i.automatic();break;case"?":R("sheet").showModal();break;default:/^[1-9]$/.test(e)&&this.jump(Number(e)-1)}}};var Ct=t=>{document.body.dataset.state=t};function An(t){R("fallback").hidden=!1,R("fallback-text").textContent=t,R("tools").hidden=R("bar").hidden=!0,R("view").hidden=!0,Ct("refused")}var Rn=3,Ln=!1,Ee=R("view"),oe=new ot;function Ss(){return Ee.getContext("webgl2",{antialias:!1,alpha:!1,depth:!1,powerPreference:"high-performance"})}var Ut=class{constructor(e,r,i){this.gl=e;this.scene=r;this.walk=i;this.lights=new it(r.groups,r.day,()=>this.show?.dim())}pieces=new Map;show;lights;begin(e=new ke(Et(this.gl))){let r=new Qe(e.device,{...this.scene,pages:this.scene.pages.slice()});this.show=new at(Ee,e,r,this.walk,oe,this.lights);for(let[i,n]of this.pieces)this.take(i,n)}take(e,r){this.pieces.set(e,r);let i=this.show,[n,a]=e.split(" "),o=Number(a);i&&(n==="light"&&r.pages[0]&&i.scene.setPage(o,r.pages[0]),n==="sharp"&&r.sharp&&i.scene.setSharp(r.sharp),n==="texture"&&r.textures[0]&&i.scene.setTexture(o,r.textures[0],!1),n==="normal"&&r.normals[0]&&i.scene.setTexture(o,r.normals[0],!0),n==="surround"&&r.surrounds[0]&&i.scene.setSurround(o,r.surrounds[0]),n==="field"&&r.field&&i.scene.movers.setField(r.field),n==="mover"&&r.movers[0]&&i.scene.movers.add(o,r.movers[0]),n==="lamps"&&r.pageGroups[0]&&i.scene.setPageGroups(r.pageGroups[0]),i.pieceCame())}};async function Ts(t){if(!("serviceWorker"in navigator)||!isSecureContext)return;let e=/pieces-([0-9a-f]+)\.json/.exec(document.body.dataset.pieces)?.[1];try{let r=await caches.open(`oriel ${new URL("./",location.href).pathname} ${e}`),i=[...document.querySelectorAll("script[src], link[href]")].map(n=>n.getAttribute("src")??n.getAttribute("href"));await r.addAll(["./",document.body.dataset.pieces,...i,...t.pieces.map(n=>n.file)]),await navigator.serviceWorker.register("offline.js"),document.body.dataset.offline="kept"}catch{}}var Es=t=>`${t.kind} ${t.index}`;async function Rs(){let t=await En(document.body.dataset.pieces,document.body.dataset.integrity),e=t.pieces.reduce((_,x)=>_+x.bytes,0),r=t.pieces.find(_=>_.kind==="scene");if(!r)throw new V("found no scene among the pieces");let i=Bt(r);i.catch(()=>{});let n=Ss();if(!n)return An("This page shows a building in three dimensions. Your browser cannot draw it: it lacks WebGL 2.");let a=new ke(Et(n));a.start();let o=r.bytes;oe.progress(.05);let s=Gt(await i,r.file),l=n.getParameter(n.MAX_TEXTURE_SIZE);Pn(s,r.file,l);let c=_=>t.pieces.filter(x=>x.kind===_).length;bn(s,c("texture"),c("normal"),c("surround"));let u=new et(s),h=new Ut(n,s,u);h.begin(a),Ln=!0,oe.begin(u,h.lights,()=>h.show);let f=new Ve(Ee,{key:_=>oe.key(_),go:(_,x)=>h.show?.go(_,x),hover:(_,x)=>h.show?.hover(_,x)}),m=!1,d=performance.now();Ee.addEventListener("webglcontextlost",_=>{_.preventDefault(),m=!0,h.show=void 0}),Ee.addEventListener("webglcontextrestored",()=>{m=!1,h.begin(),document.body.dataset.state==="whole"&&h.show.allCame()});let p=_=>{requestAnimationFrame(p);let x=Math.min((_-d)/1e3,.25);d=_,!m&&(h.show?.frame(f,x,_),h.show?.frames&&document.body.dataset.state==="loading"&&(n.finish(),performance.mark("first frame"),Ct("first")))},v=t.pieces.filter(_=>_!==r),b=[],g=_=>{for(let x=b.length;x<Math.min(_,v.length);++x)(b[x]=Bt(v[x])).catch(()=>{})};g(Rn),p(d),oe.progress(o/e);for(let[_,x]of v.entries()){g(_+Rn);let w=Gt(await b[_],x.file);As(w,x,l),x.kind==="light"&&qi(w.pages[0],h.pieces.get("sharp 0")?.sharp),x.kind==="mover"&&yn(w.movers[0],s),x.kind==="field"&&xn(w.field,s),x.kind==="lamps"&&wn(w.pageGroups[0],s,h.pieces.get(`light ${w.pageGroups[0].page}`)?.pages[0]),h.take(Es(x),w),oe.progress((o+=x.bytes)/e)}h.show?.allCame(),Ct("whole"),oe.progress(1),oe.sizes(e,h.show?.scene.bytes??0),await Ts(t)}function As(t,e,r){let n={light:t.pages,texture:t.textures,normal:t.normals,surround:t.surrounds,lamps:t.pageGroups,mover:t.movers,field:t.field?[t.field]:[],sharp:t.sharp?[t.sharp]:[]}[e.kind]?.length??0;if(n!==1)throw new V(`${e.file}: found ${n} of kind '${e.kind}', expected one`);Pn(t,e.file,r)}function Pn(t,e,r){let i=[...t.textures,...t.normals,...t.pages].map(n=>[n.width,n.height]);for(let n of t.pages)i.push([n.detailWidth,n.detailHeight]);for(let n of t.surrounds)i.push([1.5*n.size+4,n.size+64]);t.sharp&&i.push([ce,ji(t.sharp)]);for(let[n,a]of i)if(Math.max(n,a)>r)throw new V(`${e}: found an image of ${n} x ${a} texels, but this device holds at most ${r} a side`)}Rs().catch(t=>{Ln?oe.say(`A part is missing: ${t.message}`,!0):An(`This walkthrough cannot be shown: ${t.message}`),t instanceof V||console.error(t)});
