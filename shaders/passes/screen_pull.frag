// Half the size: the average of those pixels that hold light (a > 0).
#include "lib/fill.glsl"

uniform sampler2D u_source;  // one level
uniform ivec2 u_source_size; // pixels in use
uniform float u_reach;       // see farther_average
layout(location = 0) out vec4 o_light;

void main() {
  ivec2 at = 2 * ivec2(gl_FragCoord.xy);
  vec4 light[4];
  for (int i = 0; i < 4; ++i) {
    ivec2 from = at + ivec2(i & 1, i >> 1);
    light[i] = all(lessThan(from, u_source_size)) ? texelFetch(u_source, from, 0) : vec4(0.0);
  }
  o_light = farther_average(light, vec4(1.0), u_reach);
}
