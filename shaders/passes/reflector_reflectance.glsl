// R of a reflector at a pixel, and what it takes to know it.
#include "lib/reflectance.glsl"
#include "lib/shading.glsl"
#include "passes/place_reflectance.glsl"

uniform vec4 u_eye;
uniform vec3 u_normal;           // of the reflector, unit, pack space
uniform sampler2D u_reflectance; // tables
uniform int u_reflectance_row;   // -1: reflects nothing
uniform int u_reflectance_count; // entries of the table
uniform bool u_modulate;         // by R
in vec3 v_position;

float reflector_cosine() { return view_cosine(u_normal, u_normal, v_position, u_eye); }

// 1 for the stages before R.
vec3 reflector_reflectance(float cos_theta) {
  if (!u_modulate) return vec3(1.0);
  if (u_reflectance_row < 0) return vec3(0.0);
  return reflectance_here(reflectance_from_table(u_reflectance, u_reflectance_row, u_reflectance_count, cos_theta));
}
