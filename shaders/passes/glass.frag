// A body of glass over what lies behind it: its light is there by pixel (screen_glass), for the middles of pixels that it covers.
// Edges between take a neighbour's.
#include "lib/distance_alpha.glsl"

uniform sampler2D u_shaded;  // a: 0 where there is no light, 2 where 4 x 4 neighbours have looked at a part of it each
uniform vec4 u_eye;
in vec3 v_position;
layout(location = 0) out vec4 o_light;  // a: how far away the glass is

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(u_shaded, 0) - 1;
  vec4 found = texelFetch(u_shaded, at, 0);
  for (int i = 0; i < 4 && found.a == 0.0; ++i) {
    ivec2 step = ivec2(i % 2 * (i - 2), (1 - i % 2) * (i - 1));
    found = texelFetch(u_shaded, clamp(at + step, ivec2(0), last), 0);
  }
  for (int i = 0; i < 4 && found.a == 0.0; ++i)
    found = texelFetch(u_shaded, clamp(at + 2 * ivec2(i % 2, i / 2) - 1, ivec2(0), last), 0);
  if (found.a == 0.0) discard;
  o_light = vec4(found.rgb, inverse_distance(u_eye.xyz, v_position));
  if (found.a < 1.5) return;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 16; ++i) {
    vec4 beside = texelFetch(u_shaded, clamp(at + ivec2(i % 4, i / 4) - 2, ivec2(0), last), 0);
    if (beside.a > 1.5) sum += vec4(beside.rgb, 1.0);
  }
  if (sum.a > 0.0) o_light.rgb = sum.rgb / sum.a;
}
