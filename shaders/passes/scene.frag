// The opaque scene: diffuse light, emission, and the undirected reflection where no reflector shows an image.
#include "passes/lightmap.glsl"

uniform sampler2D u_change;  // lux by pixel that movers block
uniform bool u_changed;

vec3 irradiance_here(vec3 normal) {
  vec3 irradiance = irradiance_on(normal);
  if (u_changed) irradiance = max(irradiance - texelFetch(u_change, ivec2(gl_FragCoord.xy), 0).rgb, 0.0);
  return irradiance;
}

#include "passes/opaque.glsl"
