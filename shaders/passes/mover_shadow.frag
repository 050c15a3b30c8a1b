// The share that a mover takes of each of four points of a light. On the scene: of what the scene lets through, as its lightmap
// holds no more. On the mover itself: together with the scene.
#include "lib/lit_surface.glsl"

const float kMapSize = 256.0;  // texels of a layer, shared by the points

uniform usampler2D u_surfaces;
uniform sampler2DArrayShadow u_mover_depth;
uniform sampler2DArrayShadow u_scene_depth;
uniform int u_layer;
uniform vec4 u_at[4];  // LightSamples
uniform int u_points;
uniform mat4 u_places[4];  // place_from_pack
uniform vec4 u_depths[4];  // depth_terms of the mover's map and the scene's
uniform vec4 u_tangents;   // Shaft
uniform int u_caster;
layout(location = 0) out vec4 o_taken;

// Share of the light that passes what a map holds. place: [0, 1] inside, and the distance along the shaft or one over it.
float passes(sampler2DArrayShadow map, vec2 texel, vec2 terms, float along) {
  return texture(map, vec4(texel / kMapSize, float(u_layer), clamp(terms.x + terms.y * along, 0.0, 1.0)));
}

float taken_of(int i, LitSurface surface) {
  vec3 towards = normalize(u_at[i].xyz - surface.position * u_at[i].w);
  float side = u_points > 1 ? 2.0 : 1.0, tile = kMapSize / side;
  // Texels of the map are that wide here: the point leaves its surface by as much.
  float wide = 2.0 / tile * u_tangents[i] * (u_places[i] * vec4(surface.position, 1.0)).w;
  vec3 off = surface.normal * (2.0 - dot(surface.normal, towards)) + towards;
  vec4 place = u_places[i] * vec4(surface.position + wide * off, 1.0);
  if (max(abs(place.x), abs(place.y)) >= place.w) return 0.0;
  vec2 corner = tile * vec2(float(i & 1), float(i >> 1));
  vec2 texel = corner + clamp((0.5 + 0.5 * place.xy / place.w) * tile, 0.5, tile - 0.5);
  float along = u_at[i].w == 0.0 ? place.z : 1.0 / place.z;
  float mover = passes(u_mover_depth, texel, u_depths[i].xy, along);
  float still = surface.id == 0 || surface.id == u_caster ? passes(u_scene_depth, texel, u_depths[i].zw, along) : 1.0;
  return surface.id == 0 ? still * (1.0 - mover) : 1.0 - still * mover;
}

void main() {
  LitSurface surface = unpack_surface(texelFetch(u_surfaces, ivec2(gl_FragCoord.xy), 0));
  // Constant indices: some drivers gather what a loop's index names, pixel by pixel.
  o_taken = vec4(taken_of(0, surface), taken_of(1, surface), taken_of(2, surface), taken_of(3, surface));
}
