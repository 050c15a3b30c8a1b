// Marching a reflected ray through the distances around a point (formats/assets/surround_map.h), the same as
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
