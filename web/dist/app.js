var V=class extends Error{},Le=class{constructor(e,r){this.bytes=e;this.name=r;this.view=new DataView(e.buffer,e.byteOffset,e.byteLength)}at=0;view;get left(){return this.bytes.length-this.at}fail(e){throw new V(`${this.name}: ${e}`)}take(e){return e>this.left&&this.fail(`found ${this.left} bytes more, expected ${e}`),this.at+=e,this.at-e}u8(){return this.view.getUint8(this.take(1))}u32(){return this.view.getUint32(this.take(4),!0)}u16(){return this.view.getUint16(this.take(2),!0)}i32(){return this.view.getInt32(this.take(4),!0)}f64(){return this.view.getFloat64(this.take(8),!0)}f32(){let e=this.view.getFloat32(this.take(4),!0);return Number.isFinite(e)||this.fail("found a number that is not finite"),e}floats(e){let r=[];for(let i=0;i<e;++i)r.push(this.f32());return r}count(e){let r=this.u32();return r*e>this.left&&this.fail(`found ${r} elements in ${this.left} bytes`),r}text(){let e=this.count(1),r=this.take(e);return new TextDecoder().decode(this.bytes.subarray(r,r+e))}choice(e,r){let i=this.u8();return i>e&&this.fail(`found ${r} ${i}, expected 0 to ${e}`),i}size(e,r){let i=this.u32();return i>e&&this.fail(`found ${r} ${i}, expected at most ${e}`),i}planes(e,r){e*r>this.left&&this.fail(`found ${this.left} bytes, expected ${e*r}`);let i=this.take(e*r),a=new Uint8Array(e*r);for(let n=0;n<r;++n){let o=0;for(let s=0,l=n,c=i+n*e;s<e;++s,l+=r)o=o+this.bytes[c+s]&255,a[l]=o}return a}planesF32(e,r=1){let i=new Float32Array(this.planes(e,4*r).buffer);for(let a=0;a<i.length;++a)Number.isFinite(i[a])||this.fail("found a number that is not finite");return i}planesU32(e){return new Uint32Array(this.planes(e,4).buffer)}planesU16(e,r=1){return new Uint16Array(this.planes(e,2*r).buffer)}f32s(e){return 4*e>this.left&&this.fail(`found ${this.left} bytes, expected ${4*e}`),Float32Array.from(this.floats(e))}u32s(e){4*e>this.left&&this.fail(`found ${this.left} bytes, expected ${4*e}`);let r=this.take(4*e),i=new Uint32Array(e);for(let a=0;a<e;++a)i[a]=this.view.getUint32(r+4*a,!0);return i}end(){this.left>0&&this.fail(`found ${this.left} bytes more than expected`)}};function Y(t){let e=t>>10&31,r=t&1023,i=t&32768?-1:1;return e===0?i*r*2**-24:e===31?NaN:i*(1+r/1024)*2**(e-15)}var Bt=new Float32Array(1),pa=new Uint32Array(Bt.buffer);function Dt(t){if(!(t<65504))return 31743;if(t<2**-14)return Math.round(t*2**24);Bt[0]=t;let e=pa[0]-939524096,r=e>>>13,i=e&8191;return r+ +(i>4096||i===4096&&(r&1)>0)}var ze=class{constructor(e,r){this.canvas=e;this.events=r;addEventListener("keydown",i=>this.key(i)),addEventListener("keyup",i=>this.down.delete(i.code)),addEventListener("blur",()=>this.reset()),e.addEventListener("pointerdown",i=>this.begin(i)),e.addEventListener("pointermove",i=>this.move(i)),e.addEventListener("pointerup",i=>this.end(i)),e.addEventListener("pointercancel",i=>this.fingers.delete(i.pointerId)),e.addEventListener("contextmenu",i=>i.preventDefault())}down=new Set;fingers=new Map;yaw=0;pitch=0;pressed=[];reset(){this.down.clear(),this.fingers.clear()}key(e){e.ctrlKey||e.altKey||e.metaKey||e.target instanceof Element&&e.target.closest("button, select, dialog, a")&&!/^Key[WASD]$/.test(e.code)||e.target instanceof HTMLSelectElement||(/^Arrow|^Space$/.test(e.code)&&e.preventDefault(),e.repeat||this.events.key(e.key.length===1?e.key.toLowerCase():e.key),this.down.add(e.code))}begin(e){if(e.button!==0)return;this.canvas.focus({preventScroll:!0});try{this.canvas.setPointerCapture(e.pointerId)}catch{}let r=e.pointerType==="touch"&&e.clientX<.5*innerWidth&&![...this.fingers.values()].some(i=>i.moves);this.fingers.set(e.pointerId,{x:e.clientX,y:e.clientY,startX:e.clientX,startY:e.clientY,begin:e.timeStamp,moves:r,far:!1})}move(e){let r=this.fingers.get(e.pointerId);if(!r){e.pointerType==="mouse"&&this.events.hover(...this.place(e));return}if(r.far||=Math.hypot(e.clientX-r.startX,e.clientY-r.startY)>12,!r.moves){let i=e.pointerType==="touch"?.006:.004;this.yaw+=(e.clientX-r.x)*i,this.pitch+=(e.clientY-r.y)*i}r.x=e.clientX,r.y=e.clientY}end(e){let r=this.fingers.get(e.pointerId);this.fingers.delete(e.pointerId),!(!r||r.far||e.timeStamp-r.begin>800)&&(e.pointerType!=="mouse"||e.detail>=2||this.doubled(e))&&this.events.go(...this.place(e))}lastClick=-1e9;doubled(e){let r=e.timeStamp-this.lastClick<400;return this.lastClick=e.timeStamp,r}place(e){let r=this.canvas.getBoundingClientRect();return[(e.clientX-r.left)/r.width,(e.clientY-r.top)/r.height]}get stick(){return[...this.fingers.values()].find(e=>e.moves&&e.far)}gamepad(e,r){let i=(navigator.getGamepads?.()??[]).find(o=>o?.connected);if(!i)return;let a=o=>{let s=i.axes[o]??0;return Math.abs(s)<.15?0:(s-Math.sign(s)*.15)/(1-.15)};e.right+=a(0),e.ahead-=a(1),e.yaw+=a(2)*2*r,e.pitch+=a(3)*2*r;let n=["g",void 0,"p",void 0,"Shift","c",void 0,void 0,"?","Home",void 0,void 0,"+","-"];e.fast||=!!i.buttons[4]?.pressed,i.buttons.forEach((o,s)=>{let l=n[s];o.pressed&&!this.pressed[s]&&l&&s!==4&&this.events.key(l),this.pressed[s]=o.pressed})}take(e){let r=n=>Number(this.down.has(n)),i={right:r("KeyD")-r("KeyA"),ahead:r("KeyW")-r("KeyS"),fast:!!(r("ShiftLeft")+r("ShiftRight")),yaw:-this.yaw+(r("ArrowRight")-r("ArrowLeft"))*1.5*e,pitch:-this.pitch+(r("ArrowDown")-r("ArrowUp"))*1.2*e};this.yaw=this.pitch=0;for(let n of this.fingers.values())!n.moves||!n.far||(i.right+=(n.x-n.startX)/60,i.ahead-=(n.y-n.startY)/60);this.gamepad(i,e);let a=n=>Math.min(Math.max(n,-1),1);return i.right=a(i.right),i.ahead=a(i.ahead),i}};var U=(t,e)=>[t[0]+e[0],t[1]+e[1],t[2]+e[2]],F=(t,e)=>[t[0]-e[0],t[1]-e[1],t[2]-e[2]],L=(t,e)=>[t[0]*e,t[1]*e,t[2]*e],B=(t,e)=>t[0]*e[0]+t[1]*e[1]+t[2]*e[2],O=(t,e)=>[t[1]*e[2]-t[2]*e[1],t[2]*e[0]-t[0]*e[2],t[0]*e[1]-t[1]*e[0]],j=t=>Math.hypot(t[0],t[1],t[2]),N=(t,e)=>{let r=j(t);return r>0&&Number.isFinite(r)?L(t,1/r):e};function Ct(){let t=new Float64Array(16);return t[0]=t[5]=t[10]=t[15]=1,t}function Q(t,e){let r=new Float64Array(16);for(let i=0;i<4;++i)for(let a=0;a<4;++a){let n=0;for(let o=0;o<4;++o)n+=t[4*o+a]*e[4*i+o];r[4*i+a]=n}return r}function ce(t,e){let r=[0,0,0,0];for(let i=0;i<4;++i)r[i]=t[i]*e[0]+t[4+i]*e[1]+t[8+i]*e[2]+t[12+i]*e[3];return r}var ee=(t,e)=>ce(t,[e[0],e[1],e[2],1]).slice(0,3);function It(t){let e=new Float64Array(16);for(let r=0;r<3;++r)for(let i=0;i<3;++i)e[4*i+r]=t[4*r+i];for(let r=0;r<3;++r)e[12+r]=-(t[4*r]*t[12]+t[4*r+1]*t[13]+t[4*r+2]*t[14]);return e[15]=1,e}function Pe(t,e){let r=Array.from({length:4},(i,a)=>[...Array.from({length:4},(n,o)=>t[4*a+o]),e[a]]);for(let i=0;i<4;++i){let a=i;for(let n=i+1;n<4;++n)Math.abs(r[n][i])>Math.abs(r[a][i])&&(a=n);[r[i],r[a]]=[r[a],r[i]];for(let n=0;n<4;++n){if(n===i)continue;let o=r[n][i]/r[i][i];for(let s=i;s<5;++s)r[n][s]-=o*r[i][s]}}return r.map((i,a)=>i[4]/i[a])}var he=()=>({lower:[1/0,1/0,1/0],upper:[-1/0,-1/0,-1/0]});function ae(t,e,r,i){t.lower[0]=Math.min(t.lower[0],e),t.lower[1]=Math.min(t.lower[1],r),t.lower[2]=Math.min(t.lower[2],i),t.upper[0]=Math.max(t.upper[0],e),t.upper[1]=Math.max(t.upper[1],r),t.upper[2]=Math.max(t.upper[2],i)}var oe=t=>L(U(t.lower,t.upper),.5),_e=t=>.5*j(F(t.upper,t.lower));function te(t,e){for(let r=0;r<6;++r){let i=r>>1,a=r&1?-1:1,n=t[15]+a*t[12+i];for(let o=0;o<3;++o){let s=t[4*o+3]+a*t[4*o+i];n+=s*(s>0?e.upper[o]:e.lower[o])}if(n<0)return!1}return!0}var Ut=`// Colour: linear Rec. 709 everywhere; sRGB only at the screen. The same as formats/core/color.h.

float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126, 0.7152, 0.0722)); }

// IEC 61966-2-1, per channel, [0,1] to [0,1].
vec3 srgb_from_linear(vec3 linear) {
  vec3 low = 12.92 * linear;
  vec3 high = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(high, low, vec3(lessThanEqual(linear, vec3(0.0031308))));
}

vec3 linear_from_srgb(vec3 shown) {
  vec3 low = shown / 12.92;
  vec3 high = pow((max(shown, vec3(0.04045)) + 0.055) / 1.055, vec3(2.4));
  return mix(high, low, vec3(lessThanEqual(shown, vec3(0.04045))));
}
`;var Ot=`// What tells how far away a surface is, in pictures of what reflectors show.
#ifdef NO_DISTANCE
const int u_alpha_kind = 0;
#else
uniform int u_alpha_kind;  // 0: nothing does; 1 one over the distance from the eye, 2 over depth
#endif
uniform vec4 u_depth_row;  // depth of a point of pack space = dot(row, point)
uniform float u_closest;   // least 1 / distance that is stored

float inverse_distance(vec3 eye, vec3 point) {
  float away = u_alpha_kind == 1 ? distance(eye, point) : dot(u_depth_row, vec4(point, 1.0));
  return clamp(1.0 / max(away, 1e-18), u_closest, 1e18);
}
`;var Nt=`// Filling holes of a reflected image. Light has 1 / distance in a, 0 where there is none.

// The weighted average of those that hold light and lie not nearer than the farthest by more than the factor \`reach\`: what
// comes into view beside a near thing is the ground behind it. A huge reach takes all.
vec4 farther_average(vec4 light[4], vec4 weight, float reach) {
  float farthest = 1e30;
  for (int i = 0; i < 4; ++i) {
    if (light[i].a > 0.0 && weight[i] > 0.0) farthest = min(farthest, light[i].a);
  }
  vec4 sum = vec4(0.0);
  float total = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (light[i].a <= 0.0 || light[i].a > reach * farthest) continue;
    sum += weight[i] * light[i];
    total += weight[i];
  }
  return total > 0.0 ? sum / total : vec4(0.0);
}
`;var Wt=`// One triangle that covers the viewport, from vertex numbers 0, 1, 2: no vertex buffer.
vec4 fullscreen_position(int vertex) {
  vec2 corner = vec2(float((vertex & 1) << 2) - 1.0, float((vertex & 2) << 1) - 1.0);
  return vec4(corner, 0.0, 1.0);
}
`;var $t=`// K as taps of equal energy by incidence (player/scene/kernel_taps.h): where a glossy lobe goes around the mirror direction.

// Where a cosine lies among the rows, row i of which is at cos theta = (i / (rows - 1))^2: the row below, and the share of the
// next.
vec2 kernel_row(float cos_theta, int rows) {
  float at = sqrt(clamp(cos_theta, 0.0, 1.0)) * float(rows - 1);
  float row = min(floor(at), float(max(rows - 2, 0)));
  return vec2(row, at - row);
}

// A tap between two rows: xy mirror coordinates, z width, w how much its light counts.
vec4 kernel_tap(sampler2D taps, int tap, vec2 row) {
  vec4 below = texelFetch(taps, ivec2(tap, int(row.x)), 0);
  return row.y > 0.0 ? mix(below, texelFetch(taps, ivec2(tap, int(row.x) + 1), 0), row.y) : below;
}

// The direction at mirror coordinates u, stereographic: |u| = 2 tan(gamma / 2). mirror, across and along are an orthonormal
// frame.
vec3 lobe_direction(vec3 mirror, vec3 across, vec3 along, vec2 u) {
  float q = 0.25 * dot(u, u);
  return ((1.0 - q) * mirror + u.x * across + u.y * along) / (1.0 + q);
}
`;var Ht=`// A place on a page of the lightmap, interpolated at the centroid of what a triangle covers of a pixel: at its middle,
// beside the triangle, lies another chart's light. A driver may take the point's 1/w from the middle all the same (Mesa
// 22's llvmpipe does), which scales all that it interpolates there: the third component, 1 everywhere, tells by how
// much.
vec2 lightmap_uv(vec3 v) {
  return v.xy / v.z;
}

// Where the image of details holds a cell of the page (formats/assets/lightmap.h).
struct DetailBlock {
  vec2 first;  // of its points
  float side;  // steps along a side; 1: the cell has no points of its own
};

DetailBlock detail_block(uint code) {
  return DetailBlock(vec2(code & 0x3fffu, code >> 14u & 0x3fffu), float(1u << (code >> 28u)));
}
`;var qt=`// Polygons of light in glossy lobes, in closed form: the twin of formats/query/lobe_light.h. Surface frame: z the normal, x the
// projection of the direction towards the eye on the surface, y = z x x.

// m11, m13, m22, m31 over m33 after the frame has turned by an angle of that cosine and sine: about y, z towards -x.
vec4 turned_lobe(vec4 m, float cosine, float sine) {
  return vec4(m.x * cosine + m.y * sine, m.y * cosine - m.x * sine, m.z, m.w * cosine + sine) / (cosine - m.w * sine);
}

// Inverse matrices in the frame of the mirror direction: between two of them, and back to the surface frame.
vec4 mix_lobes(vec4 a, vec4 b, float share) {
  vec4 m = mix(a, b, share);
  m.z = a.z * b.z / (b.z + (a.z - b.z) * share);
  return m;
}
vec4 lobe_in_surface_frame(vec4 m, float cos_theta) {
  return turned_lobe(m, cos_theta, -sqrt(max(0.0, 1.0 - cos_theta * cos_theta)));
}

// angle / sin(angle) by the cosine, [0, 1]: relative error 5e-7, an interpolation at Chebyshev's points.
float angle_over_sine(float c) {
  float high = -0.648626993 + c * (0.509054596 + c * (-0.323932017 + c * (0.135951283 - c * 0.0266371514)));
  return 1.57079558 + c * (-0.999903565 + c * (0.78329788 + c * high));
}

// Lambert's edge vector: the angle under which the edge a b is seen, along the normal of its plane. |a| |b| follows from the
// products (Lagrange); beyond 90 degrees angle / sine is pi / sine less that of the rest.
vec3 edge_vector(vec3 a, vec3 b) {
  vec3 normal = cross(a, b);
  float sine2 = dot(normal, normal), cosine = dot(a, b);
  float inverse = inversesqrt(max(sine2 + cosine * cosine, 1e-37));
  float acute = inverse * angle_over_sine(min(abs(cosine) * inverse, 1.0));
  return normal * (cosine < 0.0 ? 3.14159265359 * inversesqrt(max(sine2, 1e-37)) - acute : acute);
}

// What the lobe of integral 1 sees of a polygon above the surface, in the frame of its cosine: z is the integral of the lobe over
// it, without Fresnel; the vector points to where that light comes from on average, or the opposite way where z is negative.
// inverse: m11, m13, m22, m31 of LobeFit. v: convex, relative to the point, none of it below the surface, a triangle's last
// corner twice; of a size about 1, so that products of four coordinates are numbers. Counter-clockwise as seen from the point:
// positive, else negative.
// No corner list, which would be indexed by numbers: each edge is clipped to the transformed lobe's hemisphere for itself, and
// where a convex polygon leaves and enters it an edge along the horizon closes what is left.
vec3 reflected_vector(vec4 inverse, vec3 v[4]) {
  vec3 w[4];
  for (int i = 0; i < 4; ++i)
    w[i] = vec3(inverse.x * v[i].x + inverse.y * v[i].z, inverse.z * v[i].y, inverse.w * v[i].x + v[i].z);
  vec3 leaves = vec3(0.0), enters = vec3(0.0), sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    vec3 a = w[i], b = w[i == 3 ? 0 : i + 1];
    bool a_above = a.z >= 0.0, b_above = b.z >= 0.0;
    vec3 crossing = vec3(a.xy + (b.xy - a.xy) * (a_above == b_above ? 0.0 : a.z / (a.z - b.z)), 0.0);
    if (a_above && !b_above) leaves = crossing;
    if (!a_above && b_above) enters = crossing;
    vec3 part = edge_vector(a_above ? a : crossing, b_above ? b : crossing);
    sum += a_above || b_above ? part : vec3(0.0);
  }
  return -0.15915494309 * (sum + edge_vector(leaves, enters));
}

float reflected_polygon(vec4 inverse, vec3 v[4]) { return reflected_vector(inverse, v).z; }

// From the frame of the lobe's cosine to the surface's, not unit.
vec3 from_lobe(vec4 inverse, vec3 w) {
  float determinant = inverse.x - inverse.y * inverse.w;
  return vec3((w.x - inverse.y * w.z) / determinant, w.y / inverse.z, (inverse.x * w.z - inverse.w * w.x) / determinant);
}

// The same of a lobe that is one direction, over a square of that angle about it: the share of the square that the polygon covers,
// exact for a rectangle along it; negative where it is the polygon's other side. The angle may be 0: all or nothing.
float polygon_share(vec3 v[4], vec3 direction, float angle) {
  vec3 normal = cross(v[1] - v[0], v[2] - v[0]);
  float facing = dot(normal, v[0]);
  if (facing * dot(normal, direction) <= 0.0) return 0.0;
  float inside[4];  // sine of the angle from each edge to the direction, over the square's, within half of it
  for (int i = 0; i < 4; ++i) {
    vec3 edge = cross(v[i], v[i == 3 ? 0 : i + 1]);
    float size = length(edge), side = dot(edge, direction) * (facing < 0.0 ? -1.0 : 1.0);
    inside[i] = size > 0.0 ? clamp(side / max(size * angle, 1e-30), -0.5, 0.5) : 0.5;  // a triangle's last edge has no length
  }
  float share = max(inside[0] + inside[2], 0.0) * max(inside[1] + inside[3], 0.0);
  if (v[3] == v[2] && angle > 0.0) {  // a triangle's edges have no opposite ones: no more than all of it
    float way = length(v[0] + v[1] + v[2]) / 3.0;
    share = min(share, 0.5 * abs(facing) / (way * way * way * angle * angle));
  }
  return facing > 0.0 ? -share : share;
}
`;var Xt=`// What is seen at a pixel, as bright lights on movers need it: position, normal, and the mover (1 and up; 0: the scene).
#include "lib/octahedral.glsl"

struct LitSurface {
  vec3 position;
  vec3 normal;
  int id;  // -1: nothing that is lit
};

const int kNoSurface = 1023;

uvec4 pack_surface(vec3 position, vec3 normal, int id) {
  uvec2 n = uvec2((0.5 + 0.5 * octahedral_from_direction(normal)) * 2047.0 + 0.5);
  return uvec4(floatBitsToUint(position), n.x | n.y << 11 | uint(id) << 22);
}

LitSurface unpack_surface(uvec4 texel) {
  int id = int(texel.w >> 22);
  vec2 p = vec2(texel.w & 2047u, texel.w >> 11 & 2047u) / 1023.5 - 1.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return LitSurface(uintBitsToFloat(texel.xyz), normalize(n), id == kNoSurface ? -1 : id);
}
`;var jt=`// The direction that an eye ray is reflected into, about a normal of any length; normal: what the eye sees of it, unit.
vec3 mirrored(vec3 tilted, vec3 view, out vec3 normal, out float cos_theta) {
  float length2 = dot(tilted, tilted);
  normal = length2 > 0.0 ? tilted * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
  cos_theta = -dot(normal, view);
  if (cos_theta < 0.0) {  // it turns away at the silhouette: bent back until the view grazes it
    normal = normalize(normal + (cos_theta - 1e-4) * view);
    cos_theta = 0.0;
  }
  return normalize(reflect(view, normal));
}

// How far neighbouring pixels' directions part, radians.
float spread_of(vec3 mirror) { return min(0.5 * (length(dFdx(mirror)) + length(dFdy(mirror))), 2.0); }
`;var Kt=`// Normal maps: how a texel tilts a surface's normal, the same as formats/assets/normal_map.h.

// The tangent of a surface with unit normal n from two steps on it and the changes of the texture coordinates over them.
// xyz along dp/du, any length; w: the side of the bitangent w cross(n, xyz), which is that of -dp/dv (v down).
vec4 tangent_of_steps(vec3 n, vec3 step_a, vec3 step_b, vec2 uv_a, vec2 uv_b) {
  float turn = sign(uv_a.x * uv_b.y - uv_a.y * uv_b.x);
  vec3 along_u = turn * (uv_b.y * step_a - uv_a.y * step_b);
  vec3 along_v = turn * (uv_a.x * step_b - uv_b.x * step_a);
  return vec4(along_u, dot(cross(n, along_u), along_v) > 0.0 ? -1.0 : 1.0);
}

// The unit normal that the texel makes of the unit normal n; n itself where the tangent or the texel says nothing.
vec3 tilted_normal(vec3 n, vec4 tangent, vec3 texel, float scale) {
  vec3 size = abs(tangent.xyz);
  vec3 unit = tangent.xyz / max(max(size.x, max(size.y, size.z)), 1e-30);
  vec3 across = unit - dot(n, unit) * n;
  float across_length = length(across);
  if (!(across_length > 1e-6)) return n;
  vec3 t = across / across_length;
  vec3 b = tangent.w * cross(n, t);
  vec3 local = 2.0 * texel - 1.0;
  vec3 tilted = scale * (local.x * t + local.y * b) + max(local.z, 0.0) * n;
  float size2 = dot(tilted, tilted);
  return size2 > 1e-12 ? tilted / sqrt(size2) : n;
}

// Irradiance over 2 pi m under an even hemisphere and a lamp in direction \`towards\`, whose length is its share. The part of
// a tilted lobe that is below the surface counts above it.
float light_on(vec3 normal, vec3 g, float lamp, vec3 towards) {
  vec3 mirrored = normal - 2.0 * dot(normal, g) * g;
  return 1.0 - lamp + 2.0 * (max(dot(towards, normal), 0.0) + max(dot(towards, mirrored), 0.0));
}

// E(n) / E(g) of a directional lightmap's d (formats/assets/lightmap.h).
float directional_ratio(vec3 d, vec3 n, vec3 g) {
  vec3 off = d - 0.5 * g;
  float h = 0.5 - dot(d, g);
  float lamp = clamp((sqrt(h * h + 3.0 * dot(off, off)) - h) / 1.5, 0.0, 1.0);
  vec3 towards = off + 0.5 * lamp * g;
  float untilted = light_on(g, g, lamp, towards);
  return max(1.0 + (light_on(n, g, lamp, towards) - untilted) / max(untilted, 0.1), 0.0);
}
`;var Yt=`// Directions on a square, the same maths as formats/core/octahedral.h, and the levels of a map of it in one image with borders
// (player/images/surround_pyramid.h).

// The point of [-1, 1]^2 of a direction of any length but 0.
vec2 octahedral_from_direction(vec3 d) {
  vec2 p = d.xy / (abs(d.x) + abs(d.y) + abs(d.z));
  if (d.z >= 0.0) return p;
  return (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
}

// Texels of a map of that size in a radian around a unit direction, the mean of both ways.
float octahedral_density(vec3 d, int size) { return 0.5 * float(size) * pow(abs(d.x) + abs(d.y) + abs(d.z), -1.5); }

// Where point p of the map lies at a level of the image.
vec2 pyramid_uv(vec2 p, int size, int level, vec2 image_size) {
  vec2 corner = level == 0 ? vec2(0.0) : vec2(float(size + 2), float(size - (size >> (level - 1)) + 2 * (level - 1)));
  return (corner + 1.0 + (0.5 * p + 0.5) * float(size >> level)) / image_size;
}

// Light from a direction, between two levels.
vec3 pyramid_light(sampler2D light, int size, vec3 direction, float level) {
  vec2 p = octahedral_from_direction(direction), image_size = vec2(textureSize(light, 0));
  float at = clamp(level, 0.0, log2(float(size)));
  int low = int(at);
  vec3 fine = textureLod(light, pyramid_uv(p, size, low, image_size), 0.0).rgb;
  if (at <= float(low)) return fine;
  return mix(fine, textureLod(light, pyramid_uv(p, size, low + 1, image_size), 0.0).rgb, at - float(low));
}
`;var Qt=`// R: the directional albedo of a material's specular lobe (formats/assets/fresnel_map.h).

// Linear between the entries of row \`row\`; entry i of count is at cos theta = (i / (count - 1))^2.
vec3 reflectance_from_table(sampler2D tables, int row, int count, float cos_theta) {
  float at = sqrt(clamp(cos_theta, 0.0, 1.0)) * float(count - 1);
  int low = min(int(at), max(count - 2, 0));
  vec3 a = texelFetch(tables, ivec2(low, row), 0).rgb;
  vec3 b = texelFetch(tables, ivec2(min(low + 1, count - 1), row), 0).rgb;
  return mix(a, b, at - float(low));
}
`;var Zt=`// The shading equation of docs/conventions.md: L = kd (1 - max R) / pi E + S + emission.
const float kPi = 3.14159265358979323846;

float max_channel(vec3 v) { return max(v.r, max(v.g, v.b)); }

// The diffuse part kd * D, cd/m2. irradiance in lux.
vec3 diffuse_light(vec3 kd, vec3 reflectance, vec3 irradiance) {
  return kd * (1.0 - max_channel(reflectance)) * irradiance / kPi;
}

// What a wide lobe shows where there is no image to reflect: the light around, without direction.
vec3 ambient_reflection(vec3 reflectance, vec3 irradiance) { return reflectance * irradiance / kPi; }

// Cosine between a surface's normal, as its map tilted it, and the direction to the eye: 0 where it turns away from an eye
// that sees the surface from the side of \`normal\` or of its opposite. Normals of any length. eye: a point (w = 1), or the
// direction to it (w = 0, orthographic).
float view_cosine(vec3 tilted, vec3 normal, vec3 position, vec4 eye) {
  vec3 to_eye = eye.xyz - position * eye.w;
  float length2 = dot(tilted, tilted) * dot(to_eye, to_eye);
  float side = dot(normal, to_eye) < 0.0 ? -1.0 : 1.0;
  return length2 > 0.0 ? clamp(side * dot(tilted, to_eye) * inversesqrt(length2), 0.0, 1.0) : 1.0;
}
`;var Jt=`// Marching a reflected ray through the distances around a point (formats/assets/surround_map.h), the same as
// tests/player/twins/surround_march.h, which tells what the numbers mean.
#include "lib/octahedral.glsl"

const int kSurroundSteps = 24;
const int kSurroundHalvings = 4;
const float kSurroundThickness = 0.5;
const float kSurroundBeside = 4.0;

// Inverse distance of the surface seen from the centre; nearest texel in y.
vec2 surround_distance(sampler2D inverse_distance, int size, vec3 direction) {
  vec2 uv = pyramid_uv(octahedral_from_direction(direction), size, 0, vec2(textureSize(inverse_distance, 0)));
  ivec2 texel = ivec2(uv * vec2(textureSize(inverse_distance, 0)));
  return vec2(textureLod(inverse_distance, uv, 0.0).r, texelFetch(inverse_distance, texel, 0).r);
}

// The point of the arc at an angle to the ray's direction: xyz the direction from the centre, w the inverse distance along the ray.
vec4 arc_point(vec3 side, vec3 direction, float h, float along, float angle) {
  return vec4(cos(angle) * direction + sin(angle) * side, 1.0 / max(h * cos(angle) / sin(angle) - along, 1e-6 * h));
}

// What the ray meets: xyz the direction from the centre, unit; w the inverse distance along the ray, 0 for the sky.
vec4 march_surroundings(sampler2D inverse_distance, int size, vec2 range, vec3 origin, vec3 direction) {
  float along = dot(origin, direction);
  vec3 nearest = origin - along * direction;
  float h = length(nearest), from_centre = length(origin);
  vec4 beside = vec4(0.0);  // where the ray was hidden last
  if (h > 1e-5 * from_centre) {
    vec3 side = nearest / h;
    float begin = atan(h, along);
    if (from_centre * range.x < 1.0) begin = min(begin, asin(min(h * range.x, 1.0)));
    float end = asin(min(h * range.y, 1.0));
    int steps = clamp(int(ceil((begin - end) * 0.5 * float(size))), 1, kSurroundSteps);
    float before = begin;
    vec3 way = cos(begin) * direction + sin(begin) * side;
    bool in_front = surround_distance(inverse_distance, size, way).x * h <= sin(begin) * (1.0 + kSurroundThickness);
    for (int i = 1; i <= steps && begin > end; ++i) {
      float at = mix(begin, end, float(i) / float(steps));
      way = cos(at) * direction + sin(at) * side;
      bool behind = surround_distance(inverse_distance, size, way).x * h >= sin(at);
      if (in_front && behind) {
        float low = before, high = at;  // in front at low, behind at high
        for (int k = 0; k < kSurroundHalvings; ++k) {
          float middle = 0.5 * (low + high);
          way = cos(middle) * direction + sin(middle) * side;
          if (surround_distance(inverse_distance, size, way).x * h >= sin(middle)) high = middle;
          else low = middle;
        }
        vec3 at_low = cos(low) * direction + sin(low) * side, at_high = cos(high) * direction + sin(high) * side;
        float over = sin(low) - surround_distance(inverse_distance, size, at_low).x * h;
        float under = surround_distance(inverse_distance, size, at_high).x * h - sin(high);
        float hit = over + under > 0.0 ? mix(low, high, clamp(over / (over + under), 0.0, 1.0)) : high;
        vec4 met = arc_point(side, direction, h, along, hit);
        float surface = surround_distance(inverse_distance, size, met.xyz).y * h;
        if (abs(surface - sin(hit)) <= kSurroundThickness * sin(hit)) return met;
        beside = arc_point(side, direction, h, along, min(low + kSurroundBeside / float(size), begin));
        in_front = false;
      } else if (!behind) {
        in_front = true;
      }
      before = at;
    }
    if (!in_front && beside.w > 0.0) return beside;
  }
  float w = surround_distance(inverse_distance, size, direction).y;
  return vec4(direction, w > 0.0 ? 1.0 / max(1.0 / w - along, 1e-3 / w) : 0.0);
}
`;var er=`// Light that movers take from the scene, from a picture of half the frame's size: from the pixels around that are of the
// same surface.

// Lux. at: place in the picture, pixels. surfaces: LitSurface. p, n: position and unit normal here.
vec3 taken_light(sampler2D change, usampler2D surfaces, vec2 at, vec3 p, vec3 n) {
  vec2 first = floor(at - 0.5), part = at - 0.5 - first;
  ivec2 last = textureSize(change, 0) - 1;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 step = ivec2(i & 1, i >> 1);
    ivec2 texel = clamp(ivec2(first) + step, ivec2(0), last);
    vec2 near = mix(1.0 - part, part, vec2(step));
    vec3 off = uintBitsToFloat(texelFetch(surfaces, texel, 0).xyz) - p;
    float out_of_plane = dot(off, n);  // as the sine of an angle: 0 on the same plane
    float same = max(1.0 - 8.0 * out_of_plane * out_of_plane / max(dot(off, off), 1e-20), 1e-3);
    sum += near.x * near.y * same * vec4(texelFetch(change, texel, 0).rgb, 1.0);
  }
  return sum.rgb / max(sum.a, 1e-20);
}
`;var tr=`// Tone curves: linear light, 1 = the luminance that the exposure maps to white, to linear display values in [0,1].

// Plain exposure: clips.
vec3 tonemap_none(vec3 light) { return clamp(light, 0.0, 1.0); }

// Narkowicz 2016, "ACES Filmic Tone Mapping Curve": a fit per channel.
vec3 tonemap_aces(vec3 light) {
  vec3 x = clamp(light, 0.0, 1e4);  // the curve is flat long before, and squares must stay finite
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

// Walls lit by a far lamp change by less than a step of the display over a metre: rounded alone they show contours.
// Between -1/2 and 1/2 of a step; Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare".
float dither(vec2 pixel) {
  return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5;
}
`;var rr=`// Light of a vertex from its transfer (formats/assets/transfer.h) and the table of its mover's light
// (player/movers/mover_light.h): irradiance over pi.
const int kWeightsWidth = 2048;  // texels a row

// q: where the vertex is in its mover's box, [-1,1].
vec3 transferred_light(isampler2D weights, sampler2D table, int components, int vertex, int cluster, vec3 q) {
  vec4 red = texelFetch(table, ivec2(0, cluster), 0);
  vec4 green = texelFetch(table, ivec2(1, cluster), 0);
  vec4 blue = texelFetch(table, ivec2(2, cluster), 0);
  int first = vertex * ((components + 3) / 4);
  for (int k = 0; k < components; k += 4) {
    int at = first + k / 4;
    vec4 w = vec4(texelFetch(weights, ivec2(at % kWeightsWidth, at / kWeightsWidth), 0)) / 32767.0;
    for (int i = 0; i < 4; ++i) {
      int texel = 3 * (k + i + 1);
      if (k + i >= components) break;
      red += w[i] * texelFetch(table, ivec2(texel, cluster), 0);
      green += w[i] * texelFetch(table, ivec2(texel + 1, cluster), 0);
      blue += w[i] * texelFetch(table, ivec2(texel + 2, cluster), 0);
    }
  }
  vec4 at = vec4(1.0, q);
  return vec3(dot(red, at), dot(green, at), dot(blue, at));
}
`;var ir=`// A mover: shaded as the opaque scene is, its light from transfer by vertex and from bright lights by pixel.
#include "passes/surface.glsl"
#include "lib/lit_surface.glsl"

uniform sampler2D u_change;     // lux by pixel of bright lights
uniform usampler2D u_surfaces;  // where there is any
uniform bool u_changed;

in vec3 v_light;

// Of a pixel whose middle this mover does not cover, that beside it.
vec3 bright_light() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(u_change, 0) - 1;
  for (int i = 0; i < 9; ++i) {
    int k = (i + 4) % 9;  // itself first
    ivec2 texel = clamp(at + ivec2(k % 3, k / 3) - 1, ivec2(0), last);
    if (int(texelFetch(u_surfaces, texel, 0).w >> 22) != kNoSurface) return texelFetch(u_change, texel, 0).rgb;
  }
  return vec3(0.0);
}

vec3 irradiance_here(vec3 normal) {
  vec3 irradiance = kPi * max(v_light, 0.0);
  if (u_changed) irradiance += bright_light();
  return irradiance;
}

#include "passes/opaque.glsl"
`;var ar=`// A vertex of a mover with its light.
#include "lib/transfer.glsl"

layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_uv;
layout(location = 4) in vec4 a_color;
layout(location = 5) in vec2 a_normal_uv;
layout(location = 6) in vec4 a_tangent;
layout(location = 7) in float a_cluster;
uniform mat4 u_clip_from_pack;  // from the object, as passes/depth.vert takes it
uniform mat4 u_pack_from_object;
uniform vec3 u_box_center;
uniform vec3 u_box_scale;  // one over half its size, 0 where flat
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

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = (u_pack_from_object * vec4(a_position, 1.0)).xyz;
  v_normal = mat3(u_pack_from_object) * a_normal;
  v_uv = a_uv;
  v_color = a_color;
  v_normal_uv = a_normal_uv;
  v_tangent = vec4(mat3(u_pack_from_object) * a_tangent.xyz, a_tangent.w);
  vec3 q = (a_position - u_box_center) * u_box_scale;
  v_light = transferred_light(u_codes, u_table, u_components, gl_VertexID, int(a_cluster + 0.5), q);
}
`;var nr=`// Curved reflectors. SHADED: their light is there by pixel (screen_curved), for the middles of pixels that they cover: edges
// between take a neighbour's. A program of its own for it: software rasterisers run every branch, and a whole block of pixels
// for each triangle that touches it.
#include "passes/surface.glsl"
#include "passes/curved_lobe.glsl"
#include "lib/mirrored.glsl"

uniform bool u_modulate;  // by R
#ifdef SHADED
uniform sampler2D u_shaded;  // a: whose light it is
uniform float u_id;
#endif
layout(location = 0) out vec4 o_light;

#ifdef SHADED
vec3 shaded_light(vec3 mirror) {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(u_shaded, 0) - 1;
  vec4 found = texelFetch(u_shaded, at, 0);
  float away = found.a == u_id ? 0.0 : 9.0;
  for (int i = 0; i < 9; ++i) {
    ivec2 step = ivec2(i % 3, i / 3) - 1;
    vec4 beside = texelFetch(u_shaded, clamp(at + step, ivec2(0), last), 0);
    float here = float(abs(step.x) + abs(step.y));
    if (beside.a != u_id || here >= away) continue;
    found = beside;
    away = here;
  }
  if (away < 9.0) return found.rgb;
  // Thinner than a pixel: about the same, without its parallax.
  return pyramid_light(u_light, u_size, mirror, u_tap_count > 1 ? log2(float(u_size)) - 2.0 : 0.0);
}
#endif

void main() {
  vec3 tilted = tilted_by_map(), normal;
  float cos_theta;
  vec3 mirror = mirrored(tilted, normalize(v_position * u_eye.w - u_eye.xyz), normal, cos_theta);
#ifdef SHADED
  vec3 light = shaded_light(mirror);
#else
  vec3 light = curved_light(v_position, normal, mirror, cos_theta, spread_of(mirror));
#endif
  light *= u_light_scale;
  o_light = vec4(u_modulate ? light * reflectance_of(tilted) : light, 1.0);
}
`;var or=`#include "passes/surface_vertex.glsl"
`;var sr=`// Light that a curved reflector mirrors: the eye ray is reflected about the normal; the lobe is taps of the kernel, each from the
// level of the surround map as wide as the tap at the distance that is met. For a narrow lobe that is where the mirrored ray,
// marched through the distances around, ends. In a wide one each tap finds its own: with one distance for all, its light
// jumped where that ray passes an edge.
#include "lib/kernel.glsl"
#include "lib/surround.glsl"

uniform vec3 u_centre;
uniform int u_size;
uniform sampler2D u_light;  // over u_light_scale
uniform vec3 u_light_scale;
uniform sampler2D u_inverse_distance;
uniform vec2 u_range;
uniform sampler2D u_taps;  // see kernel_tap()
uniform int u_tap_count;   // 1: a mirror
uniform bool u_wide;       // the lobe
uniform int u_tap_rows;

// Light from around a direction of a bundle that leaves the surface at \`origin\` and meets something at that distance; spread is
// its width in radians.
vec3 light_along(vec3 origin, vec3 direction, float inverse_distance, float spread) {
  vec3 from_centre = direction + origin * inverse_distance;
  float stretch = length(from_centre);
  if (stretch < 1e-3) return vec3(0.0);
  from_centre /= stretch;
  float texels = spread / stretch * octahedral_density(from_centre, u_size);
  return pyramid_light(u_light, u_size, from_centre, log2(max(texels, 1.0)));
}

const int kTapSteps = 2;
const float kTapSphere = 1.5;  // of the surface's distance from the centre

// The inverse distance at which a tap meets something: where it leaves the sphere around the map's centre on which lies what the map
// shows in the direction of the last guess. What the map shows nearer to its centre than the surface is, or little further, is no
// sphere that the tap could leave: it is taken as far away as kTapSphere tells, else narrow sides of boxes looked like crumpled foil.
float tap_distance(vec3 origin, vec3 direction) {
  float along = dot(origin, direction), apart = dot(origin, origin) - along * along;
  float least = kTapSphere * length(origin);
  vec3 way = direction;
  float inverse = 0.0;
  for (int i = 0; i <= kTapSteps; ++i) {
    float seen = surround_distance(u_inverse_distance, u_size, way).x;
    if (!(seen > 0.0)) return 0.0;  // the sky
    float radius = max(1.0 / seen, least);
    inverse = 1.0 / (sqrt(radius * radius - apart) - along);
    way = normalize(direction + origin * inverse);
  }
  return inverse;
}

// inverse_distance: of the mirrored ray, in a narrow lobe.
vec3 lobe_light(vec3 origin, vec3 normal, vec3 mirror, float cos_theta, float inverse_distance, float spread) {
  vec3 along = normal - dot(normal, mirror) * mirror;
  vec3 side = cross(mirror, abs(mirror.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0));
  along = dot(along, along) > 1e-8 ? normalize(along) : normalize(side);
  vec3 across = cross(mirror, along);
  vec2 row = kernel_row(cos_theta, u_tap_rows);
  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int i = 0; i < u_tap_count; ++i) {
    vec4 tap = kernel_tap(u_taps, i, row);
    vec3 direction = lobe_direction(mirror, across, along, tap.xy);
    if (dot(direction, normal) <= 0.0) continue;
    float inverse = u_wide ? tap_distance(origin, direction) : inverse_distance;
    sum += tap.w * light_along(origin, direction, inverse, max(tap.z, spread));
    total += tap.w;
  }
  return total > 0.0 ? sum / total : light_along(origin, mirror, inverse_distance, spread);
}

// (M * K), over u_light_scale. normal: unit, as mirrored() gives it.
vec3 curved_light(vec3 position, vec3 normal, vec3 mirror, float cos_theta, float spread) {
  vec3 origin = position - u_centre;
  float inverse = u_wide ? 0.0 : march_surroundings(u_inverse_distance, u_size, u_range, origin, mirror).w;
  return u_tap_count > 1 ? lobe_light(origin, normal, mirror, cos_theta, inverse, spread)
                         : light_along(origin, mirror, inverse, spread);
}
`;var lr=`// Where a curved reflector is and how it is turned, by pixel.
#include "passes/surface.glsl"
#include "lib/mirrored.glsl"

layout(location = 0) out vec4 o_place;   // a: how far the directions part that neighbouring pixels are mirrored into, radians
layout(location = 1) out vec4 o_normal;  // any length

void main() {
  vec3 tilted = tilted_by_map(), normal;
  float cos_theta;
  vec3 mirror = mirrored(tilted, normalize(v_position * u_eye.w - u_eye.xyz), normal, cos_theta);
  o_place = vec4(v_position, spread_of(mirror));
  o_normal = vec4(tilted, 1.0);
}
`;var cr=`#include "passes/surface_vertex.glsl"
`;var ur=`// Depth of the opaque scene. Only cut-outs need the texture.
uniform sampler2D u_base_texture;
uniform float u_alpha;
#ifdef PLAIN
const float u_alpha_cutoff = -1.0;
#else
uniform float u_alpha_cutoff;  // negative: no cut-outs
#endif
in vec2 v_uv;
in float v_alpha;

void main() {
  if (u_alpha_cutoff >= 0.0 && texture(u_base_texture, v_uv).a * u_alpha * v_alpha < u_alpha_cutoff) discard;
}
`;var hr=`layout(location = 0) in vec3 a_position;
layout(location = 2) in vec2 a_uv;
layout(location = 4) in vec4 a_color;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec2 v_uv;
out float v_alpha;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_uv = a_uv;
  v_alpha = a_color.a;
}
`;var fr=`// Baked light on a surface of the scene that stands still.
#include "passes/surface.glsl"
#include "lib/lightmap_uv.glsl"

uniform sampler2D u_lightmap;
uniform float u_lightmap_scale;  // lux; 0: nothing was baked
uniform sampler2D u_direction;   // of a directional lightmap
uniform bool u_detailed;         // some cells between texels have light of their own
uniform highp usampler2D u_cells;
uniform sampler2D u_detail;
#ifdef PLAIN
const bool u_directional = false;
#else
uniform bool u_directional;
#endif

centroid in vec3 v_lightmap_uv;

const float kFullyFine = 1.5;  // steps between places up to which all points show: bilinear ones are two wide
const float kFewPlaces = 8.0;  // steps along a side up to which four places are enough, else sixteen

// The finest that is known at a place, in texels from the centre of the first: between a finer cell's own points, or texels.
vec3 finest_light(vec2 at) {
  vec2 size = vec2(textureSize(u_lightmap, 0));
  at = clamp(at, vec2(0.0), size - 1.0);
  vec2 corner = min(floor(at), max(size - 2.0, vec2(0.0)));
  DetailBlock block = detail_block(texelFetch(u_cells, ivec2(corner), 0).r);
  if (block.side < 1.5) return textureLod(u_lightmap, (at + 0.5) / size, 0.0).rgb;
  vec2 place = (block.first + (at - corner) * block.side + 0.5) / vec2(textureSize(u_detail, 0));
  return textureLod(u_detail, place, 0.0).rgb;
}

// A pixel that is wider than a cell's step is averaged over four places, in a row where it is long, else in a square; over
// four around each of them where the cell has more than eight steps. Where these are too few points would flicker: the cell
// fades to its texels until places are as far from each other as they.
vec3 lightmap_at(vec2 uv) {
  vec3 light = texture(u_lightmap, uv).rgb;
  if (!u_detailed) return light;
  vec2 size = vec2(textureSize(u_lightmap, 0));
  vec2 at = uv * size - 0.5;
  vec2 dx = dFdx(at), dy = dFdy(at);
  vec2 corner = min(floor(clamp(at, vec2(0.0), size - 1.0)), max(size - 2.0, vec2(0.0)));
  float side = detail_block(texelFetch(u_cells, ivec2(corner), 0).r).side;
  if (side < 1.5) return light;
  bool along_x = dot(dx, dx) > dot(dy, dy);
  vec2 longer = along_x ? dx : dy, shorter = along_x ? dy : dx;
  float length_of_longer = length(longer);
  if (length_of_longer * side <= 1.0) return finest_light(at);
  bool row = length_of_longer > 2.0 * length(shorter);
  float apart = row ? max(0.25 * length_of_longer, length(shorter)) : 0.5 * length_of_longer;
  if (apart >= 1.0) return light;
  vec3 sum = vec3(0.0);
  int around = side > kFewPlaces ? 4 : 1;
  for (int k = 0; k < 4; ++k) {
    vec2 place = row ? vec2(0.25 * float(k) - 0.375, 0.0) : vec2(0.5 * float(k & 1) - 0.25, 0.5 * float(k >> 1) - 0.25);
    for (int j = 0; j < around; ++j) {
      vec2 beside = around == 1 ? vec2(0.0) : 0.25 * vec2(float(j & 1) - 0.5, float(j >> 1) - 0.5) * (row ? vec2(0.5, 2.0) : vec2(1.0));
      sum += finest_light(at + (place.x + beside.x) * longer + (place.y + beside.y) * shorter);
    }
  }
  side = min(side, kFewPlaces);
  float faded = log2(max(apart * side / kFullyFine, 1.0)) / log2(side / kFullyFine);
  return mix(sum / float(4 * around), light, clamp(faded, 0.0, 1.0));
}

#ifdef BICUBIC
uniform sampler2D u_inner;  // 1 at texels that are of one chart with all within two texels

// How much of the light at a place is the spline's: all where the four texels around are inner ones and no cell that
// touches them is finer, 0 where it would read another chart's texels, without a step between.
float bicubic_share(vec2 uv, vec2 size) {
  if (vec2(textureSize(u_inner, 0)) != size) return 0.0;  // a page that is shown coarser
  float share = texture(u_inner, uv).r;
  if (!u_detailed || share == 0.0) return share;
  vec2 at = clamp(uv * size - 0.5, vec2(0.0), size - 1.0);
  ivec2 corner = ivec2(at);
  vec4 plain = vec4(1.0);  // texels at (0, 0), (1, 0), (0, 1), (1, 1) of the cell
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      ivec2 cell = clamp(corner + ivec2(i, j), ivec2(0), ivec2(size) - 1);
      if (texelFetch(u_cells, cell, 0).r == 0u) continue;
      bvec2 lower = bvec2(i <= 0, j <= 0), upper = bvec2(i >= 0, j >= 0);
      plain *= 1.0 - vec4(lower.x && lower.y, upper.x && lower.y, lower.x && upper.y, upper.x && upper.y);
    }
  vec4 inner = vec4(texelFetch(u_inner, corner, 0).r, texelFetch(u_inner, corner + ivec2(1, 0), 0).r,
                    texelFetch(u_inner, corner + ivec2(0, 1), 0).r, texelFetch(u_inner, corner + ivec2(1, 1), 0).r);
  vec4 kept = plain * inner;
  vec2 f = at - vec2(corner);
  return mix(mix(kept.x, kept.y, f.x), mix(kept.z, kept.w, f.x), f.y);
}

// A uniform cubic B-spline over sixteen texels: of four places between texels (Sigg and Hadwiger 2005).
vec3 spline_light(vec2 uv, vec2 size) {
  vec2 at = uv * size - 0.5;
  vec2 corner = floor(at), f = at - corner, g = 1.0 - f;
  vec2 w0 = g * g * g / 6.0, w3 = f * f * f / 6.0;
  vec2 w1 = 2.0 / 3.0 - f * f * (1.0 - 0.5 * f), w2 = 2.0 / 3.0 - g * g * (1.0 - 0.5 * g);
  vec2 first = (corner - 0.5 + w1 / (w0 + w1)) / size, second = (corner + 1.5 + w3 / (w2 + w3)) / size;
  vec2 share = w2 + w3;
  return mix(mix(textureLod(u_lightmap, first, 0.0).rgb, textureLod(u_lightmap, vec2(second.x, first.y), 0.0).rgb, share.x),
             mix(textureLod(u_lightmap, vec2(first.x, second.y), 0.0).rgb, textureLod(u_lightmap, second, 0.0).rgb, share.x),
             share.y);
}
#endif

#ifdef VERTEX_LIGHT
centroid in vec3 v_light;

vec3 baked_light() {
  return max(v_light / v_lightmap_uv.z, 0.0);
}
#else
vec3 baked_light() {
  vec2 uv = lightmap_uv(v_lightmap_uv);
  vec3 light = lightmap_at(uv);
#ifdef BICUBIC
  vec2 size = vec2(textureSize(u_lightmap, 0));
  light = mix(light, spline_light(uv, size), bicubic_share(uv, size));
#endif
  return light * u_lightmap_scale;
}
#endif

// Lightmaps hold the light of fronts: a back that is lit is a surface of its own.
vec3 irradiance_on(vec3 tilted) {
  vec3 irradiance = baked_light();
  if (!gl_FrontFacing) return vec3(0.0);
  if (!u_normal_mapped || !u_directional) return irradiance;
  return irradiance * directional_ratio(texture(u_direction, lightmap_uv(v_lightmap_uv)).xyz, tilted, front_normal());
}
`;var mr=`// The light of an opaque surface. To be included after irradiance_here(normal), lux.
uniform sampler2D u_base_texture;
uniform vec4 u_base_color;
#ifdef PLAIN
const float u_alpha_cutoff = -1.0;
const bool u_unlit = false;
#else
uniform float u_alpha_cutoff;  // negative: no cut-outs
uniform bool u_unlit;
#endif
#if defined(PLAIN) && !defined(REFLECTED)
#define NO_DISTANCE
#endif
#include "lib/distance_alpha.glsl"
uniform float u_diffuse_share;  // (1 - metallic) (1 - transmission)
uniform vec3 u_emission;        // cd/m2, of white texels; of an unlit surface what shows its colour
#ifndef PLAIN
uniform sampler2D u_emission_texture;
#endif
uniform vec3 u_weights;  // of the diffuse part, the undirected reflection, the emission: 0 or 1

in vec2 v_uv;
in vec4 v_color;
layout(location = 0) out vec4 o_light;  // a: where it tells no distance, the kind of light: 1 cd/m2, 2 that of an unlit surface

float alpha_of_light(float kind) { return u_alpha_kind == 0 ? kind : inverse_distance(u_eye.xyz, v_position); }

void main() {
  vec3 normal = tilted_by_map();
  vec4 base = u_base_color * v_color * texture(u_base_texture, v_uv);
  if (u_alpha_cutoff >= 0.0 && base.a < u_alpha_cutoff) discard;
  if (u_unlit) {
    o_light = vec4(u_weights.z * u_emission * base.rgb, alpha_of_light(u_weights.z > 0.0 ? 2.0 : 1.0));
    return;
  }
  vec3 reflectance = reflectance_of(normal);
  vec3 irradiance = irradiance_here(normal);
  vec3 light = u_weights.x * diffuse_light(base.rgb * u_diffuse_share, reflectance, irradiance);
  light += u_weights.y * ambient_reflection(reflectance, irradiance);
#ifdef PLAIN
  light += u_weights.z * u_emission;
#else
  light += u_weights.z * u_emission * texture(u_emission_texture, v_uv).rgb;
#endif
  o_light = vec4(light, alpha_of_light(1.0));
}
`;var dr=`// M R on a mirror (Bastos et al. 1999, section 8.2.2).
#include "passes/reflector_reflectance.glsl"

uniform sampler2D u_image;       // M
uniform vec2 u_texture_size;
uniform vec2 u_image_size;       // pixels in use
uniform vec2 u_origin;           // of the image in the frame, pixels
uniform vec3 u_missing;          // light where no map shows anything
uniform bool u_with_distance;     // a: the image's 1 / distance; else the kind of light
layout(location = 0) out vec4 o_light;

void main() {
  vec2 at = clamp(gl_FragCoord.xy - u_origin, vec2(0.5), max(u_image_size - 0.5, vec2(0.5)));
  vec4 image = textureLod(u_image, at / u_texture_size, 0.0);
  vec3 light = image.a > 0.0 ? image.rgb : u_missing;
  o_light = vec4(light * reflector_reflectance(reflector_cosine()), u_with_distance ? image.a : 1.0);
}
`;var pr=`#include "passes/reflector_surface.glsl"
`;var vr=`// (M * K) R on a reflector (Bastos et al. 1999, section 8.2.2).
#include "passes/reflector_reflectance.glsl"
#include "passes/screen_convolve.glsl"

uniform vec2 u_origin;           // of the image in the frame, pixels
uniform sampler2D u_blurred;     // M * K at a pixel in u_coarse
uniform vec3 u_missing;          // light where no map shows anything
uniform bool u_with_distance;     // a: the image's 1 / distance; else the kind of light
layout(location = 0) out vec4 o_light;

// The least radius of the lobe in coarse pixels for those to do.
const float kLeastRadius = 1.0;

void main() {
  vec2 pixel = gl_FragCoord.xy - u_origin;
  vec4 image;
  if (u_coarse > 1 && lobe_radius(pixel) >= kLeastRadius * float(u_coarse)) {
    vec2 size = vec2(u_image_size) / float(u_coarse);
    vec2 at = clamp(pixel / float(u_coarse), vec2(0.5), max(size - 0.5, vec2(0.5)));
    image = textureLod(u_blurred, at / u_texture_size, 0.0);
  } else {
    image = convolved(pixel);
  }
  vec3 light = image.a > 0.0 ? image.rgb : u_missing;
  o_light = vec4(light * reflector_reflectance(reflector_cosine()), u_with_distance ? image.a : 1.0);
}
`;var gr=`#include "passes/reflector_surface.glsl"
`;var _r=`// The emitters that a glossy reflector's maps leave out, in closed form, times R: added to compose.
#include "lib/kernel.glsl"
#include "lib/lobe_light.glsl"
#include "passes/reflector_reflectance.glsl"
#include "passes/reflector_emitters.glsl"

uniform sampler2D u_lobes;       // see upload_lobe_fits(); columns as the rows of kernel_row()
uniform int u_lobe_rows;
layout(location = 0) out vec4 o_light;

const float kLeastCosine = 1e-3;  // of the incidences that lobes are known for

vec3 s_eye;            // of the pixel, surface frame
float s_mean_factor;  // F over its lobe

// F where the half vector is at that cosine (x), and its mean over the lobe at that incidence (y).
vec2 fresnel_factors(float cosine) {
  vec2 at = kernel_row(cosine, u_lobe_rows);
  vec2 low = texelFetch(u_lobes, ivec2(int(at.x), 1), 0).xy;
  return mix(low, texelFetch(u_lobes, ivec2(min(int(at.x) + 1, u_lobe_rows - 1), 1), 0).xy, at.y);
}

// R is the whole lobe's; a lamp at its side is reflected as the facets do that turn it to the eye.
float share_of_polygon(vec4 lobe, vec3 corners[4]) {
  vec3 seen = reflected_vector(lobe, corners);
  if (seen.z == 0.0) return 0.0;
  vec3 half_vector = normalize(from_lobe(lobe, seen.z < 0.0 ? -seen : seen)) + s_eye;
  return seen.z * fresnel_factors(dot(s_eye, normalize(half_vector))).x / s_mean_factor;
}

void main() {
  float cos_theta = reflector_cosine();
  vec2 row = kernel_row(cos_theta, u_lobe_rows);
  vec4 below = texelFetch(u_lobes, ivec2(int(row.x), 0), 0);
  vec4 above = texelFetch(u_lobes, ivec2(min(int(row.x) + 1, u_lobe_rows - 1), 0), 0);
  s_eye = vec3(sqrt(max(0.0, 1.0 - cos_theta * cos_theta)), 0.0, cos_theta);
  s_mean_factor = max(fresnel_factors(cos_theta).y, 1e-6);
  vec4 lobe = lobe_in_surface_frame(mix_lobes(below, above, row.y), max(cos_theta, kLeastCosine));
  o_light = vec4(light_of_emitters(lobe) * reflector_reflectance(cos_theta), 1.0);
}
`;var br=`// The emitters that a glossy reflector's maps leave out (player/scene/gpu_emitters.h), as a pixel's lobe shows them.

// The share of a lobe of integral 1 that a polygon fills: the pass defines it. corners: relative to the pixel's point, frame as in
// lib/lobe_light.glsl. Positive on the polygon's bright side.
float share_of_polygon(vec4 lobe, vec3 corners[4]);

uniform sampler2D u_polygons;      // a row each: 12 coordinates of corners; light, and the emitter + 1, negative: both sides shine
uniform sampler2D u_visibility;    // by cell and emitter: the shares seen from the cell's corners
uniform usampler2D u_seen;         // by cell, 128 bits: k is set where polygon k is seen from any of its corners
uniform ivec2 u_cells;
uniform vec2 u_lower;              // bounds of the reflector
uniform vec2 u_upper;
uniform mat4 u_emitters_from_pack; // reflector space, in units of the reflector's size

float visible_share(int emitter, ivec2 cell, vec2 t) {
  vec4 nodes = texelFetch(u_visibility, cell + ivec2(0, emitter * u_cells.y), 0);
  vec2 sides = mix(nodes.xz, nodes.yw, t.x);
  return mix(sides.x, sides.y, t.y);
}

vec3 light_of_polygon(int k, vec4 lobe, vec2 place, vec2 x, ivec2 cell, vec2 t) {
  vec4 a = texelFetch(u_polygons, ivec2(0, k), 0), b = texelFetch(u_polygons, ivec2(1, k), 0);
  vec4 c = texelFetch(u_polygons, ivec2(2, k), 0), light = texelFetch(u_polygons, ivec2(3, k), 0);
  vec3 corners[4] = vec3[4](a.xyz, vec3(a.w, b.xy), vec3(b.zw, c.x), c.yzw);
  for (int i = 0; i < 4; ++i) {
    vec2 v = corners[i].xy - place;
    corners[i].xy = vec2(dot(v, x), dot(v, vec2(-x.y, x.x)));
  }
  float share = share_of_polygon(lobe, corners);
  float shown = light.a < 0.0 ? abs(share) : max(share, 0.0);
  return visible_share(int(abs(light.a)) - 1, cell, t) * shown * light.rgb;
}

vec3 light_of_emitters(vec4 lobe) {
  vec2 place = (u_emitters_from_pack * vec4(v_position, 1.0)).xy;
  vec2 to_eye = (mat3(u_emitters_from_pack) * (u_eye.xyz - v_position * u_eye.w)).xy;
  vec2 x = dot(to_eye, to_eye) > 0.0 ? normalize(to_eye) : vec2(1.0, 0.0);
  vec2 at = clamp((place - u_lower) / (u_upper - u_lower), 0.0, 1.0) * vec2(u_cells);
  ivec2 cell = min(ivec2(at), u_cells - 1);
  uvec4 words = texelFetch(u_seen, cell, 0);
  vec3 sum = vec3(0.0);
  for (int word = 0; word < 4; ++word) {
    int k = 32 * word;
    for (uint seen = words[word]; seen != 0u; seen >>= 1, ++k)
      if ((seen & 1u) != 0u) sum += light_of_polygon(k, lobe, place, x, cell, at - vec2(cell));
  }
  return sum;
}
`;var wr=`// The emitters that a reflector lists, as a mirror shows them, times R: added to compose. What is smaller than a pixel has its light
// spread over one, so that it does not come and go.
#include "lib/lobe_light.glsl"
#include "passes/reflector_reflectance.glsl"
#include "passes/reflector_emitters.glsl"

layout(location = 0) out vec4 o_light;

float s_pixel;  // the angle that the pixel sees
float s_way;    // from the eye to the pixel's point

// As the eye behind the mirror sees it.
float share_of_polygon(vec4 lobe, vec3 corners[4]) {
  vec3 seen[4];
  for (int i = 0; i < 4; ++i) seen[i] = corners[i] + s_way * lobe.xyz;
  return polygon_share(seen, lobe.xyz, s_pixel);
}

void main() {
  vec3 way = normalize(v_position * u_eye.w - u_eye.xyz);
  s_pixel = sqrt(length(cross(dFdx(way), dFdy(way))));
  s_way = u_eye.w * length(mat3(u_emitters_from_pack) * (v_position - u_eye.xyz));
  float cos_theta = reflector_cosine();
  vec4 mirror = vec4(-sqrt(max(0.0, 1.0 - cos_theta * cos_theta)), 0.0, cos_theta, 0.0);
  o_light = vec4(light_of_emitters(mirror) * reflector_reflectance(cos_theta), 1.0);
}
`;var yr=`#include "passes/reflector_surface.glsl"
`;var xr=`#include "passes/reflector_surface.glsl"
`;var kr=`// A reflector's region in the stencil: no colour.
void main() {}
`;var Mr=`layout(location = 0) in vec3 a_position;
uniform mat4 u_clip_from_pack;
invariant gl_Position;

void main() { gl_Position = u_clip_from_pack * vec4(a_position, 1.0); }
`;var Tr=`// R of a reflector at a pixel, and what it takes to know it.
#include "lib/reflectance.glsl"
#include "lib/shading.glsl"

uniform vec4 u_eye;
uniform vec3 u_normal;           // of the reflector, unit, pack space
uniform sampler2D u_reflectance; // tables
uniform int u_reflectance_row;   // -1: reflects nothing
uniform int u_reflectance_count; // entries of the table
uniform bool u_modulate;         // by R
in vec3 v_position;

float reflector_cosine() { return view_cosine(u_normal, u_normal, v_position, u_eye); }

// 1 for the stages before R.
vec3 reflector_reflectance(float cos_theta) {
  if (!u_modulate) return vec3(1.0);
  if (u_reflectance_row < 0) return vec3(0.0);
  return reflectance_from_table(u_reflectance, u_reflectance_row, u_reflectance_count, cos_theta);
}
`;var Fr=`// A vertex of a reflector.
layout(location = 0) in vec3 a_position;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = a_position;
}
`;var Er=`// The opaque scene: diffuse light, emission, and the undirected reflection where no reflector shows an image.
#include "passes/lightmap.glsl"
#include "lib/taken_light.glsl"

uniform sampler2D u_change;  // BrightChange: what movers block, and where
uniform usampler2D u_surfaces;
#ifdef PLAIN
const vec2 u_change_scale = vec2(0.0);
#else
uniform vec2 u_change_scale;  // of its size over the frame's; 0: nothing is blocked
#endif

vec3 irradiance_here(vec3 normal) {
  vec3 irradiance = irradiance_on(normal);
  if (u_change_scale.x > 0.0) {
    vec2 at = gl_FragCoord.xy * u_change_scale;
    irradiance = max(irradiance - taken_light(u_change, u_surfaces, at, v_position, front_normal()), 0.0);
  }
  return irradiance;
}

#include "passes/opaque.glsl"
`;var Rr=`#include "passes/surface_vertex.glsl"
`;var Ar=`// How wide the blur of a reflected image is at a pixel: the share d / (d + e) of the lobe's angle, e from the eye to the plane, d from
// there to what is seen.
uniform vec4 u_ndc_from_image; // scale, offset
uniform vec2 u_tangents;       // view-space x, y over -z at ndc 1; orthographic: half sizes in metres
uniform float u_ortho;
uniform vec3 u_plane_normal;   // view space, towards the eye's side
uniform float u_plane_offset;  // dot(normal, point of the plane)
uniform float u_farthest;      // metres: distances are cut off here
uniform float u_median;        // tangent of the radius that holds half of the lobe
uniform float u_pixels_per_tangent;  // of the image, at its centre
uniform int u_coarse;          // pixels of the image along a side of a coarse one

// The view ray of a pixel, and where it meets the plane. valid: it does.
struct PlaneHit {
  vec3 view;
  vec3 at;
  float cos_theta;
  float distance;
  bool valid;
};

PlaneHit plane_hit(vec2 pixel) {
  vec2 ndc = pixel * u_ndc_from_image.xy + u_ndc_from_image.zw;
  vec3 origin = vec3(ndc * u_tangents, 0.0) * u_ortho;
  vec3 view = normalize(vec3(ndc * u_tangents * (1.0 - u_ortho), -1.0));
  float cos_theta = -dot(u_plane_normal, view);
  float distance = (u_plane_offset - dot(u_plane_normal, origin)) / -max(cos_theta, 1e-6);
  return PlaneHit(view, origin + distance * view, cos_theta, distance, cos_theta >= 1e-4 && distance > 0.0);
}

// How far behind the plane lies what is seen at 1 / distance from the eye.
float behind_plane(float inverse, float to_plane) {
  return max(1.0 / max(inverse, 1.0 / u_farthest) - to_plane, 0.0);
}

// Pixels that a tangent spans at such a distance.
float pixels_at(float behind, float to_plane) {
  return u_pixels_per_tangent * (u_ortho > 0.5 ? behind : behind / (behind + to_plane));
}
`;var Sr=`// M * K (Bastos et al. 1999, section 8.2.1). K is given as taps of equal energy around the mirror direction, by incidence. A tap
// is carried to the mirrored image at the distance that M has there, so that what touches the reflector stays sharp and what is
// far away blurs: footprint d / (d + e) of the angle, e from the eye to the plane, d from there to the hit.
#include "lib/kernel.glsl"
#include "passes/screen_blur_width.glsl"

uniform sampler2D u_image;     // M, filled, with all its coarser levels
uniform ivec2 u_image_size;    // pixels in use
uniform vec2 u_texture_size;
uniform sampler2D u_taps;      // see kernel_tap()
uniform int u_tap_count;
uniform int u_tap_rows;

vec4 image_at(vec2 pixel, float level) {
  float margin = 0.5 * exp2(ceil(level));
  vec2 size = vec2(u_image_size);
  vec2 at = clamp(pixel, min(vec2(margin), 0.5 * size), max(size - margin, 0.5 * size));
  return textureLod(u_image, at / u_texture_size, level);
}

// How far behind the plane the pixel's image lies.
float distance_behind(vec2 pixel, float to_plane) {
  float level = log2(max(0.25 * u_median * u_pixels_per_tangent / float(u_coarse), 1.0));
  return behind_plane(image_at(pixel, level).a, to_plane);
}

float lobe_radius(vec2 pixel) {
  PlaneHit hit = plane_hit(pixel);
  return hit.valid ? u_median * pixels_at(distance_behind(pixel, hit.distance), hit.distance) : 0.0;
}

vec2 pixel_of(vec3 at) {
  vec2 ndc = at.xy / (u_ortho > 0.5 ? u_tangents : u_tangents * max(-at.z, 1e-12));
  return (ndc - u_ndc_from_image.zw) / u_ndc_from_image.xy;
}

// The light at a pixel of the image, and 1 / distance, 0 where nothing is seen.
vec4 convolved(vec2 pixel) {
  vec4 centre = image_at(pixel, 0.0);
  PlaneHit from = plane_hit(pixel);
  if (!from.valid || centre.a <= 0.0) return centre;
  float behind = distance_behind(pixel, from.distance);
  // In the mirrored world the view ray is the mirror direction, and the surface's normal points away from the eye.
  vec3 along = -u_plane_normal - from.cos_theta * from.view;
  vec3 side = cross(from.view, abs(from.view.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0));
  along = dot(along, along) > 1e-8 ? normalize(along) : normalize(side);
  vec3 across = cross(from.view, along);
  float to_pixels = pixels_at(behind, from.distance);
  vec2 row = kernel_row(from.cos_theta, u_tap_rows);

  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int i = 0; i < u_tap_count; ++i) {
    vec4 tap = kernel_tap(u_taps, i, row);
    vec3 direction = lobe_direction(from.view, across, along, tap.xy), at = from.at + behind * direction;
    if (dot(direction, u_plane_normal) >= 0.0 || (u_ortho < 0.5 && at.z >= -1e-6 * from.distance)) continue;
    sum += tap.w * image_at(pixel_of(at), log2(max(tap.z * to_pixels, 1.0))).rgb;
    total += tap.w;
  }
  return total > 0.0 ? vec4(sum / total, centre.a) : centre;
}
`;var Lr=`// M * K at a pixel in u_coarse, for lobes so wide that more would not show; where it would, reflector/convolve asks again.
#include "passes/screen_convolve.glsl"

layout(location = 0) out vec4 o_light;

void main() { o_light = convolved(gl_FragCoord.xy * float(u_coarse)); }
`;var zr=`// A curved reflector's light, once by pixel.
#include "passes/curved_lobe.glsl"
#include "lib/mirrored.glsl"

uniform sampler2D u_places;  // of curved_surface
uniform sampler2D u_normals;
uniform vec4 u_eye;
uniform float u_id;
layout(location = 0) out vec4 o_light;  // over u_light_scale; a: whose it is

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 place = texelFetch(u_places, at, 0);
  vec3 normal;
  float cos_theta;
  vec3 mirror = mirrored(texelFetch(u_normals, at, 0).xyz, normalize(place.xyz * u_eye.w - u_eye.xyz), normal, cos_theta);
  o_light = vec4(curved_light(place.xyz, normal, mirror, cos_theta, place.a), u_id);
}
`;var Pr=`#include "lib/fullscreen.glsl"

void main() { gl_Position = fullscreen_position(gl_VertexID); }
`;var Gr=`// Sums of log2 luminance over blocks of the frame, for the exposure. Black pixels and unlit ones do not count.
#include "lib/color.glsl"
uniform sampler2D u_frame;
uniform ivec2 u_frame_size;
uniform int u_block;
layout(location = 0) out vec4 o_sum;  // sum, count

void main() {
  ivec2 from = ivec2(gl_FragCoord.xy) * u_block;
  ivec2 to = min(from + u_block, u_frame_size);
  vec2 sum = vec2(0.0);
  for (int y = from.y; y < to.y; ++y) {
    for (int x = from.x; x < to.x; ++x) {
      vec4 light = texelFetch(u_frame, ivec2(x, y), 0);
      float value = luminance(light.rgb);
      if (light.a > 1.5 || !(value > 0.0)) continue;
      sum += vec2(log2(max(value, 1e-6)), 1.0);
    }
  }
  o_sum = vec4(sum, 0.0, 0.0);
}
`;var Vr=`// Half the size: the average of those pixels that hold light (a > 0).
#include "lib/fill.glsl"

uniform sampler2D u_source;  // one level
uniform ivec2 u_source_size; // pixels in use
uniform float u_reach;       // see farther_average
layout(location = 0) out vec4 o_light;

void main() {
  ivec2 at = 2 * ivec2(gl_FragCoord.xy);
  vec4 light[4];
  for (int i = 0; i < 4; ++i) {
    ivec2 from = at + ivec2(i & 1, i >> 1);
    light[i] = all(lessThan(from, u_source_size)) ? texelFetch(u_source, from, 0) : vec4(0.0);
  }
  o_light = farther_average(light, vec4(1.0), u_reach);
}
`;var Br=`// What shaded surfaces share: their normals and reflectance.
#include "lib/normal_map.glsl"
#include "lib/reflectance.glsl"
#include "lib/shading.glsl"

uniform vec4 u_eye;
uniform sampler2D u_normal_texture;
uniform float u_normal_scale;
#ifdef REFLECTED  // what is plain, in the image of a mirror
#define PLAIN
#endif
#ifdef PLAIN  // a program of its own for what most surfaces are: software rasterisers run every branch
const bool u_normal_mapped = false;
#else
uniform bool u_normal_mapped;
#endif
uniform sampler2D u_reflectance;
uniform int u_reflectance_row;  // -1: reflects nothing
uniform int u_reflectance_count;

in vec3 v_position;
in vec3 v_normal;
in vec2 v_normal_uv;
in vec4 v_tangent;

// Of the front, as interpolated; opposite normals may cancel between vertices.
vec3 front_normal() {
  float length2 = dot(v_normal, v_normal);
  return length2 > 0.0 ? v_normal * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
}

// The same with its map; any length where there is no map. To be called before a discard: it takes
// derivatives.
vec3 tilted_by_map() {
  if (!u_normal_mapped) return v_normal;
  vec3 n = front_normal();
  vec4 tangent = tangent_of_steps(n, dFdx(v_position), dFdy(v_position), dFdx(v_normal_uv), dFdy(v_normal_uv));
  if (abs(v_tangent.w) >= 0.5) tangent = vec4(v_tangent.xyz, sign(v_tangent.w));
  return tilted_normal(n, tangent, texture(u_normal_texture, v_normal_uv).rgb, u_normal_scale);
}

vec3 reflectance_of(vec3 tilted) {
  if (u_reflectance_row < 0) return vec3(0.0);
  float cos_theta = view_cosine(tilted, v_normal, v_position, u_eye);
  return reflectance_from_table(u_reflectance, u_reflectance_row, u_reflectance_count, cos_theta);
}
`;var Dr=`// A vertex of a surface that is shaded: opaque or see-through.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_uv;
layout(location = 3) in vec2 a_lightmap_uv;
layout(location = 4) in vec4 a_color;
layout(location = 5) in vec2 a_normal_uv;
layout(location = 6) in vec4 a_tangent;
#ifdef VERTEX_LIGHT
layout(location = 7) in vec3 a_light;  // lux
centroid out vec3 v_light;             // as v_lightmap_uv
#endif
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;
out vec3 v_normal;
out vec2 v_uv;
centroid out vec3 v_lightmap_uv;  // lib/lightmap_uv.glsl
out vec4 v_color;
out vec2 v_normal_uv;
out vec4 v_tangent;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = a_position;
  v_normal = a_normal;
  v_uv = a_uv;
  v_lightmap_uv = vec3(a_lightmap_uv, 1.0 + float(min(gl_VertexID, 0)));  // 1 that no driver takes for a constant
  v_color = a_color;
#ifdef VERTEX_LIGHT
  v_light = a_light;
#endif
  v_normal_uv = a_normal_uv;
  v_tangent = a_tangent;
}
`;var Cr=`// See-through surfaces, drawn twice: once to dim what lies behind, once to add their own light.
#include "passes/lightmap.glsl"

uniform sampler2D u_base_texture;
uniform vec4 u_base_color;
uniform float u_alpha_cutoff;  // negative: no cut-outs
uniform bool u_covers;         // alpha is coverage; else the surface is whole
uniform float u_diffuse_share;
uniform float u_transmission;
uniform vec3 u_emission;
uniform sampler2D u_emission_texture;
uniform bool u_unlit;
uniform vec3 u_weights;
uniform bool u_dimming;  // write what the surface lets through instead of its light

in vec2 v_uv;
in vec4 v_color;
layout(location = 0) out vec4 o_light;

void main() {
  vec3 normal = tilted_by_map();
  vec4 base = u_base_color * v_color * texture(u_base_texture, v_uv);
  if (u_alpha_cutoff >= 0.0 && base.a < u_alpha_cutoff) discard;
  float coverage = u_covers ? clamp(base.a, 0.0, 1.0) : 1.0;
  vec3 reflectance = u_unlit ? vec3(0.0) : reflectance_of(normal);
  if (u_dimming) {
    vec3 through = u_unlit ? vec3(0.0) : base.rgb * u_transmission * (1.0 - max_channel(reflectance));
    o_light = vec4(1.0 - coverage + coverage * through, 1.0);
    return;
  }
  vec3 irradiance = irradiance_on(normal);
  vec3 light = u_weights.x * diffuse_light(base.rgb * u_diffuse_share, reflectance, irradiance);
  light += u_weights.y * ambient_reflection(reflectance, irradiance);
  light += u_weights.z * u_emission * texture(u_emission_texture, v_uv).rgb;
  if (u_unlit) light = u_weights.z * u_emission * base.rgb;
  o_light = vec4(coverage * light, 0.0);
}
`;var Ir=`#include "passes/surface_vertex.glsl"
`;var Ur=`// Light in cd/m2 as linear display values, to be added up: frames that are a part of a pixel apart make smooth edges. Each is
// tone-mapped by itself, as samples of a pixel are in the player.
#include "lib/color.glsl"
#include "lib/tonemap.glsl"
uniform sampler2D u_frame;
uniform sampler2D u_before;  // the sum of those before
uniform float u_before_weight;
uniform float u_exposure;    // 1 / (the luminance shown as white)
uniform float u_unlit_exposure;  // of unlit surfaces
uniform bool u_encode;       // the mean, sRGB-encoded
uniform float u_count;
uniform float u_share;       // above 0: that much of the light itself, for the meter
uniform vec2 u_scale;        // pixels of the frame for one that is shown
layout(location = 0) out vec4 o_color;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy * u_scale);
  vec3 sum = u_before_weight > 0.0 ? texelFetch(u_before, at, 0).rgb : vec3(0.0);
  if (u_encode) {
    o_color = vec4(srgb_from_linear(sum / u_count) + dither(gl_FragCoord.xy) / 255.0, 1.0);
    return;
  }
  vec4 light = texelFetch(u_frame, at, 0);
  if (u_share > 0.0) {
    o_color = light * u_share;
    return;
  }
  o_color = vec4(sum + (light.a > 1.5 ? tonemap_none(light.rgb * u_unlit_exposure) : tonemap_aces(light.rgb * u_exposure)), 1.0);
}
`;var _n={"lib/color.glsl":Ut,"lib/distance_alpha.glsl":Ot,"lib/fill.glsl":Nt,"lib/fullscreen.glsl":Wt,"lib/kernel.glsl":$t,"lib/lightmap_uv.glsl":Ht,"lib/lobe_light.glsl":qt,"lib/lit_surface.glsl":Xt,"lib/mirrored.glsl":jt,"lib/normal_map.glsl":Kt,"lib/octahedral.glsl":Yt,"lib/reflectance.glsl":Qt,"lib/shading.glsl":Zt,"lib/surround.glsl":Jt,"lib/taken_light.glsl":er,"lib/tonemap.glsl":tr,"lib/transfer.glsl":rr,"passes/curved_light.frag":nr,"passes/curved_light.vert":or,"passes/curved_lobe.glsl":sr,"passes/curved_surface.frag":lr,"passes/curved_surface.vert":cr,"passes/depth.frag":ur,"passes/depth.vert":hr,"passes/lightmap.glsl":fr,"passes/mover_light.frag":ir,"passes/mover_light.vert":ar,"passes/opaque.glsl":mr,"passes/reflector_compose.frag":dr,"passes/reflector_compose.vert":pr,"passes/reflector_convolve.frag":vr,"passes/reflector_convolve.vert":gr,"passes/reflector_emitters.frag":_r,"passes/reflector_emitters.glsl":br,"passes/reflector_emitters_sharp.frag":wr,"passes/reflector_emitters_sharp.vert":yr,"passes/reflector_emitters.vert":xr,"passes/reflector_mask.frag":kr,"passes/reflector_mask.vert":Mr,"passes/reflector_reflectance.glsl":Tr,"passes/reflector_surface.glsl":Fr,"passes/scene.frag":Er,"passes/scene.vert":Rr,"passes/screen_blur_width.glsl":Ar,"passes/screen_convolve.glsl":Sr,"passes/screen_convolve.frag":Lr,"passes/screen_curved.frag":zr,"passes/screen_fullscreen.vert":Pr,"passes/screen_luminance.frag":Gr,"passes/screen_pull.frag":Vr,"passes/surface.glsl":Br,"passes/surface_vertex.glsl":Dr,"passes/transparent.frag":Cr,"passes/transparent.vert":Ir,"passes/screen_average.frag":Ur},bn=["#version 300 es","precision highp float;","precision highp int;","precision highp sampler2D;","precision highp sampler2DArray;","precision highp isampler2D;","precision highp usampler2D;",""].join(`
`);function Or(t,e=""){let r=new Set,i=a=>{if(r.has(a))return"";r.add(a);let n=_n[a];if(n===void 0)throw new Error(`found no shader ${a}`);return n.replace(/^#include "([^"]+)".*$/gm,(o,s)=>i(s))};return bn+(e?`#define ${e}
`:"")+i(t)}var Nr={u_base_texture:0,u_lightmap:1,u_reflectance:2,u_direction:3,u_normal_texture:4,u_change:5,u_cells:6,u_detail:7,u_surfaces:8,u_image:9,u_frame:9,u_source:9,u_blurred:10,u_before:10,u_taps:11,u_emission_texture:11,u_polygons:12,u_visibility:13,u_seen:14,u_lobes:15,u_codes:6,u_table:7,u_light:9,u_inverse_distance:10,u_places:12,u_normals:13,u_shaded:15},z=class t{constructor(e,r,i){this.gl=e;this.name=r;this.define=i}at=new Map;program;linked=!1;static make(e,r,i=""){return new t(e,r,i)}start(){if(this.program)return;let{gl:e,name:r}=this,i=r.startsWith("screen_")?"screen_fullscreen":r;this.program=e.createProgram();for(let[a,n]of[[e.VERTEX_SHADER,`${i}.vert`],[e.FRAGMENT_SHADER,`${r}.frag`]]){let o=e.createShader(a);e.shaderSource(o,Or(`passes/${n}`,this.define)),e.compileShader(o),e.attachShader(this.program,o)}e.linkProgram(this.program)}finish(){this.start(),this.linked=!0;let{gl:e}=this,r=this.program;if(!e.getProgramParameter(r,e.LINK_STATUS)&&!e.isContextLost()){let a=e.getAttachedShaders(r).map(n=>e.getShaderInfoLog(n)).join("");throw new Error(`shader ${this.name} ${this.define}: ${a}${e.getProgramInfoLog(r)}`)}e.useProgram(r);let i=e.getProgramParameter(r,e.ACTIVE_UNIFORMS);for(let a=0;a<i;++a){let n=e.getActiveUniform(r,a),o=e.getUniformLocation(r,n.name);this.at.set(n.name,{place:o,type:n.type});let s=Nr[n.name];[e.SAMPLER_2D,e.INT_SAMPLER_2D,e.UNSIGNED_INT_SAMPLER_2D].includes(n.type)&&s!==void 0&&e.uniform1i(o,s)}}use(){this.linked||this.finish(),this.gl.useProgram(this.program)}set(e,r){let i=this.at.get(e),a=this.gl;if(!i)return;let n=typeof r=="object"?Float32Array.from(r):void 0,o=Number(r);switch(i.type){case a.FLOAT:a.uniform1f(i.place,o);break;case a.INT:case a.BOOL:a.uniform1i(i.place,o);break;case a.INT_VEC2:a.uniform2i(i.place,n[0],n[1]);break;case a.FLOAT_VEC2:a.uniform2fv(i.place,n);break;case a.FLOAT_VEC3:a.uniform3fv(i.place,n);break;case a.FLOAT_VEC4:a.uniform4fv(i.place,n);break;case a.FLOAT_MAT4:a.uniformMatrix4fv(i.place,!1,n);break}}};function wn(t,e){switch(e){case t.RGB16F:return[t.RGB,t.HALF_FLOAT];case t.RGBA16F:return[t.RGBA,t.HALF_FLOAT];case t.RGBA32F:return[t.RGBA,t.FLOAT];case t.RGB9_E5:return[t.RGB,t.UNSIGNED_INT_5_9_9_9_REV];case t.R32F:return[t.RED,t.FLOAT];case t.R32UI:return[t.RED_INTEGER,t.UNSIGNED_INT];case t.RGBA16I:return[t.RGBA_INTEGER,t.SHORT];case t.RGBA32UI:return[t.RGBA_INTEGER,t.UNSIGNED_INT];case t.DEPTH24_STENCIL8:return[t.DEPTH_STENCIL,t.UNSIGNED_INT_24_8];default:return[t.RGBA,t.UNSIGNED_BYTE]}}function T(t,e,r=null){let i=t.createTexture(),[a,n]=wn(t,e.format);return t.activeTexture(t.TEXTURE0),t.bindTexture(t.TEXTURE_2D,i),t.pixelStorei(t.UNPACK_ALIGNMENT,1),t.texStorage2D(t.TEXTURE_2D,e.levels??1,e.format,e.width,e.height),r&&t.texSubImage2D(t.TEXTURE_2D,0,0,0,e.width,e.height,a,n,r),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,e.min??t.NEAREST),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MAG_FILTER,e.mag??t.NEAREST),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,e.wrapS??t.CLAMP_TO_EDGE),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,e.wrapT??t.CLAMP_TO_EDGE),i}function k(t,e,r){t.activeTexture(t.TEXTURE0+Nr[e]),t.bindTexture(t.TEXTURE_2D,r)}function re(t,e,r,i){let a=t.createFramebuffer();return t.bindFramebuffer(t.FRAMEBUFFER,a),t.framebufferTexture2D(t.FRAMEBUFFER,t.COLOR_ATTACHMENT0,t.TEXTURE_2D,e,0),i&&(t.framebufferTexture2D(t.FRAMEBUFFER,t.COLOR_ATTACHMENT1,t.TEXTURE_2D,i,0),t.drawBuffers([t.COLOR_ATTACHMENT0,t.COLOR_ATTACHMENT1])),r&&t.framebufferTexture2D(t.FRAMEBUFFER,t.DEPTH_STENCIL_ATTACHMENT,t.TEXTURE_2D,r,0),a}function A(t,e){let r=(a,n)=>{n?t.enable(a):t.disable(a)};r(t.DEPTH_TEST,!!e.depthTest),t.depthFunc(t.LEQUAL),t.depthMask(!!e.depthWrite);let i=e.color??!0;t.colorMask(i,i,i,i&&(e.alpha??!0)),r(t.CULL_FACE,!!e.cull),t.cullFace(t.BACK),t.frontFace(e.mirrored?t.CW:t.CCW),r(t.BLEND,!!e.blend),e.blend==="add"&&t.blendFuncSeparate(t.ONE,t.ONE,t.ONE,t.ZERO),e.blend==="multiply"&&t.blendFuncSeparate(t.ZERO,t.SRC_COLOR,t.ZERO,t.ONE),r(t.STENCIL_TEST,e.stencilFunc!==void 0||!!e.stencilWrite),t.stencilFunc(e.stencilFunc??t.ALWAYS,e.stencilRef??0,e.stencilRead??255),t.stencilMask(e.stencilWrite??0),t.stencilOp(t.KEEP,t.KEEP,t.REPLACE)}function yn(t,e,r,i){let a=Math.max(_e(t),1e-12),n=B(F(oe(t),e),r),o=n+a*1.01,s=n-a*1.01;return i?[s,Math.max(o,s+a*.001)]:(o=Math.max(o,a*.01),s=Math.max(s,Math.min(.02,a*.001),o*1e-5),[s,Math.max(o,s*1.001)])}function Ge(t,e){let r=Math.max(e,t.near+.001*Math.max(Math.abs(t.near),1e-20)),i=r-t.near,[a,n]=t.tangents,o=new Float64Array(16),s=[t.centre[0]/a,t.centre[1]/n];return o[0]=1/a,o[5]=1/n,t.ortho?(o[12]=-s[0],o[13]=-s[1],o[10]=-2/i,o[14]=-(r+t.near)/i,o[15]=1):(o[10]=-(r+t.near)/i,o[14]=-2*r*t.near/i,o[11]=-1,o[8]=s[0],o[9]=s[1]),o}function at(t){let e=N(t.forward,[0,0,-1]),r=N(t.up,[0,1,0]);j(O(e,r))<1e-5&&(r=Math.abs(e[1])<.9?[0,1,0]:[0,0,-1]);let i=N(O(e,r),[1,0,0]);return{right:i,up:O(i,e),forward:e}}function Wr(t,e,r,i,a=[0,0]){let{right:n,up:o,forward:s}=at(t),l=t.fov===0,c=t.eye,u=new Float64Array([n[0],o[0],-s[0],0,n[1],o[1],-s[1],0,n[2],o[2],-s[2],0,-B(n,c),-B(o,c),B(s,c),1]),[h,f]=yn(i,c,s,l),p=l?t.halfHeight>0?t.halfHeight:_e(i):Math.tan(.5*Math.min(Math.max(t.fov,.001),3.1)),d=[p*e/r,p],m={viewFromPack:u,clipFromView:u,clipFromPack:u,eye:l?[-s[0],-s[1],-s[2],0]:[...c,1],tangents:d,centre:[d[0]*2*a[0]/e,d[1]*2*a[1]/r],ortho:l,mirrored:!1,near:h,far:f,width:e,height:r};return m.clipFromView=Ge(m,f),m.clipFromPack=Q(m.clipFromView,u),m}function $r(t,e,r,i){let a={...t,width:r,height:i};return a.tangents=[t.tangents[0]*r/t.width,t.tangents[1]*i/t.height],a.centre=[t.centre[0]+t.tangents[0]*((2*e[0]+r)/t.width-1),t.centre[1]+t.tangents[1]*((2*e[1]+i)/t.height-1)],a.clipFromView=Ge(a,a.far),a.clipFromPack=Q(a.clipFromView,a.viewFromPack),a}function Hr(t,e){let r=Pe(t,e),i=r[0]*(r[0]<0?-1:1)+r[1]*(r[1]<0?-1:1)+r[2]+r[3];if(!(i>0))return t;let a=t.slice();for(let n=0;n<4;++n)a[4*n+2]=e[n]*2/i-t[4*n+3];return a}function Ve(t,e){let r=e.map(s=>ce(t,[s[0],s[1],s[2],1])),i=[[0,0,1,1],[1,0,0,1],[-1,0,0,1],[0,1,0,1],[0,-1,0,1]];for(let s of i){let l=c=>s[0]*c[0]+s[1]*c[1]+s[2]*c[2]+s[3]*c[3];r=r.flatMap((c,u)=>{let h=r[(u+1)%r.length],f=l(c),p=l(h),d=f>=0?[c]:[];return f>=0!=p>=0&&d.push(c.map((m,v)=>m+(h[v]-m)*f/(f-p))),d})}let a=r.filter(s=>s[3]>0).map(s=>[s[0]/s[3],s[1]/s[3]].map(l=>Math.min(Math.max(l,-1),1)));if(a.length===0)return;let n=a.map(s=>s[0]),o=a.map(s=>s[1]);return{lower:[Math.min(...n),Math.min(...o)],upper:[Math.max(...n),Math.max(...o)]}}var nt=127,qr=128,xn=.03,Be=class{constructor(e,r){this.device=e;this.renderer=r}mask;surface;shade;light;shadedLight;made=!1;canvas;make(){let{gl:e}=this.device;this.made=!0,this.mask=z.make(e,"reflector_mask"),this.surface=z.make(e,"curved_surface"),this.shade=z.make(e,"screen_curved"),this.light=z.make(e,"curved_light"),this.shadedLight=z.make(e,"curved_light","SHADED")}draw(e,r,i){let a=[],n=[],o=[],{view:s}=r;if(i.largeOnly||e.surrounds.length===0)return{later:a,materials:n};this.made||this.make();for(let l of e.curved){if(l.count===0||!e.surrounds[l.map]||!te(s.clipFromPack,l.bounds))continue;let c=e.isTransparent(l.material);if(c?!r.inFrame:r.values+1>=nt)continue;let u=c?qr:++r.values;c||n.push(l.material),c||!r.inFrame?(this.drawMask(e,r,l,u,c?qr:nt),a.push(l)):o.push({curved:l,value:u})}return o.length>0&&this.drawShown(e,r,o,i),{later:a,materials:n}}add(e,r,i,a){for(let n of i)this.drawLight(e,r,n,this.light,{blend:"add",alpha:!1},a)}state(e,r){return{depthTest:!0,cull:!0,mirrored:e.view.mirrored,...r}}drawMask(e,r,i,a,n){A(this.device.gl,this.state(r,{color:!1,stencilRef:a,stencilWrite:n})),this.mask.use(),this.mask.set("u_clip_from_pack",r.view.clipFromPack),e.bindGeometry(),e.draw(i)}drawShown(e,r,i,a){let{gl:n,color:o}=this.device,s=o===n.RGBA32F;s&&this.shadeAll(e,r,i,a),r.begin();for(let{curved:l,value:c}of i){let u={stencilRef:c,stencilWrite:nt};s&&(this.shadedLight.use(),this.shadedLight.set("u_id",c),k(n,"u_shaded",this.canvas.light)),this.drawLight(e,r,l,s?this.shadedLight:this.light,u,a)}}drawLight(e,r,i,a,n,o){A(this.device.gl,this.state(r,n)),a.use(),this.setLobe(a,e,r,i,o),this.setNormals(a,e,r,i),a.set("u_modulate",!0),e.setReflectance(a,i.material),e.bindGeometry(),e.draw(i)}ensure(e,r){let i=this.canvas,{gl:a}=this.device;if(i&&i.width>=e&&i.height>=r)return i;if(i){for(let f of[i.places,i.normals,i.depth,i.light])a.deleteTexture(f);for(let f of[i.surfaces,i.shaded])a.deleteFramebuffer(f)}let n=Math.max(e,i?.width??0),o=Math.max(r,i?.height??0),s=f=>T(a,{width:n,height:o,format:f}),l=s(a.RGBA32F),c=s(a.RGBA32F),u=s(a.DEPTH24_STENCIL8),h=s(a.RGBA16F);return this.canvas={width:n,height:o,places:l,normals:c,depth:u,light:h,surfaces:re(a,l,u,c),shaded:re(a,h,u)}}shadeAll(e,r,i,a){let{gl:n}=this.device,{view:o}=r,s=this.ensure(o.width,o.height);n.enable(n.SCISSOR_TEST);let l=(c,u)=>{n.bindFramebuffer(n.FRAMEBUFFER,c),n.viewport(0,0,o.width,o.height),n.scissor(0,0,o.width,o.height),A(n,{depthWrite:!0,stencilWrite:255}),n.clearColor(0,0,0,0),n.clear(u)};l(s.surfaces,n.DEPTH_BUFFER_BIT|n.STENCIL_BUFFER_BIT),this.surface.use();for(let{curved:c,value:u}of i)A(n,this.state(r,{depthWrite:!0,stencilRef:u,stencilWrite:255})),this.setNormals(this.surface,e,r,c),e.bindGeometry(),e.draw(c);l(s.shaded,n.COLOR_BUFFER_BIT),this.shade.use(),k(n,"u_places",s.places),k(n,"u_normals",s.normals);for(let{curved:c,value:u}of i)A(n,{stencilFunc:n.EQUAL,stencilRef:u}),this.setLobe(this.shade,e,r,c,a),this.shade.set("u_id",u),this.scissor(r,c),this.renderer.drawScreen();n.disable(n.SCISSOR_TEST)}scissor(e,r){let{lower:i,upper:a}=r.bounds,{view:n}=e,o={x0:1,y0:1,x1:-1,y1:-1};for(let u=0;u<6;++u){let h=u>>1,f=(h+1)%3,p=(h+2)%3,d=[0,1,2,3].map(v=>{let _=u%2===0?[...i]:[...a];return _[f]=v===1||v===2?a[f]:i[f],_[p]=v>=2?a[p]:i[p],_}),m=Ve(n.clipFromPack,d);m&&(o.x0=Math.min(o.x0,m.lower[0]),o.y0=Math.min(o.y0,m.lower[1]),o.x1=Math.max(o.x1,m.upper[0]),o.y1=Math.max(o.y1,m.upper[1]))}let s=(u,h,f)=>f((u*.5+.5)*h),l=s(o.x0,n.width,Math.floor),c=s(o.y0,n.height,Math.floor);this.device.gl.scissor(l,c,Math.max(0,s(o.x1,n.width,Math.ceil)-l),Math.max(0,s(o.y1,n.height,Math.ceil)-c))}setNormals(e,r,i,a){e.set("u_clip_from_pack",i.view.clipFromPack),e.set("u_eye",i.view.eye),r.setNormals(e,a.material)}setLobe(e,r,i,a,n){let{gl:o}=this.device,s=r.surrounds[a.map],l=r.kernel(a.material,n.taps);k(o,"u_light",s.light),k(o,"u_inverse_distance",s.inverseDistance),k(o,"u_taps",l.taps),e.set("u_eye",i.view.eye),e.set("u_centre",s.centre),e.set("u_size",s.size),e.set("u_light_scale",s.tint.map(c=>c*s.scale*r.unit)),e.set("u_range",s.range),e.set("u_tap_count",l.count),e.set("u_tap_rows",l.rows),e.set("u_wide",l.median>=xn)}};var ot=127,Xr=128,kn=.01,Mn=.001,jr=.5,Kr=1e-5,Tn=.02,st=6,Fn=16/6,Yr=t=>.25*(t.upper[0]-t.lower[0])*(t.upper[1]-t.lower[1]),De=class{constructor(e,r,i){this.device=e;this.renderer=r;this.none=i;let{gl:a}=e;this.mask=z.make(a,"reflector_mask"),this.compose=z.make(a,"reflector_compose"),this.convolve=z.make(a,"reflector_convolve"),this.emitters=z.make(a,"reflector_emitters"),this.glints=z.make(a,"reflector_emitters_sharp"),this.curved=new Be(e,r),this.pull=z.make(a,"screen_pull"),this.blur=z.make(a,"screen_convolve")}mask;compose;convolve;emitters;glints;pull;blur;curved;images=[];get programs(){return[this.mask,this.compose,this.convolve,this.emitters,this.glints,this.pull,this.blur]}drawMasks(e,r,i){let a=[],{gl:n}=this.device,o=r.view;if(r.values=0,i.orders===0)return a;for(let s of e.reflectors){let l=ce(s.reflectorFromPack,o.eye);if(s.count===0||l[2]<=(o.ortho?Kr:Kr*s.size))continue;let c=Ve(o.clipFromPack,s.corners);if(!c||i.largeOnly&&r.share*Yr(c)<Tn)continue;let u=e.isTransparent(s.material),h=r.reflectance*e.reflectanceOf(s.material);if(!r.inFrame&&(u||h<kn||h*r.share*Yr(c)<Mn)||r.mirrors>=i.orders&&(h<jr||e.kernel(s.material,i.taps).count>1)||!u&&r.values+1>=ot)continue;let f=u?0:++r.values;if(this.drawMask(e,s,o,f,r.inFrame),r.inFrame&&!s.visible){u||this.drawMask(e,s,o,0,!1,!0);continue}a.push({reflector:s,screen:c,value:f})}return n.disable(n.STENCIL_TEST),a}drawMask(e,r,i,a,n,o=!1){let{gl:s}=this.device;n&&r.asked&&s.getQueryParameter(r.query,s.QUERY_RESULT_AVAILABLE)&&(r.visible=s.getQueryParameter(r.query,s.QUERY_RESULT)>0,r.asked=!1);let l=a===0&&!o;A(s,{depthTest:!0,color:!1,cull:!0,mirrored:i.mirrored,stencilRef:l?Xr:a,stencilWrite:l?Xr:ot}),this.mask.use(),this.mask.set("u_clip_from_pack",i.clipFromPack),e.bindGeometry();let c=n&&!r.asked;c&&s.beginQuery(s.ANY_SAMPLES_PASSED,r.query??=s.createQuery()),e.draw(r),c&&(s.endQuery(s.ANY_SAMPLES_PASSED),r.asked=!0)}chooseImage(e,r,i){let a=i.ortho?0:.5*r*.5*i.height/i.tangents[1],n=a>=Fn*st?4:a>=st?2:1,o=a>=st?4:1,s=Math.max(i.width,i.height),l=Math.ceil(Math.min(Math.max(4*a,4),.15*s+4)),c=(d,m,v,_)=>o*_(((d*.5+.5)*m+v)/o),u=c(e.lower[0],i.width,-l,Math.floor),h=c(e.lower[1],i.height,-l,Math.floor),f=c(e.upper[0],i.width,l,Math.ceil),p=c(e.upper[1],i.height,l,Math.ceil);return{origin:[u,h],width:Math.max(f-u,1),height:Math.max(p-h,1),coarse:n}}image(e,r,i){let a=this.images[e];if(a&&a.width>=r&&a.height>=i)return a;let{gl:n,color:o,linear:s}=this.device,l=(m,v)=>2**Math.ceil(Math.log2(Math.max(m,v,16))),c=l(r,a?.width??0),u=l(i,a?.height??0);if(a){for(let m of[a.color,a.blurred,a.depth])n.deleteTexture(m);for(let m of[a.target,a.level])n.deleteFramebuffer(m)}let h=Math.log2(Math.max(c,u))+1,f=T(n,{width:c,height:u,levels:h,format:o,min:n.LINEAR_MIPMAP_NEAREST,mag:s}),p=T(n,{width:c,height:u,format:o,min:s,mag:s}),d=T(n,{width:c,height:u,format:n.DEPTH24_STENCIL8});return this.images[e]={width:c,height:u,color:f,blurred:p,depth:d,target:re(n,f,d),level:re(n,p)}}draw(e,r,i,a){let n=i.reflector,o=e.kernel(n.material,a.taps),s=o.count>1,l=this.chooseImage(i.screen,s?o.median:0,r.view),c=this.image(r.mirrors,l.width,l.height);this.drawMirrored(e,r,n,l,c,a),s&&this.makeLevels(l,c),s&&l.coarse>1&&this.drawBlurred(e,r.view,n,o,l,c),r.begin(),this.drawComposed(e,r,i,o,l,c),this.drawEmitters(e,r,i,o)}drawMirrored(e,r,i,a,n,o){let{gl:s,closest:l}=this.device,c=r.view,u=()=>{s.bindFramebuffer(s.FRAMEBUFFER,n.target),s.viewport(0,0,a.width,a.height)};u(),s.enable(s.SCISSOR_TEST),s.scissor(0,0,a.width,a.height),this.renderer.clear([...e.sky.map(m=>m*e.unit),l]),s.disable(s.SCISSOR_TEST);let h=this.mirroredView(e,i,c,a),f=e.opaque.filter(m=>te(h.clipFromPack,m.bounds)),p=i.dark.filter(m=>te(h.clipFromPack,m.bounds)),d={view:h,begin:u,inFrame:!1,mirrors:r.mirrors+1,texture:n.color,values:0,reflectance:r.reflectance*e.reflectanceOf(i.material),share:r.share*h.width*h.height/(c.width*c.height)};if(d.mirrors<o.mirrors){this.renderer.drawDepth(e,h,f);let m=this.drawMasks(e,d,o),v=this.curved.draw(e,d,o);this.renderer.drawReflected(e,h,f,p,new Set([...m.map(_=>_.reflector.material),...v.materials]));for(let _ of m)this.draw(e,d,_,o);u(),this.curved.add(e,d,v.later,o)}else this.renderer.drawReflected(e,h,f,p,new Set);e.movers.some&&(e.movers.drawDepth(h),e.movers.drawLight(h,!0)),this.renderer.drawTransparent(e,h)}mirroredView(e,r,i,a){let n=Ct();n[10]=-1;let o=Q(i.viewFromPack,r.packFromReflector),s=Q(Q(o,n),r.reflectorFromPack),l=ce(r.reflectorFromPack,i.eye);l[2]=-l[2];let c=0,u=e.bounds;for(let p=0;p<8;++p){let d=ee(s,[p&1?u.upper[0]:u.lower[0],p&2?u.upper[1]:u.lower[1],p&4?u.upper[2]:u.lower[2]]);c=Math.max(c,-1.01*d[2])}let h=$r(i,a.origin,a.width,a.height);h.far=Math.max(i.far,c),h.mirrored=!i.mirrored,h.viewFromPack=s,h.eye=ce(r.packFromReflector,l),h.clipFromView=Ge(h,h.far);let f=r.reflectorFromPack;return h.clipFromPack=Hr(Q(h.clipFromView,s),[f[2],f[6],f[10],f[14]-r.flatness-1e-5*r.size]),h}makeLevels(e,r){let{gl:i}=this.device,a=Math.ceil(Math.log2(Math.max(e.width,e.height)))+1,n=(o,s)=>Math.max(1,o+(1<<s)-1>>s);A(i,{}),this.pull.use(),this.pull.set("u_reach",1e30),i.bindFramebuffer(i.FRAMEBUFFER,r.level);for(let o=1;o<a;++o)k(i,"u_source",r.color),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_BASE_LEVEL,o-1),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MAX_LEVEL,o-1),i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,r.color,o),this.pull.set("u_source_size",[n(e.width,o-1),n(e.height,o-1)]),i.viewport(0,0,n(e.width,o),n(e.height,o)),this.renderer.drawScreen();i.framebufferTexture2D(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,r.blurred,0),k(i,"u_source",r.color),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_BASE_LEVEL,0),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MAX_LEVEL,a-1)}setConvolution(e,r,i,a,n,o,s){let{gl:l}=this.device,c=Q(i.viewFromPack,a.packFromReflector),u=N([c[8],c[9],c[10]],[0,0,1]),h=[i.centre[0]/i.tangents[0],i.centre[1]/i.tangents[1]];e.set("u_ndc_from_image",[2/i.width,2/i.height,2*o.origin[0]/i.width-1+h[0],2*o.origin[1]/i.height-1+h[1]]),e.set("u_tangents",i.tangents),e.set("u_ortho",i.ortho?1:0),e.set("u_plane_normal",u),e.set("u_plane_offset",B(u,[c[12],c[13],c[14]])),e.set("u_farthest",1e4*Math.max(_e(r.bounds),1e-12)),e.set("u_constant_footprint",-1),e.set("u_median",n.median),e.set("u_coarse",o.coarse),e.set("u_pixels_per_tangent",.5*i.height/i.tangents[1]),k(l,"u_image",s.color),k(l,"u_taps",n.taps),e.set("u_image_size",[o.width,o.height]),e.set("u_texture_size",[s.width,s.height]),e.set("u_tap_count",n.count),e.set("u_tap_rows",n.rows)}drawBlurred(e,r,i,a,n,o){let{gl:s}=this.device;s.bindFramebuffer(s.FRAMEBUFFER,o.level),s.viewport(0,0,Math.floor(n.width/n.coarse),Math.floor(n.height/n.coarse)),A(s,{}),this.blur.use(),this.setConvolution(this.blur,e,r,i,a,n,o),s.bindVertexArray(this.none),this.renderer.drawScreen()}where(e,r,i){let a={depthTest:!0,cull:!0,mirrored:e.view.mirrored};return e.inFrame&&r.value>0?{...a,stencilFunc:this.device.gl.EQUAL,stencilRef:r.value,stencilRead:ot}:{...a,blend:"add",alpha:i}}setReflector(e,r,i,a){let n=a.packFromReflector;r.bindGeometry(),e.set("u_clip_from_pack",i.view.clipFromPack),e.set("u_eye",i.view.eye),e.set("u_normal",[n[8],n[9],n[10]]),r.setReflectance(e,a.material),e.set("u_modulate",!0)}drawComposed(e,r,i,a,n,o){let{gl:s}=this.device,l=i.reflector,c=!r.inFrame&&e.reflectanceOf(l.material)>jr,u=a.count>1?this.convolve:this.compose;A(s,this.where(r,i,c)),u.use(),u.set("u_origin",n.origin),u.set("u_missing",[0,0,0]),u.set("u_with_distance",c),this.setReflector(u,e,r,l),k(s,"u_blurred",o.blurred),this.setConvolution(u,e,r.view,l,a,n,o),e.draw(l)}drawEmitters(e,r,i,a){let{gl:n}=this.device,o=i.reflector,s=o.emitters;if(!s)return;let l=e.data.reflectors[o.index],c=a.lobes?this.emitters:this.glints;c.use(),k(n,"u_polygons",s.polygons),k(n,"u_visibility",s.visibility),k(n,"u_seen",s.seen),a.lobes&&k(n,"u_lobes",a.lobes),c.set("u_cells",[s.cellsX,s.cellsY]),c.set("u_lower",l.lower.map(h=>h/o.size)),c.set("u_upper",l.upper.map(h=>h/o.size));let u=o.reflectorFromPack.slice();for(let h=0;h<4;++h)for(let f=0;f<3;++f)u[4*h+f]/=o.size;c.set("u_emitters_from_pack",u),a.lobes&&c.set("u_lobe_rows",33),this.setReflector(c,e,r,o),A(n,{...this.where(r,i,!1),blend:"add",alpha:!1}),e.draw(o)}};function En(t,e,r){let i=t.corners.map(o=>L(ee(e,o),1/r)),a=i.flatMap((o,s)=>{let l=i[(s+1)%i.length],c=o[2]>=0?[o]:[];return o[2]>=0!=l[2]>=0&&c.push(U(o,L(F(l,o),o[2]/(o[2]-l[2])))),c}),n=[];return a.length>=3&&n.push([a[0],a[1],a[2],a[Math.min(a.length-1,3)]]),a.length===5&&n.push([a[0],a[3],a[4],a[4]]),n}function lt(t,e,r,i,a,n){if(e.emitters.length===0||!(a>0))return;let o=e.nodesX-1,s=e.nodesY-1,l=o*s,c=[],u=new Uint8Array(4*l*e.emitters.length),h=new Uint32Array(4*l);if(e.emitters.forEach((f,p)=>{let d=r[f],m=e.visibility.subarray(p*e.nodesX*e.nodesY),v=En(d,i,a).map(_=>{let b=d.twoSided?-(p+1):p+1;return c.push(..._[0],..._[1],..._[2],..._[3],...d.radiance.map(g=>g*n),b),c.length/16-1});for(let _=0;_<s;++_)for(let b=0;b<o;++b){let g=_*e.nodesX+b,w=_*o+b,x=[m[g],m[g+1],m[g+e.nodesX],m[g+e.nodesX+1]];if(u.set(x,4*(p*l+w)),x.some(y=>y>0))for(let y of v)h[4*w+(y>>5)]|=1<<(y&31)}}),c.length!==0)return{cellsX:o,cellsY:s,polygons:T(t,{width:4,height:c.length/16,format:t.RGBA32F},new Float32Array(c)),visibility:T(t,{width:o,height:s*e.emitters.length,format:t.RGBA8},u),seen:T(t,{width:o,height:s,format:t.RGBA32UI},h)}}function Qr(t,e,r){let i=t.corners,a=i.length,n=[0,0,0],o=0;i.forEach((f,p)=>{n=U(n,O(F(f,i[0]),F(i[(p+1)%a],i[0]))),o=Math.max(o,j(F(i[(p+1)%a],f)))});let s=N(n,[0,0,0]),l=j(s)>0?.001*o:-1,c=i.map((f,p)=>N(O(s,F(i[(p+1)%a],f)),[0,0,0])),u=f=>{let p=[e.positions[3*f],e.positions[3*f+1],e.positions[3*f+2]];return Math.abs(B(F(p,i[0]),s))<=l&&i.every((d,m)=>B(F(p,d),c[m])>=-l)},h=[];for(let f of e.parts){if(r[f.material].emission.every(d=>d===0))continue;let p=[];for(let d=f.first;d<f.first+f.count;d+=3){let m=[...e.indices.subarray(d,d+3)];m.every(u)&&p.push(...m)}p.length>0&&h.push({part:f,indices:p})}return h}var Rn=Float32Array.from({length:256},(t,e)=>e/255<=.04045?e/255/12.92:((e/255+.055)/1.055)**2.4),An=t=>t<=.0031308?12.92*t:1.055*t**(1/2.4)-.055,Zr=t=>Math.round(255*Math.min(Math.max(t,0),1));function Sn(t,e){let r=t.width*t.height,i=new Float32Array(5*r),a=t.texels;for(let n=0;n<r;++n){let o=a[4*n+3]/255,s=e>0?+(o>=Math.fround(e)):o;for(let l=0;l<3;++l)i[5*n+l]=Rn[a[4*n+l]]*s;i[5*n+3]=s,i[5*n+4]=o}return{width:t.width,height:t.height,texels:i}}function Jr(t,e){let r=t/e;return Array.from({length:e},(i,a)=>{let n=[];for(let o=Math.floor(a*r);o<t&&o<(a+1)*r;++o)n.push([o,(Math.min((a+1)*r,o+1)-Math.max(a*r,o))/r]);return n})}function Ln(t){let e=Math.max(1,t.width>>1),r=Math.max(1,t.height>>1),i=new Float32Array(5*e*r),a=Jr(t.width,e);return Jr(t.height,r).forEach((o,s)=>a.forEach((l,c)=>{for(let[u,h]of o)for(let[f,p]of l)for(let d=0;d<5;++d)i[5*(s*e+c)+d]+=p*h*t.texels[5*(u*t.width+f)+d]})),{width:e,height:r,texels:i}}function zn(t,e,r){let i=t.texels.length/5,a=Math.min(Math.round(e*i),i),n=new Float32Array(i);for(let h=0;h<i;++h)n[h]=t.texels[5*h+4];n.sort().reverse();let o=n.filter(h=>h>=Math.fround(r)).length;if(a===0||a===o)return 1;let s=n[a-1],l=n.indexOf(s),c=n.lastIndexOf(s)+1,u=l===0||c-a<=a-l?s:n[l-1];return u>0?(r+1/255)/u:1}function Pn(t,e){let r=new Uint8Array(t.texels.length/5*4),i=t.texels;for(let a=0;a<r.length/4;++a){let n=i[5*a+3];for(let o=0;o<3;++o)r[4*a+o]=Zr(n>0?An(i[5*a+o]/n):0);r[4*a+3]=Zr(e*i[5*a+4])}return r}function ei(t,e){let r=[];for(let a=Sn(t,e);a.width>1||a.height>1;)r.push(a=Ln(a));if(r.length===0)return[];let i=r[r.length-1].texels[3];for(let a=r.length-2;a>=0;--a){let n=r[a+1],o=r[a];for(let s=0,l=0;s<o.height;++s)for(let c=0;c<o.width;++c,++l){if(o.texels[5*l+3]>0)continue;let u=5*(Math.min(s>>1,n.height-1)*n.width+Math.min(c>>1,n.width-1));o.texels.set(n.texels.subarray(u,u+4),5*l)}}return r.map(a=>({width:a.width,height:a.height,texels:Pn(a,e>0?zn(a,i,e):1)}))}var ri=1667,ii=25e3,Gn=100,Vn=.01,Bn=t=>.2126*t[0]+.7152*t[1]+.0722*t[2],ct=t=>t.map(e=>e/Math.max(Bn(t),1e-6));function ut(t){let e=1e3/Math.min(Math.max(t,ri),ii),r=t<=4e3?((-.2661239*e-.2343589)*e+.8776956)*e+.17991:((-3.0258469*e+2.1070379)*e+.2226347)*e+.24039,i=t<=2222?((-1.1063814*r-1.3481102)*r+2.18555832)*r-.20219683:t<=4e3?((-.9549476*r-1.37418593)*r+2.09137015)*r-.16748867:((3.081758*r-5.8733867)*r+3.75112997)*r-.37001483,a=r/i,n=(1-r-i)/i;return ct([3.2404542*a-1.5371385-.4985314*n,-.969266*a+1.8760108+.041556*n,.0556434*a-.2040259+1.0572252*n].map(o=>Math.max(o,0)))}function Dn(t){if(!/^#[0-9a-f]{6}$/i.test(t))return;let e=[1,3,5].map(r=>{let i=parseInt(t.slice(r,r+2),16)/255;return i<=.04045?i/12.92:((i+.055)/1.055)**2.4});return Math.max(...e)>0?ct(e):void 0}function Cn(t){let e=Math.max(...t);return`#${t.map(r=>{let i=r/e<=.0031308?12.92*r/e:1.055*(r/e)**.4166666666666667-.055;return Math.round(255*Math.min(Math.max(i,0),1)).toString(16).padStart(2,"0")}).join("")}`}var Ce=(t,e)=>t.map((r,i)=>{let a={on:!0,value:r.value};return e?.hours.some(n=>n.group===i)&&(a.value=1,a.hour=e.shown),r.color.some(n=>n!==1)&&(a.color=ct(r.color.map((n,o)=>n*r.ownColor[o]))),a});function In(t,e){let r=Dn(t),i=/^([0-9.]+)k$/i.exec(t),a=Number(t);t==="on"||t==="off"?e.on=t==="on":r?(e.color=r,delete e.kelvin):i&&Number(i[1])>=ri&&Number(i[1])<=ii?Ie(e,Number(i[1])):t!==""&&a>=0&&a<=Gn&&(e.value=a,e.on=!0)}function Ie(t,e){t.kelvin=e,t.color=ut(e)}function ai(t,e,r,i){for(let a of e){let n=a.lastIndexOf("="),o=a.slice(0,n);i&&o==="hour"&&t.every(s=>s.name!==o)&&ht(i,Number(a.slice(n+1)),r),t.forEach((s,l)=>{let c=o==="*"||(r[l].hour===void 0?o===s.name:o==="day");n>0&&c&&a.slice(n+1).split(/\s+/).forEach(u=>In(u,r[l]))})}}function ht(t,e,r){if(e>=t.hours[0].hour&&e<=t.hours.at(-1).hour)for(let i of r)i.hour!==void 0&&(i.hour=e)}function Un(t,e){let r=t.find(u=>u.hour!==void 0)?.hour;if(!e||r===void 0)return t.map(()=>1);let{hours:i}=e,a=i.filter(u=>u.group<t.length).length,n=Math.max(i.findIndex(u=>u.hour>=r),0),o=Math.max(n-1,0),s=i[o].hour,l=i[n].hour,c=l>s?(r-s)/(l-s):1;return t.map((u,h)=>u.hour===void 0?1:a*((i[n].group===h?c:0)+(o<n&&i[o].group===h?1-c:0)))}function ni(t,e,r){let i=s=>[String(+s.value.toFixed(3)),s.kelvin?`${Math.round(s.kelvin)}K`:s.color?Cn(s.color):"",s.on?"":"off"].filter(Boolean).join(" "),a=Ce(t,r),n=e.find(s=>s.hour!==void 0)?.hour,o=e.flatMap((s,l)=>i(s)===i(a[l])?[]:[`${t[l].name}=${i(s)}`]);return n===void 0||n===r?.shown?o:[`hour=${n}`,...o]}var oi=(t,e,r,i=Un(e,r))=>e.map((a,n)=>[0,1,2].map(o=>a.on?i[n]*a.value*(a.color?a.color[o]/Math.max(t[n].ownColor[o],Vn):1):0)),On;function ti(t,e,r,i,a,n){let o=e?t.restOfDetail:t.rest,s=new Uint16Array(i.length),l=On??=Float32Array.from({length:1984},(c,u)=>Y(u<<4));for(let c=0;c<o.length;++c){let u=o[c],h=r[u];for(let f=0;f<3;++f){let p=h[f]*Y(i[3*c+f])*a;for(let d of t.others)d.group!==u&&(p+=(r[d.group][f]-h[f])*t.scale*l[(e?d.detail:d.light)[3*c+f]]);s[3*c+f]=Dt(Math.max(p,0)/n)}}return s}function si(t,e,r){if(!e||e.width!==t.width||e.height!==t.height||r.every(n=>n.every(o=>o===1)))return t;let i=Math.max(1,...r.flat()),a=t.scale*2**Math.ceil(Math.log2(i));return{...t,scale:a,light:ti(e,!1,r,t.light,t.scale,a),detail:t.detail&&ti(e,!0,r,t.detail,t.scale,a)}}function li(t,e){let r=t.hours.filter(i=>i.group<e.length);return[0,1,2].map(i=>r.reduce((a,n)=>a+e[n.group][i]/r.length*n.sky[i],0))}function be(t,e,r,i){return[0,1,2].map(a=>Math.max(0,t.reduce((n,o,s)=>n+(e[s][a]-1)*(o[r][3*i+a]??0),1)))}var Nn=.001,ft=.2,Ue=16;function Oe(t,e){let r=new Float64Array(e*e),i=Math.sqrt(.25/Math.PI),a=1,n=0;for(let o=0;o<e;++o){o>0&&(i*=Math.sqrt((2*o+1)/(2*o)),[a,n]=[t[0]*a-t[1]*n,t[0]*n+t[1]*a]);let s=0,l=i*(o>0?Math.SQRT2:1);for(let c=o;c<e;++c){if(c>o){let u=Math.sqrt((4*c*c-1)/(c*c-o*o)),h=c===o+1?0:-u*Math.sqrt(((c-1)**2-o*o)/(4*(c-1)**2-1));[s,l]=[l,u*t[2]*l+h*s]}r[c*(c+1)+o]=l*a,o>0&&(r[c*(c+1)-o]=l*n)}}return r}function ui(t,e,r){let i=t.lights.map(a=>a.intensity);return e.forEach((a,n)=>{for(let o of a.brightLights)i[o]=t.lights[o].intensity.map((s,l)=>s*r[n][l])}),{field:t,bright:i,probes:t.valid.length===0?[]:Array.from(t.valid,(a,n)=>be(e,r,"probes",n))}}function Wn(t,e,r){let i=Math.sqrt(Math.max(0,1-Math.abs(r[2]))),a=i*Math.atan2(Math.abs(r[1]),Math.abs(r[0]))*(2/Math.PI),n=i-a,[o,s]=r[2]<0?[1-a,1-n]:[n,a],l=t.depthSide,c=b=>b<0||Object.is(b,-0)?-1:1,u=(.5*o*c(r[0])+.5)*l-.5,h=(.5*s*c(r[1])+.5)*l-.5,f=Math.floor(u),p=Math.floor(h),d=u-f,m=h-p,v=l*l,_=[0,0];for(let b=0;b<4;++b){let g=[f+(b&1),p+(b>>1)];for(let y of[0,1])(g[y]<0||g[y]>=l)&&(g[y]=g[y]<0?-1-g[y]:2*l-1-g[y],g[1-y]=l-1-g[1-y]);let w=(b&1?d:1-d)*(b>>1?m:1-m),x=e*v+g[1]*l+g[0];_[0]+=w*t.depth[x]/65535,_[1]+=w*t.depthSquared[x]/65535}return _}function $n(t,e,r){let i=F(r,[t.positions[3*e],t.positions[3*e+1],t.positions[3*e+2]]),a=j(i);if(!(a>0))return 1;let[n,o]=Wn(t,e,L(i,1/a)),s=a/t.depthCap-n;if(s<=0)return 1;let l=Math.max(o-n*n,1e-6);return(l/(l+s*s))**3}function Hn(t,e){let r=[0,0,0],i=0,a=1;for(let n=0;n<3;++n){let o=t.size[n],s=Math.min(Math.max((e[n]-t.lower[n])/t.cell[n],0),o),l=Math.min(Math.floor(s),o-1);r[n]=s-l,i+=l*a,a*=o}for(;t.cells[9*i]!==0;){i=t.cells[9*i];for(let n=0;n<3;++n){let o=r[n]>=.5;r[n]=2*r[n]-Number(o),o&&(i+=1<<n)}}return{cell:i,inCell:r}}var ci=(t,e,r)=>(t[2*e+(r>>5)]>>>(r&31)&1)>0;function qn(t){if(t.kind===1||t.kind===2)return[{at:t.position,w:1}];let e=[];if(t.kind===3){let n=Math.tan(Math.min(t.angularRadius,1.5)),o=L(t.direction,-1),s=n>0?Ue:1,l=N(O(Math.abs(o[0])<.9?[1,0,0]:[0,1,0],o),[1,0,0]),c=O(o,l);for(let u=0;u<s;++u){let h=s>1?n*Math.sqrt((u+.5)/s):0,f=2.3999632*u;e.push({at:N(U(o,U(L(l,h*Math.cos(f)),L(c,h*Math.sin(f)))),o),w:0})}return e}let r=[],i=t.corners,a=0;for(let n=0;n+2<i.length;n+=3)r.push(a+=.5*j(O(F(i[n+1],i[n]),F(i[n+2],i[n]))));for(let n=0;n<Ue&&a>0;++n){let o=.5/Ue,s=0;for(let d=n,m=.5;d>0;d>>=1,m*=.5)o+=(d&1)*m;let l=(n+.5)/Ue*a;for(;s+1<r.length&&r[s]<=l;)++s;let c=s>0?r[s-1]:0,u=Math.sqrt(Math.min(Math.max((l-c)/Math.max(r[s]-c,1e-30),0),1)),[h,f,p]=[i[3*s],i[3*s+1],i[3*s+2]];e.push({at:U(L(h,1-u),U(L(f,u*(1-o)),L(p,u*o))),w:1})}return e}function Xn(t,e,r,i,a,n){let o=qn(t),s=a*a,l=1;if(t.kind===0){l=0;for(let h=0,f=t.corners;h+2<f.length;h+=3)l+=.5*j(O(F(f[h+1],f[h]),F(f[h+2],f[h])))}let c=Math.cos(t.outerCone),u=c+Math.max(.001,Math.cos(t.innerCone)-c);for(let{at:h,w:f}of o){let p=F(h,L(i,f)),d=Math.max(B(p,p),1e-12),m=L(p,1/Math.sqrt(d)),v=-B(m,t.direction),_=1;t.kind===0&&(_=t.twoSided?Math.abs(v):Math.max(v,0)),t.kind===2&&(_=Math.min(Math.max((v-c)/(u-c),0),1)**2);let b=f===0?1:l*_/d,g=Oe(m,a),w=b*r/o.length;for(let x=0;x<3;++x)for(let y=0;y<s;++y)n[x*s+y]+=w*e[x]*g[y]}}function hi(t,e){let{field:r}=t,i=r.bands*r.bands,a=new Float64Array(3*i),{cell:n,inCell:o}=Hn(r,e),s=[...r.cells.subarray(9*n+1,9*n+9)],l=[],c=[],u=[];s.forEach((_,b)=>{let g=o.reduce((y,G,C)=>y*(b>>C&1?G:1-G),1),w=r.valid[_]>0,x=w?$n(r,_,e):0;x<ft&&(x*=x*x/(ft*ft)),u.push(g),c.push(w?g:0),l.push(x*g)});let h=_=>_.reduce((b,g)=>b+g,0),f=Math.min(1,h(l)),p=f>Nn?l:h(c)>0?c:u,d=h(p),m=r.lights.map(()=>0),v=r.lights.map(()=>!1);return s.forEach((_,b)=>{let g=p[b]/d;if(g>0){for(let w=0;w<3;++w){let x=g*(t.probes[_]?.[w]??1);for(let y=0;y<i;++y)a[w*i+y]+=x*r.harmonics[(w*i+y)*r.valid.length+_]}r.lights.forEach((w,x)=>{v[x]||=ci(r.bright,_,x),ci(r.kept,_,x)&&(m[x]+=g)})}}),r.lights.forEach((_,b)=>{v[b]&&Xn(_,t.bright[b],Math.max(0,1-m[b]),e,r.bands,a)}),{sh:a,trust:f}}var fe=.7,jn=.02,Kn=.05;function Yn(t,e,r){let i=t.reduce((o,s,l)=>o+s*e[l],0),a=e;if(i<0&&(i=-i,a=e.map(o=>-o)),i>1-1e-7)return t.map((o,s)=>o+(a[s]-o)*r);let n=Math.acos(i);return t.map((o,s)=>(Math.sin((1-r)*n)*o+Math.sin(r*n)*a[s])/Math.sin(n))}function fi(t,e){let r=t.keys,i=r[r.length-1];if(!i)return t.rest;let a=e>i.time?i.time>0?e%i.time:i.time:e,n=r.findIndex(c=>c.time>a);if(n<=0)return(n===0?r[0]:i).pose;let o=r[n-1],s=r[n],l=(a-o.time)/(s.time-o.time);return{position:U(o.pose.position,L(F(s.pose.position,o.pose.position),l)),rotation:Yn(o.pose.rotation,s.pose.rotation,l)}}function dt(t){let e=Math.hypot(...t.rotation)||1,[r,i,a,n]=t.rotation.map(o=>o/e);return new Float64Array([1-2*(i*i+a*a),2*(r*i+n*a),2*(r*a-n*i),0,2*(r*i-n*a),1-2*(r*r+a*a),2*(i*a+n*r),0,2*(r*a+n*i),2*(i*a-n*r),1-2*(r*r+i*i),0,...t.position,1])}var Ne=t=>[1,t&1?fe:-fe,t&2?fe:-fe,t&4?fe:-fe];function Qn(t){let e=Array.from({length:4},(i,a)=>Array.from({length:4},(n,o)=>t.reduce((s,l,c)=>s+l*Ne(c)[a]*Ne(c)[o],0)));for(let i=1;i<4;++i)e[i][i]+=Kn*e[0][0];let r=new Float64Array(e.flat());return t.map((i,a)=>Pe(r,Ne(a)).map(n=>i*n))}var Zn=[[.1252334085114689,.2491470458134028],[.3678314989981802,.2334925365383548],[.5873179542866175,.2031674267230659],[.7699026741943047,.1600783285433462],[.9041172563704749,.1069393259953184],[.9815606342467192,.0471753363865118]],mt;function Jn(){if(mt)return mt;let t=[],e=12;for(let[r,i]of Zn)for(let a of[r,-r])for(let n=0;n<e;++n){let o=2*Math.PI*n/e,s=Math.sqrt(1-a*a);t.push({way:[s*Math.cos(o),s*Math.sin(o),a],weight:i*2*Math.PI/e})}return mt=t}function eo(t,e,r,i){let a=r*r,n=new Float64Array(t.length);for(let{way:o,weight:s}of Jn()){let l=Oe(o,r),c=[0,1,2].map(h=>i[h]*o[0]+i[4+h]*o[1]+i[8+h]*o[2]),u=Oe(c,r);for(let h=0;h<e;++h){let f=0;for(let p=0;p<a;++p)f+=t[h*a+p]*u[p];for(let p=0;p<a;++p)n[h*a+p]+=s*f*l[p]}}return n}function mi(t,e,r,i){let a=e.components+1,n=new Float32Array(e.clusters*a*3*4),{bands:o}=t.field,s=o*o,l=Array.from({length:8},(d,m)=>{let v=Ne(m),_=[0,1,2].map(b=>.5*(r.lower[b]+r.upper[b])+.5*v[b+1]*(r.upper[b]-r.lower[b]));return hi(t,ee(i,_))}),c=Qn(l.map(d=>Math.max(d.trust,jn))),u=new Float64Array(12*s);for(let d=0;d<3;++d)for(let m=0;m<4;++m)for(let v=0;v<s;++v)u[(4*d+m)*s+v]=l.reduce((_,b,g)=>_+c[g][m]*b.sh[d*s+v],0);let h=eo(u,12,o,i),f=Math.min(e.bands*e.bands,s),p=e.channels*e.bands*e.bands;for(let d=0;d<e.clusters*a;++d){let m=Math.floor(d/a),v=d%a,_=v===0?1:e.weightScale[m*(a-1)+v-1];for(let b=0;b<3;++b){let g=d*p+(e.channels===3?b*e.bands*e.bands:0);for(let w=0;w<4;++w){let x=0;for(let y=0;y<f;++y)x+=e.basis[g+y]*h[(4*b+w)*s+y];n[4*(3*d+b)+w]=_*x}}}return n}var pt=2048,di=127;function to(t,e){let{mesh:r,transfer:i}=e,a=0,n=(o,s,l,c=t.FLOAT,u=!1)=>{s&&(t.bindBuffer(t.ARRAY_BUFFER,t.createBuffer()),t.bufferData(t.ARRAY_BUFFER,s,t.STATIC_DRAW),t.enableVertexAttribArray(o),t.vertexAttribPointer(o,l,c,u,0,0),a+=s.byteLength)};return n(0,r.positions,3),n(1,r.normals,3),n(2,r.uvs,2),n(4,r.colors,4,t.UNSIGNED_BYTE,!0),n(5,r.normalUvs,2),n(6,r.tangents,4),n(7,i.cluster,1,t.UNSIGNED_BYTE),t.vertexAttrib4f(4,1,1,1,1),t.bindBuffer(t.ELEMENT_ARRAY_BUFFER,t.createBuffer()),t.bufferData(t.ELEMENT_ARRAY_BUFFER,r.indices,t.STATIC_DRAW),a+r.indices.byteLength}var We=class{constructor(e,r){this.device=e;this.scene=r}movers=[];depth;light;field;shining;get animated(){return this.movers.some(e=>(e?.mover.keys.length??0)>1)}get some(){return this.movers.some(e=>e?.table)}setField(e){this.field=e,this.relight()}relight(){if(this.field){this.shining=ui(this.field,this.scene.data.groups,this.scene.factors);for(let e of this.movers)e&&delete e.placedAt}}add(e,r){let{gl:i}=this.device,a=r.mesh.positions;this.depth??=z.make(i,"depth"),this.light??=z.make(i,"mover_light");let n=he(),o=[];for(let d of r.mesh.parts){if(d.count===0)continue;let m={...d,page:-1,bounds:he()};for(let v=d.first;v<d.first+d.count;++v){let _=3*r.mesh.indices[v];ae(m.bounds,a[_],a[_+1],a[_+2])}ae(n,...m.bounds.lower),ae(n,...m.bounds.upper),o.push(m)}if(o.length===0)return;let s=i.createVertexArray(),l=r.transfer.components,c=Math.ceil(l/4),u=a.length/3;i.bindVertexArray(s),this.scene.bytes+=to(i,r),i.bindVertexArray(null);let h=Math.max(1,Math.ceil(u*c/pt)),f=new Int16Array(h*pt*4);for(let d=0;d<u;++d)f.set(r.transfer.weight.subarray(d*l,d*l+l),d*c*4);let p=T(i,{width:pt,height:h,format:i.RGBA16I},f);this.movers[e]={mover:r,array:s,ranges:o,bounds:n,weights:p,packFromObject:dt(r.rest)},this.scene.bytes+=f.byteLength}place(e){let{gl:r}=this.device;for(let i of this.movers){if(!i||!this.shining)continue;let a=i.mover.keys.length>1?e:0;if(i.placedAt===a)continue;i.placedAt=a,i.packFromObject=dt(fi(i.mover,a)),i.table&&r.deleteTexture(i.table);let{components:n,clusters:o}=i.mover.transfer,s=mi(this.shining,i.mover.transfer,i.bounds,i.packFromObject);i.table=T(r,{width:3*(n+1),height:o,format:r.RGBA32F},s.map(l=>l*this.scene.unit))}}bounds(){let e=this.scene.bounds,r={lower:[...e.lower],upper:[...e.upper]};for(let i of this.movers)for(let a=0;i?.table&&a<8;++a){let{lower:n,upper:o}=i.bounds,s=[a&1?o[0]:n[0],a&2?o[1]:n[1],a&4?o[2]:n[2]];ae(r,...ee(i.packFromObject,s))}return r}drawDepth(e){this.each(e,this.depth,r=>{let i=this.scene.data.materials[r.material];A(this.device.gl,{depthTest:!0,depthWrite:!0,color:!1,cull:!i.doubleSided,mirrored:e.mirrored}),this.depth.set("u_alpha",i.alpha),this.depth.set("u_alpha_cutoff",se(i)),this.scene.bindBase(i.texture)})}drawLight(e,r){if(!this.some)return;let i=e.viewFromPack;this.light.use(),this.light.set("u_eye",e.eye),this.light.set("u_alpha_kind",r?e.ortho?2:1:0),this.light.set("u_depth_row",[-i[2],-i[6],-i[10],-i[14]]),this.light.set("u_closest",this.device.closest),this.light.set("u_changed",!1),this.light.set("u_weights",[1,1,1]),this.each(e,this.light,(a,n)=>{let o={depthTest:!0,stencilRef:di,stencilWrite:di,mirrored:e.mirrored};A(this.device.gl,{...o,cull:!this.scene.data.materials[a.material].doubleSided}),this.scene.setSurface(this.light,a,!!n.mesh.normalUvs)})}each(e,r,i){let{gl:a}=this.device;for(let n of this.movers){if(!n?.table)continue;let o=Q(e.clipFromPack,n.packFromObject),s=n.bounds.upper.map((l,c)=>.5*(l-n.bounds.lower[c]));this.scene.bindGeometry(),a.bindVertexArray(n.array),r.use(),r.set("u_clip_from_pack",o),r.set("u_pack_from_object",n.packFromObject),r.set("u_box_center",oe(n.bounds)),r.set("u_box_scale",s.map(l=>l>0?1/l:0)),r.set("u_components",n.mover.transfer.components);for(let l of n.ranges)te(o,l.bounds)&&(i(l,n.mover),k(a,"u_codes",n.weights),k(a,"u_table",n.table),this.scene.draw(l))}}};function ro(t){let e=new Float32Array(4*t.light.length);return t.light.forEach((r,i)=>{if(t.valid[i]===0)return;let a=t.scale*2**((r>>>27)-24);e.set([(r&511)*a,(r>>>9&511)*a,(r>>>18&511)*a,1],4*i)}),{size:t.size,texels:e}}function io(t){let e=t.size/2,r={size:e,texels:new Float32Array(4*e*e)};for(let i=0;i<e;++i)for(let a=0;a<e;++a){let n=[0,0,0,0];for(let o=0;o<4;++o){let s=4*((2*i+(o>>1))*t.size+2*a+(o&1)),l=t.texels[s+3];for(let c=0;c<3;++c)n[c]+=l*t.texels[s+c];n[3]+=l}n[3]>0&&r.texels.set([n[0]/n[3],n[1]/n[3],n[2]/n[3],.25*n[3]],4*(i*e+a))}return r}function ao(t){for(let e=t.length-2;e>=0;--e){let r=t[e],i=t[e+1];for(let a=0;a<r.size*r.size;++a){if(r.texels[4*a+3]>0)continue;let n=4*((a/r.size>>1)*i.size+(a%r.size>>1));r.texels.set(i.texels.subarray(n,n+4),4*a)}}}function pi(t,e){for(let r=-1;r<=t;++r)for(let i=-1;i<=t;++i){let a=[i,r];for(let n of[0,1])(a[n]<0||a[n]>=t)&&(a[n]=a[n]<0?-1-a[n]:2*t-1-a[n],a[1-n]=t-1-a[1-n]);e(i+1,r+1,a[1]*t+a[0])}}function no(t,e,r){let i=u=>u>0?Math.min(u,65408):0,a=[i(t),i(e),i(r)],n=Math.max(...a);if(n<=0)return 0;let o=Math.max(-16,Math.floor(Math.log2(n)))+16;Math.floor(n*2**(24-o)+.5)>=512&&++o;let[s,l,c]=a.map(u=>Math.floor(u*2**(24-o)+.5));return(s|l<<9|c<<18|o<<27)>>>0}var vi=(t,e)=>e===0?[0,0]:[t+2,t-(t>>e-1)+2*(e-1)];function gi(t,e){let r=[ro(e)],i=e.size;for(;r[r.length-1].size>1;)r.push(io(r[r.length-1]));ao(r);let a=0,n=0,o=1/0;for(let d=0;d<i*i;++d){for(let m=0;m<3;++m)a=Math.max(a,r[0].texels[4*d+m]);n=Math.max(n,e.inverseDistance[d]),o=Math.min(o,e.inverseDistance[d])}let s=a>0?2**Math.min(Math.max(Math.floor(Math.log2(a))-14,-120),120):1,l=r.length-1,c=Math.max(i+2,l>0?i+i/2+4:0),u=Math.max(i+2,l>0?vi(i,l)[1]+3:3),h=new Uint32Array(c*u),f=new Float32Array((i+2)**2);r.forEach((d,m)=>{let[v,_]=vi(i,m),b=d.texels;pi(d.size,(g,w,x)=>{h[(_+w)*c+v+g]=no(b[4*x]/s,b[4*x+1]/s,b[4*x+2]/s)})}),pi(i,(d,m,v)=>{f[m*(i+2)+d]=e.inverseDistance[v]});let p=t.getExtension("OES_texture_float_linear")?t.LINEAR:t.NEAREST;return{centre:e.centre,size:i,scale:s,range:[n,o],tint:[1,1,1],light:T(t,{width:c,height:u,format:t.RGB9_E5,min:t.LINEAR,mag:t.LINEAR},h),inverseDistance:T(t,{width:i+2,height:i+2,format:t.R32F,min:p,mag:p},f)}}function _i(t,e){let r=0;for(let a=0;a<t.length;++a)r+=t[a];let i=e*r;for(let a=0;a<t.length;++a){if(i<t[a])return a+i/t[a];i-=t[a]}return t.length}function oo(t){let e=0;for(let r=.5;t!==0;t>>>=1,r*=.5)e+=(t&1)*r;return e}function bi(t,e,r,i){let a=new Float64Array(e);for(let c=0;c<e;++c)for(let u=0;u<e;++u)a[c]+=t[c*e+u];let n=[],o=i(1,1),s=i(0,0),l=(o[0]-s[0])*(o[1]-s[1]);for(let c=0;c<r;++c){let u=_i(a,(c+.5)/r),h=Math.min(Math.floor(u),e-1),f=_i(t.subarray(h*e,h*e+e),oo(c)+.5/r),p=Math.min(Math.floor(f),e-1),d=i(p/e,h/e),m=i((p+1)/e,(h+1)/e),v=i(f/e,u/e),_=Math.max(t[h*e+p],1e-12)*r;n.push({x:v[0],y:v[1],width:Math.sqrt(Math.min((m[0]-d[0])*(m[1]-d[1])/_,l)),weight:1})}return n}var so=t=>(e,r)=>[t.width[0]*Math.sinh(t.lower[0]+e*(t.upper[0]-t.lower[0])),t.shift+t.width[1]*Math.sinh(t.lower[1]+r*(t.upper[1]-t.lower[1]))];function lo(t,e){return(r,i)=>{let a=(2*r-1)*t.halfExtent*e,n=(2*i-1)*t.halfExtent,o=2/(1+Math.sqrt(1+a*a+n*n));return[a*o,n*o]}}function wi(t,e){if(t.length===1)return[0,0,0];let r=o=>Math.sqrt(t[o].cosTheta),i=Math.sqrt(e),a=1;for(;a+1<t.length&&r(a)<i;)++a;let n=r(a-1);return[a-1,a,Math.min(Math.max((i-n)/(r(a)-n),0),1)]}function yi(t,e){let r=t?.factor;if(!r||r.length===0)return 1;let i=r.length/3-1,a=Math.sqrt(Math.min(Math.max(e,0),1))*i,n=Math.min(Math.floor(a),i),o=s=>.2126*r[3*s]+.7152*r[3*s+1]+.0722*r[3*s+2];return o(n)+(o(Math.min(n+1,i))-o(n))*(a-n)}function co(t,e,r){let i=e*e,a=Math.sqrt(Math.max(0,1-i*i)),n=0,o=0;for(let l of t){let c=.25*(l.x*l.x+l.y*l.y),u=[l.x/(1+c),l.y/(1+c),(1-c)/(1+c)],h=[0,2*i*a,2*i*i-1];l.weight=yi(r,Math.sqrt(Math.max(0,.5*(1+h[1]*u[1]+h[2]*u[2])))),a*u[1]+i*u[2]>0&&(n+=l.weight,++o)}let s=o>0?n/o:1;for(let l of t)l.weight=s>0?l.weight/s:1;return s}function xi(t,e,r){if(!t||t.size<=1||!(t.halfExtent>0))return{count:1,rows:1,median:0,texels:new Float32Array([0,0,0,1]),means:[1]};let i=t.slices.map(l=>bi(l.weights,t.sliceSize,e,so(l))),a=i.length===0?9:Math.max(i.length,2),n=new Float32Array(4*e*a),o=[],s=0;for(let l=0;l<a;++l){let c=l/(a-1),u;if(i.length===0)u=bi(t.weights,t.size,e,lo(t,Math.max(c*c,.001)));else{let[h,f,p]=wi(t.slices,c*c);u=i[h].map((d,m)=>{let v=i[f][m],_=(b,g)=>b+(g-b)*p;return{x:_(d.x,v.x),y:_(d.y,v.y),width:_(d.width,v.width),weight:1}})}o.push(co(u,c,r)),u.forEach((h,f)=>n.set([h.x,h.y,h.width,h.weight],4*(l*e+f))),l===a-1&&(s=u.map(h=>Math.hypot(h.x,h.y)).sort((h,f)=>h-f)[e>>1])}return{count:e,rows:a,median:s,texels:n,means:o}}var me=33;function ki(t,e,r){let i=new Float32Array(8*me),a=n=>{let[o,s,l,c]=t.fits[n],u=t.slices[n].cosTheta,h=Math.sqrt(Math.max(0,1-u*u));return[o*u+s*h,s*u-o*h,l,c*u+h].map(f=>f/(u-c*h))};for(let n=0;n<me;++n){let o=n/(me-1),[s,l,c]=wi(t.slices,o*o),u=a(s),h=a(l),f=u.map((v,_)=>v+(h[_]-v)*c);f[2]=u[2]*h[2]/(h[2]+(u[2]-h[2])*c),i.set(f,4*n);let p=o*(r.length-1),d=Math.min(Math.floor(p),Math.max(r.length-2,0)),m=Math.min(d+1,r.length-1);i.set([yi(e,o*o),r[d]+(r[m]-r[d])*(p-d)],4*(me+n))}return i}function vt(t){let e=t.getExtension("EXT_color_buffer_float")&&t.getExtension("EXT_float_blend")&&t.getExtension("OES_texture_float_linear");if(!e&&!t.getExtension("EXT_color_buffer_float")&&!t.getExtension("EXT_color_buffer_half_float"))throw new Error("This device cannot draw light of more than eight bits.");return{gl:t,color:e?t.RGBA32F:t.RGBA16F,linear:t.LINEAR,closest:e?1e-15:1e-7}}var $e=class{constructor(e,r){this.device=e;this.data=r;let i=e.gl,a=r.mesh,n=Math.max(1,...r.materials.flatMap(c=>c.emission),...r.sky);this.emission=r.materials.map(c=>c.unlit&&!c.emission.some(u=>u>0)?[1,1,1]:c.emission),this.sky=r.sky,this.unlitWhite=Math.max(...this.emission.filter((c,u)=>r.materials[u].unlit).flat(),0)||1,this.factors=r.groups.map(()=>[1,1,1]),this.unit=e.color===i.RGBA32F?1:Math.min(1,8192/n);let o=this.sortRanges();r.reflectors.forEach((c,u)=>this.addReflector(u,o)),this.movers=new We(e,this),this.curved=r.curved.map(c=>({...this.rangeOf(o,c.indices,c.material,-1),map:c.map})),this.array=i.createVertexArray(),i.bindVertexArray(this.array);let s=(c,u,h,f=i.FLOAT)=>{u&&(i.bindBuffer(i.ARRAY_BUFFER,i.createBuffer()),i.bufferData(i.ARRAY_BUFFER,u,i.STATIC_DRAW),i.enableVertexAttribArray(c),i.vertexAttribPointer(c,h,f,f===i.UNSIGNED_BYTE,0,0),this.bytes+=u.byteLength)};s(0,a.positions,3),s(1,a.normals,3),s(2,a.uvs,2),s(3,a.lightmapUvs,2),s(4,a.colors,4,i.UNSIGNED_BYTE),s(5,a.normalUvs,2),s(6,a.tangents,4),i.vertexAttrib4f(4,1,1,1,1),i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,i.createBuffer()),i.bufferData(i.ELEMENT_ARRAY_BUFFER,new Uint32Array(o),i.STATIC_DRAW),i.bindVertexArray(null),this.bytes+=4*o.length;let l=(c,u)=>T(i,{width:1,height:1,format:c},u);this.white=l(i.SRGB8_ALPHA8,new Uint8Array([255,255,255,255])),this.flat=l(i.RGBA8,new Uint8Array([128,128,255,255])),this.zero=l(i.R32UI,new Uint32Array([0])),this.reflectance=this.uploadReflectance(),r.pages.forEach((c,u)=>this.setPage(u,c)),k(i,"u_surfaces",this.zero),k(i,"u_cells",this.zero),k(i,"u_seen",this.zero)}bounds=he();opaque=[];transparent=[];reflectors=[];curved;surrounds=[];movers;unit;bytes=0;array;textures=[];normals=[];pages=[];shown=[];pageGroups=[];factors;emission;unlitWhite;sky;white;flat;zero;reflectance;kernels=new Map;isTransparent(e){let r=this.data.materials[e];return r.alphaMode===2||r.transmission>0}rangeOf(e,r,i,a){let n={first:e.length,count:r.length,material:i,page:a,bounds:he()},o=this.data.mesh.positions;for(let s=0;s<r.length;++s){let l=r[s];e.push(l),ae(n.bounds,o[3*l],o[3*l+1],o[3*l+2])}return n}facesInward(e,r){let i=this.data.mesh.positions,a=oe(r.bounds),n=s=>F([i[3*e[s]],i[3*e[s]+1],i[3*e[s]+2]],a),o=0;for(let s=r.first;s<r.first+r.count;s+=3)o+=B(n(s),O(n(s+1),n(s+2)));return o<0}sortRanges(){let e=this.data.mesh,r=[],i=e.parts.filter(n=>n.count>0).sort((n,o)=>n.material-o.material||n.page-o.page);for(let n of i){let o=this.rangeOf(r,e.indices.subarray(n.first,n.first+n.count),n.material,n.page);(this.isTransparent(n.material)?this.transparent:this.opaque).push(o),ae(this.bounds,...o.bounds.lower),ae(this.bounds,...o.bounds.upper)}let a=new Map(this.transparent.map(n=>[n,this.facesInward(r,n)]));return this.transparent.sort((n,o)=>Number(a.get(o))-Number(a.get(n))),r}addReflector(e,r){let{gl:i}=this.device,a=this.data.reflectors[e],n=a.packFromReflector,o=It(n),s=Math.hypot(a.upper[0]-a.lower[0],a.upper[1]-a.lower[1]),l=[a.lower[0],a.upper[0],a.upper[0],a.lower[0]],c=[a.lower[1],a.lower[1],a.upper[1],a.upper[1]],u=this.rangeOf(r,a.indices,a.material,-1),h=[];for(let f of a.emitters)for(let p of Qr(this.data.emitters[f],this.data.mesh,this.data.materials))this.isTransparent(p.part.material)||h.push(this.rangeOf(r,p.indices,p.part.material,p.part.page));this.reflectors.push({index:e,material:a.material,first:u.first,count:u.count,packFromReflector:n,reflectorFromPack:o,corners:l.map((f,p)=>ee(n,[f,c[p],0])),size:s,flatness:a.flatness,dark:h,emitters:lt(i,a,this.data.emitters,o,s,this.unit),asked:!1,visible:!0})}uploadReflectance(){let e=this.data.fresnels,r=Math.max(1,...e.map(n=>n.table.length/3)),i=Math.max(e.length,1),a=new Float32Array(4*r*i);return e.forEach((n,o)=>{for(let s=0;s<n.table.length/3;++s)a.set(n.table.subarray(3*s,3*s+3),4*(o*r+s))}),T(this.device.gl,{width:r,height:i,format:this.device.gl.RGBA32F},a)}setPage(e,r){this.data.pages[e]=r,this.uploadPage(e)}setPageGroups(e){this.pageGroups[e.page]=e,this.uploadPage(e.page)}setLights(e){let{groups:r,emitters:i}=this.data,a=i.slice(),n=(o,s)=>o.map((l,c)=>l*s[c]);this.factors=e,r.forEach((o,s)=>{for(let l of o.materials)this.emission[l]=n(this.data.materials[l].emission,e[s]);for(let l of o.emitters)a[l]={...i[l],radiance:n(i[l].radiance,e[s])};o.sky&&(this.sky=n(this.data.sky,e[s]))}),this.data.day&&(this.sky=li(this.data.day,e));for(let o of this.reflectors){let s=o.emitters;if(s){for(let l of[s.polygons,s.visibility,s.seen])this.device.gl.deleteTexture(l);o.emitters=lt(this.device.gl,this.data.reflectors[o.index],a,o.reflectorFromPack,o.size,this.unit)}}this.data.pages.forEach((o,s)=>this.uploadPage(s)),this.surrounds.forEach((o,s)=>{o.tint=be(r,e,"surrounds",s)}),this.movers.relight()}uploadPage(e){let r=si(this.data.pages[e],this.pageGroups[e],this.factors);if(r===this.shown[e])return;this.shown[e]=r;let{gl:i}=this.device,a=this.pages[e];for(let l of[a?.light,a?.direction,a?.cells,a?.detail])l&&i.deleteTexture(l);this.bytes-=a?.bytes??0;let n=this.bytes,o=(l,c,u)=>(this.bytes+=l.byteLength,T(i,{width:c,height:u,format:i.RGB16F,min:i.LINEAR,mag:i.LINEAR},l)),s={light:o(r.light,r.width,r.height),scale:r.scale,bytes:0};r.direction&&(s.direction=o(r.direction,r.width,r.height)),r.detail&&r.cells&&(s.cells=T(i,{width:r.width,height:r.height,format:i.R32UI},r.cells),s.detail=o(r.detail,r.detailWidth,r.detailHeight),this.bytes+=r.cells.byteLength),s.bytes=this.bytes-n,this.pages[e]=s}setTexture(e,r,i){let{gl:a}=this.device,n=[a.REPEAT,a.CLAMP_TO_EDGE,a.MIRRORED_REPEAT],o=Math.floor(Math.log2(Math.max(r.width,r.height)))+1,s=T(a,{width:r.width,height:r.height,levels:o,format:i?a.RGBA8:a.SRGB8_ALPHA8,min:a.LINEAR_MIPMAP_LINEAR,mag:r.nearest?a.NEAREST:a.LINEAR,wrapS:n[r.wrapS],wrapT:n[r.wrapT]},r.texels),l=i?void 0:this.cutoffIn(e),c=r.texels,u=!1;for(let f=3;f<c.length&&l!==void 0&&!u;f+=4)u=c[f]<255;u?ei(r,l).forEach((f,p)=>{a.texSubImage2D(a.TEXTURE_2D,p+1,0,0,f.width,f.height,a.RGBA,a.UNSIGNED_BYTE,f.texels)}):a.generateMipmap(a.TEXTURE_2D);let h=a.getExtension("EXT_texture_filter_anisotropic");h&&!r.nearest&&a.texParameterf(a.TEXTURE_2D,h.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(8,a.getParameter(h.MAX_TEXTURE_MAX_ANISOTROPY_EXT))),(i?this.normals:this.textures)[e]=s,this.bytes+=r.texels.byteLength*4/3}cutoffIn(e){let r;for(let i of this.data.materials)if(i.texture===e){if(i.alphaMode===0)return;if(i.alphaMode===2)r??=0;else if(!r){if(!(i.cutoff>0))return;r=i.alpha>0?i.cutoff/i.alpha:2}}return r}setSurround(e,r){this.surrounds[e]=gi(this.device.gl,r),this.surrounds[e].tint=be(this.data.groups,this.factors,"surrounds",e),this.bytes+=10*r.light.length}setNormals(e,r,i=!!this.data.mesh.normalUvs){let a=this.data.materials[r],n=a.normalTexture>=0&&i?this.normals[a.normalTexture]:void 0;e.set("u_normal_mapped",!!n),e.set("u_normal_scale",a.normalScale),k(this.device.gl,"u_normal_texture",n??this.flat)}kernel(e,r){let i=this.data.materials[e],a=`${i.kernel} ${i.fresnel} ${r}`,n=this.kernels.get(a);if(n)return n;let{gl:o}=this.device,s=this.data.kernels[i.kernel],l=this.data.fresnels[i.fresnel],c=xi(s,r,l),u={taps:T(o,{width:c.count,height:c.rows,format:o.RGBA32F},c.texels),count:c.count,rows:c.rows,median:c.median};return s&&s.fits.length>0&&(u.lobes=T(o,{width:me,height:2,format:o.RGBA32F},ki(s,l,c.means))),this.kernels.set(a,u),u}reflectanceOf(e){let r=this.data.fresnels[this.data.materials[e].fresnel]?.table;if(!r)return 0;let i=3*(r.length/6|0);return Math.max(r[i],r[i+1],r[i+2])}bindGeometry(){this.device.gl.bindVertexArray(this.array),k(this.device.gl,"u_reflectance",this.reflectance)}draw(e){let{gl:r}=this.device;r.drawElements(r.TRIANGLES,e.count,r.UNSIGNED_INT,4*e.first)}bindBase(e){k(this.device.gl,"u_base_texture",this.textures[e]??this.white)}picture(e){return this.data.emissionTextures.find(r=>r.material===e)}setReflectance(e,r){let i=this.data.materials[r].fresnel;e.set("u_reflectance_row",i),e.set("u_reflectance_count",i<0?1:this.data.fresnels[i].table.length/3)}setSurface(e,r,i=!!this.data.mesh.normalUvs){let{gl:a}=this.device,n=this.data.materials[r.material],o=this.pages[r.page];e.set("u_base_color",[...n.baseColor.map(c=>Math.min(Math.max(c,0),1)),n.alpha]),e.set("u_alpha_cutoff",se(n)),e.set("u_covers",n.alphaMode===2),e.set("u_diffuse_share",(1-n.metallic)*(1-n.transmission)),e.set("u_transmission",n.transmission);let s=this.picture(r.material),l=s&&this.textures[s.texture];e.set("u_emission",this.emission[r.material].map((c,u)=>c*this.unit*(l?uo(s.mean[u]):1))),k(a,"u_emission_texture",l??this.white),e.set("u_unlit",n.unlit),this.setReflectance(e,r.material),this.bindBase(n.texture),this.setNormals(e,r.material,i),k(a,"u_lightmap",o?.light??this.white),e.set("u_lightmap_scale",o?o.scale*this.unit:0),e.set("u_directional",!!o?.direction),k(a,"u_direction",o?.direction??o?.light??this.white),e.set("u_detailed",!!o?.detail),k(a,"u_cells",o?.cells??this.zero),k(a,"u_detail",o?.detail??this.white)}luxAt(e,r,i){let a=this.shown[e];if(!a)return 0;let n=Math.min(Math.floor(r*a.width),a.width-1),o=Math.min(Math.floor(i*a.height),a.height-1),s=3*(o*a.width+n);return a.scale*(.2126*Y(a.light[s])+.7152*Y(a.light[s+1])+.0722*Y(a.light[s+2]))}},uo=t=>t>0?1/t:0,se=t=>t.alphaMode===1?Math.max(t.cutoff,0):-1;var Mi=127,ho=128,Ti={orders:2,mirrors:16,taps:48,largeOnly:!1},Fi={orders:0,mirrors:0,taps:12,largeOnly:!0},Ei={orders:1,mirrors:1,taps:12,largeOnly:!0},fo=[[-.125,-.375],[.375,-.125],[-.375,.125],[.125,.375]],gt=16,we=class{constructor(e){this.device=e;let r=e.gl,i=(a,n="")=>z.make(r,a,n);this.depth=i("depth"),this.plainDepth=i("depth","PLAIN"),this.opaque=i("scene"),this.plain=i("scene","PLAIN"),this.reflected=i("scene","REFLECTED"),this.transparent=i("transparent"),this.luminance=i("screen_luminance"),this.average=i("screen_average"),this.none=r.createVertexArray(),this.reflections=new De(e,this,this.none)}frame;sums;mean;blocks;depth;plainDepth;opaque;plain;reflected;transparent;luminance;average;reflections;none;start(){for(let e of[this.plainDepth,this.plain,this.luminance,this.average])e.start()}startRest(){for(let e of[...this.reflections.programs,this.reflected,this.opaque,this.depth,this.transparent])e.start()}drawScreen(){let{gl:e}=this.device;e.bindVertexArray(this.none),e.drawArrays(e.TRIANGLES,0,3)}ensure(e,r){if(this.frame?.width===e&&this.frame.height===r)return this.frame;let{gl:i,color:a}=this.device;for(let l of[this.frame?.light,this.frame?.depth,...[...this.sums??[],this.mean].map(c=>c?.texture)])l&&i.deleteTexture(l);for(let l of[this.frame?.target,...[...this.sums??[],this.mean].map(c=>c?.target)])l&&i.deleteFramebuffer(l);let n=T(i,{width:e,height:r,format:a}),o=T(i,{width:e,height:r,format:i.DEPTH24_STENCIL8}),s=l=>{let c=T(i,{width:e,height:r,format:l});return{texture:c,target:re(i,c)}};return this.sums=[s(i.RGBA16F),s(i.RGBA16F)],this.mean=s(a),this.frame={width:e,height:r,light:n,depth:o,target:re(i,n,o)},this.frame}draw(e,r,i,a,n,o){let{gl:s}=this.device,l=this.ensure(i,a),c=Wr(r,i,a,e.movers.bounds(),n===void 0?[0,0]:fo[n%4]),u=()=>{s.bindFramebuffer(s.FRAMEBUFFER,l.target),s.viewport(0,0,i,a)};u(),this.clear([...e.sky.map(m=>m*e.unit),1]);let h=e.opaque.filter(m=>te(c.clipFromPack,m.bounds));this.drawDepth(e,c,h),e.movers.drawDepth(c);let f={view:c,begin:u,inFrame:!0,mirrors:0,reflectance:1,share:1,texture:l.light,values:0},p=this.reflections.drawMasks(e,f,o);for(let m of p)m.value>0&&this.reflections.draw(e,f,m,o);let d=this.reflections.curved.draw(e,f,o);u(),this.drawOpaque(e,c,h,new Set([...p.filter(m=>m.value>0).map(m=>m.reflector.material),...d.materials])),e.movers.drawLight(c,!1),this.drawTransparent(e,c);for(let m of p)m.value===0&&this.reflections.draw(e,f,m,o);u(),this.reflections.curved.add(e,f,d.later,o)}clear(e){let{gl:r}=this.device;A(r,{depthWrite:!0,stencilWrite:255}),r.clearColor(e[0],e[1],e[2],e[3]),r.clear(r.COLOR_BUFFER_BIT|r.DEPTH_BUFFER_BIT|r.STENCIL_BUFFER_BIT)}drawDepth(e,r,i){e.bindGeometry();for(let a of i){let n=e.data.materials[a.material],o=se(n)<0?this.plainDepth:this.depth;A(this.device.gl,{depthTest:!0,depthWrite:!0,color:!1,cull:!n.doubleSided,mirrored:r.mirrored}),o.use(),o.set("u_clip_from_pack",r.clipFromPack),o.set("u_alpha",n.alpha),o.set("u_alpha_cutoff",se(n)),e.bindBase(n.texture),e.draw(a)}}setFrame(e,r,i,a){e.use(),e.set("u_clip_from_pack",i.clipFromPack),e.set("u_eye",i.eye),e.set("u_change_scale",[0,0]),e.set("u_alpha_kind",a?i.ortho?2:1:0);let n=i.viewFromPack;e.set("u_depth_row",[-n[2],-n[6],-n[10],-n[14]]),e.set("u_closest",this.device.closest),r.bindGeometry()}drawRanges(e,r,i,a,n,o,s){let{gl:l}=this.device;for(let c of[a,this.opaque])this.setFrame(c,e,r,s);for(let c of i){let u=e.data.materials[c.material],h=n.has(c.material),f=u.normalTexture<0&&se(u)<0&&!u.unlit&&!e.picture(c.material)?a:this.opaque;f.use(),e.setSurface(f,c),f.set("u_weights",[1,1,1]),A(l,{...o,cull:!u.doubleSided,stencilRead:Mi,stencilFunc:h?l.EQUAL:void 0}),e.draw(c),h&&(f.set("u_weights",[1,0,1]),A(l,{...o,cull:!u.doubleSided,stencilRead:Mi,stencilFunc:l.NOTEQUAL,blend:s?void 0:"add"}),e.draw(c))}}drawOpaque(e,r,i,a){this.drawRanges(e,r,i,this.plain,a,{depthTest:!0},!1)}drawReflected(e,r,i,a,n){let o={depthTest:!0,depthWrite:!0,mirrored:r.mirrored};this.drawRanges(e,r,i,this.reflected,n,o,!0);for(let s of a){let l=e.data.materials[s.material],c=l.normalTexture<0&&se(l)<0&&!l.unlit?this.reflected:this.opaque;c.use(),e.setSurface(c,s),c.set("u_weights",[1,1,0]),A(this.device.gl,{...o,cull:!l.doubleSided}),e.draw(s)}}drawTransparent(e,r){let{gl:i}=this.device,a=r.viewFromPack,n=s=>{let l=oe(s.bounds);return a[2]*l[0]+a[6]*l[1]+a[10]*l[2]},o=e.transparent.filter(s=>te(r.clipFromPack,s.bounds)).sort((s,l)=>n(s)-n(l));if(o.length!==0){this.setFrame(this.transparent,e,r,!1);for(let s of o){e.setSurface(this.transparent,s);let l={depthTest:!0,alpha:!1,mirrored:r.mirrored,stencilRead:ho,cull:!e.data.materials[s.material].doubleSided},c=(u,h,f)=>{A(i,{...l,...u}),this.transparent.set("u_dimming",h),this.transparent.set("u_weights",[1,f,1]),e.draw(s)};c({blend:"multiply"},!0,0),c({blend:"add",stencilFunc:r.mirrored?void 0:i.EQUAL},!1,1),r.mirrored||c({blend:"add",stencilFunc:i.NOTEQUAL},!1,0)}}}white=1.2;addToMean(e,r){let{gl:i}=this.device,a=this.frame;i.bindFramebuffer(i.FRAMEBUFFER,this.mean.target),i.viewport(0,0,a.width,a.height),A(i,r?{}:{blend:"add"}),r||i.blendFunc(i.ONE,i.ONE),this.average.use(),this.average.set("u_share",e),this.average.set("u_encode",!1),this.average.set("u_before_weight",0),this.average.set("u_scale",[1,1]),k(i,"u_frame",a.light),this.drawScreen(),this.average.set("u_share",0)}show(e,r,i,a,n=!0){let o=this.frame.width!==i||this.frame.height!==a,{gl:s}=this.device,l=this.frame,[c,u]=this.sums;A(s,{}),this.average.use(),this.average.set("u_exposure",1/(this.white*e.unit)),this.average.set("u_unlit_exposure",1/(e.unlitWhite*e.unit)),this.average.set("u_count",r+1),k(s,"u_frame",l.light),k(s,"u_before",c.texture),this.average.set("u_before_weight",r),this.average.set("u_encode",!1),this.average.set("u_scale",[1,1]),s.bindFramebuffer(s.FRAMEBUFFER,u.target),s.viewport(0,0,l.width,l.height),this.drawScreen(),this.sums=[u,c],n&&(k(s,"u_before",u.texture),this.average.set("u_scale",o?[l.width/i,l.height/a]:[1,1]),this.average.set("u_before_weight",1),this.average.set("u_encode",!0),s.bindFramebuffer(s.FRAMEBUFFER,null),s.viewport(0,0,i,a),this.drawScreen())}meter(e,r=!1){let{gl:i}=this.device,a=this.frame,n=Math.ceil(a.width/gt),o=Math.ceil(a.height/gt);if(this.blocks?.width!==n||this.blocks.height!==o){let c=T(i,{width:n,height:o,format:this.device.color});this.blocks={width:n,height:o,texture:c,target:re(i,c)}}i.bindFramebuffer(i.FRAMEBUFFER,this.blocks.target),i.viewport(0,0,n,o),A(i,{}),this.luminance.use(),k(i,"u_frame",r?this.mean.texture:a.light),this.luminance.set("u_frame_size",[a.width,a.height]),this.luminance.set("u_block",gt),this.drawScreen();let s=new Float32Array(4*n*o);i.readPixels(0,0,n,o,i.RGBA,i.FLOAT,s);let l=mo(s,n,o);return l===void 0?void 0:l-Math.log2(e.unit)}};function mo(t,e,r){let i=[],a=0;for(let c=0;c<e*r;++c){let u=t[4*c],h=t[4*c+1];if(!(h>0)||!Number.isFinite(u))continue;let f=(2*(c%e)+1)/e-1,p=(2*Math.floor(c/e)+1)/r-1,d=h*(.1+Math.exp(-.5*(f*f+p*p)/.25));i.push({log:u/h,weight:d}),a+=d}if(i.length===0)return;i.sort((c,u)=>c.log-u.log);let n=0,o=i[i.length-1].log;for(let c of i)if(n+=c.weight,n>=.9*a){o=c.log;break}let s=0,l=0;for(let c of i)c.log>=o-7&&(s+=c.log*c.weight,l+=c.weight);return s/l}var He=class{constructor(e){this.grids=e;this.eyeHeight=e[0]?.eyeHeight??1.6,this.step=.4*this.eyeHeight/1.6,this.beside=this.eyeHeight/1.6}eyeHeight;step;beside;eyeOf(e,r){let i=this.grids[e];return[i.lower[0]+(r%i.width+.5)*i.cell,i.floor[r]+i.eyeHeight,i.lower[1]+(Math.floor(r/i.width)+.5)*i.cell]}stand(e,r,i,a=this.step){let n;return this.grids.forEach((o,s)=>{let l=Math.floor((e-o.lower[0])/o.cell),c=Math.floor((r-o.lower[1])/o.cell),u=c*o.width+l;if(!(l>=0&&c>=0&&l<o.width&&c<o.height)||!o.walkable[u])return;let h=this.eyeOf(s,u);h[1]<=i+a&&(!n||h[1]>n.eye[1])&&(n={grid:s,cell:u,eye:h})}),n}nearest(e,r,i=(a,n)=>e[1]>a&&e[1]<=n+2*this.step){let a,n=r;return this.grids.forEach((o,s)=>{for(let l=0;l<o.floor.length;++l){if(!o.walkable[l]||!i(o.floor[l],o.floor[l]+o.eyeHeight))continue;let c=this.eyeOf(s,l),u=Math.hypot(c[0]-e[0],c[2]-e[2]);u<n&&(n=u,a={grid:s,cell:l,eye:c})}}),a}distance(e){let r=this.nearest(e,this.beside);return r?Math.hypot(r.eye[0]-e[0],r.eye[2]-e[2]):1/0}walk(e,r,i,a){let n=(this.stand(e[0],e[2],e[1])??this.stand(e[0],e[2],e[1]+this.eyeHeight,0))?.eye[1];if(n===void 0){let g=this.distance(e);if(a.fall=0,g===1/0||this.stand(r[0],r[2],e[1])||this.distance(r)<g)return r;for(let w of[[r[0],e[1],e[2]],[e[0],e[1],r[2]]])if((w[0]!==e[0]||w[2]!==e[2])&&this.distance(w)<=g)return w;return e}let o=1/0,s=this.step;for(let g of this.grids)o=Math.min(o,g.cell),s=Math.max(s,g.cell);let l=[r[0]-e[0],r[2]-e[2]],c=Math.hypot(...l)/(.5*o),u=Math.min(Math.max(Math.ceil(c),1),64),h=Math.max(u,c),f=e[0],p=e[2],d=n,m=(g,w)=>{let x=this.stand(f+g,p+w,d,s);return!x||d-x.eye[1]>s?!1:(f+=g,p+=w,d=x.eye[1],!0)},v=l[0]/h,_=l[1]/h;for(let g=0;g<u&&!(!m(v,_)&&!m(v,0)&&!m(0,_));++g);let b=e[1];return b-d>2*this.step?(a.fall+=9.81*this.beside*i,b=Math.max(b-a.fall*i,d)):(a.fall=0,b+=(d-b)*(1-Math.exp(-i/.08)),Math.abs(d-b)<.001*this.step&&(b=d)),[f,b,p]}way(e,r){let i=this.stand(e[0],e[2],e[1])??this.nearest(e,this.beside);if(!i)return[];let a=u=>u.grid*2**30+u.cell,n=new Map([[a(i),void 0]]),o=[i],s=i,l=1/0;for(let u=0;u<o.length;++u){let h=o[u],f=this.grids[h.grid],p=Math.hypot(h.eye[0]-r[0],h.eye[1]-this.grids[h.grid].eyeHeight-r[1],h.eye[2]-r[2]);p<l&&(l=p,s=h);for(let[d,m]of[[1,0],[-1,0],[0,1],[0,-1],[1,1],[1,-1],[-1,1],[-1,-1]]){let v=this.stand(h.eye[0]+d*f.cell,h.eye[2]+m*f.cell,h.eye[1],Math.max(this.step,f.cell));!v||h.eye[1]-v.eye[1]>Math.max(this.step,f.cell)||n.has(a(v))||d&&m&&(!this.stand(h.eye[0]+d*f.cell,h.eye[2],h.eye[1])||!this.stand(h.eye[0],h.eye[2]+m*f.cell,h.eye[1]))||(n.set(a(v),h),o.push(v))}}let c=[];for(let u=s;u&&a(u)!==a(i);u=n.get(a(u)))c.push(u.eye);return c}};var po=2,vo=3,Ri=1.55,_t=t=>Math.atan2(-t[0],-t[2]),Ai=t=>Math.asin(Math.min(Math.max(t[1]/Math.max(j(t),1e-12),-1),1)),Si=(t,e)=>[-Math.sin(t)*Math.cos(e),Math.sin(e),-Math.cos(t)*Math.cos(e)],qe=class{camera;cameras;path;floors;origin;state={fall:0};way=[];tour;place=0;clock;constructor(e){this.floors=new He(e.grids),this.origin=e.mesh.origin,this.path=e.paths.find(a=>a.keys.length>1),this.cameras=e.cameras.length>0?e.cameras:[this.somewhere(e)],this.camera={...this.fromHash()??this.cameras[0]};let r=Number(new URLSearchParams(location.hash.slice(1)).get("time")??NaN),i=Number.isFinite(r);this.clock={seconds:i?Math.max(r,0):0,runs:!i&&!matchMedia("(prefers-reduced-motion: reduce)").matches}}somewhere(e){let r=e.grids.findIndex(a=>a.walkable.some(n=>n>0));return{name:"start",eye:r<0?[0,1.6,0]:this.floors.eyeOf(r,e.grids[r].walkable.indexOf(1)),forward:[0,0,-1],up:[0,1,0],fov:1.05,halfHeight:0}}fromHash(){let e=new URLSearchParams(location.hash.slice(1)).get("camera");if(!e)return;let r=this.cameras.find(o=>o.name===e);if(r)return r;let i=e.split(",").map(Number);if(i.length<5||i.length>6||!i.every(Number.isFinite))return;let a=i[5]===void 0?60:Math.min(Math.max(i[5],10),120),n=Math.PI/180;return{name:"",eye:F(i.slice(0,3),this.origin),forward:Si(i[3]*n,i[4]*n),up:[0,1,0],fov:a*n,halfHeight:0}}toHash(){let e=this.camera,r=U(e.eye,this.origin),i=180/Math.PI;return`#camera=${[...r.map(n=>n.toFixed(3)),...[_t(e.forward),Ai(e.forward),e.fov].map(n=>(n*i).toFixed(2))].join(",")}`}jump(e){this.camera={...e},this.way=[],this.tour=void 0,this.state.fall=0}goTo(e,r){return this.tour=void 0,this.way=this.floors.way(this.camera.eye,e),r&&this.way[0]&&this.jump({...this.camera,eye:this.way[0]}),this.way.length>0||r}get touring(){return this.tour!==void 0}toggleTour(){this.tour=this.touring||!this.path?void 0:this.path.keys[0].time,this.way=[]}step(e,r){let i={...this.camera},a=e.right!==0||e.ahead!==0,n=e.yaw!==0||e.pitch!==0;if(a&&(this.way=[]),(a||n)&&(this.tour=void 0),this.touring&&this.alongPath(r),n){let s=Math.min(Math.max(Ai(this.camera.forward)-e.pitch,-Ri),Ri);this.camera.forward=Si(_t(this.camera.forward)-e.yaw,s),this.camera.up=[0,1,0]}!this.touring&&(a||this.way.length>0||this.state.fall>0||this.settling)&&this.walk(e,r);let o=(s,l)=>s.some((c,u)=>c!==l[u]);return o(i.eye,this.camera.eye)||o(i.forward,this.camera.forward)}settling=!1;walk(e,r){let i=po*this.floors.eyeHeight*(e.fast?vo:1)/1.6,a=this.camera.eye,n=[...a];if(this.way.length>0){let o=i*1.5*r;for(;this.way.length>0&&o>0;){let s=this.way[this.way.length-1],l=[s[0]-n[0],s[2]-n[2]],c=Math.hypot(...l),u=c>o?o/c:1;n=[n[0]+l[0]*u,n[1],n[2]+l[1]*u],o-=c,u===1&&this.way.pop()}}else{let o=_t(this.camera.forward),s=Math.max(Math.hypot(e.right,e.ahead),1),l=i*r/s;n[0]+=(Math.cos(o)*e.right-Math.sin(o)*e.ahead)*l,n[2]+=(-Math.sin(o)*e.right-Math.cos(o)*e.ahead)*l}this.camera.eye=this.floors.grids.length>0?this.floors.walk(a,n,r,this.state):n,this.settling=this.camera.eye[1]!==a[1]}alongPath(e){let r=this.path.keys,i=r[r.length-1];this.tour+=e,this.tour>=i.time&&(this.tour=void 0);let a=this.tour??i.time,n=Math.max(1,r.findIndex(u=>u.time>=a)),o=r[n-1],s=r[n],l=Math.min(Math.max((a-o.time)/Math.max(s.time-o.time,1e-9),0),1),c=(u,h)=>u.map((f,p)=>f+(h[p]-f)*l);this.camera={name:"",eye:c(o.eye,s.eye),forward:N(c(o.forward,s.forward),o.forward),up:[0,1,0],fov:this.path.fov,halfHeight:0}}};var go=ArrayBuffer,P=Uint8Array,Xe=Uint16Array,_o=Int16Array;var je=Int32Array,bt=function(t,e,r){if(P.prototype.slice)return P.prototype.slice.call(t,e,r);(e==null||e<0)&&(e=0),(r==null||r>t.length)&&(r=t.length);var i=new P(r-e);return i.set(t.subarray(e,r)),i},xe=function(t,e,r,i){if(P.prototype.fill)return P.prototype.fill.call(t,e,r,i);for((r==null||r<0)&&(r=0),(i==null||i>t.length)&&(i=t.length);r<i;++r)t[r]=e;return t},bo=function(t,e,r,i){if(P.prototype.copyWithin)return P.prototype.copyWithin.call(t,e,r,i);for((r==null||r<0)&&(r=0),(i==null||i>t.length)&&(i=t.length);r<i;)t[e++]=t[r++]};var wo=["invalid zstd data","window size too large (>2046MB)","invalid block type","FSE accuracy too high","match distance too far back","unexpected EOF"],D=function(t,e,r){var i=new Error(e||wo[t]);if(i.code=t,Error.captureStackTrace&&Error.captureStackTrace(i,D),!r)throw i;return i},Li=function(t,e,r){for(var i=0,a=0;i<r;++i)a|=t[e++]<<(i<<3);return a},yo=function(t,e){return(t[e]|t[e+1]<<8|t[e+2]<<16|t[e+3]<<24)>>>0},xo=function(t,e){var r=t[0]|t[1]<<8|t[2]<<16;if(r==3126568&&t[3]==253){var i=t[4],a=i>>5&1,n=i>>2&1,o=i&3,s=i>>6;i&8&&D(0);var l=6-a,c=o==3?4:o,u=Li(t,l,c);l+=c;var h=s?1<<s:a,f=Li(t,l,h)+(s==1&&256),p=f;if(!a){var d=1<<10+(t[5]>>3);p=d+(d>>3)*(t[5]&7)}p>2145386496&&D(1);var m=new P((e==1?f||p:e?0:p)+12);return m[0]=1,m[4]=4,m[8]=8,{b:l+h,y:0,l:0,d:u,w:e&&e!=1?e:m.subarray(12),e:p,o:new je(m.buffer,0,3),u:f,c:n,m:Math.min(131072,p)}}else if((r>>4|t[3]<<20)==25481893)return yo(t,4)+8;D(0)},ue=function(t){for(var e=0;1<<e<=t;++e);return e-1},ke=function(t,e,r){var i=(e<<3)+4,a=(t[e]&15)+5;a>r&&D(3);for(var n=1<<a,o=n,s=-1,l=-1,c=-1,u=n,h=new go(512+(n<<2)),f=new _o(h,0,256),p=new Xe(h,0,256),d=new Xe(h,512,n),m=512+(n<<1),v=new P(h,m,n),_=new P(h,m+n);s<255&&o>0;){var b=ue(o+1),g=i>>3,w=(1<<b+1)-1,x=(t[g]|t[g+1]<<8|t[g+2]<<16)>>(i&7)&w,y=(1<<b)-1,G=w-o-1,C=x&y;if(C<G?(i+=b,x=C):(i+=b+1,x>y&&(x-=G)),f[++s]=--x,x==-1?(o+=x,v[--u]=s):o-=x,!x)do{var X=i>>3;l=(t[X]|t[X+1]<<8)>>(i&7)&3,i+=2,s+=l}while(l==3)}(s>255||o)&&D(0);for(var I=0,$=(n>>1)+(n>>3)+3,J=n-1,K=0;K<=s;++K){var R=f[K];if(R<1){p[K]=-R;continue}for(c=0;c<R;++c){v[I]=K;do I=I+$&J;while(I>=u)}}for(I&&D(0),c=0;c<n;++c){var M=p[v[c]]++,H=_[c]=a-ue(M);d[c]=(M<<H)-n}return[i+7>>3,{b:a,s:v,n:_,t:d}]},ko=function(t,e){var r=0,i=-1,a=new P(292),n=t[e],o=a.subarray(0,256),s=a.subarray(256,268),l=new Xe(a.buffer,268);if(n<128){var c=ke(t,e+1,6),u=c[0],h=c[1];e+=n;var f=u<<3,p=t[e];p||D(0);for(var d=0,m=0,v=h.b,_=v,b=(++e<<3)-8+ue(p);b-=v,!(b<f);){var g=b>>3;if(d+=(t[g]|t[g+1]<<8)>>(b&7)&(1<<v)-1,o[++i]=h.s[d],b-=_,b<f)break;g=b>>3,m+=(t[g]|t[g+1]<<8)>>(b&7)&(1<<_)-1,o[++i]=h.s[m],v=h.n[d],d=h.t[d],_=h.n[m],m=h.t[m]}++i>255&&D(0)}else{for(i=n-127;r<i;r+=2){var w=t[++e];o[r]=w>>4,o[r+1]=w&15}++e}var x=0;for(r=0;r<i;++r){var y=o[r];y>11&&D(0),x+=y&&1<<y-1}var G=ue(x)+1,C=1<<G,X=C-x;for(X&X-1&&D(0),o[i++]=ue(X)+1,r=0;r<i;++r){var y=o[r];++s[o[r]=y&&G+1-y]}var I=new P(C<<1),$=I.subarray(0,C),J=I.subarray(C);for(l[G]=0,r=G;r>0;--r){var K=l[r];xe(J,r,K,l[r-1]=K+s[r]*(1<<G-r))}for(l[0]!=C&&D(0),r=0;r<i;++r){var R=o[r];if(R){var M=l[R];xe($,r,M,l[R]=M+(1<<G-R))}}return[e,{n:J,b:G,s:$}]},Mo=ke(new P([81,16,99,140,49,198,24,99,12,33,196,24,99,102,102,134,70,146,4]),0,6)[1],To=ke(new P([33,20,196,24,99,140,33,132,16,66,8,33,132,16,66,8,33,68,68,68,68,68,68,68,68,36,9]),0,6)[1],Fo=ke(new P([32,132,16,66,102,70,68,68,68,68,36,73,2]),0,5)[1],zi=function(t,e){for(var r=t.length,i=new je(r),a=0;a<r;++a)i[a]=e,e+=1<<t[a];return i},wt=new P(new je([0,0,0,0,16843009,50528770,134678020,202050057,269422093]).buffer,0,36),Eo=zi(wt,0),yt=new P(new je([0,0,0,0,0,0,0,0,16843009,50528770,117769220,185207048,252579084,16]).buffer,0,53),Ro=zi(yt,3),ye=function(t,e,r){var i=t.length,a=e.length,n=t[i-1],o=(1<<r.b)-1,s=-r.b;n||D(0);for(var l=0,c=r.b,u=(i<<3)-8+ue(n)-c,h=-1;u>s&&h<a;){var f=u>>3,p=(t[f]|t[f+1]<<8|t[f+2]<<16)>>(u&7);l=(l<<c|p)&o,e[++h]=r.s[l],u-=c=r.n[l]}(u!=s||h+1!=a)&&D(0)},Ao=function(t,e,r){var i=6,a=e.length,n=a+3>>2,o=n<<1,s=n+o;ye(t.subarray(i,i+=t[0]|t[1]<<8),e.subarray(0,n),r),ye(t.subarray(i,i+=t[2]|t[3]<<8),e.subarray(n,o),r),ye(t.subarray(i,i+=t[4]|t[5]<<8),e.subarray(o,s),r),ye(t.subarray(i),e.subarray(s),r)},So=function(t,e,r){var i,a=e.b,n=t[a],o=n>>1&3;e.l=n&1;var s=n>>3|t[a+1]<<5|t[a+2]<<13,l=(a+=3)+s;if(o==1)return a>=t.length?void 0:(e.b=a+1,r?(xe(r,t[a],e.y,e.y+=s),r):xe(new P(s),t[a]));if(!(l>t.length)){if(o==0)return e.b=l,r?(r.set(t.subarray(a,l),e.y),e.y+=s,r):bt(t,a,l);if(o==2){var c=t[a],u=c&3,h=c>>2&3,f=c>>4,p=0,d=0;u<2?h&1?f|=t[++a]<<4|(h&2&&t[++a]<<12):f=c>>3:(d=h,h<2?(f|=(t[++a]&63)<<4,p=t[a]>>6|t[++a]<<2):h==2?(f|=t[++a]<<4|(t[++a]&3)<<12,p=t[a]>>2|t[++a]<<6):(f|=t[++a]<<4|(t[++a]&63)<<12,p=t[a]>>6|t[++a]<<2|t[++a]<<10)),++a;var m=r?r.subarray(e.y,e.y+e.m):new P(e.m),v=m.length-f;if(u==0)m.set(t.subarray(a,a+=f),v);else if(u==1)xe(m,t[a++],v);else{var _=e.h;if(u==2){var b=ko(t,a);p+=a-(a=b[0]),e.h=_=b[1]}else _||D(0);(d?Ao:ye)(t.subarray(a,a+=p),m.subarray(v),_)}var g=t[a++];if(g){g==255?g=(t[a++]|t[a++]<<8)+32512:g>127&&(g=g-128<<8|t[a++]);var w=t[a++];w&3&&D(0);for(var x=[To,Fo,Mo],y=2;y>-1;--y){var G=w>>(y<<1)+2&3;if(G==1){var C=new P([0,0,t[a++]]);x[y]={s:C.subarray(2,3),n:C.subarray(0,1),t:new Xe(C.buffer,0,1),b:0}}else G==2?(i=ke(t,a,9-(y&1)),a=i[0],x[y]=i[1]):G==3&&(e.t||D(0),x[y]=e.t[y])}var X=e.t=x,I=X[0],$=X[1],J=X[2],K=t[l-1];K||D(0);var R=(l<<3)-8+ue(K)-J.b,M=R>>3,H=0,Fe=(t[M]|t[M+1]<<8)>>(R&7)&(1<<J.b)-1;M=(R-=$.b)>>3;var Ee=(t[M]|t[M+1]<<8)>>(R&7)&(1<<$.b)-1;M=(R-=I.b)>>3;var Re=(t[M]|t[M+1]<<8)>>(R&7)&(1<<I.b)-1;for(++g;--g;){var rt=J.s[Fe],Lt=J.n[Fe],it=I.s[Re],zt=I.n[Re],Pt=$.s[Ee],Gt=$.n[Ee];M=(R-=Pt)>>3;var Vt=1<<Pt,le=Vt+((t[M]|t[M+1]<<8|t[M+2]<<16|t[M+3]<<24)>>>(R&7)&Vt-1);M=(R-=yt[it])>>3;var pe=Ro[it]+((t[M]|t[M+1]<<8|t[M+2]<<16)>>(R&7)&(1<<yt[it])-1);M=(R-=wt[rt])>>3;var Ae=Eo[rt]+((t[M]|t[M+1]<<8|t[M+2]<<16)>>(R&7)&(1<<wt[rt])-1);if(M=(R-=Lt)>>3,Fe=J.t[Fe]+((t[M]|t[M+1]<<8)>>(R&7)&(1<<Lt)-1),M=(R-=zt)>>3,Re=I.t[Re]+((t[M]|t[M+1]<<8)>>(R&7)&(1<<zt)-1),M=(R-=Gt)>>3,Ee=$.t[Ee]+((t[M]|t[M+1]<<8)>>(R&7)&(1<<Gt)-1),le>3)e.o[2]=e.o[1],e.o[1]=e.o[0],e.o[0]=le-=3;else{var Se=le-(Ae!=0);Se?(le=Se==3?e.o[0]-1:e.o[Se],Se>1&&(e.o[2]=e.o[1]),e.o[1]=e.o[0],e.o[0]=le):le=e.o[0]}for(var y=0;y<Ae;++y)m[H+y]=m[v+y];H+=Ae,v+=Ae;var ve=H-le;if(ve<0){var ge=-ve,da=e.e+ve;ge>pe&&(ge=pe);for(var y=0;y<ge;++y)m[H+y]=e.w[da+y];H+=ge,pe-=ge,ve=0}for(var y=0;y<pe;++y)m[H+y]=m[ve+y];H+=pe}if(H!=v)for(;v<m.length;)m[H++]=m[v++];else H=m.length;r?e.y+=H:m=bt(m,0,H)}else if(r){if(e.y+=f,v)for(var y=0;y<f;++y)m[y]=m[v+y]}else v&&(m=bt(m,v));return e.b=l,m}D(2)}},Lo=function(t,e){if(t.length==1)return t[0];for(var r=new P(e),i=0,a=0;i<t.length;++i){var n=t[i];r.set(n,a),a+=n.length}return r};function Pi(t,e){for(var r=[],i=+!e,a=0,n=0;t.length;){var o=xo(t,i||e);if(typeof o=="object"){for(i?(e=null,o.w.length==o.u&&(r.push(e=o.w),n+=o.u)):(r.push(e),o.e=0);!o.l;){var s=So(t,o,e);s||D(5),e?o.e=o.y:(r.push(s),n+=s.length,bo(o.w,0,s.length),o.w.set(s,o.w.length-s.length))}a=o.b+o.c*4}else a=o;t=t.subarray(a)}return Lo(r,n)}var Ye=64,q=32768,Gi=1983;function W(t){return t.floats(3)}function Vi(t,e){let r=new Float32Array(t.length*e);for(let i=0;i<t.length;++i){let a=t[i],n=Math.max(a<<16>>16,-32767)/32767,o=Math.max(a>>16,-32767)/32767,s=1-Math.abs(n)-Math.abs(o);s<0&&([n,o]=[(1-Math.abs(o))*(n<0?-1:1),(1-Math.abs(n))*(o<0?-1:1)]);let l=Math.hypot(n,o,s);r[e*i]=n/l,r[e*i+1]=o/l,r[e*i+2]=s/l}return r}function Qe(t){let e=[t.f64(),t.f64(),t.f64()],r=t.u32(),i=t.u32(),a=t.u32(),n=t.size(3,"mesh flags");i%3!==0&&t.fail(`found ${i} indices, expected triangles`);let o={origin:e,positions:t.planesF32(r,3),normals:Vi(t.planesU32(r),3),uvs:t.planesF32(r,2),lightmapUvs:t.planesF32(r,2),indices:new Uint32Array,parts:[]};if(n&1&&(o.colors=t.planes(r,4)),n&2){o.normalUvs=t.planesF32(r,2),o.tangents=Vi(t.planesU32(r),4);let s=new Int8Array(t.planes(r,1).buffer);for(let l=0;l<r;++l)o.tangents[4*l+3]=s[l]}o.indices=t.planesU32(i);for(let s=0,l=0;s<i;++s)l=l+o.indices[s]>>>0,l>=r&&t.fail(`found index ${l} of ${r} vertices`),o.indices[s]=l;for(let s=0;s<a;++s){let l={name:t.text(),first:t.u32(),count:t.u32(),material:t.u32(),page:t.i32()};(l.first%3||l.count%3||l.first+l.count>i)&&t.fail(`found part '${l.name}' outside the indices`),o.parts.push(l)}return o}var Di=t=>({material:t.u32(),texture:t.u32(),mean:t.floats(3)});function Ci(t){let e=t.text(),r=t.floats(3),i=t.f32(),a=t.i32(),n=t.choice(2,"alpha mode"),o=t.choice(1,"flag")>0,s=t.choice(1,"flag")>0;t.choice(0,"reserved byte");let l=t.f32(),c=t.f32();return t.floats(5),{name:e,baseColor:r,alpha:i,texture:a,alphaMode:n,doubleSided:o,unlit:s,cutoff:l,metallic:c,transmission:t.f32(),emission:t.floats(3),kernel:t.i32(),fresnel:t.i32(),normalTexture:t.i32(),normalScale:t.f32()}}function xt(t){t.text();let e=t.size(q,"width"),r=t.size(q,"height"),i=t.choice(2,"wrap"),a=t.choice(2,"wrap"),n=t.choice(1,"filter")>0;return t.choice(0,"reserved byte"),(!e||!r)&&t.fail("found a texture without texels"),{width:e,height:r,wrapS:i,wrapT:a,nearest:n,texels:t.planes(e*r,4)}}function Ke(t,e,r){let i=t.planesU16(e,3);for(let a of i)((a&31744)===31744||!r&&a>32768)&&t.fail("found light that is negative or no number");return i}function de(t){let e=t.i32();return(e<-94||e>112)&&t.fail(`found exponent ${e}, expected -94 to 112`),e}function Ii(t){let e=t.size(q,"width"),r=t.size(q,"height"),i=t.size(1,"lightmap flags"),a=t.size(16384,"details"),n=t.size(16384,"details"),o={width:e,height:r,detailWidth:a,detailHeight:n,scale:2**de(t),light:Ke(t,e*r,!1)};if((!e||!r)&&t.fail("found a page without texels"),i&1&&(o.direction=Ke(t,e*r,!0)),a>0){o.cells=t.planesU32(e*r);for(let s of o.cells){let l=s>>>28;s!==0&&(l<1||l>5||(s&16383)+(1<<l)>=a||(s>>>14&16383)+(1<<l)>=n)&&t.fail("found a cell outside of the image of details")}o.detail=Ke(t,a*n,!1)}return de(t),Ke(t,e*r,!1),t.planes(e*r,1),o}function Ui(t){let e=t.text(),r=t.u32(),i=new Float64Array(t.floats(16)),a=t.floats(2),n=t.floats(2);t.f32();let o=t.f32();t.u32s(4);let s=t.u32s(t.count(4)),l=t.size(64,"emitters"),c=t.size(q,"nodes"),u=t.size(q,"nodes");return l>0&&(c<2||u<2)&&t.fail("found emitters without nodes"),{name:e,material:r,packFromReflector:i,lower:a,upper:n,flatness:o,indices:s,nodesX:c,nodesY:u,emitters:t.u32s(l),visibility:t.planes(c*u*l,1)}}function Oi(t){let e=t.choice(4,"corners"),r=t.choice(1,"flag")>0;return e<3&&t.fail(`found ${e} corners, expected 3 or 4`),{twoSided:r,radiance:t.floats(3),corners:Array.from({length:e},()=>W(t))}}function zo(t,e){let r=t.f32();t.floats(3);let i=t.f32(),a=t.floats(2),n=t.floats(2),o=t.floats(2);t.f32(),t.planesU16(t.count(2));let s=t.planesU16(e*(e+1)/2),l=new Float32Array(e*e),c=0;for(let u=0;u<e;++u)for(let h=(e-1)/2;h<e;++h){let f=Y(s[c++]);f>=0&&f<=1||t.fail("found a weight outside 0 to 1"),l[u*e+h]=l[u*e+e-1-h]=f}return{cosTheta:r,shift:i,width:a,lower:n,upper:o,weights:l}}function Ni(t){t.choice(2,"kernel model"),t.u8(),t.u8(),t.u8(),t.floats(2);let e=t.f32();t.f32();let r=t.size(q,"kernel size"),i=t.planesF32(r*r),a=t.size(q,"slice size"),n=t.count(4);(n>256||n>0&&a%2===0)&&t.fail(`found ${n} slices of ${a}`);let o=Array.from({length:n},()=>zo(t,a)),s=t.count(20);return s!==0&&s!==n&&t.fail(`found ${s} cosine lobes of ${n} slices`),{size:r,halfExtent:e,weights:i,sliceSize:a,slices:o,fits:Array.from({length:s},()=>t.floats(5))}}function Wi(t){t.f32();let e=t.u32(),r=t.u32(),i=t.size(q,"sphere");e<2&&t.fail("found a reflectance of fewer than two angles");let a={table:t.planesF32(e,3),factor:t.planesF32(r,3)};return t.planesF32(i*i,3),a}function $i(t){return{name:t.text(),eye:W(t),forward:W(t),up:W(t),fov:t.f32(),halfHeight:t.f32()}}function Hi(t){let e=t.text(),r=t.f32(),i=t.count(28);return{name:e,fov:r,keys:Array.from({length:i},()=>({time:t.f32(),eye:W(t),forward:W(t)}))}}function qi(t){let e=t.floats(2),r=t.f32(),i=t.f32(),a=t.size(q,"width"),n=t.size(q,"height");return r>0||t.fail("found a walk grid without cells"),{lower:e,cell:r,eyeHeight:i,width:a,height:n,walkable:t.planes(a*n,1),floor:t.planesF32(a*n)}}function kt(t,e){let r=()=>({position:W(t),rotation:t.floats(4)}),i=r(),a=S(t,t.count(32),()=>({time:t.f32(),pose:r()}));return a.forEach((n,o)=>{o>0&&n.time<a[o-1].time&&t.fail(`found keys of '${e}' whose times fall`)}),{rest:i,keys:a}}function Xi(t){let e=()=>Float32Array.from(t.floats(3*t.count(12))),r=()=>t.u32s(t.count(4)),i={name:t.text(),lamps:S(t,t.count(4),()=>t.text()),value:t.f32(),color:W(t),ownColor:W(t),materials:r(),emitters:r(),brightLights:r(),sky:t.choice(1,"sky flag")>0},a=t.choice(1,"motion flag")>0;for(let o=0;o<2;++o)t.choice(0,"reserved byte");(!(i.value>=0)||[...i.color,...i.ownColor].some(o=>o<0))&&t.fail(`found negative light in group '${i.name}'`);let n={...i,reflectors:e(),surrounds:e(),probes:e()};return a&&kt(t,i.name),n}function ji(t){t.text(),t.floats(3);let e=t.choice(1,"clock")>0;t.choice(16,"sky type");for(let s=0;s<2;++s)t.choice(0,"reserved byte");let r=t.f32(),i=t.f32(),a=Math.round(Math.abs(r)*60),n=e?"solar time":`UTC${r<0?"-":"+"}${Mt(a/60)}`,o=S(t,t.count(40),()=>{let s=t.f32(),l=t.u32();return t.floats(5),{hour:s,group:l,sky:t.floats(3)}});return o.some((s,l)=>l>0&&!(s.hour>o[l-1].hour))&&t.fail("found hours that do not rise"),{clock:n,shown:i,hours:o}}function Mt(t){let e=Math.round(t*60),r=i=>String(i).padStart(2,"0");return`${r(Math.floor(e/60))}:${r(e%60)}`}function Bi(t,e){let r=t.planesU16(e,3);for(let i=0;i<r.length;i+=3){r[i]+=r[i+1],r[i+2]+=r[i+1];for(let a=0;a<3;++a)r[i+a]>Gi&&t.fail(`found code ${r[i+a]} of light, expected at most ${Gi}`)}return r}function Ki(t){let e=t.u32(),r=t.size(q,"width"),i=t.size(q,"height"),a=t.size(16384,"details"),n=t.size(16384,"details"),o=2**de(t),s=t.size(Ye,"groups"),l=r*i,c=a*n;return{page:e,width:r,height:i,detailWidth:a,detailHeight:n,scale:o,rest:t.planes(l,1),restOfDetail:t.planes(c,1),others:S(t,s,()=>({group:t.u32(),light:Bi(t,l),detail:Bi(t,c)}))}}function Yi(t){let e={name:t.text(),material:t.u32(),map:t.u32(),indices:t.u32s(t.count(4))};return e.indices.length%3&&t.fail(`found ${e.indices.length} indices, expected triangles`),e}function Qi(t){let e=W(t),r=t.size(q,"texels"),i=2**de(t),a=t.f32(),n=r*r;(r===0||(r&r-1)>0)&&t.fail(`found ${r} texels a side, expected a power of two`),a>=0&&a<=1e18||t.fail(`found inverse distance ${a}`);let o=t.planesU32(n),s=t.planesU16(n);return{centre:e,size:r,scale:i,light:o,inverseDistance:Float32Array.from(s,l=>l/65535*a),valid:t.planes(n,1)}}function S(t,e,r){let i=[];for(let a=0;a<e;++a)i.push(r(t));return i}var Po=64;function Go(t,e){let r=t.u16(),i=t.u16(),a=t.u16(),n=t.u16();(r<2||r>6||i!==1&&i!==3||a<1||a>256||n<1||n>64)&&t.fail(`found a transfer of ${r} bands, ${i} channels, ${a} clusters and ${n} components`),t.f32();let o=t.f32s(a*(n+1)*i*r*r),s=t.f32s(a*n),l=t.planes(e,1),c=new Int16Array(t.planes(e*n,2).buffer);for(let u of l)u>=a&&t.fail(`found cluster ${u} of ${a}`);return{bands:r,channels:i,clusters:a,components:n,basis:o,weightScale:s,cluster:l,weight:c}}function Zi(t){let e=t.text(),r=kt(t,e),i=Qe(t);return{name:e,...r,mesh:i,transfer:Go(t,i.positions.length/3)}}function Vo(t){return t.text(),{kind:t.choice(3,"kind of light"),twoSided:t.choice(1,"flag")>0,intensity:W(t),position:W(t),direction:W(t),innerCone:t.f32(),outerCone:t.f32(),angularRadius:t.f32(),corners:S(t,t.count(12),W)}}function Ji(t){let e=t.u32(),r=t.u32();(e<2||e>6||r<2||r>64)&&t.fail(`found ${e} bands and depth maps of ${r} texels a side`);let i=t.f32();t.f32();let a=W(t),n=W(t),o=[t.u32(),t.u32(),t.u32()],s=t.count(36),l=t.count(12),c=t.size(Po,"lights");(!(i>0)||n.some(w=>!(w>0))||o.some(w=>w<1)||o[0]*o[1]*o[2]>s)&&t.fail(`found a grid of ${o.join(" x ")} cells of ${s}`);let u=new Uint32Array(t.planes(s,36).buffer);for(let w=0;w<s;++w){let x=u[9*w];x!==0&&(x<=w||x+8>s)&&t.fail(`found parts ${x} of cell ${w} of ${s}`);for(let y=1;y<9;++y)u[9*w+y]>=l&&t.fail(`found probe ${u[9*w+y]} of ${l}`)}let h=t.planesF32(l,3),f=t.planes(l,1),p=()=>new Uint32Array(t.planes(l,8).buffer),d=p(),m=p(),v=2**de(t),_=t.planesU16(3*e*e*l),b=r*r*l,g=Float32Array.from(_,w=>Y(w)*v);return g.some(w=>!Number.isFinite(w))&&t.fail("found a coefficient that is not finite"),{bands:e,depthSide:r,depthCap:i,lower:a,cell:n,size:o,cells:u,positions:h,valid:f,bright:d,kept:m,harmonics:g,depth:t.planesU16(b),depthSquared:t.planesU16(b),lights:S(t,c,Vo)}}var Bo=2**30;function Do(t,e,r,i){switch(t){case"SCNE":i.sky=r.floats(3);break;case"MESH":i.mesh=Qe(r);break;case"MATL":i.materials=S(r,e,Ci);break;case"ETEX":i.emissionTextures=S(r,e,Di);break;case"TEXR":i.textures.push(...S(r,e,xt));break;case"NTEX":i.normals.push(...S(r,e,xt));break;case"LMAP":i.pages.push(...S(r,e,Ii));break;case"RFLT":i.reflectors=S(r,e,Ui);break;case"EMIT":i.emitters=S(r,e,Oi);break;case"KERN":i.kernels=S(r,e,Ni);break;case"FRES":i.fresnels=S(r,e,Wi);break;case"CAMS":i.cameras=S(r,e,$i);break;case"PATH":i.paths=S(r,e,Hi);break;case"CRFL":i.curved=S(r,e,Yi);break;case"SMAP":i.surrounds.push(...S(r,e,Qi));break;case"MOVR":i.movers.push(...S(r,e,Zi));break;case"PROB":i.field=Ji(r);break;case"LGRP":i.groups=S(r,e,Xi);break;case"GLMP":i.pageGroups.push(...S(r,e,Ki));break;case"DAYH":i.day=ji(r);break;case"WALK":i.grids=S(r,e,qi);break;default:r.fail("found a section that a piece does not have")}r.end()}var Co=[143,79,82,73,13,10,26,10];function Tt(t,e){let r=s=>{throw new V(`${e}: ${s}`)},i=new DataView(t.buffer,t.byteOffset,t.byteLength),a={sky:[0,0,0],materials:[],emissionTextures:[],textures:[],normals:[],pages:[],reflectors:[],emitters:[],kernels:[],fresnels:[],cameras:[],paths:[],grids:[],groups:[],pageGroups:[],curved:[],surrounds:[],movers:[]};(t.length<64||Co.some((s,l)=>t[l]!==s))&&r("is no piece of a pack"),i.getUint32(8,!0)!==1&&r(`found format version ${i.getUint32(8,!0)}, expected 1`);let n=i.getUint32(16,!0);64+n*64>t.length&&r("ends inside its table");let o=s=>Number(i.getBigUint64(s,!0));for(let s=0;s<n;++s){let l=64+64*s,c=String.fromCharCode(...t.subarray(l,l+4)),u=i.getUint32(l+4,!0),h=o(l+16),f=o(l+24),p=o(l+32),d=o(l+40),m=`${e}, ${c}`;h+f>t.length&&r(`section ${c} ends outside`),(p>Bo||p>f*65536+65536||d>p+1)&&r(`found ${p} bytes in section ${c}`);let v=t.subarray(h,h+f);if(u===1)try{v=Pi(v,new Uint8Array(p))}catch{r(`section ${c} cannot be decompressed`)}else u!==0&&r(`found codec ${u}`);v.length!==p&&r(`section ${c}: found ${v.length} bytes, expected ${p}`),Do(c,d,new Le(v,m),a)}return a}function ea(t,e,r,i){let a=s=>{throw new V(`scene: ${s}`)},n=(s,l,c,u=-1)=>{(s<u||s>=l)&&a(`found ${c} ${s} of ${l}`)},o=t.mesh;if(!o)return a("found no mesh");for(let s of o.parts)n(s.material,t.materials.length,"material",0),n(s.page,t.pages.length,"lightmap page");for(let s of t.materials)n(s.texture,e,"texture"),n(s.normalTexture,r,"normal texture"),n(s.kernel,t.kernels.length,"kernel"),n(s.fresnel,t.fresnels.length,"Fresnel map");for(let s of t.emissionTextures)n(s.material,t.materials.length,"material",0),n(s.texture,e,"texture",0);for(let s of t.reflectors){n(s.material,t.materials.length,"material",0);for(let l of s.indices)n(l,o.positions.length/3,"vertex",0);for(let l of s.emitters)n(l,t.emitters.length,"emitter",0)}for(let s of t.curved){n(s.material,t.materials.length,"material",0),n(s.map,i,"surround map",0);for(let l of s.indices)n(l,o.positions.length/3,"vertex",0)}t.groups.length>Ye&&a(`found ${t.groups.length} light groups, expected at most ${Ye}`);for(let s of t.groups){for(let l of s.materials)n(l,t.materials.length,"material",0);for(let l of s.emitters)n(l,t.emitters.length,"emitter",0)}}function ta(t,e){for(let r of e.groups)for(let i of r.brightLights)if(i>=t.lights.length)throw new V(`group '${r.name}': found bright light ${i} of ${t.lights.length}`)}function ra(t,e){for(let r of t.mesh.parts)if(r.material>=e.materials.length)throw new V(`mover '${t.name}': found material ${r.material} of ${e.materials.length}`)}function ia(t,e,r){let i=n=>{throw new V(`light of groups on page ${t.page}: ${n}`)},a=e.groups.length;if(!r)return i(`found no such page among ${e.pages.length}`);(t.width!==r.width||t.height!==r.height||t.detailWidth!==r.detailWidth||t.detailHeight!==r.detailHeight)&&i(`found ${t.width} x ${t.height} texels, expected ${r.width} x ${r.height} and as many details`);for(let n of[t.rest,t.restOfDetail])for(let o of n)o>=a&&i(`found group ${o} of ${a}`);for(let n of t.others)n.group>=a&&i(`found group ${n.group} of ${a}`)}var Io=2,Uo=1800,Oo=1e4,aa=2700,ie=t=>document.getElementById(t);function Me(t,e,r){let i=document.createElement("input");return i.type=t,i.setAttribute("aria-label",e),i.addEventListener("input",()=>r(i)),i}function Ft(t,e,r,i){return t.min=String(e),t.max=String(r),t.step=String(i),t}function No(t){let e=t.hours.slice(1).map((r,i)=>r.hour-t.hours[i].hour);return e.length>0?Math.min(...e)/4:.25}var Ze=class{constructor(e,r,i){this.groups=e;this.day=r;this.wanted=i;this.settings=Ce(e,r),e.length!==0&&(ie("lamps").hidden=!1,ie("lamps").addEventListener("click",()=>this.toggle()),ie("lights-close").addEventListener("click",()=>this.toggle()),ie("lights-baked").addEventListener("click",()=>this.all(({hour:a})=>({on:!0,value:1,hour:a}))),ie("lights-off").addEventListener("click",()=>this.all(a=>({...a,on:!1}))),this.dialog.addEventListener("keydown",a=>{(a.key==="Escape"||a.key==="o"&&!(a.ctrlKey||a.altKey||a.metaKey))&&(this.toggle(),a.preventDefault())}),r&&ie("lights-groups").append(this.rowOfHour(r)),e.forEach((a,n)=>{this.settings[n].hour===void 0&&ie("lights-groups").append(this.rowsOf(n))}),this.fromHash())}settings;refreshes=[];dialog=ie("lights");get factors(){return oi(this.groups,this.settings,this.day)}get changed(){return this.factors.some(e=>e.some(r=>r!==1))}toggle(){this.groups.length!==0&&(this.dialog.open?(this.dialog.close(),ie("view").focus()):this.dialog.show(),ie("lamps").setAttribute("aria-expanded",String(this.dialog.open)))}fromHash(){let e=new URLSearchParams(location.hash.slice(1)).getAll("light");e.length!==0&&(this.settings=Ce(this.groups,this.day),ai(this.groups,e,this.settings,this.day),this.refresh())}toHash(){return ni(this.groups,this.settings,this.day).map(e=>`&light=${encodeURIComponent(e)}`).join("")}all(e){this.settings=this.settings.map(e),this.refresh()}refresh(){for(let e of this.refreshes)e();this.wanted()}rowOfHour(e){let r=document.createElement("label"),i=document.createElement("output"),a=()=>this.settings.find(o=>o.hour!==void 0).hour,n=Ft(Me("range",`hour, ${e.clock}`,()=>{ht(e,Number(n.value),this.settings),this.refresh()}),e.hours[0].hour,e.hours.at(-1).hour,No(e));return r.append("hour",n,i),this.refreshes.push(()=>{n.value=String(a()),i.textContent=`${Mt(a())} ${e.clock}`}),this.refreshes.at(-1)(),r}rowsOf(e){let{name:r,lamps:i}=this.groups[e],a=document.createElement("div"),n=()=>this.settings[e],o=v=>()=>{v(),this.refresh()},s=(v,..._)=>{let b=document.createElement("label");return b.append(..._.slice(0,1),v,..._.slice(1)),a.append(b),b};a.setAttribute("role","group"),a.setAttribute("aria-label",r),a.title=i.join(", ");let l=Me("checkbox",r,o(()=>{n().on=l.checked})),c=Ft(Me("range",`${r}: light, times what was baked`,o(()=>{n().value=Number(c.value)})),0,Io,.05),u=Me("checkbox",`${r}: a colour of its own`,o(()=>{delete n().color,delete n().kelvin,u.checked&&Ie(n(),aa)})),h=Ft(Me("range",`${r}: colour temperature, kelvin`,o(()=>Ie(n(),Number(h.value)))),Uo,Oo,100),f=document.createElement("output"),p=document.createElement("output");s(r,l);let d=s("",c,f),m=s("colour",u,h,p);return this.refreshes.push(()=>{let v=n();l.checked=v.on,c.value=String(v.value),u.checked=!!v.color,h.value=String(v.kelvin??aa),d.hidden=m.hidden=!v.on,h.hidden=p.hidden=v.kelvin===void 0,f.textContent=`× ${v.value.toFixed(2)}`,p.textContent=`${Math.round(v.kelvin??0)} K`,h.style.setProperty("accent-color",v.kelvin?Wo(v.kelvin):"")}),this.refreshes.at(-1)(),a}};function Wo(t){let e=ut(t),r=Math.max(...e);return`rgb(${e.map(i=>Math.round(255*(i/r)**(1/2.2))).join(" ")})`}function na(t,e,r,i){let{right:a,up:n,forward:o}=at(t),s=t.fov===0?t.halfHeight:Math.tan(.5*t.fov),l=U(L(a,(2*e-1)*s*i),L(n,(1-2*r)*s));return t.fov===0?{from:U(t.eye,l),way:o}:{from:t.eye,way:N(U(o,l),o)}}function oa(t,e,r){let i=t.data.mesh,a=i.positions,n=m=>[a[3*m],a[3*m+1],a[3*m+2]],o;for(let m of i.parts){let v=t.data.materials[m.material].doubleSided;for(let _=m.first;_<m.first+m.count;_+=3){let b=n(i.indices[_]),g=F(n(i.indices[_+1]),b),w=F(n(i.indices[_+2]),b),x=O(r,w),y=B(g,x);if(y===0||y<0&&!v)continue;let G=F(e,b),C=B(G,x)/y,X=O(G,g),I=B(r,X)/y,$=B(w,X)/y;C<0||I<0||C+I>1||$<=1e-4||o&&$>=o.t||(o={t:$,index:_,u:C,w:I,page:m.page,normal:N(O(g,w),[0,1,0])})}}if(!o)return;let{t:s,index:l,u:c,w:u,page:h,normal:f}=o,p=i.lightmapUvs,d=m=>[0,1,2].reduce((v,_)=>v+p[2*i.indices[l+_]+m]*[1-c-u,c,u][_],0);return{at:U(e,L(r,s)),normal:f,distance:s,lux:h<0?0:t.luxAt(h,d(0),d(1))}}var Je=4,$o=120,Et=50,Ho=25,qo=.25,Xo=.5,jo=.002,Ko=5e3,Yo=200,Qo=4,et=class{constructor(e,r,i,a,n,o){this.canvas=e;this.renderer=r;this.scene=i;this.walk=a;this.panel=n;this.lights=o;o.changed&&this.dim()}count=0;movedAt=-1e9;scale=1;hurries=!1;began=!1;presented=!1;meteredAt=-1e9;byHand;luxShown=!1;pointer=[.5,.5];frames=0;changed(){this.count=0,this.settled=!1}settled=!1;loading=!0;came=!1;drawnAt=-1e9;took=0;pieceCame(){this.came=!0}allCame(){this.loading=!1,delete document.body.dataset.rest,this.changed()}waits(e){let r=this.loading&&this.took>Yo&&this.count>0;return this.came&&(!r||e-this.drawnAt>Qo*this.took)?(this.came=!1,this.changed(),!1):r||this.count>=Je}dimmed=!1;dim(){this.dimmed=!0}brighter(e){this.byHand=(this.byHand??0)-e/3,this.meteredAt=-1e9,this.changed()}automatic(){this.byHand=void 0,this.meteredAt=-1e9,this.changed()}frame(e,r,i){let a=this.walk.step(e.take(r),r),n=this.walk.clock.runs&&this.scene.movers.animated,o=a||n;n&&(this.walk.clock.seconds+=r),this.scene.movers.place(this.walk.clock.seconds),this.panel.moversAre(this.scene.movers.animated,n),this.panel.stick(e.stick),this.dimmed&&(this.dimmed=!1,this.scene.setLights(this.lights.factors),this.changed());let s=Math.max(1,Math.round(this.canvas.clientWidth*Math.min(devicePixelRatio,2))),l=Math.max(1,Math.round(this.canvas.clientHeight*Math.min(devicePixelRatio,2)));(this.canvas.width!==s||this.canvas.height!==l)&&(this.canvas.width=s,this.canvas.height=l,this.changed()),o&&(i-this.movedAt<500&&this.adapt(r*1e3),this.movedAt=i,this.changed(),delete document.body.dataset.rest),!o&&i-this.movedAt>500&&(this.hurries=!1);let c=this.began&&i-this.movedAt<$o;if(this.frames===1&&!this.presented){this.presented=!0;return}(c?!o:this.waits(i))||(this.began?this.draw(c,s,l,i):this.drawFirst(s,l,i),++this.frames)}adapt(e){e>Et&&!this.hurries?this.hurries=!0:e>Et?this.scale=Math.max(this.scale*Math.max(Math.sqrt(Et/e),.5),qo):e<Ho&&(this.scale=Math.min(this.scale*1.05,1))}drawFirst(e,r,i){let a=n=>Math.max(1,Math.round(n*Xo));this.renderer.draw(this.scene,this.walk.camera,a(e),a(r),void 0,Fi),this.meter(!1,i),this.renderer.show(this.scene,0,e,r),this.renderer.startRest(),this.began=!0,this.changed()}draw(e,r,i,a){let n=e?this.scale:1,o=Math.max(1,Math.round(r*n)),s=Math.max(1,Math.round(i*n)),l=performance.now(),c=e?a-this.meteredAt>200:this.count===0&&!this.settled;this.renderer.draw(this.scene,this.walk.camera,o,s,e?void 0:this.count,e&&this.hurries?Ei:Ti),c&&this.meter(e,a),c&&!e&&(this.took=performance.now()-l),this.drawnAt=performance.now(),!e&&!this.settled&&this.renderer.addToMean(1/Je,this.count===0);let u=this.count===Je-1;this.renderer.show(this.scene,e?0:this.count,r,i,e||!this.settled||u),this.count=e?0:this.count+1,!(this.count<Je)&&(!this.settled&&this.settle(a)||(document.body.dataset.rest=String(this.frames),this.panel.lux(this.luxShown?this.luxThere():void 0)))}settle(e){let r=this.renderer.white;return this.settled=!0,this.meter(!1,e,!0),this.took>Ko||Math.abs(Math.log2(this.renderer.white/r))<jo?!1:(this.count=0,!0)}meter(e,r,i=!1){let a=this.renderer.meter(this.scene,i);if(this.meteredAt=r,a===void 0)return;let n=Math.min(Math.max(a-Math.log2(1.2*.18),-4),17)+(this.byHand??0),o=Math.log2(this.renderer.white/1.2),s=e?.45:1;this.renderer.white=1.2*2**(o+(n-o)*s)}get aspect(){return this.canvas.width/this.canvas.height}hitAt(e,r){let i=na(this.walk.camera,e,r,this.aspect);return oa(this.scene,i.from,i.way)}go(e,r){let i=this.hitAt(e,r);if(!i)return;let a=i.normal[1]>.7?0:.5,n=[i.at[0]+i.normal[0]*a,i.at[1],i.at[2]+i.normal[2]*a];a>0&&(n[1]=this.walk.floors.nearest(this.walk.camera.eye,1e9)?.eye[1]??n[1]),this.walk.goTo(n,matchMedia("(prefers-reduced-motion: reduce)").matches)||this.panel.say("Nobody can walk there."),this.changed()}hover(e,r){this.pointer=[e,r],this.luxShown&&this.panel.lux(this.luxThere())}luxThere(){let e=this.hitAt(...this.pointer);return e?`${e.lux<10?e.lux.toFixed(1):Math.round(e.lux)} lux`:"no surface"}toggleLux(){this.luxShown=!this.luxShown,this.panel.lux(this.luxShown?this.luxThere():void 0)}};var sa=2;async function la(t,e){let r;try{r=await fetch(t,{integrity:e})}catch{throw new V(`${t} did not come, or is not the one that this page was made with`)}if(!r.ok)throw new V(`${t}: ${r.status} ${r.statusText}`);return new Uint8Array(await r.arrayBuffer())}async function ca(t,e){let r=JSON.parse(new TextDecoder().decode(await la(t,e)));if(r.version!==sa)throw new V(`${t} is of version ${r.version}, this viewer of ${sa}: write the folder anew`);for(let i of r.pieces)if(!/^pieces\/[a-z]+-[0-9a-f]+\.oriel$/.test(i.file)||!(i.bytes>0)||!(i.index>=0))throw new V(`${t}: found piece '${i.file}'`);return r}async function Rt(t){let e=await la(t.file,t.integrity);if(e.length!==t.bytes)throw new V(`${t.file}: found ${e.length} bytes, expected ${t.bytes}`);return e}function E(t){let e=document.getElementById(t);if(!e)throw new Error(`the page has no ${t}`);return e}var tt=class{walk;lights;show=()=>{};timer=0;begin(e,r,i){this.walk=e,this.lights=r,this.show=i;let a=E("places");e.cameras.forEach((n,o)=>a.append(new Option(n.name||`place ${o+1}`,String(o)))),a.addEventListener("change",()=>{a.value!==""&&this.jump(Number(a.value)),a.value="",E("view").focus()}),E("tour").hidden=!e.path,E("tour").addEventListener("click",()=>this.key("p")),E("movers").addEventListener("click",()=>this.key("m")),E("link").addEventListener("click",()=>void this.copyLink()),E("screen").hidden=!document.fullscreenEnabled,E("screen").addEventListener("click",()=>{(document.fullscreenElement?document.exitFullscreen():document.documentElement.requestFullscreen()).catch(()=>this.say("The browser does not give the whole screen."))}),E("help").addEventListener("click",()=>this.key("?")),addEventListener("hashchange",()=>{let n=e.fromHash();n&&(this.walk.jump(n),this.show()?.changed()),r.fromHash()})}sizes(e,r){E("sheet-sizes").textContent=`Loaded: ${(e/1e6).toFixed(1)} MB. Held on the graphics device: ${(r/1e6).toFixed(1)} MB, and the frame.`,document.body.dataset.held=String(r)}movers="";moversAre(e,r){let i=`${e} ${r}`;i!==this.movers&&(this.movers=i,E("movers").hidden=!e,E("movers").setAttribute("aria-pressed",String(r)))}progress(e){E("progress").value=e,E("bar").hidden=e>=1}say(e,r=!1){E("line").textContent=e,clearTimeout(this.timer),r||(this.timer=window.setTimeout(()=>{E("line").textContent=""},4e3))}lux(e){E("lux").hidden=e===void 0,E("lux").textContent=e??""}stick(e){let r=E("stick");r.hidden=!e,e&&(r.style.setProperty("left",`${e.startX}px`),r.style.setProperty("top",`${e.startY}px`)),E("tour").setAttribute("aria-pressed",String(!!this.walk?.touring))}jump(e){let r=this.walk,i=r.cameras[e];i&&(r.place=e,r.jump(i),this.show()?.changed(),this.say(i.name))}async copyLink(){let e=this.walk.toHash()+this.lights.toHash(),r=location.href.split("#")[0]+e;history.replaceState(null,"",e);try{await navigator.clipboard.writeText(r),this.say("A link to this view is on the clipboard.")}catch{this.say("The address now leads to this view.")}}key(e){let r=this.walk,i=this.show();if(!(!r||!i))switch(e){case"c":this.jump((r.place+1)%r.cameras.length);break;case"Home":this.jump(0);break;case"o":this.lights.toggle();break;case"m":r.clock.runs=!r.clock.runs;break;case"p":r.toggleTour();break;case"g":i.go(.5,.5);break;case"l":i.toggleLux();break;case"+":case"=":i.brighter(1);break;case"-":i.brighter(-1);break;case"x":i.automatic();break;case"?":E("sheet").showModal();break;default:/^[1-9]$/.test(e)&&this.jump(Number(e)-1)}}};var At=t=>{document.body.dataset.state=t};function ha(t){E("fallback").hidden=!1,E("fallback-text").textContent=t,E("tools").hidden=E("bar").hidden=!0,E("view").hidden=!0,At("refused")}var ua=3,fa=!1,Te=E("view"),ne=new tt;function Zo(){return Te.getContext("webgl2",{antialias:!1,alpha:!1,depth:!1,powerPreference:"high-performance"})}var St=class{constructor(e,r,i){this.gl=e;this.scene=r;this.walk=i;this.lights=new Ze(r.groups,r.day,()=>this.show?.dim())}pieces=new Map;show;lights;begin(e=new we(vt(this.gl))){let r=new $e(e.device,{...this.scene,pages:this.scene.pages.slice()});this.show=new et(Te,e,r,this.walk,ne,this.lights);for(let[i,a]of this.pieces)this.take(i,a)}take(e,r){this.pieces.set(e,r);let i=this.show,[a,n]=e.split(" "),o=Number(n);i&&(a==="light"&&r.pages[0]&&i.scene.setPage(o,r.pages[0]),a==="texture"&&r.textures[0]&&i.scene.setTexture(o,r.textures[0],!1),a==="normal"&&r.normals[0]&&i.scene.setTexture(o,r.normals[0],!0),a==="surround"&&r.surrounds[0]&&i.scene.setSurround(o,r.surrounds[0]),a==="field"&&r.field&&i.scene.movers.setField(r.field),a==="mover"&&r.movers[0]&&i.scene.movers.add(o,r.movers[0]),a==="lamps"&&r.pageGroups[0]&&i.scene.setPageGroups(r.pageGroups[0]),i.pieceCame())}};async function Jo(t){if(!("serviceWorker"in navigator)||!isSecureContext)return;let e=/pieces-([0-9a-f]+)\.json/.exec(document.body.dataset.pieces)?.[1];try{let r=await caches.open(`oriel ${new URL("./",location.href).pathname} ${e}`),i=[...document.querySelectorAll("script[src], link[href]")].map(a=>a.getAttribute("src")??a.getAttribute("href"));await r.addAll(["./",document.body.dataset.pieces,...i,...t.pieces.map(a=>a.file)]),await navigator.serviceWorker.register("offline.js"),document.body.dataset.offline="kept"}catch{}}var es=t=>`${t.kind} ${t.index}`;async function ts(){let t=await ca(document.body.dataset.pieces,document.body.dataset.integrity),e=t.pieces.reduce((g,w)=>g+w.bytes,0),r=t.pieces.find(g=>g.kind==="scene");if(!r)throw new V("found no scene among the pieces");let i=Rt(r);i.catch(()=>{});let a=Zo();if(!a)return ha("This page shows a building in three dimensions. Your browser cannot draw it: it lacks WebGL 2.");let n=new we(vt(a));n.start();let o=r.bytes;ne.progress(.05);let s=Tt(await i,r.file),l=a.getParameter(a.MAX_TEXTURE_SIZE);ma(s,r.file,l);let c=g=>t.pieces.filter(w=>w.kind===g).length;ea(s,c("texture"),c("normal"),c("surround"));let u=new qe(s),h=new St(a,s,u);h.begin(n),fa=!0,ne.begin(u,h.lights,()=>h.show);let f=new ze(Te,{key:g=>ne.key(g),go:(g,w)=>h.show?.go(g,w),hover:(g,w)=>h.show?.hover(g,w)}),p=!1,d=performance.now();Te.addEventListener("webglcontextlost",g=>{g.preventDefault(),p=!0,h.show=void 0}),Te.addEventListener("webglcontextrestored",()=>{p=!1,h.begin(),document.body.dataset.state==="whole"&&h.show.allCame()});let m=g=>{requestAnimationFrame(m);let w=Math.min((g-d)/1e3,.25);d=g,!p&&(h.show?.frame(f,w,g),h.show?.frames&&document.body.dataset.state==="loading"&&(a.finish(),performance.mark("first frame"),At("first")))},v=t.pieces.filter(g=>g!==r),_=[],b=g=>{for(let w=_.length;w<Math.min(g,v.length);++w)(_[w]=Rt(v[w])).catch(()=>{})};b(ua),m(d),ne.progress(o/e);for(let[g,w]of v.entries()){b(g+ua);let x=Tt(await _[g],w.file);rs(x,w,l),w.kind==="mover"&&ra(x.movers[0],s),w.kind==="field"&&ta(x.field,s),w.kind==="lamps"&&ia(x.pageGroups[0],s,h.pieces.get(`light ${x.pageGroups[0].page}`)?.pages[0]),h.take(es(w),x),ne.progress((o+=w.bytes)/e)}h.show?.allCame(),At("whole"),ne.progress(1),ne.sizes(e,h.show?.scene.bytes??0),await Jo(t)}function rs(t,e,r){let a={light:t.pages,texture:t.textures,normal:t.normals,surround:t.surrounds,lamps:t.pageGroups,mover:t.movers,field:t.field?[t.field]:[]}[e.kind]?.length??0;if(a!==1)throw new V(`${e.file}: found ${a} of kind '${e.kind}', expected one`);ma(t,e.file,r)}function ma(t,e,r){let i=[...t.textures,...t.normals,...t.pages].map(a=>[a.width,a.height]);for(let a of t.pages)i.push([a.detailWidth,a.detailHeight]);for(let a of t.surrounds)i.push([1.5*a.size+4,a.size+64]);for(let[a,n]of i)if(Math.max(a,n)>r)throw new V(`${e}: found an image of ${a} x ${n} texels, but this device holds at most ${r} a side`)}ts().catch(t=>{fa?ne.say(`A part is missing: ${t.message}`,!0):ha(`This walkthrough cannot be shown: ${t.message}`),t instanceof V||console.error(t)});
