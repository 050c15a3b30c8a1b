// A reflector's R where it is metal in places, by its base colour and metalness.
#include "lib/metalness.glsl"
#include "lib/texture_along.glsl"

uniform vec4 u_base_color;
uniform sampler2D u_base_texture;
uniform sampler2D u_metal_texture;
in vec2 v_uv;
in vec4 v_color;

vec3 reflectance_here(vec3 reflectance) {
  if (!u_metal_varies) return reflectance;
  vec3 base = (u_base_color * v_color * texture_along(u_base_texture, v_uv)).rgb;
  return reflectance_in_place(reflectance, base, u_metal * texture_along(u_metal_texture, v_uv).a);
}
