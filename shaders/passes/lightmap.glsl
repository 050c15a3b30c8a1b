// Baked light on a surface of the scene that stands still.
#include "passes/surface.glsl"
#include "lib/lightmap_uv.glsl"

uniform sampler2D u_lightmap;
uniform float u_lightmap_scale;  // lux; 0: nothing was baked
uniform sampler2D u_direction;   // of a directional lightmap
uniform bool u_detailed;         // some cells between texels have light of their own
uniform highp usampler2D u_cells;
uniform sampler2D u_detail;
#ifdef PLAIN
const bool u_directional = false;
#else
uniform bool u_directional;
#endif

centroid in vec3 v_lightmap_uv;

// Between the four texels around, or, in a finer cell, between its own points. Where a pixel is as large as a step between
// these they would flicker: the cell fades to its texels until it is as large as their distance.
vec3 lightmap_at(vec2 uv) {
  vec3 light = texture(u_lightmap, uv).rgb;
  if (!u_detailed) return light;
  vec2 at = uv * vec2(textureSize(u_lightmap, 0)) - 0.5;
  vec2 footprint = fwidth(at);
  vec2 last = vec2(textureSize(u_lightmap, 0) - 1);
  at = clamp(at, vec2(0.0), last);
  vec2 corner = min(floor(at), max(last - 1.0, vec2(0.0)));
  DetailBlock block = detail_block(texelFetch(u_cells, ivec2(corner), 0).r);
  if (block.side < 1.5) return light;
  vec2 place = (block.first + (at - corner) * block.side + 0.5) / vec2(textureSize(u_detail, 0));
  float steps = max(footprint.x, footprint.y) * block.side;
  return mix(textureLod(u_detail, place, 0.0).rgb, light, clamp(log2(max(steps, 1.0)) / log2(block.side), 0.0, 1.0));
}

// Lightmaps hold the light of fronts: a back that is lit is a surface of its own.
vec3 irradiance_on(vec3 tilted) {
  vec3 irradiance = lightmap_at(lightmap_uv(v_lightmap_uv)) * u_lightmap_scale;
  if (!gl_FrontFacing) return vec3(0.0);
  if (!u_normal_mapped || !u_directional) return irradiance;
  return irradiance * directional_ratio(texture(u_direction, lightmap_uv(v_lightmap_uv)).xyz, tilted, front_normal());
}
