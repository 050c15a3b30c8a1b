// The light of a lamp that movers take from a flat surface of the scene, by a soft-shadow texture of it.
#include "lib/lit_surface.glsl"

uniform usampler2D u_surfaces;
uniform sampler2D u_texture;  // lux for a radiance of 1, 0 at its edges
uniform vec4 u_plane;
uniform float u_touching;
uniform vec4 u_along;  // place in the texture, 0 to 1: dot(u_along, (position, 1))
uniform vec4 u_across;
uniform vec3 u_radiance;
layout(location = 0) out vec4 o_lux;

void main() {
  LitSurface surface = unpack_surface(texelFetch(u_surfaces, ivec2(gl_FragCoord.xy), 0));
  if (surface.id != 0 || abs(dot(u_plane.xyz, surface.position) - u_plane.w) > u_touching) discard;
  if (dot(u_plane.xyz, surface.normal) < 0.99) discard;
  vec4 p = vec4(surface.position, 1.0);
  float lux = texture(u_texture, vec2(dot(u_along, p), dot(u_across, p))).r;
  o_lux = vec4(u_radiance * lux, 0.0);
}
