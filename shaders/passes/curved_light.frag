// Curved reflectors. SHADED: their light is there by pixel (screen_curved), for the middles of pixels that they cover: edges
// between take a neighbour's. A program of its own for it: software rasterisers run every branch, and a whole block of pixels
// for each triangle that touches it.
#include "passes/surface.glsl"
#include "passes/curved_lobe.glsl"
#include "lib/mirrored.glsl"

uniform bool u_modulate;  // by R
#ifdef SHADED
uniform sampler2D u_shaded;  // a: whose light it is
uniform float u_id;
#endif
layout(location = 0) out vec4 o_light;

#ifdef SHADED
vec3 shaded_light(vec3 mirror) {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(u_shaded, 0) - 1;
  vec4 found = texelFetch(u_shaded, at, 0);
  float away = found.a == u_id ? 0.0 : 9.0;
  for (int i = 0; i < 9; ++i) {
    ivec2 step = ivec2(i % 3, i / 3) - 1;
    vec4 beside = texelFetch(u_shaded, clamp(at + step, ivec2(0), last), 0);
    float here = float(abs(step.x) + abs(step.y));
    if (beside.a != u_id || here >= away) continue;
    found = beside;
    away = here;
  }
  if (away < 9.0) return found.rgb;
  // Thinner than a pixel: about the same, without its parallax.
  return pyramid_light(u_light, u_size, mirror, u_tap_count > 1 ? log2(float(u_size)) - 2.0 : 0.0);
}
#endif

void main() {
  vec3 tilted = tilted_by_map(), normal;
  float cos_theta;
  vec3 mirror = mirrored(tilted, normalize(v_position * u_eye.w - u_eye.xyz), normal, cos_theta);
#ifdef SHADED
  vec3 light = shaded_light(mirror);
#else
  vec3 light = curved_light(v_position, normal, mirror, cos_theta, spread_of(mirror));
#endif
  light *= u_light_scale;
  o_light = vec4(u_modulate ? light * reflectance_of(tilted) : light, 1.0);
}
