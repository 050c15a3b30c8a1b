// What shaded surfaces share: their normals and reflectance.
#include "lib/normal_map.glsl"
#include "lib/reflectance.glsl"
#include "lib/shading.glsl"
#include "lib/texture_along.glsl"

uniform vec4 u_eye;
uniform sampler2D u_normal_texture;
uniform float u_normal_scale;
#ifdef REFLECTED  // what is plain, in the image of a mirror
#define PLAIN
#endif
#ifdef PLAIN  // a program of its own for what most surfaces are: software rasterisers run every branch
const bool u_normal_mapped = false;
#else
uniform bool u_normal_mapped;
#endif
uniform sampler2D u_reflectance;
uniform int u_reflectance_row;  // -1: reflects nothing
uniform int u_reflectance_count;

in vec3 v_position;
centroid in vec3 v_normal;
in vec2 v_normal_uv;
in vec4 v_tangent;

// Of the front, as interpolated; opposite normals may cancel between vertices.
vec3 front_normal() {
  float length2 = dot(v_normal, v_normal);
  return length2 > 0.0 ? v_normal * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
}

// The same with its map; any length where there is no map. To be called before a discard: it takes
// derivatives.
vec3 tilted_by_map() {
  if (!u_normal_mapped) return v_normal;
  vec3 n = front_normal();
  vec4 tangent = tangent_of_steps(n, dFdx(v_position), dFdy(v_position), dFdx(v_normal_uv), dFdy(v_normal_uv));
  if (abs(v_tangent.w) >= 0.5) tangent = vec4(v_tangent.xyz, sign(v_tangent.w));
  return tilted_normal(n, tangent, texture_along(u_normal_texture, v_normal_uv).rgb, u_normal_scale);
}

vec3 reflectance_of(vec3 tilted) {
  if (u_reflectance_row < 0) return vec3(0.0);
  float cos_theta = view_cosine(tilted, v_normal, v_position, u_eye);
  return reflectance_from_table(u_reflectance, u_reflectance_row, u_reflectance_count, cos_theta);
}
