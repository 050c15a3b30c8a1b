// Curved reflectors. SHADED: their light is there by pixel (screen_curved), for the middles of pixels that they cover: edges
// between take a neighbour's. A program of its own for it: software rasterisers run every branch, and a whole block of pixels
// for each triangle that touches it.
#include "passes/surface.glsl"
#include "passes/place_reflectance.glsl"
#include "passes/curved_lobe.glsl"
#include "lib/mirrored.glsl"

uniform bool u_modulate;  // by R
layout(location = 0) out vec4 o_light;

#ifdef SHADED
uniform sampler2D u_shaded, u_normals;  // a of the light: whose it is
uniform float u_id;
const float kStep = 0.01, kOther = 0.5;  // of unit normals: what a pixel's step counts as; another side's

// Of the pixels around, whose light is of such a side of the reflector: its normal is nearest, a step away counts as kStep.
vec3 shaded_light(vec3 normal, vec3 mirror) {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(u_shaded, 0) - 1;
  // Thinner than a pixel: about the same, without its parallax.
  vec3 found = pyramid_light(u_light, u_size, mirror, u_tap_count > 1 ? log2(float(u_size)) - 2.0 : 0.0);
  float least = kOther;
  for (int i = 0; i < 9 && least > kStep; ++i) {
    ivec2 step = ivec2((i + 4) % 3, (i + 4) % 9 / 3) - 1, beside = clamp(at + step, ivec2(0), last);
    vec4 shaded = texelFetch(u_shaded, beside, 0);
    float away = distance(texelFetch(u_normals, beside, 0).xyz, normal) + kStep * float(abs(step.x) + abs(step.y));
    if (shaded.a == u_id && away < least) found = shaded.rgb, least = away;
  }
  return found;
}
#endif

void main() {
  vec3 tilted = tilted_by_map(), normal;
  float cos_theta;
  vec3 mirror = mirrored(tilted, normalize(v_position * u_eye.w - u_eye.xyz), normal, cos_theta);
#ifdef SHADED
  vec3 light = shaded_light(normal, mirror);
#else
  vec3 light = curved_light(v_position, normal, mirror, cos_theta, spread_of(mirror));
#endif
  light *= u_light_scale;
  o_light = vec4(u_modulate ? light * reflectance_here(reflectance_of(tilted)) : light, 1.0);
}
