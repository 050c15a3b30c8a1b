// M * K (Bastos et al. 1999, section 8.2.1). K is given as taps of equal energy around the mirror direction, by incidence. A tap
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
