// Baked light on a surface of the scene that stands still.
#include "passes/surface.glsl"
#include "lib/lightmap_uv.glsl"

uniform sampler2D u_lightmap;
uniform float u_lightmap_scale;  // lux; 0: nothing was baked
uniform sampler2D u_direction;   // of a directional lightmap
#ifdef PLAIN
const bool u_directional = false;
#else
uniform bool u_directional;
#endif

centroid in vec3 v_lightmap_uv;

// Lightmaps hold the light of fronts: a back that is lit is a surface of its own.
vec3 irradiance_on(vec3 tilted) {
  vec3 irradiance = texture(u_lightmap, lightmap_uv(v_lightmap_uv)).rgb * u_lightmap_scale;
  if (!gl_FrontFacing) return vec3(0.0);
  if (!u_normal_mapped || !u_directional) return irradiance;
  return irradiance * directional_ratio(texture(u_direction, lightmap_uv(v_lightmap_uv)).xyz, tilted, front_normal());
}
