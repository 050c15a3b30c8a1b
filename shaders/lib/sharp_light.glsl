// Direct light of points, spots and suns by the pixel (formats/assets/sharp_light.h, docs/notes/sharp-light.md).
uniform highp usampler2D u_sharp_at;        // by texel of the page
uniform highp usampler2D u_sharp_words;     // 4096 a row; before them two rows of half_disk()
uniform highp sampler2D u_sharp_triangles;  // likewise, four texels each: corners, and one unused; then profiles
uniform highp sampler2D u_sharp_lamps;      // a row each, see lamp_at()

const uint kSharpSplit = 0xffffffffu;
const float kMostSharpLux = 1.5e5;  // close to a lamp: half floats hold what white reflects of it

struct SharpLamp {
  vec3 to;       // from the pixel; of a sun: unit
  float near;    // 1, of a sun 0
  float spread;  // tangent of a sun's radius
  vec3 light;    // lux, without shadows
};

ivec2 sharp_texel(uint i) { return ivec2(int(i & 4095u), int(i >> 12u)); }

uint sharp_word(uint i) { return texelFetch(u_sharp_words, sharp_texel(i + 8192u), 0).r; }

vec3 color_of_word(uint code) {
  return vec3(code & 511u, code >> 9u & 511u, code >> 18u & 511u) * exp2(float(code >> 27u) - 24.0);
}

// Candela along a unit direction. place.w: less the profile's columns; axis.w: its first vertical angle; steps: a radian.
float profile_candela(int row, vec4 place, vec4 axis, float steps, vec3 direction) {
  vec4 right = texelFetch(u_sharp_lamps, ivec2(3, row), 0);  // horizontal 0, and the last row
  vec4 over = texelFetch(u_sharp_lamps, ivec2(4, row), 0);   // horizontal 90 degrees, and where in u_sharp_triangles
  vec2 across = vec2(dot(right.xyz, direction), dot(over.xyz, direction));
  float y = (atan(length(across), dot(axis.xyz, direction)) - axis.w) * steps;
  if (abs(y - 0.5 * right.w) > 0.5 * right.w + 1e-4) return 0.0;
  if (across == vec2(0.0)) across.x = 1.0;
  float x = fract(atan(across.y, across.x) / 6.2831853) * -place.w;
  vec2 at = clamp(floor(vec2(x, y)), vec2(0.0), vec2(-place.w, right.w) - 1.0);
  // Itself, the next row's, and both of the next column.
  vec4 around = texelFetch(u_sharp_triangles, sharp_texel(uint(over.w) * 4096u + uint(at.y * -place.w + at.x)), 0);
  vec2 between = mix(around.xz, around.yw, clamp(y - at.y, 0.0, 1.0));
  return mix(between.x, between.y, clamp(x - at.x, 0.0, 1.0));
}

SharpLamp lamp_at(int row, vec3 p, vec3 normal) {
  vec4 place = texelFetch(u_sharp_lamps, ivec2(0, row), 0);   // of a sun the way to it, and 1
  vec4 axis = texelFetch(u_sharp_lamps, ivec2(1, row), 0);    // and the cosine of its outer cone
  vec4 power = texelFetch(u_sharp_lamps, ivec2(2, row), 0);   // and its inverse falloff; of a sun its spread
#ifdef SUNS
  if (place.w > 0.5) return SharpLamp(place.xyz, 0.0, power.w, power.rgb * max(dot(normal, place.xyz), 0.0));
#endif
  vec3 to = place.xyz - p;
  float distance2 = max(dot(to, to), 1e-12);
  vec3 towards = to * inversesqrt(distance2);
  float cone = clamp((-dot(axis.xyz, towards) - axis.w) * power.w, 0.0, 1.0);
  float share = place.w < 0.0 ? profile_candela(row, place, axis, power.w, -towards) : cone * cone;
  return SharpLamp(to, 1.0, 0.0, power.rgb * (share * max(dot(normal, towards), 0.0) / distance2));
}

float extent(vec3 v) { return dot(abs(v), vec3(1.0)); }

#ifdef SUNS  // some lamps are
#define COVER uvec2
#define IS_FULL(cover) ((cover.x & cover.y) == 0xffffffffu)
// Which of 64 places of a unit disk, all shares of it alike, have dot(place, n) + off >= 0, n being across, normalized.
uvec2 half_disk(vec2 across, float off) {
  if (off >= 1.0) return uvec2(0xffffffffu);
  if (off <= -1.0) return uvec2(0u);
  float x = across.x / max(abs(across.x) + abs(across.y), 1e-30);
  int direction = int((across.y < 0.0 ? 3.0 + x : 1.0 - x) * 16.0) & 63;
  int at = 128 * direction + 2 * min(int(off * 32.0 + 32.0), 63);
  ivec2 texel = ivec2(at & 4095, at >> 12);
  return uvec2(texelFetch(u_sharp_words, texel, 0).r, texelFetch(u_sharp_words, texel + ivec2(1, 0), 0).r);
}

float ones(uvec2 bits) {
  bits -= bits >> 1u & 0x55555555u;
  bits = (bits & 0x33333333u) + (bits >> 2u & 0x33333333u);
  bits = (bits + (bits >> 4u) & 0x0f0f0f0fu) * 0x01010101u >> 24u;
  return float(bits.x + bits.y);
}
#else
#define COVER float
#define IS_FULL(cover) (cover >= 1.0)
#endif

// How much of a lamp, or of a pixel, is on the inner side of a triangle's edge: by the determinant of the way from the
// pixel to corner a, to the next and to the lamp, which changes evenly with the pixel. ends: the shadow does here, else
// another triangle goes on, and both cover a little of the other so that nothing leaks.
COVER inside(vec3 a, vec3 ab, SharpLamp lamp, vec3 u, vec3 v, float turn, bool ends, vec3 dx, vec3 dy) {
  vec3 to = lamp.to - lamp.near * a, across = cross(ab, to);
  float rounding = 1e-6 * extent(ab) * extent(to) * extent(a) + 1e-30, depth = turn * dot(across, a);
  vec2 by_pixel = vec2(dot(across, dx), dot(across, dy));
  float width = abs(by_pixel.x) + abs(by_pixel.y);
#ifdef SUNS
  vec3 plane = turn * lamp.spread * cross(a, ab);
  vec2 slope = lamp.spread > 0.0 ? vec2(dot(plane, u), dot(plane, v)) : by_pixel;
  float pixel = ends ? 0.5 * width : 0.0;
  float reach = max(lamp.spread > 0.0 ? length(vec3(slope, pixel)) : pixel, rounding);
  return half_disk(slope, ends ? depth / reach : (depth + 2.0 * rounding) / reach + 0.0625);
#else
  return clamp(ends ? depth / max(width, rounding) + 0.5 : depth / rounding + 2.0, 0.0, 1.0);
#endif
}

// How much of a lamp `count` > 0 triangles leave, whose words begin at `first`. dx, dy: from a pixel to the next. Loops
// are tested at their ends: llvmpipe runs what follows a break once more with no pixel in it.
float sharp_visible(SharpLamp lamp, uint first, uint count, vec3 p, vec3 dx, vec3 dy) {
  vec3 u = normalize(abs(lamp.to.x) < abs(lamp.to.y) ? vec3(0.0, lamp.to.z, -lamp.to.y) : vec3(-lamp.to.z, 0.0, lamp.to.x));
  vec3 v = cross(lamp.to, u);
  // Of a pixel pieces of one surface add up where they meet; what faces the lamp and what turns from it, as the two
  // sides of a body do, cover the same.
  COVER front = COVER(0), back = COVER(0);
  uint end = first + count;
  do {
    uint word = sharp_word(first);
    ivec2 texel = sharp_texel(4u * (word & 0x1fffffffu));
    vec3 a = texelFetch(u_sharp_triangles, texel, 0).xyz;
    vec3 b = texelFetch(u_sharp_triangles, texel + ivec2(1, 0), 0).xyz;
    vec3 c = texelFetch(u_sharp_triangles, texel + ivec2(2, 0), 0).xyz;
    vec3 ab = b - a, bc = c - b, ca = a - c, normal = cross(ab, bc);
    a -= p, b -= p, c -= p;
    float height = dot(normal, a);
    // The triangle's plane lies before a lamp.
    if (lamp.near * (height * height - height * dot(normal, lamp.to)) >= (1.0 - lamp.near) * height * height) continue;
    float turn = sign(height);
    COVER in_ab = inside(a, ab, lamp, u, v, turn, (word & 0x20000000u) != 0u, dx, dy);
    COVER in_bc = inside(b, bc, lamp, u, v, turn, (word & 0x40000000u) != 0u, dx, dy);
    COVER in_ca = inside(c, ca, lamp, u, v, turn, (word & 0x80000000u) != 0u, dx, dy);
#ifdef SUNS
    front |= in_ab & in_bc & in_ca;
#else
    // Exact between opposite edges, so that what is thinner than a pixel fades.
    float in_all = max(in_ab + in_bc + in_ca - 2.0, 0.0), faces = step(0.0, dot(normal, lamp.to - lamp.near * a));
    front += faces * in_all, back += (1.0 - faces) * in_all;
#endif
  } while (++first < end && !IS_FULL(front) && !IS_FULL(back));
#ifdef SUNS
  return 1.0 - ones(front) / 64.0;
#else
  return 1.0 - min(max(front, back), 1.0);
#endif
}

// lux at a place of a page, uv in [0,1]. normal: unit, by which light is received.
vec3 sharp_light(vec2 uv, vec3 p, vec3 dx, vec3 dy, vec3 normal) {
  vec2 size = vec2(textureSize(u_sharp_at, 0));
  vec2 at = uv * size, texel = clamp(floor(at), vec2(0.0), size - 1.0);
  uint place = texelFetch(u_sharp_at, ivec2(texel), 0).r;
  if (place == 0u) return vec3(0.0);
  vec2 within = clamp(at - texel, 0.0, 1.0);
  uint head = sharp_word(place);
  while (head == kSharpSplit) {  // ends, as quarters lie before it; llvmpipe would run a bounded loop to its bound
    within *= 2.0;
    vec2 quarter = step(1.0, within);
    within -= quarter;
    place = sharp_word(place + 1u + uint(quarter.x + 2.0 * quarter.y));
    head = sharp_word(place);
  }
  if (head == 0u) return vec3(0.0);
  vec3 sum = vec3(0.0);
  uint next = place + 1u;
  do {
    uint shine = sharp_word(next++);
    vec3 tint = (shine & 0x400u) != 0u ? color_of_word(sharp_word(next++)) : vec3(1.0);
    uint count = shine >> 11u;
    SharpLamp lamp = lamp_at(int(shine & 0x3ffu), p, normal);
    if (lamp.light.r + lamp.light.g + lamp.light.b > 0.0) {
      float visible = count > 0u ? sharp_visible(lamp, next, count, p, dx, dy) : 1.0;
      sum += lamp.light * tint * visible;
    }
    next += count;
  } while (--head > 0u);
  return min(sum, kMostSharpLux);
}
