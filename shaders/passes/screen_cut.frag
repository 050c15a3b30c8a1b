// Pixels of M beside the reflector become holes, to be filled from those on it, where something stands between the eye and the
// plane: past a wall that meets the reflector at its edge M shows what lies behind that wall, which no lobe sees. Past a free edge
// lobes see what M shows there; if M does not hold the whole scene but what is seen on the reflector, where that is a surface.
#include "passes/screen_blur_width.glsl"
uniform mat4 u_reflector_from_view;
uniform vec4 u_reflector_bounds;  // on its plane: lower, upper
uniform sampler2D u_depth;        // of what the reflector is seen in
uniform sampler2D u_image_depth;  // of M
uniform bool u_whole;             // M holds the whole scene
uniform ivec2 u_view_size;        // of that, pixels
uniform mat4 u_clip_from_view;
layout(location = 0) out vec4 o_light;

const float kAround = 2.0;     // pixels
const float kOnPlane = 1e-4;  // of the distance: what is so little before the plane lies on it

bool on_reflector(PlaneHit hit, vec2 margin) {
  vec2 p = (u_reflector_from_view * vec4(hit.at, 1.0)).xy;
  return all(greaterThan(p, u_reflector_bounds.xy + margin)) && all(lessThan(p, u_reflector_bounds.zw - margin));
}

bool free_before(PlaneHit hit) {
  vec4 clip = u_clip_from_view * vec4(hit.at - kOnPlane * hit.distance * hit.view, 1.0);
  vec3 window = 0.5 * clip.xyz / clip.w + 0.5;
  ivec2 pixel = ivec2(floor(window.xy * vec2(u_view_size)));
  if (!hit.valid || any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, u_view_size))) return false;
  return texelFetch(u_depth, pixel, 0).r >= window.z;
}

void main() {
  PlaneHit hit = plane_hit(gl_FragCoord.xy);
  vec2 p = (u_reflector_from_view * vec4(hit.at, 1.0)).xy;
  vec2 margin = min(0.5 * fwidth(p), 0.25 * (u_reflector_bounds.zw - u_reflector_bounds.xy));  // rounding decides about half a pixel
  if (on_reflector(hit, margin)) discard;
  // At the very edge the depth is the reflector's own: what stands there is seen a little further.
  bool open = u_whole || texelFetch(u_image_depth, ivec2(gl_FragCoord.xy), 0).r < 1.0;
  for (int k = 0; k < 9 && open; ++k) {
    PlaneHit near = plane_hit(gl_FragCoord.xy + kAround * vec2(k % 3 - 1, k / 3 - 1));
    open = on_reflector(near, margin) || free_before(near);
  }
  if (open) discard;
  o_light = vec4(0.0);
}
