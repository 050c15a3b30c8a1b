// Light in cd/m2 to the screen.
#include "lib/color.glsl"
#include "lib/tonemap.glsl"
uniform sampler2D u_frame;
uniform ivec2 u_frame_size;
uniform float u_exposure;  // 1 / (the luminance shown as white)
uniform int u_curve;       // 0 none, 1 aces
layout(location = 0) out vec4 o_color;

void main() {
  vec4 light = texelFetch(u_frame, min(ivec2(gl_FragCoord.xy), u_frame_size - 1), 0);
  vec3 exposed = light.rgb * u_exposure;
  vec3 shown = u_curve == 1 ? tonemap_aces(exposed) : tonemap_none(exposed);
  if (light.a > 1.5) shown = tonemap_none(light.rgb);
  o_color = vec4(srgb_from_linear(shown), 1.0);
}
