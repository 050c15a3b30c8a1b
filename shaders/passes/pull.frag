// Half the size: the average of those pixels that hold light (a > 0).
uniform sampler2D u_source;  // one level
uniform ivec2 u_source_size; // pixels in use
layout(location = 0) out vec4 o_light;

void main() {
  ivec2 at = 2 * ivec2(gl_FragCoord.xy);
  vec4 sum = vec4(0.0);
  float count = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 from = at + ivec2(i & 1, i >> 1);
    if (any(greaterThanEqual(from, u_source_size))) continue;
    vec4 light = texelFetch(u_source, from, 0);
    if (light.a <= 0.0) continue;
    sum += light;
    count += 1.0;
  }
  o_light = count > 0.0 ? sum / count : vec4(0.0);
}
