// What the bake knows of a surface's texels, in colours to be shown as they are.
uniform sampler2D u_base_texture;
uniform float u_alpha;
uniform float u_alpha_cutoff;  // negative: no cut-outs
uniform sampler2D u_survey;
uniform bool u_surveyed;  // false: no lightmap

in vec3 v_position;
in vec3 v_normal;
in vec2 v_uv;
in vec2 v_lightmap_uv;
in vec4 v_color;
in vec2 v_normal_uv;
in vec4 v_tangent;
layout(location = 0) out vec4 o_light;

const vec3 kNothing = vec3(0.1);

void main() {
  if (u_alpha_cutoff >= 0.0 && texture(u_base_texture, v_uv).a * u_alpha * v_color.a < u_alpha_cutoff) discard;
  o_light = vec4(u_surveyed && gl_FrontFacing ? texture(u_survey, v_lightmap_uv).rgb : kNothing, 2.0);
}
