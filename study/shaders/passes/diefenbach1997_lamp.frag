// The opaque scene in the light of one point of a lamp, straight or by mirrors; the stencil has its shadows.
#include "passes/surface.glsl"
#include "lib/incidence.glsl"
#include "lib/light_samples.glsl"

uniform vec4 u_source;  // homogeneous; by mirrors: its image
uniform vec3 u_intensity;
uniform vec3 u_axis;
uniform vec2 u_cones;
uniform bool u_cosine;
uniform int u_mirrors;             // on the way
uniform vec4 u_mirror_normals[3];  // unit, as the last stretch sees them
uniform vec4 u_mirror_tables[3];   // row of R, and its entries

vec3 irradiance_here(vec3 tilted) {
  vec3 towards;
  float lux = facing_irradiance(u_source, u_axis, u_cones, u_cosine, v_position, towards);
  vec3 face = cross(dFdx(v_position), dFdy(v_position));
  face *= inversesqrt(max(dot(face, face), 1e-37));
  if (dot(face, u_eye.xyz - v_position * u_eye.w) < 0.0) face = -face;
  if (!gl_FrontFacing) return vec3(0.0);
  vec3 normal = tilted * inversesqrt(max(dot(tilted, tilted), 1e-37));
  vec3 light = u_intensity * (lux * (u_cosine ? incidence(normal, face, towards) : punctual_incidence(normal, face, towards)));
  for (int i = 0; i < u_mirrors; ++i)
    light *= reflectance_from_table(u_reflectance, int(u_mirror_tables[i].x), int(u_mirror_tables[i].y),
                                    abs(dot(u_mirror_normals[i].xyz, towards)));
  return light;
}

#include "passes/opaque.glsl"
