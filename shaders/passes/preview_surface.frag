// A surface as the baker's paths meet it (bake/scene/shade.h, bake/trace/path.h: surface_at), by pixel.
#include "lib/normal_map.glsl"
in vec3 v_position;
in vec3 v_normal;
in vec2 v_uv0;
in vec2 v_uv1;
in vec4 v_color;
in vec4 v_tangent;
uniform vec4 u_eye;
uniform int u_first_triangle;
uniform sampler2D u_faces;  // geometric normals by triangle, fronts
uniform sampler2D u_base_texture, u_rough_texture, u_emission_texture, u_normal_texture;
// Rows of the images' coordinates from those of the mesh, and which of its two sets.
uniform vec3 u_base_u, u_base_v, u_rough_u, u_rough_v, u_emission_u, u_emission_v, u_normal_u, u_normal_v;
uniform int u_base_set, u_rough_set, u_emission_set, u_normal_set;
uniform vec4 u_base_color;
uniform vec2 u_metal_rough;
uniform vec3 u_emission;
uniform float u_alpha_cutoff;  // < 0: none
uniform bool u_covers;         // alpha is coverage
uniform float u_transmission;
uniform bool u_double_sided;
uniform bool u_normal_mapped;
uniform float u_normal_scale;
uniform bool u_dark;             // a metal by its constants: no diffuse reflection
uniform sampler2D u_left;        // 1 - max R by cosine, and rows
uniform vec2 u_left_rows;        // of the material: the first's centre and how far it is to the last's, roughness 0 to 1
uniform float u_glossy;          // roughness below which a surface is a mirror to tag
layout(location = 0) out vec4 o_place;     // a: triangle + 1
layout(location = 1) out vec4 o_normal;    // a: 1 to be traced
layout(location = 2) out vec4 o_face;
layout(location = 3) out vec4 o_diffuse;   // times irradiance: luminance
layout(location = 4) out vec4 o_emission;

vec2 uv_of(int set, vec3 u, vec3 v) {
  vec3 at = vec3(set == 0 ? v_uv0 : v_uv1, 1.0);
  return vec2(dot(u, at), dot(v, at));
}

vec3 shading_normal(vec3 face, float side, vec3 towards_eye, vec2 uv) {
  float size2 = dot(v_normal, v_normal);
  vec3 n = size2 > 0.0 ? side * v_normal * inversesqrt(size2) : face;
  if (dot(n, towards_eye) <= 0.0) n = face;
  if (!u_normal_mapped) return n;
  vec4 tangent = tangent_of_steps(side * n, dFdx(v_position), dFdy(v_position), dFdx(uv), dFdy(uv));
  if (abs(v_tangent.w) >= 0.5) tangent = vec4(v_tangent.xyz, sign(v_tangent.w));
  vec3 tilted = side * tilted_normal(side * n, tangent, texture(u_normal_texture, uv).rgb, u_normal_scale);
  float missing = 1e-3 - dot(tilted, towards_eye);
  return missing > 0.0 ? normalize(tilted + missing * towards_eye) : tilted;
}

void main() {
  vec4 base = clamp(u_base_color * v_color * texture(u_base_texture, uv_of(u_base_set, u_base_u, u_base_v)), 0.0, 1.0);
  vec4 rough_texel = texture(u_rough_texture, uv_of(u_rough_set, u_rough_u, u_rough_v));
  float metallic = clamp(u_metal_rough.x * rough_texel.b, 0.0, 1.0);
  float roughness = clamp(u_metal_rough.y * rough_texel.g, 0.0, 1.0);
  int triangle = u_first_triangle + gl_PrimitiveID;
  vec3 towards_eye = normalize(u_eye.w > 0.0 ? u_eye.xyz - v_position : u_eye.xyz);
  vec3 front = texelFetch(u_faces, ivec2(triangle % 4096, triangle / 4096), 0).xyz;
  float side = dot(front, towards_eye) >= 0.0 ? 1.0 : -1.0;
  vec3 face = side * front;
  vec3 normal = shading_normal(face, side, towards_eye, uv_of(u_normal_set, u_normal_u, u_normal_v));
  if (base.a < u_alpha_cutoff) discard;
  bool reflects = side > 0.0 || u_double_sided;
  float cosine = clamp(dot(normal, towards_eye), 0.0, 1.0);
  float left = texture(u_left, vec2(sqrt(cosine) * 63.0 / 64.0 + 0.5 / 64.0, u_left_rows.x + roughness * u_left_rows.y)).r;
  float coverage = u_covers ? base.a : 1.0;
  float transmitted = u_transmission * (1.0 - metallic);
  vec3 diffuse = u_dark ? vec3(0.0) : (1.0 - metallic) * (1.0 - u_transmission) * base.rgb;
  bool traced = transmitted > 0.0 || coverage < 1.0 || (reflects && roughness < u_glossy);
  o_place = vec4(v_position, float(triangle + 1));
  o_normal = vec4(normal, traced ? 1.0 : 0.0);
  o_face = vec4(face, 0.0);
  // Lobes too wide to be traced: as much light, in all directions.
  vec3 tint = mix(vec3(1.0), base.rgb / max(max(base.r, base.g), max(base.b, 1e-6)), metallic);
  vec3 wide = roughness < u_glossy ? vec3(0.0) : (1.0 - left) * tint;
  o_diffuse = vec4(reflects ? coverage / 3.14159265 * (left * diffuse + wide) : vec3(0.0), 1.0);
  vec3 emission = u_emission * texture(u_emission_texture, uv_of(u_emission_set, u_emission_u, u_emission_v)).rgb;
  o_emission = vec4(reflects ? coverage * emission : vec3(0.0), 1.0);
}
