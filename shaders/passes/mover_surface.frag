// What is seen here.
#include "lib/lit_surface.glsl"

uniform sampler2D u_base_texture;
uniform float u_alpha;
uniform float u_alpha_cutoff;  // negative: no cut-outs
uniform int u_id;

in vec3 v_position;
in vec3 v_normal;
in vec2 v_uv;
in float v_alpha;
layout(location = 0) out uvec4 o_surface;

void main() {
  if (u_alpha_cutoff >= 0.0 && texture(u_base_texture, v_uv).a * u_alpha * v_alpha < u_alpha_cutoff) discard;
  if (dot(v_normal, v_normal) == 0.0) discard;
  o_surface = pack_surface(v_position, gl_FrontFacing ? v_normal : -v_normal, u_id);
}
