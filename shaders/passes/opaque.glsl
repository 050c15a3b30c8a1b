// The light of an opaque surface. To be included after irradiance_here(normal), lux.
uniform sampler2D u_base_texture;
uniform vec4 u_base_color;
#ifdef PLAIN
const float u_alpha_cutoff = -1.0;
const bool u_unlit = false;
#else
uniform float u_alpha_cutoff;  // negative: no cut-outs
uniform bool u_unlit;
#endif
#if defined(PLAIN) && !defined(REFLECTED)
#define NO_DISTANCE
#endif
#include "lib/distance_alpha.glsl"
uniform float u_diffuse_share;  // (1 - metallic) (1 - transmission); 1 - transmission where metalness varies
uniform vec3 u_emission;        // cd/m2, of white texels; of an unlit surface what shows its colour
#ifndef PLAIN
#include "lib/metalness.glsl"
uniform sampler2D u_emission_texture;  // a: metalness
#endif
uniform vec3 u_weights;  // of the diffuse part, the undirected reflection, the emission: 0 or 1

in vec2 v_uv;
in vec4 v_color;
layout(location = 0) out vec4 o_light;  // a: where it tells no distance, the kind of light: 1 cd/m2, 2 that of an unlit surface

float alpha_of_light(float kind) { return u_alpha_kind == 0 ? kind : inverse_distance(u_eye.xyz, v_position); }

void main() {
  vec3 normal = tilted_by_map();
  vec4 base = u_base_color * v_color * texture_along(u_base_texture, v_uv);
  // As the depth pass cuts.
  if (u_alpha_cutoff >= 0.0 && u_base_color.a * v_color.a * texture(u_base_texture, v_uv).a < u_alpha_cutoff) discard;
  if (u_unlit) {
    o_light = vec4(u_weights.z * u_emission * base.rgb, alpha_of_light(u_weights.z > 0.0 ? 2.0 : 1.0));
    return;
  }
  vec3 reflectance = reflectance_of(normal);
  vec3 irradiance = irradiance_here(normal);
  float diffuse_share = u_diffuse_share;
#ifndef PLAIN
  vec4 picture = texture_along(u_emission_texture, v_uv);
  if (u_metal_varies) {
    float metal = u_metal * picture.a;
    reflectance = reflectance_in_place(reflectance, base.rgb, metal);
    diffuse_share *= 1.0 - metal;
  }
#endif
  vec3 light = u_weights.x * diffuse_light(base.rgb * diffuse_share, reflectance, irradiance);
  light += u_weights.y * ambient_reflection(reflectance, irradiance);
#ifdef PLAIN
  light += u_weights.z * u_emission;
#else
  light += u_weights.z * u_emission * picture.rgb;
#endif
  o_light = vec4(light, alpha_of_light(1.0));
}
