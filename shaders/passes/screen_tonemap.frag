// Light in cd/m2 to the screen. Samples of a pixel are tone-mapped one by one: the mean of their light would show a lamp's edge
// as bright as the lamp.
#include "lib/color.glsl"
#include "lib/tonemap.glsl"
#ifdef MULTISAMPLED
uniform sampler2DMS u_frame;
uniform int u_samples;
#else
uniform sampler2D u_frame;
const int u_samples = 1;
#endif
uniform ivec2 u_frame_size;
uniform float u_exposure;  // 1 / (the luminance shown as white)
uniform float u_unlit_exposure;  // of unlit surfaces
uniform int u_curve;       // 0 none, 1 aces
layout(location = 0) out vec4 o_color;

vec3 shown(vec4 light) {
  if (light.a > 1.5) return tonemap_none(light.rgb * u_unlit_exposure);  // colours that are to be shown as they are
  vec3 exposed = light.rgb * u_exposure;
  return u_curve == 1 ? tonemap_aces(exposed) : tonemap_none(exposed);
}

void main() {
  ivec2 at = min(ivec2(gl_FragCoord.xy), u_frame_size - 1);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < u_samples; ++i) sum += shown(texelFetch(u_frame, at, i));
  o_color = vec4(srgb_from_linear(sum / float(u_samples)) + dither(gl_FragCoord.xy) / 255.0, 1.0);
}
