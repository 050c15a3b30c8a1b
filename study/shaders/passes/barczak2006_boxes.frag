// Light that movers take, in a cell of space.
#include "lib/shade.glsl"

uniform usampler2D u_surfaces;
uniform sampler2D u_mask;  // 0: nothing is wanted here
uniform bool u_masked;
uniform int u_first_light;  // of this pass, into the list
uniform int u_light_count;
flat in vec3 v_lower;
flat in vec3 v_upper;
layout(location = 0) out vec4 o_lux;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (u_masked && texelFetch(u_mask, pixel, 0).r < 0.5) discard;
  LitSurface surface = unpack_surface(texelFetch(u_surfaces, pixel, 0));
  if (surface.id != 0 || any(lessThan(surface.position, v_lower)) || any(greaterThanEqual(surface.position, v_upper))) discard;
  o_lux = vec4(taken_light(u_first_light, u_light_count, surface), 0.0);
}
