// Direct light of points, spots and suns by the pixel (formats/assets/sharp_light.h, docs/notes/sharp-light.md).
uniform highp usampler2D u_sharp_at;        // by texel of the page
uniform highp usampler2D u_sharp_words;     // kSharpColumns a row
uniform highp sampler2D u_sharp_triangles;  // three texels each, likewise
uniform highp sampler2D u_sharp_lamps;      // a row each, see lamp_at()

const uint kSharpSplit = 0xffffffffu;
const int kSharpColumns = 4095;  // a multiple of three
// Of a disk of radius 1: directions of equal shares of it (Vogel 1979), and the side of a square as large as a share.
const vec4 kDiskX[4] = vec4[4](vec4(0.177, -0.226, 0.035, 0.285), vec4(-0.522, 0.495, -0.165, -0.316), vec4(0.685, -0.712, 0.343, 0.254), vec4(-0.765, 0.897, -0.548, -0.126));
const vec4 kDiskY[4] = vec4[4](vec4(0.000, 0.207, -0.394, 0.371), vec4(-0.092, -0.315, 0.616, -0.608), vec4(0.250, 0.294, -0.734, 0.809), vec4(-0.443, -0.197, 0.779, -0.976));
const float kDiskStep = 0.443;

struct SharpLamp {
  vec3 towards;  // unit, from the pixel
  float distance;  // 0: a sun's
  float spread;    // tangent of a sun's radius
  vec3 light;      // lux, without shadows
};

uint sharp_word(uint i) {
  return texelFetch(u_sharp_words, ivec2(int(i) % kSharpColumns, int(i) / kSharpColumns), 0).r;
}

vec3 color_of_word(uint code) {
  return vec3(code & 511u, code >> 9u & 511u, code >> 18u & 511u) * exp2(float(code >> 27u) - 24.0);
}

SharpLamp lamp_at(int row, vec3 p, vec3 normal) {
  vec4 place = texelFetch(u_sharp_lamps, ivec2(0, row), 0);   // of a sun the way to it, and 1
  vec4 axis = texelFetch(u_sharp_lamps, ivec2(1, row), 0);    // and the cosine of its outer cone
  vec4 power = texelFetch(u_sharp_lamps, ivec2(2, row), 0);   // and its inverse falloff; of a sun its spread
  if (place.w > 0.5) return SharpLamp(place.xyz, 0.0, power.w, power.rgb * max(dot(normal, place.xyz), 0.0));
  vec3 to = place.xyz - p;
  float distance2 = max(dot(to, to), 1e-12), distance = sqrt(distance2);
  to /= distance;
  float cone = clamp((-dot(axis.xyz, to) - axis.w) * power.w, 0.0, 1.0);
  return SharpLamp(to, distance, 0.0, power.rgb * (cone * cone * max(dot(normal, to), 0.0) / distance2));
}

// One of a triangle's edges as a pixel sees it: a plane through both.
struct SharpEdge {
  vec3 inwards;  // unit
  float hard;    // sine below which rounding is all that parts a direction from the plane
  float step;    // sine over which the pixel's own width spreads a shadow's edge; 0: no shadow ends here
};

SharpEdge edge_between(vec3 a, vec3 b, float turn, bool ends, vec3 dx, vec3 dy, float inverse_distance) {
  vec3 across = turn * cross(a, b);
  float size = max(length(across), 1e-20);
  vec3 inwards = across / size;
  float away = max(length(b - a) / size - inverse_distance, 0.0);
  float pixel = (abs(dot(inwards, dx)) + abs(dot(inwards, dy))) * away;
  return SharpEdge(inwards, 1e-6 * (dot(a, a) + dot(b, b)) / size, ends ? pixel + 1e-7 : 0.0);
}

float inside(SharpEdge e, vec3 direction) {
  float sine = dot(e.inwards, direction);
  return e.step > 0.0 ? clamp(sine / e.step + 0.5, 0.0, 1.0) : step(-e.hard, sine);
}

vec4 inside_disk(SharpEdge e, float sine, vec2 slope, float spread, int k) {
  vec4 sines = sine + slope.x * kDiskX[k] + slope.y * kDiskY[k];
  return e.step > 0.0 ? clamp(sines / (e.step + kDiskStep * spread) + 0.5, 0.0, 1.0) : step(vec4(-e.hard), sines);
}

// How much of a lamp `count` triangles leave, whose words begin at `first`. dx, dy: from a pixel to the next.
float sharp_visible(SharpLamp lamp, uint first, uint count, vec3 p, vec3 dx, vec3 dy) {
  vec3 u = normalize(abs(lamp.towards.x) < 0.7 ? vec3(0.0, lamp.towards.z, -lamp.towards.y)
                                               : vec3(-lamp.towards.z, 0.0, lamp.towards.x));
  vec3 v = cross(lamp.towards, u);
  float inverse_distance = lamp.distance > 0.0 ? 1.0 / lamp.distance : 0.0;
  float covered = 0.0;
  vec4 covered_disk[4] = vec4[4](vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
  for (uint k = 0u; k < count; ++k) {
    uint word = sharp_word(first + k);
    int at = 3 * int(word & 0x1fffffffu);
    ivec2 texel = ivec2(at % kSharpColumns, at / kSharpColumns);
    vec3 a = texelFetch(u_sharp_triangles, texel, 0).xyz - p;
    vec3 b = texelFetch(u_sharp_triangles, texel + ivec2(1, 0), 0).xyz - p;
    vec3 c = texelFetch(u_sharp_triangles, texel + ivec2(2, 0), 0).xyz - p;
    vec3 normal = cross(b - a, c - a);
    // The triangle's plane must lie between the pixel and the lamp.
    float height = dot(normal, a), of_lamp = dot(normal, lamp.towards) * (lamp.distance > 0.0 ? lamp.distance : 1e20);
    if (height * (of_lamp - height) <= 0.0) continue;
    float turn = sign(height);
    SharpEdge ab = edge_between(a, b, turn, (word & 0x20000000u) != 0u, dx, dy, inverse_distance);
    SharpEdge bc = edge_between(b, c, turn, (word & 0x40000000u) != 0u, dx, dy, inverse_distance);
    SharpEdge ca = edge_between(c, a, turn, (word & 0x80000000u) != 0u, dx, dy, inverse_distance);
    if (lamp.spread <= 0.0) {
      covered = max(covered, min(inside(ab, lamp.towards), min(inside(bc, lamp.towards), inside(ca, lamp.towards))));
      continue;
    }
    vec3 sines = vec3(dot(ab.inwards, lamp.towards), dot(bc.inwards, lamp.towards), dot(ca.inwards, lamp.towards));
    vec2 of_ab = lamp.spread * vec2(dot(ab.inwards, u), dot(ab.inwards, v));
    vec2 of_bc = lamp.spread * vec2(dot(bc.inwards, u), dot(bc.inwards, v));
    vec2 of_ca = lamp.spread * vec2(dot(ca.inwards, u), dot(ca.inwards, v));
    for (int j = 0; j < 4; ++j) {
      vec4 in_all = min(inside_disk(ab, sines.x, of_ab, lamp.spread, j),
                        min(inside_disk(bc, sines.y, of_bc, lamp.spread, j), inside_disk(ca, sines.z, of_ca, lamp.spread, j)));
      covered_disk[j] = max(covered_disk[j], in_all);
    }
  }
  if (lamp.spread <= 0.0) return 1.0 - covered;
  return 1.0 - dot(covered_disk[0] + covered_disk[1] + covered_disk[2] + covered_disk[3], vec4(1.0 / 16.0));
}

// lux at a place of a page, uv in [0,1]. normal: unit, by which light is received.
vec3 sharp_light(vec2 uv, vec3 p, vec3 dx, vec3 dy, vec3 normal) {
  vec2 size = vec2(textureSize(u_sharp_at, 0));
  vec2 at = clamp(uv * size, vec2(0.0), size - 0.5);
  uint place = texelFetch(u_sharp_at, ivec2(at), 0).r;
  if (place == 0u) return vec3(0.0);
  vec2 within = fract(at);
  uint head = sharp_word(place);
  for (int k = 0; k < 6 && head == kSharpSplit; ++k) {
    within *= 2.0;
    uvec2 quarter = uvec2(min(within, vec2(1.0)));
    within -= vec2(quarter);
    place = sharp_word(place + 1u + quarter.x + 2u * quarter.y);
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
  return sum;
}
