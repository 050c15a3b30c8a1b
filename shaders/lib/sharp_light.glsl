// Direct light of points, spots and suns by the pixel (formats/assets/sharp_light.h, docs/notes/sharp-light.md).
uniform highp usampler2D u_sharp_at;        // by texel of the page
uniform highp usampler2D u_sharp_words;     // 4096 a row
uniform highp sampler2D u_sharp_triangles;  // likewise, four texels each: corners, and one unused
uniform highp sampler2D u_sharp_lamps;      // a row each, see lamp_at()

const uint kSharpSplit = 0xffffffffu;
const int kMostSharpSplits = 5;
const float kDiskStep = 0.443;   // the side of a square as large as a share of a disk of radius 1
#ifdef SUNS                      // some lamps are
#define SHARES vec4
const int kDiskQuads = 4;
// Of that disk: directions of equal shares of it (Vogel 1979).
const vec4 kDiskX[4] = vec4[4](vec4(0.177, -0.226, 0.035, 0.285), vec4(-0.522, 0.495, -0.165, -0.316), vec4(0.685, -0.712, 0.343, 0.254), vec4(-0.765, 0.897, -0.548, -0.126));
const vec4 kDiskY[4] = vec4[4](vec4(0.000, 0.207, -0.394, 0.371), vec4(-0.092, -0.315, 0.616, -0.608), vec4(0.250, 0.294, -0.734, 0.809), vec4(-0.443, -0.197, 0.779, -0.976));
#else
#define SHARES float
const int kDiskQuads = 1;
#endif
const float kMostSharpLux = 1.5e5;  // close to a lamp: half floats hold what white reflects of it

struct SharpLamp {
  vec3 to;       // from the pixel; of a sun: unit
  float near;    // 1, of a sun 0
  float spread;  // tangent of a sun's radius
  vec3 light;    // lux, without shadows
};

ivec2 sharp_texel(uint i) { return ivec2(int(i & 4095u), int(i >> 12u)); }

uint sharp_word(uint i) { return texelFetch(u_sharp_words, sharp_texel(i), 0).r; }

vec3 color_of_word(uint code) {
  return vec3(code & 511u, code >> 9u & 511u, code >> 18u & 511u) * exp2(float(code >> 27u) - 24.0);
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
  return SharpLamp(to, 1.0, 0.0, power.rgb * (cone * cone * max(dot(normal, towards), 0.0) / distance2));
}

// On which side of one of a triangle's edges a lamp is, seen from a pixel: the determinant of the way to corner a, to the
// next and to the lamp. As the pixel moves it changes evenly.
struct SharpEdge {
  float inside;
  vec2 slope;     // of it, from the middle of a sun to its rim
  float inverse;  // of what it changes by along a shadow's edge
  float bias;
};

float extent(vec3 v) { return dot(abs(v), vec3(1.0)); }

// ends: the shadow does here, else another triangle goes on and takes over without a gap.
SharpEdge edge_from(vec3 a, vec3 ab, SharpLamp lamp, vec3 u, vec3 v, float turn, bool ends, vec3 dx, vec3 dy) {
  vec3 to = lamp.to - lamp.near * a, across = cross(ab, to);
  float rounding = 1e-6 * extent(ab) * extent(to) * extent(a) + 1e-30;
  vec3 plane = turn * lamp.spread * cross(a, ab);
  vec2 slope = vec2(dot(plane, u), dot(plane, v));
  float width = max(abs(dot(across, dx)) + abs(dot(across, dy)) + kDiskStep * length(slope), rounding);
  return SharpEdge(turn * dot(across, a), slope, 1.0 / (ends ? width : rounding), ends ? 0.5 : 2.0);
}

SHARES inside(SharpEdge e, int quad) {
#ifdef SUNS
  return clamp((e.inside + e.slope.x * kDiskX[quad] + e.slope.y * kDiskY[quad]) * e.inverse + e.bias, 0.0, 1.0);
#else
  return clamp(e.inside * e.inverse + e.bias, 0.0, 1.0);
#endif
}

// How much of a lamp `count` triangles leave, whose words begin at `first`. dx, dy: from a pixel to the next.
float sharp_visible(SharpLamp lamp, uint first, uint count, vec3 p, vec3 dx, vec3 dy) {
  vec3 u = normalize(abs(lamp.to.x) < abs(lamp.to.y) ? vec3(0.0, lamp.to.z, -lamp.to.y) : vec3(-lamp.to.z, 0.0, lamp.to.x));
  vec3 v = cross(lamp.to, u);
  // Pieces of one surface add up where they meet; what faces the lamp and what turns from it, as the two sides of a body
  // do, cover the same.
  SHARES front[kDiskQuads], back[kDiskQuads];
  for (int j = 0; j < kDiskQuads; ++j) front[j] = back[j] = SHARES(0.0);
  for (uint k = 0u; k < count; ++k) {
    uint word = sharp_word(first + k);
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
    SharpEdge e0 = edge_from(a, ab, lamp, u, v, turn, (word & 0x20000000u) != 0u, dx, dy);
    SharpEdge e1 = edge_from(b, bc, lamp, u, v, turn, (word & 0x40000000u) != 0u, dx, dy);
    SharpEdge e2 = edge_from(c, ca, lamp, u, v, turn, (word & 0x80000000u) != 0u, dx, dy);
    float faces = step(0.0, dot(normal, lamp.to - lamp.near * a));
    for (int j = 0; j < kDiskQuads; ++j) {
      // Exact between opposite edges, so that what is thinner than a pixel fades.
      SHARES in_all = max(inside(e0, j) + inside(e1, j) + inside(e2, j) - 2.0, SHARES(0.0));
      front[j] += faces * in_all, back[j] += (1.0 - faces) * in_all;
    }
  }
  SHARES left = SHARES(0.0);
  for (int j = 0; j < kDiskQuads; ++j) left += 1.0 - min(max(front[j], back[j]), 1.0);
#ifdef SUNS
  return dot(left, vec4(0.25 / float(kDiskQuads)));
#else
  return left;
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
  for (int k = 0; head == kSharpSplit; ++k) {
    if (k == kMostSharpSplits) return vec3(0.0);
    within *= 2.0;
    vec2 quarter = step(1.0, within);
    within -= quarter;
    place = sharp_word(place + 1u + uint(quarter.x + 2.0 * quarter.y));
    head = sharp_word(place);
  }
  vec3 sum = vec3(0.0);
  uint next = place + 1u;
  for (uint k = 0u; k < head; ++k) {
    uint shine = sharp_word(next++);
    vec3 tint = (shine & 0x400u) != 0u ? color_of_word(sharp_word(next++)) : vec3(1.0);
    uint count = shine >> 11u;
    SharpLamp lamp = lamp_at(int(shine & 0x3ffu), p, normal);
    if (lamp.light.r + lamp.light.g + lamp.light.b > 0.0) {
      float visible = count > 0u ? sharp_visible(lamp, next, count, p, dx, dy) : 1.0;
      sum += lamp.light * tint * visible;
    }
    next += count;
  }
  return min(sum, kMostSharpLux);
}
