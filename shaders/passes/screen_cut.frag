// Pixels of M beside the reflector become holes, to be filled from those on it: past a wall that meets the reflector at its edge M
// shows what lies behind that wall, which no lobe sees.
#include "passes/screen_blur_width.glsl"
uniform mat4 u_reflector_from_view;
uniform vec4 u_reflector_bounds;  // on its plane: lower, upper
layout(location = 0) out vec4 o_light;

void main() {
  vec2 p = (u_reflector_from_view * vec4(plane_hit(gl_FragCoord.xy).at, 1.0)).xy;
  vec2 margin = min(0.5 * fwidth(p), 0.25 * (u_reflector_bounds.zw - u_reflector_bounds.xy));  // rounding decides about half a pixel
  if (all(greaterThan(p, u_reflector_bounds.xy + margin)) && all(lessThan(p, u_reflector_bounds.zw - margin))) discard;
  o_light = vec4(0.0);
}
