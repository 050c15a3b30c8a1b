var z=class extends Error{},xe=class{constructor(e,r){this.bytes=e;this.name=r;this.view=new DataView(e.buffer,e.byteOffset,e.byteLength)}at=0;view;get left(){return this.bytes.length-this.at}fail(e){throw new z(`${this.name}: ${e}`)}take(e){return e>this.left&&this.fail(`found ${this.left} bytes more, expected ${e}`),this.at+=e,this.at-e}u8(){return this.view.getUint8(this.take(1))}u32(){return this.view.getUint32(this.take(4),!0)}i32(){return this.view.getInt32(this.take(4),!0)}f64(){return this.view.getFloat64(this.take(8),!0)}f32(){let e=this.view.getFloat32(this.take(4),!0);return Number.isFinite(e)||this.fail("found a number that is not finite"),e}floats(e){let r=[];for(let a=0;a<e;++a)r.push(this.f32());return r}count(e){let r=this.u32();return r*e>this.left&&this.fail(`found ${r} elements in ${this.left} bytes`),r}text(){let e=this.count(1),r=this.take(e);return new TextDecoder().decode(this.bytes.subarray(r,r+e))}choice(e,r){let a=this.u8();return a>e&&this.fail(`found ${r} ${a}, expected 0 to ${e}`),a}size(e,r){let a=this.u32();return a>e&&this.fail(`found ${r} ${a}, expected at most ${e}`),a}planes(e,r){e*r>this.left&&this.fail(`found ${this.left} bytes, expected ${e*r}`);let a=this.take(e*r),i=new Uint8Array(e*r);for(let o=0;o<r;++o){let n=0;for(let s=0,l=o,c=a+o*e;s<e;++s,l+=r)n=n+this.bytes[c+s]&255,i[l]=n}return i}planesF32(e,r=1){let a=new Float32Array(this.planes(e,4*r).buffer);for(let i=0;i<a.length;++i)Number.isFinite(a[i])||this.fail("found a number that is not finite");return a}planesU32(e){return new Uint32Array(this.planes(e,4).buffer)}planesU16(e,r=1){return new Uint16Array(this.planes(e,2*r).buffer)}u32s(e){4*e>this.left&&this.fail(`found ${this.left} bytes, expected ${4*e}`);let r=this.take(4*e),a=new Uint32Array(e);for(let i=0;i<e;++i)a[i]=this.view.getUint32(r+4*i,!0);return a}end(){this.left>0&&this.fail(`found ${this.left} bytes more than expected`)}};function ae(t){let e=t>>10&31,r=t&1023,a=t&32768?-1:1;return e===0?a*r*2**-24:e===31?NaN:a*(1+r/1024)*2**(e-15)}var ke=class{constructor(e,r){this.canvas=e;this.events=r;addEventListener("keydown",a=>this.key(a)),addEventListener("keyup",a=>this.down.delete(a.code)),addEventListener("blur",()=>this.reset()),e.addEventListener("pointerdown",a=>this.begin(a)),e.addEventListener("pointermove",a=>this.move(a)),e.addEventListener("pointerup",a=>this.end(a)),e.addEventListener("pointercancel",a=>this.fingers.delete(a.pointerId)),e.addEventListener("contextmenu",a=>a.preventDefault())}down=new Set;fingers=new Map;yaw=0;pitch=0;pressed=[];reset(){this.down.clear(),this.fingers.clear()}key(e){e.ctrlKey||e.altKey||e.metaKey||e.target instanceof Element&&e.target.closest("button, select, dialog, a")&&!/^Key[WASD]$/.test(e.code)||e.target instanceof HTMLSelectElement||(/^Arrow|^Space$/.test(e.code)&&e.preventDefault(),e.repeat||this.events.key(e.key.length===1?e.key.toLowerCase():e.key),this.down.add(e.code))}begin(e){if(e.button!==0)return;this.canvas.focus({preventScroll:!0});try{this.canvas.setPointerCapture(e.pointerId)}catch{}let r=e.pointerType==="touch"&&e.clientX<.5*innerWidth&&![...this.fingers.values()].some(a=>a.moves);this.fingers.set(e.pointerId,{x:e.clientX,y:e.clientY,startX:e.clientX,startY:e.clientY,begin:e.timeStamp,moves:r,far:!1})}move(e){let r=this.fingers.get(e.pointerId);if(!r){e.pointerType==="mouse"&&this.events.hover(...this.place(e));return}if(r.far||=Math.hypot(e.clientX-r.startX,e.clientY-r.startY)>12,!r.moves){let a=e.pointerType==="touch"?.006:.004;this.yaw+=(e.clientX-r.x)*a,this.pitch+=(e.clientY-r.y)*a}r.x=e.clientX,r.y=e.clientY}end(e){let r=this.fingers.get(e.pointerId);this.fingers.delete(e.pointerId),!(!r||r.far||e.timeStamp-r.begin>800)&&(e.pointerType!=="mouse"||e.detail>=2||this.doubled(e))&&this.events.go(...this.place(e))}lastClick=-1e9;doubled(e){let r=e.timeStamp-this.lastClick<400;return this.lastClick=e.timeStamp,r}place(e){let r=this.canvas.getBoundingClientRect();return[(e.clientX-r.left)/r.width,(e.clientY-r.top)/r.height]}get stick(){return[...this.fingers.values()].find(e=>e.moves&&e.far)}gamepad(e,r){let a=(navigator.getGamepads?.()??[]).find(n=>n?.connected);if(!a)return;let i=n=>{let s=a.axes[n]??0;return Math.abs(s)<.15?0:(s-Math.sign(s)*.15)/(1-.15)};e.right+=i(0),e.ahead-=i(1),e.yaw+=i(2)*2*r,e.pitch+=i(3)*2*r;let o=["g",void 0,"p",void 0,"Shift","c",void 0,void 0,"?","Home",void 0,void 0,"+","-"];e.fast||=!!a.buttons[4]?.pressed,a.buttons.forEach((n,s)=>{let l=o[s];n.pressed&&!this.pressed[s]&&l&&s!==4&&this.events.key(l),this.pressed[s]=n.pressed})}take(e){let r=o=>Number(this.down.has(o)),a={right:r("KeyD")-r("KeyA"),ahead:r("KeyW")-r("KeyS"),fast:!!(r("ShiftLeft")+r("ShiftRight")),yaw:-this.yaw+(r("ArrowRight")-r("ArrowLeft"))*1.5*e,pitch:-this.pitch+(r("ArrowDown")-r("ArrowUp"))*1.2*e};this.yaw=this.pitch=0;for(let o of this.fingers.values())!o.moves||!o.far||(a.right+=(o.x-o.startX)/60,a.ahead-=(o.y-o.startY)/60);this.gamepad(a,e);let i=o=>Math.min(Math.max(o,-1),1);return a.right=i(a.right),a.ahead=i(a.ahead),a}};var N=(t,e)=>[t[0]+e[0],t[1]+e[1],t[2]+e[2]],P=(t,e)=>[t[0]-e[0],t[1]-e[1],t[2]-e[2]],K=(t,e)=>[t[0]*e,t[1]*e,t[2]*e],G=(t,e)=>t[0]*e[0]+t[1]*e[1]+t[2]*e[2],O=(t,e)=>[t[1]*e[2]-t[2]*e[1],t[2]*e[0]-t[0]*e[2],t[0]*e[1]-t[1]*e[0]],Y=t=>Math.hypot(t[0],t[1],t[2]),I=(t,e)=>{let r=Y(t);return r>0&&Number.isFinite(r)?K(t,1/r):e};function at(){let t=new Float64Array(16);return t[0]=t[5]=t[10]=t[15]=1,t}function j(t,e){let r=new Float64Array(16);for(let a=0;a<4;++a)for(let i=0;i<4;++i){let o=0;for(let n=0;n<4;++n)o+=t[4*n+i]*e[4*a+n];r[4*a+i]=o}return r}function J(t,e){let r=[0,0,0,0];for(let a=0;a<4;++a)r[a]=t[a]*e[0]+t[4+a]*e[1]+t[8+a]*e[2]+t[12+a]*e[3];return r}var ie=(t,e)=>J(t,[e[0],e[1],e[2],1]).slice(0,3);function it(t){let e=new Float64Array(16);for(let r=0;r<3;++r)for(let a=0;a<3;++a)e[4*a+r]=t[4*r+a];for(let r=0;r<3;++r)e[12+r]=-(t[4*r]*t[12]+t[4*r+1]*t[13]+t[4*r+2]*t[14]);return e[15]=1,e}function nt(t,e){let r=Array.from({length:4},(a,i)=>[...Array.from({length:4},(o,n)=>t[4*i+n]),e[i]]);for(let a=0;a<4;++a){let i=a;for(let o=a+1;o<4;++o)Math.abs(r[o][a])>Math.abs(r[i][a])&&(i=o);[r[a],r[i]]=[r[i],r[a]];for(let o=0;o<4;++o){if(o===a)continue;let n=r[o][a]/r[a][a];for(let s=a;s<5;++s)r[o][s]-=n*r[a][s]}}return r.map((a,i)=>a[4]/a[i])}var Ie=()=>({lower:[1/0,1/0,1/0],upper:[-1/0,-1/0,-1/0]});function Te(t,e,r,a){t.lower[0]=Math.min(t.lower[0],e),t.lower[1]=Math.min(t.lower[1],r),t.lower[2]=Math.min(t.lower[2],a),t.upper[0]=Math.max(t.upper[0],e),t.upper[1]=Math.max(t.upper[1],r),t.upper[2]=Math.max(t.upper[2],a)}var Ee=t=>K(N(t.lower,t.upper),.5),fe=t=>.5*Y(P(t.upper,t.lower));function ne(t,e){for(let r=0;r<6;++r){let a=r>>1,i=r&1?-1:1,o=t[15]+i*t[12+a];for(let n=0;n<3;++n){let s=t[4*n+3]+i*t[4*n+a];o+=s*(s>0?e.upper[n]:e.lower[n])}if(o<0)return!1}return!0}var ot=`// Colour: linear Rec. 709 everywhere; sRGB only at the screen. The same as formats/core/color.h.

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
`;var st=`// Filling holes of a reflected image. Light has 1 / distance in a, 0 where there is none.

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
`;var lt=`// One triangle that covers the viewport, from vertex numbers 0, 1, 2: no vertex buffer.
vec4 fullscreen_position(int vertex) {
  vec2 corner = vec2(float((vertex & 1) << 2) - 1.0, float((vertex & 2) << 1) - 1.0);
  return vec4(corner, 0.0, 1.0);
}
`;var ct=`// K as taps of equal energy by incidence (player/scene/kernel_taps.h): where a glossy lobe goes around the mirror direction.

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
`;var ut=`// A place on a page of the lightmap, interpolated at the centroid of what a triangle covers of a pixel: at its middle,
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
`;var ht=`// Polygons of light in glossy lobes, in closed form: the twin of formats/query/lobe_light.h. Surface frame: z the normal, x the
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

// The same of a lobe that is one direction: 1 where a ray along it meets the polygon's bright side, -1 the other, 0 none.
float polygon_met(vec3 v[4], vec3 direction) {
  float least = 0.0, most = 0.0;
  for (int i = 0; i < 4; ++i) {
    float side = dot(cross(v[i], v[i == 3 ? 0 : i + 1]), direction);
    least = min(least, side);
    most = max(most, side);
  }
  vec3 normal = cross(v[1] - v[0], v[2] - v[0]);
  bool ahead = dot(normal, v[0]) * dot(normal, direction) > 0.0;
  if (!ahead || least * most < 0.0) return 0.0;
  return most > 0.0 ? -1.0 : 1.0;
}
`;var ft=`// Normal maps: how a texel tilts a surface's normal, the same as formats/assets/normal_map.h.

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
`;var mt=`// R: the directional albedo of a material's specular lobe (formats/assets/fresnel_map.h).

// Linear between the entries of row \`row\`; entry i of count is at cos theta = (i / (count - 1))^2.
vec3 reflectance_from_table(sampler2D tables, int row, int count, float cos_theta) {
  float at = sqrt(clamp(cos_theta, 0.0, 1.0)) * float(count - 1);
  int low = min(int(at), max(count - 2, 0));
  vec3 a = texelFetch(tables, ivec2(low, row), 0).rgb;
  vec3 b = texelFetch(tables, ivec2(min(low + 1, count - 1), row), 0).rgb;
  return mix(a, b, at - float(low));
}

// Where a direction at angle theta from the normal, with unit tangential direction \`around\`, lies in the sphere map: an
// equal-area disk, r = sqrt(2) sin(theta / 2). sin^2(theta / 2) = (1 - cos theta) / 2. Kept half a texel from the rim.
vec2 sphere_map_uv(float cos_theta, vec2 around, float size) {
  float r = min(sqrt(max(1.0 - clamp(cos_theta, 0.0, 1.0), 0.0)), 1.0 - 1.5 / size);
  return 0.5 + 0.5 * r * around;
}
`;var dt=`// The shading equation of docs/conventions.md: L = kd (1 - max R) / pi E + S + emission.
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
`;var pt=`// Light that movers take from the scene, from a picture of half the frame's size: from the pixels around that are of the
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
`;var vt=`// Tone curves: linear light, 1 = the luminance that the exposure maps to white, to linear display values in [0,1].

// Plain exposure: clips.
vec3 tonemap_none(vec3 light) { return clamp(light, 0.0, 1.0); }

// Narkowicz 2016, "ACES Filmic Tone Mapping Curve": a fit per channel.
vec3 tonemap_aces(vec3 light) {
  vec3 x = clamp(light, 0.0, 1e4);  // the curve is flat long before, and squares must stay finite
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}
`;var _t=`// Depth of the opaque scene. Only cut-outs need the texture.
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
`;var gt=`layout(location = 0) in vec3 a_position;
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
`;var bt=`// Baked light on a surface of the scene that stands still.
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

// Between the four texels around, or, in a finer cell, between its own points. Where a pixel is as large as a step between
// these they would flicker: the cell fades to its texels until it is as large as their distance.
vec3 lightmap_at(vec2 uv) {
  vec3 light = texture(u_lightmap, uv).rgb;
  if (!u_detailed) return light;
  vec2 at = uv * vec2(textureSize(u_lightmap, 0)) - 0.5;
  vec2 footprint = fwidth(at);
  vec2 last = vec2(textureSize(u_lightmap, 0) - 1);
  at = clamp(at, vec2(0.0), last);
  vec2 corner = min(floor(at), max(last - 1.0, vec2(0.0)));
  DetailBlock block = detail_block(texelFetch(u_cells, ivec2(corner), 0).r);
  if (block.side < 1.5) return light;
  vec2 place = (block.first + (at - corner) * block.side + 0.5) / vec2(textureSize(u_detail, 0));
  float steps = max(footprint.x, footprint.y) * block.side;
  return mix(textureLod(u_detail, place, 0.0).rgb, light, clamp(log2(max(steps, 1.0)) / log2(block.side), 0.0, 1.0));
}

// Lightmaps hold the light of fronts: a back that is lit is a surface of its own.
vec3 irradiance_on(vec3 tilted) {
  vec3 irradiance = lightmap_at(lightmap_uv(v_lightmap_uv)) * u_lightmap_scale;
  if (!gl_FrontFacing) return vec3(0.0);
  if (!u_normal_mapped || !u_directional) return irradiance;
  return irradiance * directional_ratio(texture(u_direction, lightmap_uv(v_lightmap_uv)).xyz, tilted, front_normal());
}
`;var wt=`// The light of an opaque surface. To be included after irradiance_here(normal), lux.
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
const int u_alpha_kind = 0;
#else
uniform int u_alpha_kind;  // of o_light.a: 0 kind of light, 1 one over the distance from the eye, 2 over depth
#endif
uniform float u_diffuse_share;  // (1 - metallic) (1 - transmission)
uniform vec3 u_emission;        // cd/m2
uniform vec4 u_depth_row;    // depth of a point of pack space = dot(row, point)
uniform float u_closest;     // least 1 / distance that is stored
uniform vec3 u_weights;  // of the diffuse part, the undirected reflection, the emission: 0 or 1

in vec2 v_uv;
in vec4 v_color;
layout(location = 0) out vec4 o_light;  // kind of light: 1 cd/m2, 2 a colour to be shown as it is

float alpha_of_light(float kind) {
  if (u_alpha_kind == 0) return kind;
  float away = u_alpha_kind == 1 ? distance(u_eye.xyz, v_position) : dot(u_depth_row, vec4(v_position, 1.0));
  return clamp(1.0 / max(away, 1e-18), u_closest, 1e18);
}

void main() {
  vec3 normal = tilted_by_map();
  vec4 base = u_base_color * v_color * texture(u_base_texture, v_uv);
  if (u_alpha_cutoff >= 0.0 && base.a < u_alpha_cutoff) discard;
  if (u_unlit) {
    o_light = vec4(base.rgb * u_weights.z, alpha_of_light(u_weights.z > 0.0 ? 2.0 : 1.0));
    return;
  }
  vec3 reflectance = reflectance_of(normal);
  vec3 irradiance = irradiance_here(normal);
  vec3 light = u_weights.x * diffuse_light(base.rgb * u_diffuse_share, reflectance, irradiance);
  light += u_weights.y * ambient_reflection(reflectance, irradiance);
  light += u_weights.z * u_emission;
  o_light = vec4(light, alpha_of_light(1.0));
}
`;var yt=`// M R on a mirror (Bastos et al. 1999, section 8.2.2).
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
`;var xt=`#include "passes/reflector_surface.glsl"
`;var kt=`// (M * K) R on a reflector (Bastos et al. 1999, section 8.2.2).
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
`;var Tt=`#include "passes/reflector_surface.glsl"
`;var Et=`// The emitters that a glossy reflector's maps leave out, in closed form, times R: added to compose.
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
`;var Mt=`// The emitters that a glossy reflector's maps leave out (player/scene/gpu_emitters.h), as a pixel's lobe shows them.

// The share of a lobe of integral 1 that a polygon fills: the pass defines it. corners: relative to the pixel's point, frame as in
// lib/lobe_light.glsl. Positive on the polygon's bright side.
float share_of_polygon(vec4 lobe, vec3 corners[4]);

uniform sampler2D u_polygons;      // a row each: 12 coordinates of corners; light, and the emitter + 1, negative: both sides shine
uniform sampler2D u_visibility;    // by cell and emitter: the shares seen from the cell's corners
uniform usampler2D u_seen;         // by cell: bit k is set where polygon k is seen from any of its corners
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
  uint seen = texelFetch(u_seen, cell, 0).r;
  vec3 sum = vec3(0.0);
  if (seen == 0u) return sum;
  int k = 0;
  do {
    for (; (seen & 1u) == 0u; ++k) seen >>= 1;
    sum += light_of_polygon(k, lobe, place, x, cell, at - vec2(cell));
    seen >>= 1;
    ++k;
  } while (seen != 0u);
  return sum;
}
`;var Ft=`#include "passes/reflector_surface.glsl"
`;var Rt=`// A reflector's region in the stencil: no colour.
void main() {}
`;var At=`layout(location = 0) in vec3 a_position;
uniform mat4 u_clip_from_pack;
invariant gl_Position;

void main() { gl_Position = u_clip_from_pack * vec4(a_position, 1.0); }
`;var St=`// R of a reflector at a pixel, and what it takes to know it.
#include "lib/reflectance.glsl"
#include "lib/shading.glsl"

uniform vec4 u_eye;
uniform vec3 u_normal;           // of the reflector, unit, pack space
uniform sampler2D u_reflectance; // tables, or the sphere map
uniform int u_reflectance_row;   // -1: reflects nothing
uniform int u_reflectance_count; // entries of the table, or width of the sphere map
uniform bool u_sphere_map;
uniform bool u_modulate;         // by R
in vec3 v_position;

float reflector_cosine() { return view_cosine(u_normal, u_normal, v_position, u_eye); }

// 1 for the stages before R.
vec3 reflector_reflectance(float cos_theta) {
  if (!u_modulate) return vec3(1.0);
  if (u_reflectance_row < 0) return vec3(0.0);
  if (u_sphere_map) return texture(u_reflectance, sphere_map_uv(cos_theta, vec2(0.70710678), float(u_reflectance_count))).rgb;
  return reflectance_from_table(u_reflectance, u_reflectance_row, u_reflectance_count, cos_theta);
}
`;var Lt=`// A vertex of a reflector.
layout(location = 0) in vec3 a_position;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = a_position;
}
`;var Pt=`// The opaque scene: diffuse light, emission, and the undirected reflection where no reflector shows an image.
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
`;var Vt=`#include "passes/surface_vertex.glsl"
`;var zt=`// How wide the blur of a reflected image is at a pixel: the share d / (d + e) of the lobe's angle, e from the eye to the plane, d from
// there to what is seen.
uniform vec4 u_ndc_from_image; // scale, offset
uniform vec2 u_tangents;       // view-space x, y over -z at ndc 1; orthographic: half sizes in metres
uniform float u_ortho;
uniform vec3 u_plane_normal;   // view space, towards the eye's side
uniform float u_plane_offset;  // dot(normal, point of the plane)
uniform float u_farthest;      // metres: distances are cut off here
uniform float u_constant_footprint;  // not negative: share of the angle (metres where orthographic) for all distances
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
  if (u_constant_footprint >= 0.0)
    return u_ortho > 0.5 ? u_constant_footprint : to_plane * u_constant_footprint / max(1.0 - u_constant_footprint, 1e-6);
  return max(1.0 / max(inverse, 1.0 / u_farthest) - to_plane, 0.0);
}

// Pixels that a tangent spans at such a distance.
float pixels_at(float behind, float to_plane) {
  return u_pixels_per_tangent * (u_ortho > 0.5 ? behind : behind / (behind + to_plane));
}
`;var Gt=`// M * K (Bastos et al. 1999, section 8.2.1). K is given as taps of equal energy around the mirror direction, by incidence. A tap
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
  return behind_plane(u_constant_footprint >= 0.0 ? 1.0 : image_at(pixel, level).a, to_plane);
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
    float weight = u_constant_footprint >= 0.0 ? 1.0 : tap.w;  // published: all directions weigh alike
    sum += weight * image_at(pixel_of(at), log2(max(tap.z * to_pixels, 1.0))).rgb;
    total += weight;
  }
  return total > 0.0 ? vec4(sum / total, centre.a) : centre;
}
`;var Ut=`// M * K at a pixel in u_coarse, for lobes so wide that more would not show; where it would, reflector/convolve asks again.
#include "passes/screen_convolve.glsl"

layout(location = 0) out vec4 o_light;

void main() { o_light = convolved(gl_FragCoord.xy * float(u_coarse)); }
`;var Bt=`#include "lib/fullscreen.glsl"

void main() { gl_Position = fullscreen_position(gl_VertexID); }
`;var Dt=`// Sums of log2 luminance over blocks of the frame, for the exposure. Black pixels and unlit ones do not count.
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
`;var It=`// Half the size: the average of those pixels that hold light (a > 0).
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
`;var Ct=`// What shaded surfaces share: their normals and reflectance.
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
`;var Wt=`// A vertex of a surface that is shaded: opaque or see-through.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_uv;
layout(location = 3) in vec2 a_lightmap_uv;
layout(location = 4) in vec4 a_color;
layout(location = 5) in vec2 a_normal_uv;
layout(location = 6) in vec4 a_tangent;
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
  v_normal_uv = a_normal_uv;
  v_tangent = a_tangent;
}
`;var Nt=`// See-through surfaces, drawn twice: once to dim what lies behind, once to add their own light.
#include "passes/lightmap.glsl"

uniform sampler2D u_base_texture;
uniform vec4 u_base_color;
uniform float u_alpha_cutoff;  // negative: no cut-outs
uniform bool u_covers;         // alpha is coverage; else the surface is whole
uniform float u_diffuse_share;
uniform float u_transmission;
uniform vec3 u_emission;
uniform bool u_unlit;
uniform float u_unlit_scale;  // cd/m2 of a white unlit surface
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
  light += u_weights.z * u_emission;
  if (u_unlit) light = u_weights.z * base.rgb * u_unlit_scale;
  o_light = vec4(coverage * light, 0.0);
}
`;var Ot=`#include "passes/surface_vertex.glsl"
`;var $t=`// Light in cd/m2 as linear display values, to be added up: frames that are a part of a pixel apart make smooth edges. Each is
// tone-mapped by itself, as samples of a pixel are in the player.
#include "lib/color.glsl"
#include "lib/tonemap.glsl"
uniform sampler2D u_frame;
uniform sampler2D u_before;  // the sum of those before
uniform float u_before_weight;
uniform float u_exposure;    // 1 / (the luminance shown as white)
uniform bool u_encode;       // the mean, sRGB-encoded
uniform float u_count;
uniform vec2 u_scale;        // pixels of the frame for one that is shown
layout(location = 0) out vec4 o_color;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy * u_scale);
  vec3 sum = u_before_weight > 0.0 ? texelFetch(u_before, at, 0).rgb : vec3(0.0);
  if (u_encode) {
    o_color = vec4(srgb_from_linear(sum / u_count), 1.0);
    return;
  }
  vec4 light = texelFetch(u_frame, at, 0);
  o_color = vec4(sum + (light.a > 1.5 ? tonemap_none(light.rgb) : tonemap_aces(light.rgb * u_exposure)), 1.0);
}
`;var _a={"lib/color.glsl":ot,"lib/fill.glsl":st,"lib/fullscreen.glsl":lt,"lib/kernel.glsl":ct,"lib/lightmap_uv.glsl":ut,"lib/lobe_light.glsl":ht,"lib/normal_map.glsl":ft,"lib/reflectance.glsl":mt,"lib/shading.glsl":dt,"lib/taken_light.glsl":pt,"lib/tonemap.glsl":vt,"passes/depth.frag":_t,"passes/depth.vert":gt,"passes/lightmap.glsl":bt,"passes/opaque.glsl":wt,"passes/reflector_compose.frag":yt,"passes/reflector_compose.vert":xt,"passes/reflector_convolve.frag":kt,"passes/reflector_convolve.vert":Tt,"passes/reflector_emitters.frag":Et,"passes/reflector_emitters.glsl":Mt,"passes/reflector_emitters.vert":Ft,"passes/reflector_mask.frag":Rt,"passes/reflector_mask.vert":At,"passes/reflector_reflectance.glsl":St,"passes/reflector_surface.glsl":Lt,"passes/scene.frag":Pt,"passes/scene.vert":Vt,"passes/screen_blur_width.glsl":zt,"passes/screen_convolve.glsl":Gt,"passes/screen_convolve.frag":Ut,"passes/screen_fullscreen.vert":Bt,"passes/screen_luminance.frag":Dt,"passes/screen_pull.frag":It,"passes/surface.glsl":Ct,"passes/surface_vertex.glsl":Wt,"passes/transparent.frag":Nt,"passes/transparent.vert":Ot,"passes/screen_average.frag":$t},ga=["#version 300 es","precision highp float;","precision highp int;","precision highp sampler2D;","precision highp sampler2DArray;","precision highp isampler2D;","precision highp usampler2D;",""].join(`
`);function Ht(t,e=""){let r=new Set,a=i=>{if(r.has(i))return"";r.add(i);let o=_a[i];if(o===void 0)throw new Error(`found no shader ${i}`);return o.replace(/^#include "([^"]+)".*$/gm,(n,s)=>a(s))};return ga+(e?`#define ${e}
`:"")+a(t)}var Xt={u_base_texture:0,u_lightmap:1,u_reflectance:2,u_direction:3,u_normal_texture:4,u_change:5,u_cells:6,u_detail:7,u_surfaces:8,u_image:9,u_frame:9,u_source:9,u_blurred:10,u_before:10,u_taps:11,u_polygons:12,u_visibility:13,u_seen:14,u_lobes:15},$=class t{constructor(e,r){this.gl=e;this.program=r}at=new Map;static make(e,r,a=""){let i=e.createProgram(),o=r.startsWith("screen_")?"screen_fullscreen":r;for(let[l,c]of[[e.VERTEX_SHADER,`${o}.vert`],[e.FRAGMENT_SHADER,`${r}.frag`]]){let u=e.createShader(l);e.shaderSource(u,Ht(`passes/${c}`,a)),e.compileShader(u),e.attachShader(i,u)}if(e.linkProgram(i),!e.getProgramParameter(i,e.LINK_STATUS)&&!e.isContextLost()){let l=e.getAttachedShaders(i).map(c=>e.getShaderInfoLog(c)).join("");throw new Error(`shader ${r} ${a}: ${l}${e.getProgramInfoLog(i)}`)}let n=new t(e,i);e.useProgram(i);let s=e.getProgramParameter(i,e.ACTIVE_UNIFORMS);for(let l=0;l<s;++l){let c=e.getActiveUniform(i,l),u=e.getUniformLocation(i,c.name);n.at.set(c.name,{place:u,type:c.type});let h=Xt[c.name];(c.type===e.SAMPLER_2D||c.type===e.UNSIGNED_INT_SAMPLER_2D)&&h!==void 0&&e.uniform1i(u,h)}return n}use(){this.gl.useProgram(this.program)}set(e,r){let a=this.at.get(e),i=this.gl;if(!a)return;let o=typeof r=="object"?Float32Array.from(r):void 0,n=Number(r);switch(a.type){case i.FLOAT:i.uniform1f(a.place,n);break;case i.INT:case i.BOOL:i.uniform1i(a.place,n);break;case i.INT_VEC2:i.uniform2i(a.place,o[0],o[1]);break;case i.FLOAT_VEC2:i.uniform2fv(a.place,o);break;case i.FLOAT_VEC3:i.uniform3fv(a.place,o);break;case i.FLOAT_VEC4:i.uniform4fv(a.place,o);break;case i.FLOAT_MAT4:i.uniformMatrix4fv(a.place,!1,o);break}}};function ba(t,e){switch(e){case t.RGB16F:return[t.RGB,t.HALF_FLOAT];case t.RGBA16F:return[t.RGBA,t.HALF_FLOAT];case t.RGBA32F:return[t.RGBA,t.FLOAT];case t.R32UI:return[t.RED_INTEGER,t.UNSIGNED_INT];case t.RGBA32UI:return[t.RGBA_INTEGER,t.UNSIGNED_INT];case t.DEPTH24_STENCIL8:return[t.DEPTH_STENCIL,t.UNSIGNED_INT_24_8];default:return[t.RGBA,t.UNSIGNED_BYTE]}}function F(t,e,r=null){let a=t.createTexture(),[i,o]=ba(t,e.format);return t.activeTexture(t.TEXTURE0),t.bindTexture(t.TEXTURE_2D,a),t.pixelStorei(t.UNPACK_ALIGNMENT,1),t.texStorage2D(t.TEXTURE_2D,e.levels??1,e.format,e.width,e.height),r&&t.texSubImage2D(t.TEXTURE_2D,0,0,0,e.width,e.height,i,o,r),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,e.min??t.NEAREST),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MAG_FILTER,e.mag??t.NEAREST),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,e.wrapS??t.CLAMP_TO_EDGE),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,e.wrapT??t.CLAMP_TO_EDGE),a}function T(t,e,r){t.activeTexture(t.TEXTURE0+Xt[e]),t.bindTexture(t.TEXTURE_2D,r)}function te(t,e,r){let a=t.createFramebuffer();return t.bindFramebuffer(t.FRAMEBUFFER,a),t.framebufferTexture2D(t.FRAMEBUFFER,t.COLOR_ATTACHMENT0,t.TEXTURE_2D,e,0),r&&t.framebufferTexture2D(t.FRAMEBUFFER,t.DEPTH_STENCIL_ATTACHMENT,t.TEXTURE_2D,r,0),a}function U(t,e){let r=(i,o)=>{o?t.enable(i):t.disable(i)};r(t.DEPTH_TEST,!!e.depthTest),t.depthFunc(t.LEQUAL),t.depthMask(!!e.depthWrite);let a=e.color??!0;t.colorMask(a,a,a,a&&(e.alpha??!0)),r(t.CULL_FACE,!!e.cull),t.cullFace(t.BACK),t.frontFace(e.mirrored?t.CW:t.CCW),r(t.BLEND,!!e.blend),e.blend==="add"&&t.blendFuncSeparate(t.ONE,t.ONE,t.ONE,t.ZERO),e.blend==="multiply"&&t.blendFuncSeparate(t.ZERO,t.SRC_COLOR,t.ZERO,t.ONE),r(t.STENCIL_TEST,e.stencilFunc!==void 0||!!e.stencilWrite),t.stencilFunc(e.stencilFunc??t.ALWAYS,e.stencilRef??0,e.stencilRead??255),t.stencilMask(e.stencilWrite??0),t.stencilOp(t.KEEP,t.KEEP,t.REPLACE)}function wa(t,e,r,a){let i=Math.max(fe(t),1e-12),o=G(P(Ee(t),e),r),n=o+i*1.01,s=o-i*1.01;return a?[s,Math.max(n,s+i*.001)]:(n=Math.max(n,i*.01),s=Math.max(s,Math.min(.02,i*.001),n*1e-5),[s,Math.max(n,s*1.001)])}function Me(t,e){let r=Math.max(e,t.near+.001*Math.max(Math.abs(t.near),1e-20)),a=r-t.near,[i,o]=t.tangents,n=new Float64Array(16),s=[t.centre[0]/i,t.centre[1]/o];return n[0]=1/i,n[5]=1/o,t.ortho?(n[12]=-s[0],n[13]=-s[1],n[10]=-2/a,n[14]=-(r+t.near)/a,n[15]=1):(n[10]=-(r+t.near)/a,n[14]=-2*r*t.near/a,n[11]=-1,n[8]=s[0],n[9]=s[1]),n}function Ce(t){let e=I(t.forward,[0,0,-1]),r=I(t.up,[0,1,0]);Y(O(e,r))<1e-5&&(r=Math.abs(e[1])<.9?[0,1,0]:[0,0,-1]);let a=I(O(e,r),[1,0,0]);return{right:a,up:O(a,e),forward:e}}function qt(t,e,r,a,i=[0,0]){let{right:o,up:n,forward:s}=Ce(t),l=t.fov===0,c=t.eye,u=new Float64Array([o[0],n[0],-s[0],0,o[1],n[1],-s[1],0,o[2],n[2],-s[2],0,-G(o,c),-G(n,c),G(s,c),1]),[h,f]=wa(a,c,s,l),m=l?t.halfHeight>0?t.halfHeight:fe(a):Math.tan(.5*Math.min(Math.max(t.fov,.001),3.1)),d=[m*e/r,m],p={viewFromPack:u,clipFromView:u,clipFromPack:u,eye:l?[-s[0],-s[1],-s[2],0]:[...c,1],tangents:d,centre:[d[0]*2*i[0]/e,d[1]*2*i[1]/r],ortho:l,mirrored:!1,near:h,far:f,width:e,height:r};return p.clipFromView=Me(p,f),p.clipFromPack=j(p.clipFromView,u),p}function Kt(t,e,r,a){let i={...t,width:r,height:a};return i.tangents=[t.tangents[0]*r/t.width,t.tangents[1]*a/t.height],i.centre=[t.centre[0]+t.tangents[0]*((2*e[0]+r)/t.width-1),t.centre[1]+t.tangents[1]*((2*e[1]+a)/t.height-1)],i.clipFromView=Me(i,i.far),i.clipFromPack=j(i.clipFromView,i.viewFromPack),i}function Yt(t,e){let r=nt(t,e),a=r[0]*(r[0]<0?-1:1)+r[1]*(r[1]<0?-1:1)+r[2]+r[3];if(!(a>0))return t;let i=t.slice();for(let o=0;o<4;++o)i[4*o+2]=e[o]*2/a-t[4*o+3];return i}function jt(t,e){let r=e.map(s=>J(t,[s[0],s[1],s[2],1])),a=[[0,0,1,1],[1,0,0,1],[-1,0,0,1],[0,1,0,1],[0,-1,0,1]];for(let s of a){let l=c=>s[0]*c[0]+s[1]*c[1]+s[2]*c[2]+s[3]*c[3];r=r.flatMap((c,u)=>{let h=r[(u+1)%r.length],f=l(c),m=l(h),d=f>=0?[c]:[];return f>=0!=m>=0&&d.push(c.map((p,v)=>p+(h[v]-p)*f/(f-m))),d})}let i=r.filter(s=>s[3]>0).map(s=>[s[0]/s[3],s[1]/s[3]].map(l=>Math.min(Math.max(l,-1),1)));if(i.length===0)return;let o=i.map(s=>s[0]),n=i.map(s=>s[1]);return{lower:[Math.min(...o),Math.min(...n)],upper:[Math.max(...o),Math.max(...n)]}}var We=127,Qt=128,ya=.01,xa=.001,ka=.5,Zt=1e-5,Ta=.02,Ne=6,Ea=16/6,Jt=t=>.25*(t.upper[0]-t.lower[0])*(t.upper[1]-t.lower[1]),Fe=class{constructor(e,r,a){this.device=e;this.renderer=r;this.none=a;let{gl:i}=e;this.mask=$.make(i,"reflector_mask"),this.compose=$.make(i,"reflector_compose"),this.convolve=$.make(i,"reflector_convolve"),this.emitters=$.make(i,"reflector_emitters"),this.pull=$.make(i,"screen_pull"),this.blur=$.make(i,"screen_convolve")}mask;compose;convolve;emitters;pull;blur;images=[];drawMasks(e,r,a){let i=[],{gl:o}=this.device,n=r.view,s=0;for(let l of e.reflectors){let c=J(l.reflectorFromPack,n.eye);if(l.count===0||c[2]<=(n.ortho?Zt:Zt*l.size))continue;let u=jt(n.clipFromPack,l.corners);if(!u||a.largeOnly&&r.share*Jt(u)<Ta)continue;let h=e.isTransparent(l.material),f=r.reflectance*e.reflectanceOf(l.material);if(!r.inFrame&&(h||f<ya||f*r.share*Jt(u)<xa)||!h&&s+1>=We)continue;let m=h?0:++s;if(this.drawMask(e,l,n,m,r.inFrame),r.inFrame&&!l.visible){h||this.drawMask(e,l,n,0,!1,!0);continue}i.push({reflector:l,screen:u,value:m})}return o.disable(o.STENCIL_TEST),i}drawMask(e,r,a,i,o,n=!1){let{gl:s}=this.device;o&&r.asked&&s.getQueryParameter(r.query,s.QUERY_RESULT_AVAILABLE)&&(r.visible=s.getQueryParameter(r.query,s.QUERY_RESULT)>0,r.asked=!1);let l=i===0&&!n;U(s,{depthTest:!0,color:!1,cull:!0,mirrored:a.mirrored,stencilRef:l?Qt:i,stencilWrite:l?Qt:We}),this.mask.use(),this.mask.set("u_clip_from_pack",a.clipFromPack),e.bindGeometry();let c=o&&!r.asked;c&&s.beginQuery(s.ANY_SAMPLES_PASSED,r.query??=s.createQuery()),e.draw(r),c&&(s.endQuery(s.ANY_SAMPLES_PASSED),r.asked=!0)}chooseImage(e,r,a){let i=a.ortho?0:.5*r*.5*a.height/a.tangents[1],o=i>=Ea*Ne?4:i>=Ne?2:1,n=i>=Ne?4:1,s=Math.max(a.width,a.height),l=Math.ceil(Math.min(Math.max(4*i,4),.15*s+4)),c=(d,p,v,b)=>n*b(((d*.5+.5)*p+v)/n),u=c(e.lower[0],a.width,-l,Math.floor),h=c(e.lower[1],a.height,-l,Math.floor),f=c(e.upper[0],a.width,l,Math.ceil),m=c(e.upper[1],a.height,l,Math.ceil);return{origin:[u,h],width:Math.max(f-u,1),height:Math.max(m-h,1),coarse:o}}image(e,r,a){let i=this.images[e];if(i&&i.width>=r&&i.height>=a)return i;let{gl:o,color:n,linear:s}=this.device,l=(p,v)=>2**Math.ceil(Math.log2(Math.max(p,v,16))),c=l(r,i?.width??0),u=l(a,i?.height??0);if(i){for(let p of[i.color,i.blurred,i.depth])o.deleteTexture(p);for(let p of[i.target,i.level])o.deleteFramebuffer(p)}let h=Math.log2(Math.max(c,u))+1,f=F(o,{width:c,height:u,levels:h,format:n,min:o.LINEAR_MIPMAP_NEAREST,mag:s}),m=F(o,{width:c,height:u,format:n,min:s,mag:s}),d=F(o,{width:c,height:u,format:o.DEPTH24_STENCIL8});return this.images[e]={width:c,height:u,color:f,blurred:m,depth:d,target:te(o,f,d),level:te(o,m)}}draw(e,r,a,i){let o=a.reflector,n=e.kernel(o.material,i.taps),s=n.count>1,l=this.chooseImage(a.screen,s?n.median:0,r.view),c=this.image(r.mirrors,l.width,l.height);this.drawMirrored(e,r,o,l,c,i),s&&this.makeLevels(l,c),s&&l.coarse>1&&this.drawBlurred(e,r.view,o,n,l,c),r.begin(),this.drawComposed(e,r,a,n,l,c),this.drawEmitters(e,r,a,n)}drawMirrored(e,r,a,i,o,n){let{gl:s,closest:l}=this.device,c=r.view,u=()=>{s.bindFramebuffer(s.FRAMEBUFFER,o.target),s.viewport(0,0,i.width,i.height)};u(),s.enable(s.SCISSOR_TEST),s.scissor(0,0,i.width,i.height),this.renderer.clear([...e.data.sky.map(p=>p*e.unit),l]),s.disable(s.SCISSOR_TEST);let h=this.mirroredView(e,a,c,i),f=e.opaque.filter(p=>ne(h.clipFromPack,p.bounds)),m=a.dark.filter(p=>ne(h.clipFromPack,p.bounds)),d={view:h,begin:u,inFrame:!1,mirrors:r.mirrors+1,texture:o.color,reflectance:r.reflectance*e.reflectanceOf(a.material),share:r.share*h.width*h.height/(c.width*c.height)};if(d.mirrors<n.orders){this.renderer.drawDepth(e,h,f);let p=this.drawMasks(e,d,n);this.renderer.drawReflected(e,h,f,m,new Set(p.map(v=>v.reflector.material)));for(let v of p)this.draw(e,d,v,n);u()}else this.renderer.drawReflected(e,h,f,m,new Set);this.renderer.drawTransparent(e,h)}mirroredView(e,r,a,i){let o=at();o[10]=-1;let n=j(a.viewFromPack,r.packFromReflector),s=j(j(n,o),r.reflectorFromPack),l=J(r.reflectorFromPack,a.eye);l[2]=-l[2];let c=0,u=e.bounds;for(let m=0;m<8;++m){let d=ie(s,[m&1?u.upper[0]:u.lower[0],m&2?u.upper[1]:u.lower[1],m&4?u.upper[2]:u.lower[2]]);c=Math.max(c,-1.01*d[2])}let h=Kt(a,i.origin,i.width,i.height);h.far=Math.max(a.far,c),h.mirrored=!a.mirrored,h.viewFromPack=s,h.eye=J(r.packFromReflector,l),h.clipFromView=Me(h,h.far);let f=r.reflectorFromPack;return h.clipFromPack=Yt(j(h.clipFromView,s),[f[2],f[6],f[10],f[14]-r.flatness-1e-5*r.size]),h}makeLevels(e,r){let{gl:a}=this.device,i=Math.ceil(Math.log2(Math.max(e.width,e.height)))+1,o=(n,s)=>Math.max(1,n+(1<<s)-1>>s);U(a,{}),this.pull.use(),this.pull.set("u_reach",1e30),a.bindFramebuffer(a.FRAMEBUFFER,r.level);for(let n=1;n<i;++n)T(a,"u_source",r.color),a.texParameteri(a.TEXTURE_2D,a.TEXTURE_BASE_LEVEL,n-1),a.texParameteri(a.TEXTURE_2D,a.TEXTURE_MAX_LEVEL,n-1),a.framebufferTexture2D(a.FRAMEBUFFER,a.COLOR_ATTACHMENT0,a.TEXTURE_2D,r.color,n),this.pull.set("u_source_size",[o(e.width,n-1),o(e.height,n-1)]),a.viewport(0,0,o(e.width,n),o(e.height,n)),this.renderer.drawScreen();a.framebufferTexture2D(a.FRAMEBUFFER,a.COLOR_ATTACHMENT0,a.TEXTURE_2D,r.blurred,0),T(a,"u_source",r.color),a.texParameteri(a.TEXTURE_2D,a.TEXTURE_BASE_LEVEL,0),a.texParameteri(a.TEXTURE_2D,a.TEXTURE_MAX_LEVEL,i-1)}setConvolution(e,r,a,i,o,n,s){let{gl:l}=this.device,c=j(a.viewFromPack,i.packFromReflector),u=I([c[8],c[9],c[10]],[0,0,1]),h=[a.centre[0]/a.tangents[0],a.centre[1]/a.tangents[1]];e.set("u_ndc_from_image",[2/a.width,2/a.height,2*n.origin[0]/a.width-1+h[0],2*n.origin[1]/a.height-1+h[1]]),e.set("u_tangents",a.tangents),e.set("u_ortho",a.ortho?1:0),e.set("u_plane_normal",u),e.set("u_plane_offset",G(u,[c[12],c[13],c[14]])),e.set("u_farthest",1e4*Math.max(fe(r.bounds),1e-12)),e.set("u_constant_footprint",-1),e.set("u_median",o.median),e.set("u_coarse",n.coarse),e.set("u_pixels_per_tangent",.5*a.height/a.tangents[1]),T(l,"u_image",s.color),T(l,"u_taps",o.taps),e.set("u_image_size",[n.width,n.height]),e.set("u_texture_size",[s.width,s.height]),e.set("u_tap_count",o.count),e.set("u_tap_rows",o.rows)}drawBlurred(e,r,a,i,o,n){let{gl:s}=this.device;s.bindFramebuffer(s.FRAMEBUFFER,n.level),s.viewport(0,0,Math.floor(o.width/o.coarse),Math.floor(o.height/o.coarse)),U(s,{}),this.blur.use(),this.setConvolution(this.blur,e,r,a,i,o,n),s.bindVertexArray(this.none),this.renderer.drawScreen()}where(e,r,a){let i={depthTest:!0,cull:!0,mirrored:e.view.mirrored};return e.inFrame&&r.value>0?{...i,stencilFunc:this.device.gl.EQUAL,stencilRef:r.value,stencilRead:We}:{...i,blend:"add",alpha:a}}setReflector(e,r,a,i){let o=i.packFromReflector;r.bindGeometry(),e.set("u_clip_from_pack",a.view.clipFromPack),e.set("u_eye",a.view.eye),e.set("u_normal",[o[8],o[9],o[10]]),r.setReflectance(e,i.material),e.set("u_sphere_map",!1),e.set("u_modulate",!0)}drawComposed(e,r,a,i,o,n){let{gl:s}=this.device,l=a.reflector,c=!r.inFrame&&e.reflectanceOf(l.material)>ka,u=i.count>1?this.convolve:this.compose;U(s,this.where(r,a,c)),u.use(),u.set("u_origin",o.origin),u.set("u_missing",[0,0,0]),u.set("u_with_distance",c),this.setReflector(u,e,r,l),T(s,"u_blurred",n.blurred),this.setConvolution(u,e,r.view,l,i,o,n),e.draw(l)}drawEmitters(e,r,a,i){let{gl:o}=this.device,n=a.reflector,s=n.emitters;if(!s||!i.lobes)return;let l=e.data.reflectors[n.index],c=this.emitters;c.use(),T(o,"u_polygons",s.polygons),T(o,"u_visibility",s.visibility),T(o,"u_seen",s.seen),T(o,"u_lobes",i.lobes),c.set("u_cells",[s.cellsX,s.cellsY]),c.set("u_lower",l.lower.map(h=>h/n.size)),c.set("u_upper",l.upper.map(h=>h/n.size));let u=n.reflectorFromPack.slice();for(let h=0;h<4;++h)for(let f=0;f<3;++f)u[4*h+f]/=n.size;c.set("u_emitters_from_pack",u),c.set("u_lobe_rows",33),this.setReflector(c,e,r,n),U(o,{...this.where(r,a,!1),blend:"add",alpha:!1}),e.draw(n)}};function Ma(t,e,r){let a=t.corners.map(n=>K(ie(e,n),1/r)),i=a.flatMap((n,s)=>{let l=a[(s+1)%a.length],c=n[2]>=0?[n]:[];return n[2]>=0!=l[2]>=0&&c.push(N(n,K(P(l,n),n[2]/(n[2]-l[2])))),c}),o=[];return i.length>=3&&o.push([i[0],i[1],i[2],i[Math.min(i.length-1,3)]]),i.length===5&&o.push([i[0],i[3],i[4],i[4]]),o}function er(t,e,r,a,i,o){if(e.emitters.length===0||!(i>0))return;let n=e.nodesX-1,s=e.nodesY-1,l=n*s,c=[],u=new Uint8Array(4*l*e.emitters.length),h=new Uint32Array(l);if(e.emitters.forEach((f,m)=>{let d=r[f],p=e.visibility.subarray(m*e.nodesX*e.nodesY),v=Ma(d,a,i).map(b=>{let w=d.twoSided?-(m+1):m+1;return c.push(...b[0],...b[1],...b[2],...b[3],...d.radiance.map(g=>g*o),w),1<<c.length/16-1});for(let b=0;b<s;++b)for(let w=0;w<n;++w){let g=b*e.nodesX+w,M=b*n+w,x=[p[g],p[g+1],p[g+e.nodesX],p[g+e.nodesX+1]];if(u.set(x,4*(m*l+M)),x.some(_=>_>0))for(let _ of v)h[M]|=_}}),c.length!==0)return{cellsX:n,cellsY:s,polygons:F(t,{width:4,height:c.length/16,format:t.RGBA32F},new Float32Array(c)),visibility:F(t,{width:n,height:s*e.emitters.length,format:t.RGBA8},u),seen:F(t,{width:n,height:s,format:t.R32UI},h)}}function tr(t,e,r){let a=t.corners,i=a.length,o=[0,0,0],n=0;a.forEach((f,m)=>{o=N(o,O(P(f,a[0]),P(a[(m+1)%i],a[0]))),n=Math.max(n,Y(P(a[(m+1)%i],f)))});let s=I(o,[0,0,0]),l=Y(s)>0?.001*n:-1,c=a.map((f,m)=>I(O(s,P(a[(m+1)%i],f)),[0,0,0])),u=f=>{let m=[e.positions[3*f],e.positions[3*f+1],e.positions[3*f+2]];return Math.abs(G(P(m,a[0]),s))<=l&&a.every((d,p)=>G(P(m,d),c[p])>=-l)},h=[];for(let f of e.parts){if(r[f.material].emission.every(d=>d===0))continue;let m=[];for(let d=f.first;d<f.first+f.count;d+=3){let p=[...e.indices.subarray(d,d+3)];p.every(u)&&m.push(...p)}m.length>0&&h.push({part:f,indices:m})}return h}function rr(t,e){let r=0;for(let i=0;i<t.length;++i)r+=t[i];let a=e*r;for(let i=0;i<t.length;++i){if(a<t[i])return i+a/t[i];a-=t[i]}return t.length}function Fa(t){let e=0;for(let r=.5;t!==0;t>>>=1,r*=.5)e+=(t&1)*r;return e}function ar(t,e,r,a){let i=new Float64Array(e);for(let c=0;c<e;++c)for(let u=0;u<e;++u)i[c]+=t[c*e+u];let o=[],n=a(1,1),s=a(0,0),l=(n[0]-s[0])*(n[1]-s[1]);for(let c=0;c<r;++c){let u=rr(i,(c+.5)/r),h=Math.min(Math.floor(u),e-1),f=rr(t.subarray(h*e,h*e+e),Fa(c)+.5/r),m=Math.min(Math.floor(f),e-1),d=a(m/e,h/e),p=a((m+1)/e,(h+1)/e),v=a(f/e,u/e),b=Math.max(t[h*e+m],1e-12)*r;o.push({x:v[0],y:v[1],width:Math.sqrt(Math.min((p[0]-d[0])*(p[1]-d[1])/b,l)),weight:1})}return o}var Ra=t=>(e,r)=>[t.width[0]*Math.sinh(t.lower[0]+e*(t.upper[0]-t.lower[0])),t.shift+t.width[1]*Math.sinh(t.lower[1]+r*(t.upper[1]-t.lower[1]))];function Aa(t,e){return(r,a)=>{let i=(2*r-1)*t.halfExtent*e,o=(2*a-1)*t.halfExtent,n=2/(1+Math.sqrt(1+i*i+o*o));return[i*n,o*n]}}function ir(t,e){if(t.length===1)return[0,0,0];let r=n=>Math.sqrt(t[n].cosTheta),a=Math.sqrt(e),i=1;for(;i+1<t.length&&r(i)<a;)++i;let o=r(i-1);return[i-1,i,Math.min(Math.max((a-o)/(r(i)-o),0),1)]}function nr(t,e){let r=t?.factor;if(!r||r.length===0)return 1;let a=r.length/3-1,i=Math.sqrt(Math.min(Math.max(e,0),1))*a,o=Math.min(Math.floor(i),a),n=s=>.2126*r[3*s]+.7152*r[3*s+1]+.0722*r[3*s+2];return n(o)+(n(Math.min(o+1,a))-n(o))*(i-o)}function Sa(t,e,r){let a=e*e,i=Math.sqrt(Math.max(0,1-a*a)),o=0,n=0;for(let l of t){let c=.25*(l.x*l.x+l.y*l.y),u=[l.x/(1+c),l.y/(1+c),(1-c)/(1+c)],h=[0,2*a*i,2*a*a-1];l.weight=nr(r,Math.sqrt(Math.max(0,.5*(1+h[1]*u[1]+h[2]*u[2])))),i*u[1]+a*u[2]>0&&(o+=l.weight,++n)}let s=n>0?o/n:1;for(let l of t)l.weight=s>0?l.weight/s:1;return s}function or(t,e,r){if(!t||t.size<=1||!(t.halfExtent>0))return{count:1,rows:1,median:0,texels:new Float32Array([0,0,0,1]),means:[1]};let a=t.slices.map(l=>ar(l.weights,t.sliceSize,e,Ra(l))),i=a.length===0?9:Math.max(a.length,2),o=new Float32Array(4*e*i),n=[],s=0;for(let l=0;l<i;++l){let c=l/(i-1),u;if(a.length===0)u=ar(t.weights,t.size,e,Aa(t,Math.max(c*c,.001)));else{let[h,f,m]=ir(t.slices,c*c);u=a[h].map((d,p)=>{let v=a[f][p],b=(w,g)=>w+(g-w)*m;return{x:b(d.x,v.x),y:b(d.y,v.y),width:b(d.width,v.width),weight:1}})}n.push(Sa(u,c,r)),u.forEach((h,f)=>o.set([h.x,h.y,h.width,h.weight],4*(l*e+f))),l===i-1&&(s=u.map(h=>Math.hypot(h.x,h.y)).sort((h,f)=>h-f)[e>>1])}return{count:e,rows:i,median:s,texels:o,means:n}}var oe=33;function sr(t,e,r){let a=new Float32Array(8*oe),i=o=>{let[n,s,l,c]=t.fits[o],u=t.slices[o].cosTheta,h=Math.sqrt(Math.max(0,1-u*u));return[n*u+s*h,s*u-n*h,l,c*u+h].map(f=>f/(u-c*h))};for(let o=0;o<oe;++o){let n=o/(oe-1),[s,l,c]=ir(t.slices,n*n),u=i(s),h=i(l),f=u.map((v,b)=>v+(h[b]-v)*c);f[2]=u[2]*h[2]/(h[2]+(u[2]-h[2])*c),a.set(f,4*o);let m=n*(r.length-1),d=Math.min(Math.floor(m),Math.max(r.length-2,0)),p=Math.min(d+1,r.length-1);a.set([nr(e,n*n),r[d]+(r[p]-r[d])*(m-d)],4*(oe+o))}return a}function lr(t){let e=t.getExtension("EXT_color_buffer_float")&&t.getExtension("EXT_float_blend")&&t.getExtension("OES_texture_float_linear");if(!e&&!t.getExtension("EXT_color_buffer_float")&&!t.getExtension("EXT_color_buffer_half_float"))throw new Error("This device cannot draw light of more than eight bits.");return{gl:t,color:e?t.RGBA32F:t.RGBA16F,linear:t.LINEAR,closest:e?1e-15:1e-7}}var Re=class{constructor(e,r){this.device=e;this.data=r;let a=e.gl,i=r.mesh,o=Math.max(1,...r.materials.flatMap(c=>c.emission),...r.sky);this.unit=e.color===a.RGBA32F?1:Math.min(1,8192/o);let n=this.sortRanges();r.reflectors.forEach((c,u)=>this.addReflector(u,n)),this.array=a.createVertexArray(),a.bindVertexArray(this.array);let s=(c,u,h,f=a.FLOAT)=>{u&&(a.bindBuffer(a.ARRAY_BUFFER,a.createBuffer()),a.bufferData(a.ARRAY_BUFFER,u,a.STATIC_DRAW),a.enableVertexAttribArray(c),a.vertexAttribPointer(c,h,f,f===a.UNSIGNED_BYTE,0,0),this.bytes+=u.byteLength)};s(0,i.positions,3),s(1,i.normals,3),s(2,i.uvs,2),s(3,i.lightmapUvs,2),s(4,i.colors,4,a.UNSIGNED_BYTE),s(5,i.normalUvs,2),s(6,i.tangents,4),a.vertexAttrib4f(4,1,1,1,1),a.bindBuffer(a.ELEMENT_ARRAY_BUFFER,a.createBuffer()),a.bufferData(a.ELEMENT_ARRAY_BUFFER,new Uint32Array(n),a.STATIC_DRAW),a.bindVertexArray(null),this.bytes+=4*n.length;let l=(c,u)=>F(a,{width:1,height:1,format:c},u);this.white=l(a.SRGB8_ALPHA8,new Uint8Array([255,255,255,255])),this.flat=l(a.RGBA8,new Uint8Array([128,128,255,255])),this.zero=l(a.R32UI,new Uint32Array([0])),this.reflectance=this.uploadReflectance(),r.pages.forEach((c,u)=>this.setPage(u,c)),T(a,"u_surfaces",this.zero),T(a,"u_cells",this.zero),T(a,"u_seen",this.zero)}bounds=Ie();opaque=[];transparent=[];reflectors=[];unit;bytes=0;array;textures=[];normals=[];pages=[];white;flat;zero;reflectance;kernels=new Map;isTransparent(e){let r=this.data.materials[e];return r.alphaMode===2||r.transmission>0}rangeOf(e,r,a,i){let o={first:e.length,count:r.length,material:a,page:i,bounds:Ie()},n=this.data.mesh.positions;for(let s=0;s<r.length;++s){let l=r[s];e.push(l),Te(o.bounds,n[3*l],n[3*l+1],n[3*l+2])}return o}sortRanges(){let e=this.data.mesh,r=[],a=e.parts.filter(i=>i.count>0).sort((i,o)=>i.material-o.material||i.page-o.page);for(let i of a){let o=this.rangeOf(r,e.indices.subarray(i.first,i.first+i.count),i.material,i.page);(this.isTransparent(i.material)?this.transparent:this.opaque).push(o),Te(this.bounds,...o.bounds.lower),Te(this.bounds,...o.bounds.upper)}return r}addReflector(e,r){let{gl:a}=this.device,i=this.data.reflectors[e],o=i.packFromReflector,n=it(o),s=Math.hypot(i.upper[0]-i.lower[0],i.upper[1]-i.lower[1]),l=[i.lower[0],i.upper[0],i.upper[0],i.lower[0]],c=[i.lower[1],i.lower[1],i.upper[1],i.upper[1]],u=this.rangeOf(r,i.indices,i.material,-1),h=[];for(let f of i.emitters)for(let m of tr(this.data.emitters[f],this.data.mesh,this.data.materials))this.isTransparent(m.part.material)||h.push(this.rangeOf(r,m.indices,m.part.material,m.part.page));this.reflectors.push({index:e,material:i.material,first:u.first,count:u.count,packFromReflector:o,reflectorFromPack:n,corners:l.map((f,m)=>ie(o,[f,c[m],0])),size:s,flatness:i.flatness,dark:h,emitters:er(a,i,this.data.emitters,n,s,this.unit),asked:!1,visible:!0})}uploadReflectance(){let e=this.data.fresnels,r=Math.max(1,...e.map(o=>o.table.length/3)),a=Math.max(e.length,1),i=new Float32Array(4*r*a);return e.forEach((o,n)=>{for(let s=0;s<o.table.length/3;++s)i.set(o.table.subarray(3*s,3*s+3),4*(n*r+s))}),F(this.device.gl,{width:r,height:a,format:this.device.gl.RGBA32F},i)}setPage(e,r){let{gl:a}=this.device,i=this.pages[e];for(let s of[i?.light,i?.direction,i?.cells,i?.detail])s&&a.deleteTexture(s);let o=(s,l,c)=>(this.bytes+=s.byteLength,F(a,{width:l,height:c,format:a.RGB16F,min:a.LINEAR,mag:a.LINEAR},s)),n={light:o(r.light,r.width,r.height),scale:r.scale};r.direction&&(n.direction=o(r.direction,r.width,r.height)),r.detail&&r.cells&&(n.cells=F(a,{width:r.width,height:r.height,format:a.R32UI},r.cells),n.detail=o(r.detail,r.detailWidth,r.detailHeight),this.bytes+=r.cells.byteLength),this.pages[e]=n,this.data.pages[e]=r}setTexture(e,r,a){let{gl:i}=this.device,o=[i.REPEAT,i.CLAMP_TO_EDGE,i.MIRRORED_REPEAT],n=Math.floor(Math.log2(Math.max(r.width,r.height)))+1,s=F(i,{width:r.width,height:r.height,levels:n,format:a?i.RGBA8:i.SRGB8_ALPHA8,min:i.LINEAR_MIPMAP_LINEAR,mag:r.nearest?i.NEAREST:i.LINEAR,wrapS:o[r.wrapS],wrapT:o[r.wrapT]},r.texels);i.generateMipmap(i.TEXTURE_2D);let l=i.getExtension("EXT_texture_filter_anisotropic");l&&!r.nearest&&i.texParameterf(i.TEXTURE_2D,l.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(8,i.getParameter(l.MAX_TEXTURE_MAX_ANISOTROPY_EXT))),(a?this.normals:this.textures)[e]=s,this.bytes+=r.texels.byteLength*4/3}kernel(e,r){let a=this.data.materials[e],i=`${a.kernel} ${a.fresnel} ${r}`,o=this.kernels.get(i);if(o)return o;let{gl:n}=this.device,s=this.data.kernels[a.kernel],l=this.data.fresnels[a.fresnel],c=or(s,r,l),u={taps:F(n,{width:c.count,height:c.rows,format:n.RGBA32F},c.texels),count:c.count,rows:c.rows,median:c.median};return s&&s.fits.length>0&&(u.lobes=F(n,{width:oe,height:2,format:n.RGBA32F},sr(s,l,c.means))),this.kernels.set(i,u),u}reflectanceOf(e){let r=this.data.fresnels[this.data.materials[e].fresnel]?.table;if(!r)return 0;let a=3*(r.length/6|0);return Math.max(r[a],r[a+1],r[a+2])}bindGeometry(){this.device.gl.bindVertexArray(this.array),T(this.device.gl,"u_reflectance",this.reflectance)}draw(e){let{gl:r}=this.device;r.drawElements(r.TRIANGLES,e.count,r.UNSIGNED_INT,4*e.first)}bindBase(e){T(this.device.gl,"u_base_texture",this.textures[e]??this.white)}setReflectance(e,r){let a=this.data.materials[r].fresnel;e.set("u_reflectance_row",a),e.set("u_reflectance_count",a<0?1:this.data.fresnels[a].table.length/3)}setSurface(e,r){let{gl:a}=this.device,i=this.data.materials[r.material],o=this.pages[r.page];e.set("u_base_color",[...i.baseColor.map(s=>Math.min(Math.max(s,0),1)),i.alpha]),e.set("u_alpha_cutoff",se(i)),e.set("u_covers",i.alphaMode===2),e.set("u_diffuse_share",(1-i.metallic)*(1-i.transmission)),e.set("u_transmission",i.transmission),e.set("u_emission",i.emission.map(s=>s*this.unit)),e.set("u_unlit",i.unlit),this.setReflectance(e,r.material),this.bindBase(i.texture);let n=i.normalTexture>=0&&this.data.mesh.normalUvs?this.normals[i.normalTexture]:void 0;e.set("u_normal_mapped",!!n),e.set("u_normal_scale",i.normalScale),T(a,"u_normal_texture",n??this.flat),T(a,"u_lightmap",o?.light??this.white),e.set("u_lightmap_scale",o?o.scale*this.unit:0),e.set("u_directional",!!o?.direction),T(a,"u_direction",o?.direction??o?.light??this.white),e.set("u_detailed",!!o?.detail),T(a,"u_cells",o?.cells??this.zero),T(a,"u_detail",o?.detail??this.white)}luxAt(e,r,a){let i=this.data.pages[e];if(!i)return 0;let o=Math.min(Math.floor(r*i.width),i.width-1),n=Math.min(Math.floor(a*i.height),i.height-1),s=3*(n*i.width+o);return i.scale*(.2126*ae(i.light[s])+.7152*ae(i.light[s+1])+.0722*ae(i.light[s+2]))}},se=t=>t.alphaMode===1?Math.max(t.cutoff,0):-1;var cr=127,La=128,ur={orders:2,taps:48,largeOnly:!1},hr={orders:1,taps:12,largeOnly:!0},Pa=[[-.125,-.375],[.375,-.125],[-.375,.125],[.125,.375]],Oe=16,Ae=class{constructor(e){this.device=e;let r=e.gl,a=(i,o="")=>$.make(r,i,o);this.depth=a("depth"),this.plainDepth=a("depth","PLAIN"),this.opaque=a("scene"),this.plain=a("scene","PLAIN"),this.reflected=a("scene","REFLECTED"),this.transparent=a("transparent"),this.luminance=a("screen_luminance"),this.average=a("screen_average"),this.none=r.createVertexArray(),this.reflections=new Fe(e,this,this.none)}frame;sums;blocks;depth;plainDepth;opaque;plain;reflected;transparent;luminance;average;reflections;none;drawScreen(){let{gl:e}=this.device;e.bindVertexArray(this.none),e.drawArrays(e.TRIANGLES,0,3)}ensure(e,r){if(this.frame?.width===e&&this.frame.height===r)return this.frame;let{gl:a,color:i}=this.device;for(let l of[this.frame?.light,this.frame?.depth,...(this.sums??[]).map(c=>c.texture)])l&&a.deleteTexture(l);for(let l of[this.frame?.target,...(this.sums??[]).map(c=>c.target)])l&&a.deleteFramebuffer(l);let o=F(a,{width:e,height:r,format:i}),n=F(a,{width:e,height:r,format:a.DEPTH24_STENCIL8}),s=()=>{let l=F(a,{width:e,height:r,format:a.RGBA16F});return{texture:l,target:te(a,l)}};return this.sums=[s(),s()],this.frame={width:e,height:r,light:o,depth:n,target:te(a,o,n)},this.frame}draw(e,r,a,i,o,n){let{gl:s}=this.device,l=this.ensure(a,i),c=qt(r,a,i,e.bounds,o===void 0?[0,0]:Pa[o%4]),u=()=>{s.bindFramebuffer(s.FRAMEBUFFER,l.target),s.viewport(0,0,a,i)};u(),this.clear([...e.data.sky.map(d=>d*e.unit),1]);let h=e.opaque.filter(d=>ne(c.clipFromPack,d.bounds));this.drawDepth(e,c,h);let f={view:c,begin:u,inFrame:!0,mirrors:0,reflectance:1,share:1,texture:l.light},m=this.reflections.drawMasks(e,f,n);for(let d of m)d.value>0&&this.reflections.draw(e,f,d,n);u(),this.drawOpaque(e,c,h,new Set(m.filter(d=>d.value>0).map(d=>d.reflector.material))),this.drawTransparent(e,c);for(let d of m)d.value===0&&this.reflections.draw(e,f,d,n)}clear(e){let{gl:r}=this.device;U(r,{depthWrite:!0,stencilWrite:255}),r.clearColor(e[0],e[1],e[2],e[3]),r.clear(r.COLOR_BUFFER_BIT|r.DEPTH_BUFFER_BIT|r.STENCIL_BUFFER_BIT)}drawDepth(e,r,a){e.bindGeometry();for(let i of a){let o=e.data.materials[i.material],n=se(o)<0?this.plainDepth:this.depth;U(this.device.gl,{depthTest:!0,depthWrite:!0,color:!1,cull:!o.doubleSided,mirrored:r.mirrored}),n.use(),n.set("u_clip_from_pack",r.clipFromPack),n.set("u_alpha",o.alpha),n.set("u_alpha_cutoff",se(o)),e.bindBase(o.texture),e.draw(i)}}setFrame(e,r,a,i){e.use(),e.set("u_clip_from_pack",a.clipFromPack),e.set("u_eye",a.eye),e.set("u_change_scale",[0,0]),e.set("u_alpha_kind",i?a.ortho?2:1:0);let o=a.viewFromPack;e.set("u_depth_row",[-o[2],-o[6],-o[10],-o[14]]),e.set("u_closest",this.device.closest),e.set("u_unlit_scale",1),r.bindGeometry()}drawRanges(e,r,a,i,o,n,s){let{gl:l}=this.device;for(let c of[i,this.opaque])this.setFrame(c,e,r,s);for(let c of a){let u=e.data.materials[c.material],h=o.has(c.material),f=u.normalTexture<0&&se(u)<0&&!u.unlit?i:this.opaque;f.use(),e.setSurface(f,c),f.set("u_weights",[1,1,1]),U(l,{...n,cull:!u.doubleSided,stencilRead:cr,stencilFunc:h?l.EQUAL:void 0}),e.draw(c),h&&(f.set("u_weights",[1,0,1]),U(l,{...n,cull:!u.doubleSided,stencilRead:cr,stencilFunc:l.NOTEQUAL,blend:s?void 0:"add"}),e.draw(c))}}drawOpaque(e,r,a,i){this.drawRanges(e,r,a,this.plain,i,{depthTest:!0},!1)}drawReflected(e,r,a,i,o){let n={depthTest:!0,depthWrite:!0,mirrored:r.mirrored};this.drawRanges(e,r,a,this.reflected,o,n,!0);for(let s of i){let l=e.data.materials[s.material],c=l.normalTexture<0&&se(l)<0&&!l.unlit?this.reflected:this.opaque;c.use(),e.setSurface(c,s),c.set("u_weights",[1,1,0]),U(this.device.gl,{...n,cull:!l.doubleSided}),e.draw(s)}}drawTransparent(e,r){let{gl:a}=this.device,i=r.viewFromPack,o=s=>{let l=Ee(s.bounds);return i[2]*l[0]+i[6]*l[1]+i[10]*l[2]},n=e.transparent.filter(s=>ne(r.clipFromPack,s.bounds)).sort((s,l)=>o(s)-o(l));if(n.length!==0){this.setFrame(this.transparent,e,r,!1),this.transparent.set("u_unlit_scale",this.white*e.unit);for(let s of n){e.setSurface(this.transparent,s);let l={depthTest:!0,alpha:!1,mirrored:r.mirrored,stencilRead:La,cull:!e.data.materials[s.material].doubleSided},c=(u,h,f)=>{U(a,{...l,...u}),this.transparent.set("u_dimming",h),this.transparent.set("u_weights",[1,f,1]),e.draw(s)};c({blend:"multiply"},!0,0),c({blend:"add",stencilFunc:r.mirrored?void 0:a.EQUAL},!1,1),r.mirrored||c({blend:"add",stencilFunc:a.NOTEQUAL},!1,0)}}}white=1.2;show(e,r,a,i){let o=this.frame.width!==a||this.frame.height!==i,{gl:n}=this.device,s=this.frame,[l,c]=this.sums;U(n,{}),this.average.use(),this.average.set("u_exposure",1/(this.white*e.unit)),this.average.set("u_count",r+1),T(n,"u_frame",s.light),T(n,"u_before",l.texture),this.average.set("u_before_weight",r),this.average.set("u_encode",!1),this.average.set("u_scale",[1,1]),n.bindFramebuffer(n.FRAMEBUFFER,c.target),n.viewport(0,0,s.width,s.height),this.drawScreen(),this.sums=[c,l],T(n,"u_before",c.texture),this.average.set("u_scale",o?[s.width/a,s.height/i]:[1,1]),this.average.set("u_before_weight",1),this.average.set("u_encode",!0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.viewport(0,0,a,i),this.drawScreen()}meter(e){let{gl:r}=this.device,a=this.frame,i=Math.ceil(a.width/Oe),o=Math.ceil(a.height/Oe);if(this.blocks?.width!==i||this.blocks.height!==o){let l=F(r,{width:i,height:o,format:this.device.color});this.blocks={width:i,height:o,texture:l,target:te(r,l)}}r.bindFramebuffer(r.FRAMEBUFFER,this.blocks.target),r.viewport(0,0,i,o),U(r,{}),this.luminance.use(),T(r,"u_frame",a.light),this.luminance.set("u_frame_size",[a.width,a.height]),this.luminance.set("u_block",Oe),this.drawScreen();let n=new Float32Array(4*i*o);r.readPixels(0,0,i,o,r.RGBA,r.FLOAT,n);let s=Va(n,i,o);return s===void 0?void 0:s-Math.log2(e.unit)}};function Va(t,e,r){let a=[],i=0;for(let c=0;c<e*r;++c){let u=t[4*c],h=t[4*c+1];if(!(h>0)||!Number.isFinite(u))continue;let f=(2*(c%e)+1)/e-1,m=(2*Math.floor(c/e)+1)/r-1,d=h*(.1+Math.exp(-.5*(f*f+m*m)/.25));a.push({log:u/h,weight:d}),i+=d}if(a.length===0)return;a.sort((c,u)=>c.log-u.log);let o=0,n=a[a.length-1].log;for(let c of a)if(o+=c.weight,o>=.9*i){n=c.log;break}let s=0,l=0;for(let c of a)c.log>=n-7&&(s+=c.log*c.weight,l+=c.weight);return s/l}var Se=class{constructor(e){this.grids=e;this.eyeHeight=e[0]?.eyeHeight??1.6,this.step=.4*this.eyeHeight/1.6,this.beside=this.eyeHeight/1.6}eyeHeight;step;beside;eyeOf(e,r){let a=this.grids[e];return[a.lower[0]+(r%a.width+.5)*a.cell,a.floor[r]+a.eyeHeight,a.lower[1]+(Math.floor(r/a.width)+.5)*a.cell]}stand(e,r,a,i=this.step){let o;return this.grids.forEach((n,s)=>{let l=Math.floor((e-n.lower[0])/n.cell),c=Math.floor((r-n.lower[1])/n.cell),u=c*n.width+l;if(!(l>=0&&c>=0&&l<n.width&&c<n.height)||!n.walkable[u])return;let h=this.eyeOf(s,u);h[1]<=a+i&&(!o||h[1]>o.eye[1])&&(o={grid:s,cell:u,eye:h})}),o}nearest(e,r,a=(i,o)=>e[1]>i&&e[1]<=o+2*this.step){let i,o=r;return this.grids.forEach((n,s)=>{for(let l=0;l<n.floor.length;++l){if(!n.walkable[l]||!a(n.floor[l],n.floor[l]+n.eyeHeight))continue;let c=this.eyeOf(s,l),u=Math.hypot(c[0]-e[0],c[2]-e[2]);u<o&&(o=u,i={grid:s,cell:l,eye:c})}}),i}distance(e){let r=this.nearest(e,this.beside);return r?Math.hypot(r.eye[0]-e[0],r.eye[2]-e[2]):1/0}walk(e,r,a,i){let o=this.stand(e[0],e[2],e[1])?.eye[1]??this.stand(e[0],e[2],e[1]+this.eyeHeight)?.eye[1];if(o===void 0){let g=this.distance(e);if(i.fall=0,g===1/0||this.stand(r[0],r[2],e[1])||this.distance(r)<g)return r;for(let M of[[r[0],e[1],e[2]],[e[0],e[1],r[2]]])if((M[0]!==e[0]||M[2]!==e[2])&&this.distance(M)<=g)return M;return e}let n=1/0,s=this.step;for(let g of this.grids)n=Math.min(n,g.cell),s=Math.max(s,g.cell);let l=[r[0]-e[0],r[2]-e[2]],c=Math.hypot(...l)/(.5*n),u=Math.min(Math.max(Math.ceil(c),1),64),h=Math.max(u,c),f=e[0],m=e[2],d=o,p=(g,M)=>{let x=this.stand(f+g,m+M,d,s);return!x||d-x.eye[1]>s?!1:(f+=g,m+=M,d=x.eye[1],!0)},v=l[0]/h,b=l[1]/h;for(let g=0;g<u&&!(!p(v,b)&&!p(v,0)&&!p(0,b));++g);let w=e[1];return w-d>2*this.step?(i.fall+=9.81*this.beside*a,w=Math.max(w-i.fall*a,d)):(i.fall=0,w+=(d-w)*(1-Math.exp(-a/.08)),Math.abs(d-w)<.001*this.step&&(w=d)),[f,w,m]}way(e,r){let a=this.stand(e[0],e[2],e[1])??this.nearest(e,this.beside);if(!a)return[];let i=u=>u.grid*2**30+u.cell,o=new Map([[i(a),void 0]]),n=[a],s=a,l=1/0;for(let u=0;u<n.length;++u){let h=n[u],f=this.grids[h.grid],m=Math.hypot(h.eye[0]-r[0],h.eye[1]-this.grids[h.grid].eyeHeight-r[1],h.eye[2]-r[2]);m<l&&(l=m,s=h);for(let[d,p]of[[1,0],[-1,0],[0,1],[0,-1],[1,1],[1,-1],[-1,1],[-1,-1]]){let v=this.stand(h.eye[0]+d*f.cell,h.eye[2]+p*f.cell,h.eye[1],Math.max(this.step,f.cell));!v||h.eye[1]-v.eye[1]>Math.max(this.step,f.cell)||o.has(i(v))||d&&p&&(!this.stand(h.eye[0]+d*f.cell,h.eye[2],h.eye[1])||!this.stand(h.eye[0],h.eye[2]+p*f.cell,h.eye[1]))||(o.set(i(v),h),n.push(v))}}let c=[];for(let u=s;u&&i(u)!==i(a);u=o.get(i(u)))c.push(u.eye);return c}};var za=2,Ga=3,fr=1.55,$e=t=>Math.atan2(-t[0],-t[2]),mr=t=>Math.asin(Math.min(Math.max(t[1]/Math.max(Y(t),1e-12),-1),1)),dr=(t,e)=>[-Math.sin(t)*Math.cos(e),Math.sin(e),-Math.cos(t)*Math.cos(e)],Le=class{camera;cameras;path;floors;origin;state={fall:0};way=[];tour;place=0;constructor(e){this.floors=new Se(e.grids),this.origin=e.mesh.origin,this.path=e.paths.find(r=>r.keys.length>1),this.cameras=e.cameras.length>0?e.cameras:[this.somewhere(e)],this.camera={...this.fromHash()??this.cameras[0]}}somewhere(e){let r=e.grids.findIndex(i=>i.walkable.some(o=>o>0));return{name:"start",eye:r<0?[0,1.6,0]:this.floors.eyeOf(r,e.grids[r].walkable.indexOf(1)),forward:[0,0,-1],up:[0,1,0],fov:1.05,halfHeight:0}}fromHash(){let e=new URLSearchParams(location.hash.slice(1)).get("camera");if(!e)return;let r=this.cameras.find(n=>n.name===e);if(r)return r;let a=e.split(",").map(Number);if(a.length<5||a.length>6||!a.every(Number.isFinite))return;let i=a[5]===void 0?60:Math.min(Math.max(a[5],10),120),o=Math.PI/180;return{name:"",eye:P(a.slice(0,3),this.origin),forward:dr(a[3]*o,a[4]*o),up:[0,1,0],fov:i*o,halfHeight:0}}toHash(){let e=this.camera,r=N(e.eye,this.origin),a=180/Math.PI;return`#camera=${[...r.map(o=>o.toFixed(3)),...[$e(e.forward),mr(e.forward),e.fov].map(o=>(o*a).toFixed(2))].join(",")}`}jump(e){this.camera={...e},this.way=[],this.tour=void 0,this.state.fall=0}goTo(e,r){return this.tour=void 0,this.way=this.floors.way(this.camera.eye,e),r&&this.way[0]&&this.jump({...this.camera,eye:this.way[0]}),this.way.length>0||r}get touring(){return this.tour!==void 0}toggleTour(){this.tour=this.touring||!this.path?void 0:this.path.keys[0].time,this.way=[]}step(e,r){let a={...this.camera},i=e.right!==0||e.ahead!==0,o=e.yaw!==0||e.pitch!==0;if(i&&(this.way=[]),(i||o)&&(this.tour=void 0),this.touring&&this.alongPath(r),o){let s=Math.min(Math.max(mr(this.camera.forward)-e.pitch,-fr),fr);this.camera.forward=dr($e(this.camera.forward)-e.yaw,s),this.camera.up=[0,1,0]}!this.touring&&(i||this.way.length>0||this.state.fall>0||this.settling)&&this.walk(e,r);let n=(s,l)=>s.some((c,u)=>c!==l[u]);return n(a.eye,this.camera.eye)||n(a.forward,this.camera.forward)}settling=!1;walk(e,r){let a=za*this.floors.eyeHeight*(e.fast?Ga:1)/1.6,i=this.camera.eye,o=[...i];if(this.way.length>0){let n=a*1.5*r;for(;this.way.length>0&&n>0;){let s=this.way[this.way.length-1],l=[s[0]-o[0],s[2]-o[2]],c=Math.hypot(...l),u=c>n?n/c:1;o=[o[0]+l[0]*u,o[1],o[2]+l[1]*u],n-=c,u===1&&this.way.pop()}}else{let n=$e(this.camera.forward),s=Math.max(Math.hypot(e.right,e.ahead),1),l=a*r/s;o[0]+=(Math.cos(n)*e.right-Math.sin(n)*e.ahead)*l,o[2]+=(-Math.sin(n)*e.right-Math.cos(n)*e.ahead)*l}this.camera.eye=this.floors.grids.length>0?this.floors.walk(i,o,r,this.state):o,this.settling=this.camera.eye[1]!==i[1]}alongPath(e){let r=this.path.keys,a=r[r.length-1];this.tour+=e,this.tour>=a.time&&(this.tour=void 0);let i=this.tour??a.time,o=Math.max(1,r.findIndex(u=>u.time>=i)),n=r[o-1],s=r[o],l=Math.min(Math.max((i-n.time)/Math.max(s.time-n.time,1e-9),0),1),c=(u,h)=>u.map((f,m)=>f+(h[m]-f)*l);this.camera={name:"",eye:c(n.eye,s.eye),forward:I(c(n.forward,s.forward),n.forward),up:[0,1,0],fov:this.path.fov,halfHeight:0}}};var Ua=ArrayBuffer,R=Uint8Array,Pe=Uint16Array,Ba=Int16Array;var Ve=Int32Array,He=function(t,e,r){if(R.prototype.slice)return R.prototype.slice.call(t,e,r);(e==null||e<0)&&(e=0),(r==null||r>t.length)&&(r=t.length);var a=new R(r-e);return a.set(t.subarray(e,r)),a},de=function(t,e,r,a){if(R.prototype.fill)return R.prototype.fill.call(t,e,r,a);for((r==null||r<0)&&(r=0),(a==null||a>t.length)&&(a=t.length);r<a;++r)t[r]=e;return t},Da=function(t,e,r,a){if(R.prototype.copyWithin)return R.prototype.copyWithin.call(t,e,r,a);for((r==null||r<0)&&(r=0),(a==null||a>t.length)&&(a=t.length);r<a;)t[e++]=t[r++]};var Ia=["invalid zstd data","window size too large (>2046MB)","invalid block type","FSE accuracy too high","match distance too far back","unexpected EOF"],A=function(t,e,r){var a=new Error(e||Ia[t]);if(a.code=t,Error.captureStackTrace&&Error.captureStackTrace(a,A),!r)throw a;return a},pr=function(t,e,r){for(var a=0,i=0;a<r;++a)i|=t[e++]<<(a<<3);return i},Ca=function(t,e){return(t[e]|t[e+1]<<8|t[e+2]<<16|t[e+3]<<24)>>>0},Wa=function(t,e){var r=t[0]|t[1]<<8|t[2]<<16;if(r==3126568&&t[3]==253){var a=t[4],i=a>>5&1,o=a>>2&1,n=a&3,s=a>>6;a&8&&A(0);var l=6-i,c=n==3?4:n,u=pr(t,l,c);l+=c;var h=s?1<<s:i,f=pr(t,l,h)+(s==1&&256),m=f;if(!i){var d=1<<10+(t[5]>>3);m=d+(d>>3)*(t[5]&7)}m>2145386496&&A(1);var p=new R((e==1?f||m:e?0:m)+12);return p[0]=1,p[4]=4,p[8]=8,{b:l+h,y:0,l:0,d:u,w:e&&e!=1?e:p.subarray(12),e:m,o:new Ve(p.buffer,0,3),u:f,c:o,m:Math.min(131072,m)}}else if((r>>4|t[3]<<20)==25481893)return Ca(t,4)+8;A(0)},re=function(t){for(var e=0;1<<e<=t;++e);return e-1},pe=function(t,e,r){var a=(e<<3)+4,i=(t[e]&15)+5;i>r&&A(3);for(var o=1<<i,n=o,s=-1,l=-1,c=-1,u=o,h=new Ua(512+(o<<2)),f=new Ba(h,0,256),m=new Pe(h,0,256),d=new Pe(h,512,o),p=512+(o<<1),v=new R(h,p,o),b=new R(h,p+o);s<255&&n>0;){var w=re(n+1),g=a>>3,M=(1<<w+1)-1,x=(t[g]|t[g+1]<<8|t[g+2]<<16)>>(a&7)&M,_=(1<<w)-1,L=M-n-1,V=x&_;if(V<L?(a+=w,x=V):(a+=w+1,x>_&&(x-=L)),f[++s]=--x,x==-1?(n+=x,v[--u]=s):n-=x,!x)do{var C=a>>3;l=(t[C]|t[C+1]<<8)>>(a&7)&3,a+=2,s+=l}while(l==3)}(s>255||n)&&A(0);for(var S=0,B=(o>>1)+(o>>3)+3,q=o-1,W=0;W<=s;++W){var k=f[W];if(k<1){m[W]=-k;continue}for(c=0;c<k;++c){v[S]=W;do S=S+B&q;while(S>=u)}}for(S&&A(0),c=0;c<o;++c){var y=m[v[c]]++,D=b[c]=i-re(y);d[c]=(y<<D)-o}return[a+7>>3,{b:i,s:v,n:b,t:d}]},Na=function(t,e){var r=0,a=-1,i=new R(292),o=t[e],n=i.subarray(0,256),s=i.subarray(256,268),l=new Pe(i.buffer,268);if(o<128){var c=pe(t,e+1,6),u=c[0],h=c[1];e+=o;var f=u<<3,m=t[e];m||A(0);for(var d=0,p=0,v=h.b,b=v,w=(++e<<3)-8+re(m);w-=v,!(w<f);){var g=w>>3;if(d+=(t[g]|t[g+1]<<8)>>(w&7)&(1<<v)-1,n[++a]=h.s[d],w-=b,w<f)break;g=w>>3,p+=(t[g]|t[g+1]<<8)>>(w&7)&(1<<b)-1,n[++a]=h.s[p],v=h.n[d],d=h.t[d],b=h.n[p],p=h.t[p]}++a>255&&A(0)}else{for(a=o-127;r<a;r+=2){var M=t[++e];n[r]=M>>4,n[r+1]=M&15}++e}var x=0;for(r=0;r<a;++r){var _=n[r];_>11&&A(0),x+=_&&1<<_-1}var L=re(x)+1,V=1<<L,C=V-x;for(C&C-1&&A(0),n[a++]=re(C)+1,r=0;r<a;++r){var _=n[r];++s[n[r]=_&&L+1-_]}var S=new R(V<<1),B=S.subarray(0,V),q=S.subarray(V);for(l[L]=0,r=L;r>0;--r){var W=l[r];de(q,r,W,l[r-1]=W+s[r]*(1<<L-r))}for(l[0]!=V&&A(0),r=0;r<a;++r){var k=n[r];if(k){var y=l[k];de(B,r,y,l[k]=y+(1<<L-k))}}return[e,{n:q,b:L,s:B}]},Oa=pe(new R([81,16,99,140,49,198,24,99,12,33,196,24,99,102,102,134,70,146,4]),0,6)[1],$a=pe(new R([33,20,196,24,99,140,33,132,16,66,8,33,132,16,66,8,33,68,68,68,68,68,68,68,68,36,9]),0,6)[1],Ha=pe(new R([32,132,16,66,102,70,68,68,68,68,36,73,2]),0,5)[1],vr=function(t,e){for(var r=t.length,a=new Ve(r),i=0;i<r;++i)a[i]=e,e+=1<<t[i];return a},Xe=new R(new Ve([0,0,0,0,16843009,50528770,134678020,202050057,269422093]).buffer,0,36),Xa=vr(Xe,0),qe=new R(new Ve([0,0,0,0,0,0,0,0,16843009,50528770,117769220,185207048,252579084,16]).buffer,0,53),qa=vr(qe,3),me=function(t,e,r){var a=t.length,i=e.length,o=t[a-1],n=(1<<r.b)-1,s=-r.b;o||A(0);for(var l=0,c=r.b,u=(a<<3)-8+re(o)-c,h=-1;u>s&&h<i;){var f=u>>3,m=(t[f]|t[f+1]<<8|t[f+2]<<16)>>(u&7);l=(l<<c|m)&n,e[++h]=r.s[l],u-=c=r.n[l]}(u!=s||h+1!=i)&&A(0)},Ka=function(t,e,r){var a=6,i=e.length,o=i+3>>2,n=o<<1,s=o+n;me(t.subarray(a,a+=t[0]|t[1]<<8),e.subarray(0,o),r),me(t.subarray(a,a+=t[2]|t[3]<<8),e.subarray(o,n),r),me(t.subarray(a,a+=t[4]|t[5]<<8),e.subarray(n,s),r),me(t.subarray(a),e.subarray(s),r)},Ya=function(t,e,r){var a,i=e.b,o=t[i],n=o>>1&3;e.l=o&1;var s=o>>3|t[i+1]<<5|t[i+2]<<13,l=(i+=3)+s;if(n==1)return i>=t.length?void 0:(e.b=i+1,r?(de(r,t[i],e.y,e.y+=s),r):de(new R(s),t[i]));if(!(l>t.length)){if(n==0)return e.b=l,r?(r.set(t.subarray(i,l),e.y),e.y+=s,r):He(t,i,l);if(n==2){var c=t[i],u=c&3,h=c>>2&3,f=c>>4,m=0,d=0;u<2?h&1?f|=t[++i]<<4|(h&2&&t[++i]<<12):f=c>>3:(d=h,h<2?(f|=(t[++i]&63)<<4,m=t[i]>>6|t[++i]<<2):h==2?(f|=t[++i]<<4|(t[++i]&3)<<12,m=t[i]>>2|t[++i]<<6):(f|=t[++i]<<4|(t[++i]&63)<<12,m=t[i]>>6|t[++i]<<2|t[++i]<<10)),++i;var p=r?r.subarray(e.y,e.y+e.m):new R(e.m),v=p.length-f;if(u==0)p.set(t.subarray(i,i+=f),v);else if(u==1)de(p,t[i++],v);else{var b=e.h;if(u==2){var w=Na(t,i);m+=i-(i=w[0]),e.h=b=w[1]}else b||A(0);(d?Ka:me)(t.subarray(i,i+=m),p.subarray(v),b)}var g=t[i++];if(g){g==255?g=(t[i++]|t[i++]<<8)+32512:g>127&&(g=g-128<<8|t[i++]);var M=t[i++];M&3&&A(0);for(var x=[$a,Ha,Oa],_=2;_>-1;--_){var L=M>>(_<<1)+2&3;if(L==1){var V=new R([0,0,t[i++]]);x[_]={s:V.subarray(2,3),n:V.subarray(0,1),t:new Pe(V.buffer,0,1),b:0}}else L==2?(a=pe(t,i,9-(_&1)),i=a[0],x[_]=a[1]):L==3&&(e.t||A(0),x[_]=e.t[_])}var C=e.t=x,S=C[0],B=C[1],q=C[2],W=t[l-1];W||A(0);var k=(l<<3)-8+re(W)-q.b,y=k>>3,D=0,_e=(t[y]|t[y+1]<<8)>>(k&7)&(1<<q.b)-1;y=(k-=B.b)>>3;var ge=(t[y]|t[y+1]<<8)>>(k&7)&(1<<B.b)-1;y=(k-=S.b)>>3;var be=(t[y]|t[y+1]<<8)>>(k&7)&(1<<S.b)-1;for(++g;--g;){var Be=q.s[_e],Ze=q.n[_e],De=S.s[be],Je=S.n[be],et=B.s[ge],tt=B.n[ge];y=(k-=et)>>3;var rt=1<<et,Z=rt+((t[y]|t[y+1]<<8|t[y+2]<<16|t[y+3]<<24)>>>(k&7)&rt-1);y=(k-=qe[De])>>3;var ce=qa[De]+((t[y]|t[y+1]<<8|t[y+2]<<16)>>(k&7)&(1<<qe[De])-1);y=(k-=Xe[Be])>>3;var we=Xa[Be]+((t[y]|t[y+1]<<8|t[y+2]<<16)>>(k&7)&(1<<Xe[Be])-1);if(y=(k-=Ze)>>3,_e=q.t[_e]+((t[y]|t[y+1]<<8)>>(k&7)&(1<<Ze)-1),y=(k-=Je)>>3,be=S.t[be]+((t[y]|t[y+1]<<8)>>(k&7)&(1<<Je)-1),y=(k-=tt)>>3,ge=B.t[ge]+((t[y]|t[y+1]<<8)>>(k&7)&(1<<tt)-1),Z>3)e.o[2]=e.o[1],e.o[1]=e.o[0],e.o[0]=Z-=3;else{var ye=Z-(we!=0);ye?(Z=ye==3?e.o[0]-1:e.o[ye],ye>1&&(e.o[2]=e.o[1]),e.o[1]=e.o[0],e.o[0]=Z):Z=e.o[0]}for(var _=0;_<we;++_)p[D+_]=p[v+_];D+=we,v+=we;var ue=D-Z;if(ue<0){var he=-ue,Lr=e.e+ue;he>ce&&(he=ce);for(var _=0;_<he;++_)p[D+_]=e.w[Lr+_];D+=he,ce-=he,ue=0}for(var _=0;_<ce;++_)p[D+_]=p[ue+_];D+=ce}if(D!=v)for(;v<p.length;)p[D++]=p[v++];else D=p.length;r?e.y+=D:p=He(p,0,D)}else if(r){if(e.y+=f,v)for(var _=0;_<f;++_)p[_]=p[v+_]}else v&&(p=He(p,v));return e.b=l,p}A(2)}},ja=function(t,e){if(t.length==1)return t[0];for(var r=new R(e),a=0,i=0;a<t.length;++a){var o=t[a];r.set(o,i),i+=o.length}return r};function _r(t,e){for(var r=[],a=+!e,i=0,o=0;t.length;){var n=Wa(t,a||e);if(typeof n=="object"){for(a?(e=null,n.w.length==n.u&&(r.push(e=n.w),o+=n.u)):(r.push(e),n.e=0);!n.l;){var s=Ya(t,n,e);s||A(5),e?n.e=n.y:(r.push(s),o+=s.length,Da(n.w,0,s.length),n.w.set(s,n.w.length-s.length))}i=n.b+n.c*4}else i=n;t=t.subarray(i)}return ja(r,o)}var X=32768,Qa=2**30;function le(t){return t.floats(3)}function gr(t,e){let r=new Float32Array(t.length*e);for(let a=0;a<t.length;++a){let i=t[a],o=Math.max(i<<16>>16,-32767)/32767,n=Math.max(i>>16,-32767)/32767,s=1-Math.abs(o)-Math.abs(n);s<0&&([o,n]=[(1-Math.abs(n))*(o<0?-1:1),(1-Math.abs(o))*(n<0?-1:1)]);let l=Math.hypot(o,n,s);r[e*a]=o/l,r[e*a+1]=n/l,r[e*a+2]=s/l}return r}function Za(t){let e=[t.f64(),t.f64(),t.f64()],r=t.u32(),a=t.u32(),i=t.u32(),o=t.size(3,"mesh flags");a%3!==0&&t.fail(`found ${a} indices, expected triangles`);let n={origin:e,positions:t.planesF32(r,3),normals:gr(t.planesU32(r),3),uvs:t.planesF32(r,2),lightmapUvs:t.planesF32(r,2),indices:new Uint32Array,parts:[]};if(o&1&&(n.colors=t.planes(r,4)),o&2){n.normalUvs=t.planesF32(r,2),n.tangents=gr(t.planesU32(r),4);let s=new Int8Array(t.planes(r,1).buffer);for(let l=0;l<r;++l)n.tangents[4*l+3]=s[l]}n.indices=t.planesU32(a);for(let s=0,l=0;s<a;++s)l=l+n.indices[s]>>>0,l>=r&&t.fail(`found index ${l} of ${r} vertices`),n.indices[s]=l;for(let s=0;s<i;++s){let l={name:t.text(),first:t.u32(),count:t.u32(),material:t.u32(),page:t.i32()};(l.first%3||l.count%3||l.first+l.count>a)&&t.fail(`found part '${l.name}' outside the indices`),n.parts.push(l)}return n}function Ja(t){let e=t.text(),r=t.floats(3),a=t.f32(),i=t.i32(),o=t.choice(2,"alpha mode"),n=t.choice(1,"flag")>0,s=t.choice(1,"flag")>0;t.choice(0,"reserved byte");let l=t.f32(),c=t.f32();return t.floats(5),{name:e,baseColor:r,alpha:a,texture:i,alphaMode:o,doubleSided:n,unlit:s,cutoff:l,metallic:c,transmission:t.f32(),emission:t.floats(3),kernel:t.i32(),fresnel:t.i32(),normalTexture:t.i32(),normalScale:t.f32()}}function br(t){t.text();let e=t.size(X,"width"),r=t.size(X,"height"),a=t.choice(2,"wrap"),i=t.choice(2,"wrap"),o=t.choice(1,"filter")>0;return t.choice(0,"reserved byte"),(!e||!r)&&t.fail("found a texture without texels"),{width:e,height:r,wrapS:a,wrapT:i,nearest:o,texels:t.planes(e*r,4)}}function ze(t,e,r){let a=t.planesU16(e,3);for(let i of a)((i&31744)===31744||!r&&i>32768)&&t.fail("found light that is negative or no number");return a}function wr(t){let e=t.i32();return(e<-94||e>112)&&t.fail(`found exponent ${e}, expected -94 to 112`),e}function ei(t){let e=t.size(X,"width"),r=t.size(X,"height"),a=t.size(1,"lightmap flags"),i=t.size(16384,"details"),o=t.size(16384,"details"),n={width:e,height:r,detailWidth:i,detailHeight:o,scale:2**wr(t),light:ze(t,e*r,!1)};if((!e||!r)&&t.fail("found a page without texels"),a&1&&(n.direction=ze(t,e*r,!0)),i>0){n.cells=t.planesU32(e*r);for(let s of n.cells){let l=s>>>28;s!==0&&(l<1||l>3||(s&16383)+(1<<l)>=i||(s>>>14&16383)+(1<<l)>=o)&&t.fail("found a cell outside of the image of details")}n.detail=ze(t,i*o,!1)}return wr(t),ze(t,e*r,!1),t.planes(e*r,1),n}function ti(t){let e=t.text(),r=t.u32(),a=new Float64Array(t.floats(16)),i=t.floats(2),o=t.floats(2);t.f32();let n=t.f32();t.u32s(4);let s=t.u32s(t.count(4)),l=t.size(16,"emitters"),c=t.size(X,"nodes"),u=t.size(X,"nodes");return l>0&&(c<2||u<2)&&t.fail("found emitters without nodes"),{name:e,material:r,packFromReflector:a,lower:i,upper:o,flatness:n,indices:s,nodesX:c,nodesY:u,emitters:t.u32s(l),visibility:t.planes(c*u*l,1)}}function ri(t){let e=t.choice(4,"corners"),r=t.choice(1,"flag")>0;return e<3&&t.fail(`found ${e} corners, expected 3 or 4`),{twoSided:r,radiance:t.floats(3),corners:Array.from({length:e},()=>le(t))}}function ai(t,e){let r=t.f32();t.floats(3);let a=t.f32(),i=t.floats(2),o=t.floats(2),n=t.floats(2);t.f32(),t.planesU16(t.count(2));let s=t.planesU16(e*(e+1)/2),l=new Float32Array(e*e),c=0;for(let u=0;u<e;++u)for(let h=(e-1)/2;h<e;++h){let f=ae(s[c++]);f>=0&&f<=1||t.fail("found a weight outside 0 to 1"),l[u*e+h]=l[u*e+e-1-h]=f}return{cosTheta:r,shift:a,width:i,lower:o,upper:n,weights:l}}function ii(t){t.choice(1,"kernel model"),t.u8(),t.u8(),t.u8(),t.floats(2);let e=t.f32();t.f32();let r=t.size(X,"kernel size"),a=t.planesF32(r*r),i=t.size(X,"slice size"),o=t.count(4);(o>256||o>0&&i%2===0)&&t.fail(`found ${o} slices of ${i}`);let n=Array.from({length:o},()=>ai(t,i)),s=t.count(20);return s!==0&&s!==o&&t.fail(`found ${s} cosine lobes of ${o} slices`),{size:r,halfExtent:e,weights:a,sliceSize:i,slices:n,fits:Array.from({length:s},()=>t.floats(5))}}function ni(t){t.f32();let e=t.u32(),r=t.u32(),a=t.size(X,"sphere");e<2&&t.fail("found a reflectance of fewer than two angles");let i={table:t.planesF32(e,3),factor:t.planesF32(r,3)};return t.planesF32(a*a,3),i}function oi(t){return{name:t.text(),eye:le(t),forward:le(t),up:le(t),fov:t.f32(),halfHeight:t.f32()}}function si(t){let e=t.text(),r=t.f32(),a=t.count(28);return{name:e,fov:r,keys:Array.from({length:a},()=>({time:t.f32(),eye:le(t),forward:le(t)}))}}function li(t){let e=t.floats(2),r=t.f32(),a=t.f32(),i=t.size(X,"width"),o=t.size(X,"height");return r>0||t.fail("found a walk grid without cells"),{lower:e,cell:r,eyeHeight:a,width:i,height:o,walkable:t.planes(i*o,1),floor:t.planesF32(i*o)}}function H(t,e,r){let a=[];for(let i=0;i<e;++i)a.push(r(t));return a}function ci(t,e,r,a){switch(t){case"SCNE":a.sky=r.floats(3);break;case"MESH":a.mesh=Za(r);break;case"MATL":a.materials=H(r,e,Ja);break;case"TEXR":a.textures.push(...H(r,e,br));break;case"NTEX":a.normals.push(...H(r,e,br));break;case"LMAP":a.pages.push(...H(r,e,ei));break;case"RFLT":a.reflectors=H(r,e,ti);break;case"EMIT":a.emitters=H(r,e,ri);break;case"KERN":a.kernels=H(r,e,ii);break;case"FRES":a.fresnels=H(r,e,ni);break;case"CAMS":a.cameras=H(r,e,oi);break;case"PATH":a.paths=H(r,e,si);break;case"WALK":a.grids=H(r,e,li);break;default:r.fail("found a section that a piece does not have")}r.end()}var ui=[143,79,82,73,13,10,26,10];function Ke(t,e){let r=s=>{throw new z(`${e}: ${s}`)},a=new DataView(t.buffer,t.byteOffset,t.byteLength),i={sky:[0,0,0],materials:[],textures:[],normals:[],pages:[],reflectors:[],emitters:[],kernels:[],fresnels:[],cameras:[],paths:[],grids:[]};(t.length<64||ui.some((s,l)=>t[l]!==s))&&r("is no piece of a pack"),a.getUint32(8,!0)!==1&&r(`found format version ${a.getUint32(8,!0)}, expected 1`);let o=a.getUint32(16,!0);64+o*64>t.length&&r("ends inside its table");let n=s=>Number(a.getBigUint64(s,!0));for(let s=0;s<o;++s){let l=64+64*s,c=String.fromCharCode(...t.subarray(l,l+4)),u=a.getUint32(l+4,!0),h=n(l+16),f=n(l+24),m=n(l+32),d=n(l+40),p=`${e}, ${c}`;h+f>t.length&&r(`section ${c} ends outside`),(m>Qa||m>f*65536+65536||d>m+1)&&r(`found ${m} bytes in section ${c}`);let v=t.subarray(h,h+f);if(u===1)try{v=_r(v,new Uint8Array(m))}catch{r(`section ${c} cannot be decompressed`)}else u!==0&&r(`found codec ${u}`);v.length!==m&&r(`section ${c}: found ${v.length} bytes, expected ${m}`),ci(c,d,new xe(v,p),i)}return i}function yr(t,e,r){let a=n=>{throw new z(`scene: ${n}`)},i=(n,s,l,c=-1)=>{(n<c||n>=s)&&a(`found ${l} ${n} of ${s}`)},o=t.mesh;if(!o)return a("found no mesh");for(let n of o.parts)i(n.material,t.materials.length,"material",0),i(n.page,t.pages.length,"lightmap page");for(let n of t.materials)i(n.texture,e,"texture"),i(n.normalTexture,r,"normal texture"),i(n.kernel,t.kernels.length,"kernel"),i(n.fresnel,t.fresnels.length,"Fresnel map");for(let n of t.reflectors){i(n.material,t.materials.length,"material",0);for(let s of n.indices)i(s,o.positions.length/3,"vertex",0);for(let s of n.emitters)i(s,t.emitters.length,"emitter",0)}}function xr(t,e,r,a){let{right:i,up:o,forward:n}=Ce(t),s=t.fov===0?t.halfHeight:Math.tan(.5*t.fov),l=N(K(i,(2*e-1)*s*a),K(o,(1-2*r)*s));return t.fov===0?{from:N(t.eye,l),way:n}:{from:t.eye,way:I(N(n,l),n)}}function kr(t,e,r){let a=t.data.mesh,i=a.positions,o=p=>[i[3*p],i[3*p+1],i[3*p+2]],n;for(let p of a.parts){let v=t.data.materials[p.material].doubleSided;for(let b=p.first;b<p.first+p.count;b+=3){let w=o(a.indices[b]),g=P(o(a.indices[b+1]),w),M=P(o(a.indices[b+2]),w),x=O(r,M),_=G(g,x);if(_===0||_<0&&!v)continue;let L=P(e,w),V=G(L,x)/_,C=O(L,g),S=G(r,C)/_,B=G(M,C)/_;V<0||S<0||V+S>1||B<=1e-4||n&&B>=n.t||(n={t:B,index:b,u:V,w:S,page:p.page,normal:I(O(g,M),[0,1,0])})}}if(!n)return;let{t:s,index:l,u:c,w:u,page:h,normal:f}=n,m=a.lightmapUvs,d=p=>[0,1,2].reduce((v,b)=>v+m[2*a.indices[l+b]+p]*[1-c-u,c,u][b],0);return{at:N(e,K(r,s)),normal:f,distance:s,lux:h<0?0:t.luxAt(h,d(0),d(1))}}var Tr=4,hi=120,Er=50,fi=25,mi=.25,Ge=class{constructor(e,r,a,i,o){this.canvas=e;this.renderer=r;this.scene=a;this.walk=i;this.panel=o}count=0;movedAt=-1e9;scale=1;began=!1;meteredAt=-1e9;byHand;luxShown=!1;pointer=[.5,.5];frames=0;changed(){this.count=0}brighter(e){this.byHand=(this.byHand??0)-e/3,this.meteredAt=-1e9,this.changed()}automatic(){this.byHand=void 0,this.meteredAt=-1e9,this.changed()}frame(e,r,a){let i=this.walk.step(e.take(r),r);this.panel.stick(e.stick);let o=Math.max(1,Math.round(this.canvas.clientWidth*Math.min(devicePixelRatio,2))),n=Math.max(1,Math.round(this.canvas.clientHeight*Math.min(devicePixelRatio,2)));(this.canvas.width!==o||this.canvas.height!==n)&&(this.canvas.width=o,this.canvas.height=n,this.count=0),i&&(a-this.movedAt<500&&this.adapt(r*1e3),this.movedAt=a,this.count=0,delete document.body.dataset.rest);let s=this.began&&a-this.movedAt<hi;!s&&this.count>=Tr||s&&!i||(this.draw(s,o,n,a),this.began=!0,++this.frames)}adapt(e){e>Er?this.scale=Math.max(this.scale*Math.max(Math.sqrt(Er/e),.5),mi):e<fi&&(this.scale=Math.min(this.scale*1.05,1))}draw(e,r,a,i){let o=e?this.scale:1,n=Math.max(1,Math.round(r*o)),s=Math.max(1,Math.round(a*o));this.renderer.draw(this.scene,this.walk.camera,n,s,e?void 0:this.count,e?hr:ur),(e?i-this.meteredAt>200:this.count===0)&&this.meter(e,i),this.renderer.show(this.scene,e?0:this.count,r,a),this.count=e?0:this.count+1,this.count===Tr&&(document.body.dataset.rest=String(this.frames),this.panel.lux(this.luxShown?this.luxThere():void 0))}meter(e,r){let a=this.renderer.meter(this.scene);if(this.meteredAt=r,a===void 0)return;let i=Math.min(Math.max(a-Math.log2(1.2*.18),-4),17)+(this.byHand??0),o=Math.log2(this.renderer.white/1.2),n=e?.45:1;this.renderer.white=1.2*2**(o+(i-o)*n)}get aspect(){return this.canvas.width/this.canvas.height}hitAt(e,r){let a=xr(this.walk.camera,e,r,this.aspect);return kr(this.scene,a.from,a.way)}go(e,r){let a=this.hitAt(e,r);if(!a)return;let i=a.normal[1]>.7?0:.5,o=[a.at[0]+a.normal[0]*i,a.at[1],a.at[2]+a.normal[2]*i];i>0&&(o[1]=this.walk.floors.nearest(this.walk.camera.eye,1e9)?.eye[1]??o[1]),this.walk.goTo(o,matchMedia("(prefers-reduced-motion: reduce)").matches)||this.panel.say("Nobody can walk there."),this.changed()}hover(e,r){this.pointer=[e,r],this.luxShown&&this.panel.lux(this.luxThere())}luxThere(){let e=this.hitAt(...this.pointer);return e?`${e.lux<10?e.lux.toFixed(1):Math.round(e.lux)} lux`:"no surface"}toggleLux(){this.luxShown=!this.luxShown,this.panel.lux(this.luxShown?this.luxThere():void 0)}};var Mr=1;async function Fr(t,e){let r;try{r=await fetch(t,{integrity:e})}catch{throw new z(`${t} did not come, or is not the one that this page was made with`)}if(!r.ok)throw new z(`${t}: ${r.status} ${r.statusText}`);return new Uint8Array(await r.arrayBuffer())}async function Rr(t,e){let r=JSON.parse(new TextDecoder().decode(await Fr(t,e)));if(r.version!==Mr)throw new z(`${t} is of version ${r.version}, this viewer of ${Mr}: write the folder anew`);for(let a of r.pieces)if(!/^pieces\/[a-z]+-[0-9a-f]+\.oriel$/.test(a.file)||!(a.bytes>0)||!(a.index>=0))throw new z(`${t}: found piece '${a.file}'`);return r}async function Ye(t){let e=await Fr(t.file,t.integrity);if(e.length!==t.bytes)throw new z(`${t.file}: found ${e.length} bytes, expected ${t.bytes}`);return e}function E(t){let e=document.getElementById(t);if(!e)throw new Error(`the page has no ${t}`);return e}var Ue=class{walk;show=()=>{};timer=0;begin(e,r){this.walk=e,this.show=r;let a=E("places");e.cameras.forEach((i,o)=>a.append(new Option(i.name||`place ${o+1}`,String(o)))),a.addEventListener("change",()=>{a.value!==""&&this.jump(Number(a.value)),a.value="",E("view").focus()}),E("tour").hidden=!e.path,E("tour").addEventListener("click",()=>this.key("p")),E("link").addEventListener("click",()=>void this.copyLink()),E("screen").hidden=!document.fullscreenEnabled,E("screen").addEventListener("click",()=>{(document.fullscreenElement?document.exitFullscreen():document.documentElement.requestFullscreen()).catch(()=>this.say("The browser does not give the whole screen."))}),E("help").addEventListener("click",()=>this.key("?")),addEventListener("hashchange",()=>{let i=e.fromHash();i&&(this.walk.jump(i),this.show()?.changed())})}progress(e){E("progress").value=e,E("bar").hidden=e>=1}say(e,r=!1){E("line").textContent=e,clearTimeout(this.timer),r||(this.timer=window.setTimeout(()=>{E("line").textContent=""},4e3))}lux(e){E("lux").hidden=e===void 0,E("lux").textContent=e??""}stick(e){let r=E("stick");r.hidden=!e,e&&(r.style.setProperty("left",`${e.startX}px`),r.style.setProperty("top",`${e.startY}px`)),E("tour").setAttribute("aria-pressed",String(!!this.walk?.touring))}jump(e){let r=this.walk,a=r.cameras[e];a&&(r.place=e,r.jump(a),this.show()?.changed(),this.say(a.name))}async copyLink(){let e=location.href.split("#")[0]+this.walk.toHash();history.replaceState(null,"",this.walk.toHash());try{await navigator.clipboard.writeText(e),this.say("A link to this view is on the clipboard.")}catch{this.say("The address now leads to this view.")}}key(e){let r=this.walk,a=this.show();if(!(!r||!a))switch(e){case"c":this.jump((r.place+1)%r.cameras.length);break;case"Home":this.jump(0);break;case"p":r.toggleTour();break;case"g":a.go(.5,.5);break;case"l":a.toggleLux();break;case"+":case"=":a.brighter(1);break;case"-":a.brighter(-1);break;case"x":a.automatic();break;case"?":E("sheet").showModal();break;default:/^[1-9]$/.test(e)&&this.jump(Number(e)-1)}}};var je=t=>{document.body.dataset.state=t};function Ar(t){E("fallback").hidden=!1,E("fallback-text").textContent=t,E("tools").hidden=E("bar").hidden=!0,E("view").hidden=!0,je("refused")}var Sr=!1,ve=E("view"),Q=new Ue;function di(){return ve.getContext("webgl2",{antialias:!1,alpha:!1,depth:!1,powerPreference:"high-performance"})}var Qe=class{constructor(e,r,a){this.gl=e;this.scene=r;this.walk=a}pieces=new Map;show;begin(){let e=lr(this.gl),r=this.scene.pages.slice(),a=new Re(e,{...this.scene,pages:r});this.show=new Ge(ve,new Ae(e),a,this.walk,Q);for(let[i,o]of this.pieces)this.take(i,o)}take(e,r){this.pieces.set(e,r);let a=this.show,[i,o]=e.split(" "),n=Number(o);a&&(i==="light"&&r.pages[0]&&a.scene.setPage(n,r.pages[0]),i==="texture"&&r.textures[0]&&a.scene.setTexture(n,r.textures[0],!1),i==="normal"&&r.normals[0]&&a.scene.setTexture(n,r.normals[0],!0),a.changed())}};async function pi(t){if(!("serviceWorker"in navigator)||!isSecureContext)return;let e=/pieces-([0-9a-f]+)\.json/.exec(document.body.dataset.pieces)?.[1];try{let r=await caches.open(`oriel ${e}`),a=[...document.querySelectorAll("script[src], link[href]")].map(i=>i.getAttribute("src")??i.getAttribute("href"));await r.addAll(["./",document.body.dataset.pieces,...a,...t.pieces.map(i=>i.file)]),await navigator.serviceWorker.register("offline.js"),document.body.dataset.offline="kept"}catch{}}var vi=t=>`${t.kind} ${t.index}`;async function _i(){let t=await Rr(document.body.dataset.pieces,document.body.dataset.integrity),e=t.pieces.reduce((m,d)=>m+d.bytes,0),r=t.pieces.find(m=>m.kind==="scene");if(!r)throw new z("found no scene among the pieces");let a=di();if(!a)return Ar("This page shows a building in three dimensions. Your browser cannot draw it: it lacks WebGL 2.");let i=r.bytes;Q.progress(.05);let o=Ke(await Ye(r),r.file),n=m=>t.pieces.filter(d=>d.kind===m).length;yr(o,n("texture"),n("normal"));let s=new Le(o),l=new Qe(a,o,s);l.begin(),Sr=!0,Q.begin(s,()=>l.show);let c=new ke(ve,{key:m=>Q.key(m),go:(m,d)=>l.show?.go(m,d),hover:(m,d)=>l.show?.hover(m,d)}),u=!1,h=performance.now();ve.addEventListener("webglcontextlost",m=>{m.preventDefault(),u=!0,l.show=void 0}),ve.addEventListener("webglcontextrestored",()=>{u=!1,l.begin()});let f=m=>{requestAnimationFrame(f);let d=Math.min((m-h)/1e3,.25);h=m,!u&&(l.show?.frame(c,d,m),l.show?.frames&&document.body.dataset.state==="loading"&&(a.finish(),je("first")))};requestAnimationFrame(f),Q.progress(i/e);for(let m of t.pieces){if(m===r)continue;let d=Ke(await Ye(m),m.file);m.kind==="light"&&gi(d,m),l.take(vi(m),d),Q.progress((i+=m.bytes)/e)}je("whole"),Q.progress(1),await pi(t)}function gi(t,e){if(t.pages.length!==1)throw new z(`${e.file}: found ${t.pages.length} pages, expected one`)}_i().catch(t=>{Sr?Q.say(`A part is missing: ${t.message}`,!0):Ar(`This walkthrough cannot be shown: ${t.message}`),t instanceof z||console.error(t)});
