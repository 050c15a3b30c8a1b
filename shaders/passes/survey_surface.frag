// What is known of a surface, in colours to be shown as they are.
#include "lib/lightmap_uv.glsl"

uniform sampler2D u_base_texture;
uniform float u_alpha;
uniform float u_alpha_cutoff;  // negative: no cut-outs
uniform sampler2D u_survey;
uniform bool u_surveyed;  // false: no lightmap

in vec3 v_position;
centroid in vec3 v_normal;
in vec2 v_uv;
centroid in vec3 v_lightmap_uv;
in vec4 v_color;
in vec2 v_normal_uv;
in vec4 v_tangent;
layout(location = 0) out vec4 o_light;

const vec3 kNothing = vec3(0.1);

void main() {
  if (u_alpha_cutoff >= 0.0 && texture(u_base_texture, v_uv).a * u_alpha * v_color.a < u_alpha_cutoff) discard;
  vec3 shown = u_surveyed && gl_FrontFacing ? texture(u_survey, lightmap_uv(v_lightmap_uv)).rgb : kNothing;
  o_light = vec4(shown, 2.0);
}
