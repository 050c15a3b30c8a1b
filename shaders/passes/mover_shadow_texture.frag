// The light of a lamp that movers take from a flat surface of the scene, by a soft-shadow texture of it.
#include "lib/lit_surface.glsl"

uniform usampler2D u_surfaces;
uniform sampler2D u_atlas;  // lux for a radiance of 1
uniform vec4 u_plane;
uniform float u_touching;
uniform vec4 u_along;  // texel = dot(u_along, (position, 1))
uniform vec4 u_across;
uniform ivec2 u_place;  // in the atlas
uniform ivec2 u_size;
uniform vec3 u_radiance;
layout(location = 0) out vec4 o_lux;

float texel_at(ivec2 texel) {
  return texelFetch(u_atlas, u_place + clamp(texel, ivec2(0), u_size - 1), 0).r;
}

void main() {
  LitSurface surface = unpack_surface(texelFetch(u_surfaces, ivec2(gl_FragCoord.xy), 0));
  if (surface.id != 0 || abs(dot(u_plane.xyz, surface.position) - u_plane.w) > u_touching) discard;
  if (dot(u_plane.xyz, surface.normal) < 0.99) discard;
  vec4 p = vec4(surface.position, 1.0);
  vec2 at = vec2(dot(u_along, p), dot(u_across, p)) - 0.5;
  ivec2 first = ivec2(floor(at));
  vec2 part = at - floor(at);
  float lower = mix(texel_at(first), texel_at(first + ivec2(1, 0)), part.x);
  float upper = mix(texel_at(first + ivec2(0, 1)), texel_at(first + ivec2(1, 1)), part.x);
  o_lux = vec4(u_radiance * mix(lower, upper, part.y), 0.0);
}
