// Light that a curved reflector mirrors: the eye ray is reflected about the normal; the lobe is taps of the kernel, each from the
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

// Light from around a direction of a bundle that leaves the surface at `origin` and meets something at that distance; spread is
// its width in radians.
vec3 light_along(vec3 origin, vec3 direction, float inverse_distance, float spread) {
  vec3 from_centre = direction + origin * inverse_distance;
  float stretch = length(from_centre);
  if (stretch < 1e-3) return vec3(0.0);
  from_centre /= stretch;
  float texels = spread / stretch * octahedral_density(from_centre, u_size);
  return pyramid_light(u_light, u_size, from_centre, log2(max(texels, 1.0)));
}

const float kOverlap = 1.6;  // of taps: squares side by side, interpolated, show as creases on rough balls
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
    float width = kOverlap * max(tap.z, 1e-6) / (1.0 + 0.25 * dot(tap.xy, tap.xy));  // an angle
    float weight = tap.w * clamp(0.5 + dot(direction, normal) / width, 0.0, 1.0);  // of what the horizon leaves of it
    if (weight <= 0.0) continue;
    float inverse = u_wide ? tap_distance(origin, direction) : inverse_distance;
    sum += weight * light_along(origin, direction, inverse, max(width, spread));
    total += weight;
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
