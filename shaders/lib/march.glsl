// Marching a reflected ray through a radiance map (formats/assets/radiance_map.h), the same as tests/player/twins/march.h, which tells
// what the numbers mean. Disparity is linear along the projected ray, so that the map is a height field the ray falls onto.

const float kNear = 0.1;
const float kGap = 0.5;
const float kSteep = 4.0;
const float kTouching = 0.003;
const float kDistrust = 128.0;
const float kBorder = 1e-3;
const float kMixed = 0.03;
const int kRangeLevels = 6;
const int kMaxSteps = 96;

// The part of a ray inside a map's frame: from a pixel position over `length` pixels along `direction`, while the disparity falls
// from s_begin to s_end by `fall` a pixel. length < 0: none of it. hidden: pixels that it runs outside before.
struct MapRay {
  vec2 from;
  vec2 direction;
  float length;
  float s_begin;
  float s_end;
  float fall;
  float hidden;
};

MapRay map_ray(vec3 eye, vec2 lower, vec2 upper, vec2 size, vec2 on_plane, vec3 direction) {
  vec2 to_pixels = size / (upper - lower);
  vec2 start = (on_plane - lower) * to_pixels;
  vec2 way = (eye.xy - eye.z * direction.xy / direction.z - lower) * to_pixels - start;  // to where it goes at infinity
  vec2 safe = vec2(abs(way.x) < 1e-12 ? 1e-12 : way.x, abs(way.y) < 1e-12 ? 1e-12 : way.y);
  vec2 a = -start / safe, b = (size - start) / safe;
  vec2 first = min(a, b), last = max(a, b);
  float enter = max(max(first.x, first.y), 0.0), leave = min(min(last.x, last.y), 1.0);
  MapRay ray = MapRay(vec2(0.0), vec2(0.0), -1.0, 1.0, 0.0, 0.0, 0.0);
  if (!(enter <= leave)) return ray;
  vec2 inside = (leave - enter) * way;
  ray.length = max(max(abs(inside.x), abs(inside.y)), 1e-3);
  ray.from = start + enter * way;
  ray.direction = inside / ray.length;
  ray.s_begin = 1.0 - enter;
  ray.s_end = 1.0 - leave;
  ray.fall = (leave - enter) / ray.length;
  ray.hidden = enter * max(abs(way.x), abs(way.y));
  return ray;
}

float ray_disparity(MapRay ray, float at) { return ray.s_end + (ray.length - at) * ray.fall; }

ivec2 map_texel(MapRay ray, float at, ivec2 size) {
  return clamp(ivec2(floor(ray.from + at * ray.direction)), ivec2(0), size - 1);
}

// The first border between texels more than a little after `at`.
float next_border(MapRay ray, float at) {
  vec2 from = sign(ray.direction) * (ray.from + at * ray.direction);
  vec2 inside = fract(from + kBorder) - kBorder;
  vec2 steps = (1.0 - inside) / max(abs(ray.direction), vec2(1e-6));
  return at + min(steps.x, steps.y);
}

// 16 bits hold a disparity as a share of 65535 / 32767.
const float kOfCodes = 65535.0 / 32767.0;

float texel_disparity(sampler2DArray disparity, int layer, ivec2 texel) {
  return kOfCodes * texelFetch(disparity, ivec3(texel, layer), 0).r;
}

// Where the ray meets a surface: pixel position, disparity, and trust in (0, 1]; trust 0: the map does not see it.
struct MapHit {
  vec2 at;
  float s;
  float trust;
};

// Disparity, bilinear.
float disparity_at(sampler2DArray disparity, int layer, ivec2 size, vec2 at) {
  vec2 inside = clamp(at, vec2(0.5), vec2(size) - 0.5) / vec2(textureSize(disparity, 0).xy);
  return kOfCodes * textureLod(disparity, vec3(inside, float(layer)), 0.0).r;
}

// The same over the surface around a texel of it.
float on_surface(float s, float surface) {
  return clamp(s, surface / (1.0 + kNear), surface * (1.0 + kNear));
}

// Whether a texel of disparity `surface` goes on the surface at `begin`, in the texel before it: both are on one plane by the
// slopes before and behind, or those planes meet between them.
bool is_connected(sampler2DArray disparity, int layer, ivec2 size, MapRay ray, float begin, ivec2 texel, float surface) {
  ivec2 beside = map_texel(ray, begin, size), way = texel - beside;
  float last = texel_disparity(disparity, layer, beside);
  float earlier = texel_disparity(disparity, layer, clamp(beside - way, ivec2(0), size - 1));
  float after = texel_disparity(disparity, layer, clamp(texel + way, ivec2(0), size - 1));
  float unit = float(max(size.x, size.y));
  float first = unit * (last - (surface - (after - surface))), second = unit * (last + (last - earlier) - surface);
  float least = min(abs(first), abs(second)), most = max(abs(first), abs(second));
  bool meet = (first <= 0.0) != (second <= 0.0) || least <= kGap;
  return surface <= 1.0 && last <= 1.0 && (most <= kGap || (meet && unit * abs(surface - last) <= kSteep));
}

// How far the ray is above the surface.
float height_above(sampler2DArray disparity, int layer, ivec2 size, MapRay ray, float at, float surface) {
  return ray_disparity(ray, at) - on_surface(disparity_at(disparity, layer, size, ray.from + at * ray.direction), surface);
}

// The crossing in [begin, end], found by false position.
float refine_crossing(sampler2DArray disparity, int layer, ivec2 size, MapRay ray, float begin, float end, float surface) {
  float above = height_above(disparity, layer, size, ray, begin, surface);
  float below = height_above(disparity, layer, size, ray, end, surface);
  for (int i = 0; i < 2; ++i) {
    if (above <= 0.0) return begin;
    if (below >= 0.0) return end;
    float middle = mix(begin, end, above / (above - below));
    float left = height_above(disparity, layer, size, ray, middle, surface);
    if (left > 0.0) {
      begin = middle;
      above = left;
    } else {
      end = middle;
      below = left;
    }
  }
  return above - below > 0.0 ? mix(begin, end, clamp(above / (above - below), 0.0, 1.0)) : begin;
}

MapHit march(sampler2DArray disparity, sampler2DArray ranges, int layer, ivec2 size, MapRay ray) {
  MapHit miss = MapHit(vec2(0.0), 0.0, 0.0);
  if (ray.length < 0.0) return miss;
  float at = 0.0, s = ray.s_begin, hidden = ray.hidden, surface = -1.0;
  bool before = texel_disparity(disparity, layer, map_texel(ray, 0.0, size)) <= s * (1.0 + kTouching);
  int level = clamp(int(ceil(log2(ray.length))), 1, kRangeLevels);
  ivec2 first_level = textureSize(ranges, 0).xy * ivec2(3, 2) / 3;  // above it lie the others, beside each other
  ivec2 texel = ivec2(0);
  bool hit = false;
  // Squares in a loop of their own: a machine that runs a branch for all pixels or none looks up texels only at their end.
  for (int step = 0; step < kMaxSteps && at < ray.length; ++step) {
    for (; level > 0 && step < kMaxSteps && at < ray.length; ++step) {
      float next = min(at + float(1 << level), ray.length);
      float s_next = ray_disparity(ray, next);
      ivec2 cell = map_texel(ray, 0.5 * (at + next), size) >> level;
      if (level > 1) cell += ivec2(first_level.x - (first_level.x >> (level - 2)), first_level.y);
      vec2 range = kOfCodes * texelFetch(ranges, ivec3(cell, layer), 0).rg;
      if (before ? range.y < s_next : range.x > s) {
        hidden += before ? 0.0 : next - at;
        at = next;
        s = s_next;
        level = min(level + 1, kRangeLevels);
      } else {
        if (before && range.y < s) {
          at = clamp((ray.s_end - range.y) / ray.fall + ray.length, at, max(at, next - 0.5));
          s = ray_disparity(ray, at);
        }
        --level;
      }
    }
    if (level > 0 || step >= kMaxSteps || at >= ray.length) break;
    float next = min(next_border(ray, at), ray.length);
    float s_next = ray_disparity(ray, next);
    texel = map_texel(ray, 0.5 * (at + next), size);
    surface = texel_disparity(disparity, layer, texel);
    // It comes out behind an edge, or through the back of a surface, which it does not meet again at once.
    if (!before)
      before = surface < s_next || (surface < s && !is_connected(disparity, layer, size, ray, at - 2.0 * kBorder, texel, surface));
    if (before && surface >= s_next) {
      hit = surface <= s * (1.0 + kTouching) || is_connected(disparity, layer, size, ray, at - 2.0 * kBorder, texel, surface);
      if (hit) break;
      before = false;
    }
    hidden += before ? 0.0 : next - at;
    at = next;
    s = s_next;
    level = 1;
  }
  if (!hit) return miss;
  float crossing =
      refine_crossing(disparity, layer, size, ray, max(at - 0.5, 0.0), min(at + 1.5, ray.length), surface);
  float trust = 1.0 / (1.0 + kDistrust * hidden / float(max(size.x, size.y)));
  vec2 place = ray.from + crossing * ray.direction;
  float s_mixed = disparity_at(disparity, layer, size, place);
  // Beside another surface its own texel tells, so that nothing of the other is mixed in.
  if (abs(s_mixed - surface) > kMixed * surface)
    return MapHit(vec2(texel) + 0.5, clamp(surface, ray_disparity(ray, min(at + 1.0, ray.length)), s), trust);
  return MapHit(place, ray_disparity(ray, crossing), trust);
}

// 1 / distance along the ray from the mirrored eye to a hit. to_plane: distance to where the ray leaves the plane; pace: length
// of `direction`, whose z is `rise`.
float inverse_distance(float s, float map_eye_z, float to_plane, float pace, float rise) {
  return s * rise / (s * rise * to_plane - map_eye_z * (1.0 - s) * pace);
}
