// A mover: shaded as the opaque scene is, its light from transfer by vertex and from bright lights by pixel.
#include "passes/surface.glsl"

uniform sampler2D u_change;  // lux by pixel of bright lights
uniform bool u_changed;

in vec3 v_light;

vec3 irradiance_here(vec3 normal) {
  vec3 irradiance = kPi * max(v_light, 0.0);
  if (u_changed) irradiance += texelFetch(u_change, ivec2(gl_FragCoord.xy), 0).rgb;
  return irradiance;
}

#include "passes/opaque.glsl"
