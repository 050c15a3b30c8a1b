// Sums of log2 luminance over blocks of the frame, for the exposure. Black pixels and unlit ones do not count.
#include "lib/color.glsl"
uniform sampler2D u_frame;
uniform ivec2 u_frame_size;
uniform int u_block;
layout(location = 0) out vec4 o_sum;  // sum, count

void main() {
  ivec2 from = ivec2(gl_FragCoord.xy) * u_block;
  ivec2 to = min(from + u_block, u_frame_size);
  vec2 sum = vec2(0.0);
  for (int y = from.y; y < to.y; ++y) {
    for (int x = from.x; x < to.x; ++x) {
      vec4 light = texelFetch(u_frame, ivec2(x, y), 0);
      float value = luminance(light.rgb);
      if (light.a > 1.5 || !(value > 0.0)) continue;
      sum += vec2(log2(max(value, 1e-6)), 1.0);
    }
  }
  o_sum = vec4(sum, 0.0, 0.0);
}
