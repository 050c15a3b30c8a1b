// What is known of a surface, in colours to be shown as they are.
#include "lib/lightmap_uv.glsl"

uniform sampler2D u_base_texture;
uniform float u_alpha;
uniform float u_alpha_cutoff;  // negative: no cut-outs
uniform sampler2D u_survey;
uniform bool u_surveyed;   // false: no lightmap
uniform int u_mode;        // 0: by texel, 1: what each surface adds to a pixel, 2: plain, lit from the eye
uniform vec3 u_added;      // 1
uniform vec4 u_eye;        // 2: w = 0 is a direction
uniform vec3 u_box_lower;  // 2: what lies in it is tinted
uniform vec3 u_box_upper;
uniform vec3 u_tint;

in vec3 v_position;
in vec3 v_normal;
in vec2 v_uv;
centroid in vec3 v_lightmap_uv;
in vec4 v_color;
in vec2 v_normal_uv;
in vec4 v_tangent;
layout(location = 0) out vec4 o_light;

const vec3 kNothing = vec3(0.1);

vec3 plain() {
  vec3 to_eye = normalize(u_eye.xyz - u_eye.w * v_position);
  float facing = abs(dot(normalize(v_normal), to_eye));
  bool inside = all(greaterThanEqual(v_position, u_box_lower)) && all(lessThanEqual(v_position, u_box_upper));
  return (0.05 + 0.2 * facing) * (inside ? u_tint : vec3(1.0));
}

void main() {
  if (u_alpha_cutoff >= 0.0 && texture(u_base_texture, v_uv).a * u_alpha * v_color.a < u_alpha_cutoff) discard;
  vec3 shown = u_surveyed && gl_FrontFacing ? texture(u_survey, lightmap_uv(v_lightmap_uv)).rgb : kNothing;
  if (u_mode == 1) shown = u_added;
  if (u_mode == 2) shown = plain();
  o_light = vec4(shown, 2.0);
}
