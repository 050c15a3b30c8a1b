// A mover: shaded as the opaque scene is, its light from transfer by vertex and from bright lights by pixel.
#include "passes/surface.glsl"
#include "lib/lit_surface.glsl"

uniform sampler2D u_change;     // lux by pixel of bright lights
uniform usampler2D u_surfaces;  // where there is any
uniform bool u_changed;

in vec3 v_light;

// Of a pixel whose middle this mover does not cover, that beside it.
vec3 bright_light() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(u_change, 0) - 1;
  for (int i = 0; i < 9; ++i) {
    int k = (i + 4) % 9;  // itself first
    ivec2 texel = clamp(at + ivec2(k % 3, k / 3) - 1, ivec2(0), last);
    if (int(texelFetch(u_surfaces, texel, 0).w >> 22) != kNoSurface) return texelFetch(u_change, texel, 0).rgb;
  }
  return vec3(0.0);
}

vec3 irradiance_here(vec3 normal) {
  vec3 irradiance = kPi * max(v_light, 0.0);
  if (u_changed) irradiance += bright_light();
  return irradiance;
}

#include "passes/opaque.glsl"
