// What a flat frosted pane's facets send to the eye of points, spots and suns on its other side: times the density with which they send
// the eye's ray there, GGX facets that mirror it at the pane (docs/materials.md, "Frosted panes").
#include "lib/reflectance.glsl"

uniform vec4 u_eye;
uniform vec3 u_lit_normal;       // unit, towards the lights
uniform vec3 u_tint;
uniform float u_width;           // alpha of its facets
uniform sampler2D u_base_texture;
uniform sampler2D u_reflectance;
uniform int u_reflectance_row;   // -1: reflects nothing
uniform int u_reflectance_count;
in vec3 v_position;
in vec2 v_uv;
in vec4 v_color;
layout(location = 0) out vec4 o_light;

#include "passes/reflector_emitters.glsl"

// Of directions that facets turn wo (unit, z > 0) to, where h (any length) lies between: D G1 / (4 cos theta), after visible normals.
float density_of(vec3 wo, vec3 h) {
  if (h.z <= 0.0) return 0.0;
  float a2 = u_width * u_width, along = h.z * h.z, all = dot(h, h);
  float slope = (all - along + a2 * along) / all;  // cos^2 (a2 - 1) + 1, without cancelling
  float d = a2 / max(3.14159265359 * slope * slope, 1e-30);
  float g1 = 2.0 * wo.z / (wo.z + sqrt(a2 + (1.0 - a2) * wo.z * wo.z));
  return d * g1 / (4.0 * wo.z);
}

// lobe.xyz: the eye, mirrored at the pane.
float share_of_polygon(vec4 lobe, vec3 v[4]) {
  vec3 middle = 0.25 * (v[0] + v[1] + v[2] + v[3]), area = cross(v[1] - v[0], v[2] - v[0]);
  if (v[3] == v[2]) middle = (v[0] + v[1] + v[2]) / 3.0, area *= 0.5;
  float way = length(middle);
  vec3 wi = middle / way;
  float density = density_of(lobe.xyz, lobe.xyz + wi) + density_of(lobe.xyz, lobe.xyz + vec3(wi.xy, -wi.z));
  return -dot(area / way, wi) / way * density;
}

void main() {
  float cos_theta = -dot(u_lit_normal, normalize(u_eye.xyz - v_position * u_eye.w));
  vec4 tint = vec4(u_tint, 1.0) * v_color * texture(u_base_texture, v_uv);
  if (cos_theta <= 1e-4) discard;
  vec3 mirrored = vec3(sqrt(max(0.0, 1.0 - cos_theta * cos_theta)), 0.0, cos_theta);
  vec3 r = u_reflectance_row < 0
               ? vec3(0.0)
               : reflectance_from_table(u_reflectance, u_reflectance_row, u_reflectance_count, cos_theta);
  vec3 passed = tint.rgb * (1.0 - max(max(r.r, r.g), r.b));
  o_light = vec4(passed * light_of_emitters(vec4(mirrored, 0.0)), 0.0);
}
