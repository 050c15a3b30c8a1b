// Baked light on a surface of the scene that stands still.
#include "passes/surface.glsl"
#include "lib/lightmap_uv.glsl"
#ifdef SHARP  // a program of its own for pages with such light, likewise
#include "lib/sharp_light.glsl"
#endif

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
#ifdef SHARP
centroid in vec3 v_lit_position;  // beside the triangle, behind a wall, lies another shadow
#endif

const float kFullyFine = 1.5;  // steps between places up to which all points show: bilinear ones are two wide
const float kFewPlaces = 8.0;  // steps along a side up to which four places are enough, else sixteen

// The finest that is known at a place, in texels from the centre of the first: between a finer cell's own points, or texels.
vec3 finest_light(vec2 at) {
  vec2 size = vec2(textureSize(u_lightmap, 0));
  at = clamp(at, vec2(0.0), size - 1.0);
  vec2 corner = min(floor(at), max(size - 2.0, vec2(0.0)));
  DetailBlock block = detail_block(texelFetch(u_cells, ivec2(corner), 0).r);
  if (block.side < 1.5) return textureLod(u_lightmap, (at + 0.5) / size, 0.0).rgb;
  vec2 place = (block.first + (at - corner) * block.side + 0.5) / vec2(textureSize(u_detail, 0));
  return textureLod(u_detail, place, 0.0).rgb;
}

// A pixel that is wider than a cell's step is averaged over four places, in a row where it is long, else in a square; over
// four around each of them where the cell has more than eight steps. Where these are too few points would flicker: the cell
// fades to its texels until places are as far from each other as they.
vec3 lightmap_at(vec2 uv) {
  vec3 light = texture(u_lightmap, uv).rgb;
  if (!u_detailed) return light;
  vec2 size = vec2(textureSize(u_lightmap, 0));
  vec2 at = uv * size - 0.5;
  vec2 dx = dFdx(at), dy = dFdy(at);
  vec2 corner = min(floor(clamp(at, vec2(0.0), size - 1.0)), max(size - 2.0, vec2(0.0)));
  float side = detail_block(texelFetch(u_cells, ivec2(corner), 0).r).side;
  if (side < 1.5) return light;
  bool along_x = dot(dx, dx) > dot(dy, dy);
  vec2 longer = along_x ? dx : dy, shorter = along_x ? dy : dx;
  float length_of_longer = length(longer);
  if (length_of_longer * side <= 1.0) return finest_light(at);
  bool row = length_of_longer > 2.0 * length(shorter);
  float apart = row ? max(0.25 * length_of_longer, length(shorter)) : 0.5 * length_of_longer;
  if (apart >= 1.0) return light;
  vec3 sum = vec3(0.0);
  int around = side > kFewPlaces ? 4 : 1;
  for (int k = 0; k < 4; ++k) {
    vec2 place = row ? vec2(0.25 * float(k) - 0.375, 0.0) : vec2(0.5 * float(k & 1) - 0.25, 0.5 * float(k >> 1) - 0.25);
    int j = 0;
    do {
      vec2 beside = around == 1 ? vec2(0.0) : 0.25 * vec2(float(j & 1) - 0.5, float(j >> 1) - 0.5) * (row ? vec2(0.5, 2.0) : vec2(1.0));
      sum += finest_light(at + (place.x + beside.x) * longer + (place.y + beside.y) * shorter);
    } while (++j < around);
  }
  side = min(side, kFewPlaces);
  float faded = log2(max(apart * side / kFullyFine, 1.0)) / log2(side / kFullyFine);
  return mix(sum / float(4 * around), light, clamp(faded, 0.0, 1.0));
}

vec3 baked_light() {
  vec2 uv = lightmap_uv(v_lightmap_uv);
  return lightmap_at(uv) * u_lightmap_scale;
}

// Lightmaps hold the light of fronts: a back that is lit is a surface of its own.
vec3 irradiance_on(vec3 tilted) {
  vec3 irradiance = baked_light();
#ifdef SHARP
  vec3 dx = dFdx(v_position), dy = dFdy(v_position);
#endif
  if (!gl_FrontFacing) return vec3(0.0);
  if (u_normal_mapped && u_directional)
    irradiance *= directional_ratio(texture(u_direction, lightmap_uv(v_lightmap_uv)).xyz, tilted, front_normal());
#ifdef SHARP
  vec3 normal = u_normal_mapped ? normalize(tilted) : front_normal();
  irradiance += sharp_light(lightmap_uv(v_lightmap_uv), v_lit_position / v_lightmap_uv.z, dx, dy, normal);
#endif
  return irradiance;
}
