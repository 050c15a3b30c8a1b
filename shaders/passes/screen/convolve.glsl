// M * K (Bastos et al. 1999, section 8.2.1). K is given as taps of equal energy around the mirror direction, by incidence. A tap
// is carried to the mirrored image at the distance that M has there, so that what touches the reflector stays sharp and what is
// far away blurs: footprint d / (d + e) of the angle, e from the eye to the plane, d from there to the hit. Where near and far
// lie side by side, each tap looks for what it meets itself.
#include "lib/lobe/kernel.glsl"

uniform sampler2D u_image;     // M, filled, with all its coarser levels
uniform ivec2 u_image_size;    // pixels in use
uniform vec2 u_texture_size;
uniform vec4 u_ndc_from_image; // scale, offset
uniform vec2 u_tangents;       // view-space x, y over -z at ndc 1; orthographic: half sizes in metres
uniform float u_ortho;
uniform vec3 u_plane_normal;   // view space, towards the eye's side
uniform float u_plane_offset;  // dot(normal, point of the plane)
uniform float u_farthest;      // metres: distances are cut off here
uniform float u_constant_footprint;  // not negative: share of the angle (metres where orthographic) for all distances
uniform float u_median;        // tangent of the radius that holds half of the lobe
uniform float u_pixels_per_tangent;  // of the image, at its centre
uniform int u_coarse;          // pixels along a side of one of u_blurred
uniform sampler2D u_taps;      // see kernel_tap()
uniform int u_tap_count;
uniform int u_tap_rows;

const float kVaried = 0.5;    // relative: neighbours whose 1 / distance differs by less lie at the same distance
const int kSteps = 6;          // of a tap that looks for itself
const float kStep = 3.0;       // by which they grow
const float kSame = 0.02;      // relative: a surface so near to a point of a ray is met there

vec4 image_at(vec2 pixel, float level) {
  float margin = 0.5 * exp2(ceil(level));
  vec2 size = vec2(u_image_size);
  vec2 at = clamp(pixel, min(vec2(margin), 0.5 * size), max(size - margin, 0.5 * size));
  return textureLod(u_image, at / u_texture_size, level);
}

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

// How far behind the plane the pixel's image lies.
float distance_behind(vec2 pixel, float to_plane) {
  if (u_constant_footprint >= 0.0)
    return u_ortho > 0.5 ? u_constant_footprint : to_plane * u_constant_footprint / max(1.0 - u_constant_footprint, 1e-6);
  float level = log2(max(0.25 * u_median * u_pixels_per_tangent / float(u_coarse), 1.0));
  return max(1.0 / max(image_at(pixel, level).a, 1.0 / u_farthest) - to_plane, 0.0);
}

// Pixels that a tangent spans at such a distance.
float pixels_at(float behind, float to_plane) {
  return u_pixels_per_tangent * (u_ortho > 0.5 ? behind : behind / (behind + to_plane));
}

float lobe_radius(vec2 pixel) {
  PlaneHit hit = plane_hit(pixel);
  return hit.valid ? u_median * pixels_at(distance_behind(pixel, hit.distance), hit.distance) : 0.0;
}

// Whether what lies around is nearer or farther than what the pixel shows.
bool is_varied(vec2 pixel) {
  if (u_constant_footprint >= 0.0) return false;
  float reach = log2(max(2.0 * u_median * u_pixels_per_tangent, 1.0)), own = image_at(pixel, 0.0).a;
  vec2 around = vec2(image_at(pixel, max(reach - 1.5, 0.0)).a, image_at(pixel, reach).a);
  return any(greaterThan(abs(around - own), vec2(kVaried * own)));
}

vec2 pixel_of(vec3 at) {
  vec2 ndc = at.xy / (u_ortho > 0.5 ? u_tangents : u_tangents * max(-at.z, 1e-12));
  return (ndc - u_ndc_from_image.zw) / u_ndc_from_image.xy;
}

float distance_of(vec3 at) { return u_ortho > 0.5 ? -at.z : length(at); }

// What a ray from the plane meets in the image, in steps that grow with the distance; width: its own, a tangent.
vec3 light_met(PlaneHit from, vec3 direction, float width, float farthest) {
  float t = farthest * pow(kStep, -float(kSteps - 1)), before = from.distance;
  vec4 found = vec4(0.0);
  for (int i = 0; i < kSteps; ++i, t *= kStep) {
    vec3 at = from.at + t * direction;
    if (u_ortho < 0.5 && at.z >= 0.0) break;
    float pixels = width * pixels_at(t, from.distance);
    found = image_at(pixel_of(at), log2(max(pixels, 1.0)));
    float seen = 1.0 / max(found.a, 1.0 / u_farthest), here = distance_of(at);
    if (seen < here * (1.0 + kSame) && seen >= before * (1.0 - kSame)) {
      float share = clamp((seen - from.distance) / max(here - from.distance, 1e-6 * here), 0.0, 1.0);
      return image_at(pixel_of(from.at + share * t * direction), log2(max(share * pixels, 1.0))).rgb;
    }
    before = here;
  }
  return found.rgb;
}

// The light at a pixel of the image, its centre, and 1 / distance, 0 where nothing is seen. by_tap: each tap looks for what it
// meets, instead of taking the pixel's distance.
vec4 convolved(vec2 pixel, bool by_tap) {
  vec4 centre = image_at(pixel, 0.0);
  PlaneHit from = plane_hit(pixel);
  if (!from.valid || centre.a <= 0.0) return centre;
  float behind = distance_behind(pixel, from.distance);
  float farthest = behind;
  if (by_tap) {
    float reach = log2(max(2.0 * u_median * u_pixels_per_tangent, 1.0));
    farthest = max(1.0 / max(min(image_at(pixel, reach).a, centre.a), 1.0 / u_farthest) - from.distance, behind);
  }
  // In the mirrored world the view ray is the mirror direction, and the surface's normal points away from the eye.
  vec3 along = -u_plane_normal - from.cos_theta * from.view;
  vec3 side = cross(from.view, abs(from.view.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0));
  along = dot(along, along) > 1e-8 ? normalize(along) : normalize(side);
  vec3 across = cross(from.view, along);
  float to_pixels = pixels_at(behind, from.distance);
  vec2 row = kernel_row(from.cos_theta, u_tap_rows);

  vec3 sum = vec3(0.0);
  float total = 0.0;
  // Two loops, not one with a branch inside: software rasterisers run both sides of a branch.
  int near_and_far = by_tap ? u_tap_count : 0, even = by_tap ? 0 : u_tap_count;
  for (int i = 0; i < near_and_far; ++i) {
    vec4 tap = kernel_tap(u_taps, i, row);
    vec3 direction = lobe_direction(from.view, across, along, tap.xy);
    if (dot(direction, u_plane_normal) >= 0.0) continue;
    sum += tap.w * light_met(from, direction, tap.z, farthest);
    total += tap.w;
  }
  for (int i = 0; i < even; ++i) {
    vec4 tap = kernel_tap(u_taps, i, row);
    vec3 direction = lobe_direction(from.view, across, along, tap.xy), at = from.at + behind * direction;
    if (dot(direction, u_plane_normal) >= 0.0 || (u_ortho < 0.5 && at.z >= -1e-6 * from.distance)) continue;
    float weight = u_constant_footprint >= 0.0 ? 1.0 : tap.w;  // published: all directions weigh alike
    sum += weight * image_at(pixel_of(at), log2(max(tap.z * to_pixels, 1.0))).rgb;
    total += weight;
  }
  return total > 0.0 ? vec4(sum / total, centre.a) : centre;
}
