// Light in cd/m2 as linear display values, to be added up: frames that are a part of a pixel apart make smooth edges. Each is
// tone-mapped by itself, as samples of a pixel are in the player.
#include "lib/color.glsl"
#include "lib/tonemap.glsl"
uniform sampler2D u_frame;
uniform sampler2D u_before;  // the sum of those before
uniform float u_before_weight;
uniform float u_exposure;    // 1 / (the luminance shown as white)
uniform float u_unlit_exposure;  // of unlit surfaces
uniform bool u_encode;       // the mean, sRGB-encoded
uniform float u_count;
uniform float u_share;       // above 0: that much of the light itself, for the meter
uniform vec2 u_scale;        // pixels of the frame for one that is shown
layout(location = 0) out vec4 o_color;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy * u_scale);
  vec3 sum = u_before_weight > 0.0 ? texelFetch(u_before, at, 0).rgb : vec3(0.0);
  if (u_encode) {
    o_color = vec4(srgb_from_linear(sum / u_count) + dither(gl_FragCoord.xy) / 255.0, 1.0);
    return;
  }
  vec4 light = texelFetch(u_frame, at, 0);
  if (u_share > 0.0) {
    o_color = light * u_share;
    return;
  }
  o_color = vec4(sum + (light.a > 1.5 ? tonemap_none(light.rgb * u_unlit_exposure) : tonemap_aces(light.rgb * u_exposure)), 1.0);
}
