// Pixels without light take it from the next coarser level, bilinearly, from behind rather than from before; levels above have
// no holes left.
#include "lib/fill.glsl"

uniform sampler2D u_fine;    // one level, with holes
uniform sampler2D u_coarse;  // the level above, filled
uniform ivec2 u_coarse_size; // pixels in use; 0: there is no level above
uniform float u_reach;       // see farther_average
layout(location = 0) out vec4 o_light;

void main() {
  o_light = texelFetch(u_fine, ivec2(gl_FragCoord.xy), 0);
  if (o_light.a > 0.0 || u_coarse_size.x == 0) return;
  vec2 at = 0.5 * gl_FragCoord.xy - 0.5;
  ivec2 low = ivec2(floor(at));
  vec2 t = at - vec2(low);
  vec4 light[4];
  for (int i = 0; i < 4; ++i) {
    ivec2 from = clamp(low + ivec2(i & 1, i >> 1), ivec2(0), u_coarse_size - 1);
    light[i] = texelFetch(u_coarse, from, 0);
  }
  o_light = farther_average(light, vec4((1.0 - t.x) * (1.0 - t.y), t.x * (1.0 - t.y), (1.0 - t.x) * t.y, t.x * t.y), u_reach);
}
