// The opaque scene: diffuse light, emission, and the undirected reflection where no reflector shows an image.
#include "passes/lightmap.glsl"
#include "lib/taken_light.glsl"

uniform sampler2D u_change;  // BrightChange: what movers block, and where
uniform usampler2D u_surfaces;
#ifdef PLAIN
const vec2 u_change_scale = vec2(0.0);
#else
uniform vec2 u_change_scale;  // of its size over the frame's; 0: nothing is blocked
#endif

vec3 irradiance_here(vec3 normal) {
  vec3 irradiance = irradiance_on(normal);
  if (u_change_scale.x > 0.0) {
    vec2 at = gl_FragCoord.xy * u_change_scale;
    irradiance = max(irradiance - taken_light(u_change, u_surfaces, at, v_position, front_normal()), 0.0);
  }
  return irradiance;
}

#include "passes/opaque.glsl"
