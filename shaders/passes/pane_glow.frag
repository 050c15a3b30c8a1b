// What a frosted pane's facets send to the eye of points, spots and suns on its other side: times the density with which they send the
// eye's ray there, GGX facets that mirror it at the pane (docs/notes/materials.md, "Frosted panes"). Bent panes by their normal.
#include "lib/reflectance.glsl"

uniform vec4 u_eye;
uniform vec3 u_tint;
uniform float u_width;           // alpha of its facets
uniform sampler2D u_base_texture;
uniform sampler2D u_reflectance;
uniform int u_reflectance_row;   // -1: reflects nothing
uniform int u_reflectance_count;
in vec3 v_position;
centroid in vec3 v_normal;
in vec2 v_uv;
in vec4 v_color;
layout(location = 0) out vec4 o_light;

#include "passes/reflector_emitters.glsl"

// Of the pixel, in the frame of light_of_emitters():
vec3 s_normal;    // unit, towards the lights
vec3 s_mirrored;  // the eye, mirrored at the pane
float s_height;   // over the pane's plane

// Of directions that facets turn the mirrored eye to, where h (any length) lies between: D G1 / (4 cos theta), after visible normals.
float density_of(vec3 h) {
  float along = dot(h, s_normal), cos_o = dot(s_mirrored, s_normal);
  if (along <= 0.0) return 0.0;
  float a2 = u_width * u_width, all = dot(h, h);
  float slope = (all - along * along + a2 * along * along) / all;  // cos^2 (a2 - 1) + 1, without cancelling
  float d = a2 / max(3.14159265359 * slope * slope, 1e-30);
  float g1 = 2.0 * cos_o / (cos_o + sqrt(a2 + (1.0 - a2) * cos_o * cos_o));
  return d * g1 / (4.0 * cos_o);
}

float share_of_polygon(vec4 lobe, vec3 v[4]) {
  vec3 middle = 0.25 * (v[0] + v[1] + v[2] + v[3]), area = cross(v[1] - v[0], v[2] - v[0]);
  if (v[3] == v[2]) middle = (v[0] + v[1] + v[2]) / 3.0, area *= 0.5;
  middle.z -= s_height;
  float way = length(middle);
  vec3 wi = middle / way;
  float cos_i = dot(wi, s_normal);
  if (cos_i <= 0.0) return 0.0;
  float density = density_of(s_mirrored + wi) + density_of(s_mirrored + wi - 2.0 * cos_i * s_normal);
  return min(length(area / way) / way * density, 1.0);  // squares turn to the pane; 1: a lobe narrower than the light
}

void main() {
  mat3 to_pane = mat3(u_emitters_from_pack);
  vec3 eye = normalize(to_pane * (u_eye.xyz - v_position * u_eye.w)), normal = normalize(to_pane * v_normal);
  vec4 tint = vec4(u_tint, 1.0) * v_color * texture(u_base_texture, v_uv);
  normal *= normal.z < 0.0 ? -1.0 : 1.0;
  vec2 x = dot(eye.xy, eye.xy) > 0.0 ? normalize(eye.xy) : vec2(1.0, 0.0);
  s_normal = vec3(dot(normal.xy, x), dot(normal.xy, vec2(-x.y, x.x)), normal.z);
  vec3 to_eye = vec3(length(eye.xy), 0.0, eye.z);
  float cos_theta = -dot(s_normal, to_eye);
  if (cos_theta <= 1e-4) discard;
  s_mirrored = to_eye + 2.0 * cos_theta * s_normal;
  s_height = (u_emitters_from_pack * vec4(v_position, 1.0)).z;
  vec3 r = u_reflectance_row < 0
               ? vec3(0.0)
               : reflectance_from_table(u_reflectance, u_reflectance_row, u_reflectance_count, cos_theta);
  vec3 passed = tint.rgb * (1.0 - max(max(r.r, r.g), r.b));
  o_light = vec4(passed * light_of_emitters(vec4(0.0)), 0.0);
}
