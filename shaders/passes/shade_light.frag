// Light that movers take from the scene, of lights that stand for all that comes from everywhere, lux: what the lightmap holds of
// it is not there where a mover is nearer to the light, and nothing else is (Barczak 2006, section 4.3.2).
#include "lib/hemisphere.glsl"
#include "lib/lit_surface.glsl"

uniform usampler2D u_surfaces;
uniform sampler2D u_mask;  // 0: nothing is wanted here
uniform bool u_masked;
uniform sampler2D u_lights;
uniform usampler2D u_list;
uniform int u_first_light;  // of this pass, into the list
uniform int u_light_count;
uniform sampler2DArrayShadow u_mover_depth;  // by light
uniform sampler2DArrayShadow u_still_depth;
uniform float u_mover_side;  // texels
flat in vec3 v_lower;
flat in vec3 v_upper;
layout(location = 0) out vec4 o_lux;

float passes(sampler2DArrayShadow map, int layer, ShadeLight light, vec3 local) {
  vec3 place = map_place(light, local);
  if (local.z <= 0.0 || min(place.x, place.y) < 0.0 || max(place.x, place.y) > 1.0) return 1.0;
  return texture(map, vec4(place.xy, float(layer), place.z));
}

// Share of the light that movers take. A point leaves its surface by the width of a texel of their map there.
float taken_of(int layer, ShadeLight light, LitSurface surface) {
  vec3 towards = normalize(light.from - surface.position), local = local_of(light, surface.position);
  float wide = 2.0 / u_mover_side * height_of(local);
  vec3 off = wide * (surface.normal * (2.0 - dot(surface.normal, towards)) + towards);
  float taken = 1.0 - passes(u_mover_depth, layer, light, local_of(light, surface.position + off));
  return taken > 0.0 ? taken * passes(u_still_depth, layer, light, local) : 0.0;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (u_masked && texelFetch(u_mask, pixel, 0).r < 0.5) discard;
  LitSurface surface = unpack_surface(texelFetch(u_surfaces, pixel, 0));
  if (surface.id != 0 || any(lessThan(surface.position, v_lower)) || any(greaterThanEqual(surface.position, v_upper))) discard;
  int width = textureSize(u_list, 0).x;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < u_light_count; ++i) {
    int at = u_first_light + i;
    int index = int(texelFetch(u_list, ivec2(at % width, at / width), 0).x);
    ShadeLight light = fetch_light(u_lights, index);
    vec3 lux = unshadowed(light, surface.position, surface.normal);
    if (max(lux.r, max(lux.g, lux.b)) <= 0.0) continue;
    sum += taken_of(index, light, surface) * lux;
  }
  o_lux = vec4(sum, 0.0);
}
