// M by marching each pixel's reflected ray through the radiance maps of its element: the best ones blended, the others asked only
// where those see nothing.
#include "lib/march.glsl"

const int kMaps = 16;             // kMostMapsPerElement
const float kLeastTrust = 0.2;    // below, what is hidden before a hit (a 30th of the map's width) may be nearer: filled from beside it errs less
const float kSure = 0.6;          // from here on (a 200th of the width) a hit is one: others count only where no map has such a one
const float kLeastWeight = 0.01;  // of a map whose own weight is 0
const float kSameDepth = 0.05;   // hits whose distances differ by less, relatively, are of one surface

uniform sampler2DArray u_light;      // of the maps, over u_maps[].w
uniform sampler2DArray u_disparity;
uniform sampler2DArray u_ranges;
uniform int u_count;
uniform int u_blended;       // so many are asked in any case
uniform vec4 u_eyes[kMaps];  // reflector space; w: weight
uniform vec4 u_maps[kMaps];  // width, height, layer, scale of light
uniform vec2 u_lower;        // the element
uniform vec2 u_upper;
uniform vec4 u_mirrored_eye;  // reflector space; w = 0: the direction to it
uniform vec4 u_depth_row;     // view-space -z of a point of reflector space = dot(row, point)
uniform float u_ortho;        // 1: distances run along the view direction
uniform float u_pixel;        // tangent of an image pixel, or its metres
uniform float u_hole;         // what a holds where nothing is seen
uniform float u_closest;      // 1 / distance is never stored smaller: marks the sky as seen

in vec2 v_on_plane;
layout(location = 0) out vec4 o_light;

// Pixels of the map under one of the image, across the wider of the two. s_distance: the hit's disparity times its distance from
// the mirrored eye, finite for the sky too.
float map_pixels(MapHit hit, vec4 map, float s_distance) {
  vec2 pixel = (u_upper - u_lower) / map.xy;
  float footprint = u_pixel * (u_ortho > 0.5 ? hit.s : s_distance);
  return max(footprint / max(pixel.x, pixel.y), 1e-6);
}

vec3 light_of_hit(MapHit hit, vec4 map, float pixels) {
  float coarsest = floor(log2(max(map.x, map.y)) + 1e-3);
  float level = clamp(log2(pixels), 0.0, coarsest);
  // Beyond the map's own texels of a level lies nothing.
  float texel = exp2(ceil(level));
  vec2 last = (max(floor(map.xy / texel), 1.0) - 0.5) * texel;
  vec2 at = clamp(hit.at, vec2(0.5 * texel), last) / vec2(textureSize(u_light, 0).xy);
  return textureLod(u_light, vec3(at, map.z), level).rgb * map.w;
}

void main() {
  o_light = vec4(vec3(0.0), u_hole);
  vec3 on_plane = vec3(v_on_plane, 0.0);
  vec3 direction = on_plane * u_mirrored_eye.w - u_mirrored_eye.xyz;
  if (!(direction.z > 0.0) || u_count == 0) return;
  float pace = length(direction);
  float to_plane = u_ortho > 0.5 ? dot(u_depth_row, vec4(on_plane, 1.0)) : pace;

  // Beyond the reflector's edges, where only blurring looks, the best map must do: there, or else at the edge. Filled from afar such a
  // pixel would shine into the foot of a wall.
  bool inside = all(greaterThanEqual(v_on_plane, u_lower)) && all(lessThanEqual(v_on_plane, u_upper));
  int count = inside ? u_count : min(u_count, 1);
  vec2 place = v_on_plane;
  bool at_edge = inside, sure = false;
  vec4 sum = vec4(0.0);
  float total = 0.0;
  int i = 0;
  do {  // asks at the end, so that no round is begun for nothing
    vec4 map = u_maps[i];
    vec3 eye = u_eyes[i].xyz;
    MapRay ray = map_ray(eye, u_lower, u_upper, map.xy, place, direction);
    MapHit hit = march(u_disparity, u_ranges, int(map.z), ivec2(map.xy), ray);
    if (hit.trust > (sure ? kSure : kLeastTrust)) {
      if (!sure && hit.trust > kSure) {
        sure = true;
        sum = vec4(0.0);
        total = 0.0;
      }
      float inverse = clamp(inverse_distance(hit.s, eye.z, to_plane, pace, direction.z), u_closest, 1e18);
      float s_distance = hit.s * to_plane - eye.z * (1.0 - hit.s) * pace / max(direction.z, 1e-6 * pace);
      vec4 light = vec4(light_of_hit(hit, map, map_pixels(hit, map, s_distance)), inverse);
      // Maps that do not agree about the distance do not mix: the weightier ones win.
      float weight = max(u_eyes[i].w, kLeastWeight) * hit.trust * hit.trust * smoothstep(kLeastTrust, 1.5 * kLeastTrust, hit.trust);
      if (total > 0.0) {
        float mean = sum.a / total;
        float agreement = exp2(-pow(abs(inverse - mean) / (kSameDepth * max(inverse, mean)), 2.0));
        float vote = (weight + total * agreement) / (total + weight * agreement);
        weight *= vote * vote;
      }
      sum += weight * light;
      total += weight;
    }
    ++i;
    if (!at_edge && total == 0.0) {
      at_edge = true;
      place = clamp(v_on_plane, u_lower, u_upper);
      i = 0;
    }
  } while (i < count && (i < u_blended || !sure));
  if (total > 0.0) o_light = sum / total;
}
