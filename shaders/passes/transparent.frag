// See-through surfaces. Those that tint what lies behind are drawn twice: once to dim it, once to add their own light.
#include "passes/lightmap.glsl"

uniform sampler2D u_base_texture;
uniform vec4 u_base_color;
uniform float u_alpha_cutoff;  // negative: no cut-outs; what covers is cut from there up, where it is drawn as opaque
uniform bool u_covers;         // alpha is coverage; else the surface is whole
uniform float u_diffuse_share;
uniform float u_transmission;
uniform vec3 u_emission;
uniform sampler2D u_emission_texture;
uniform bool u_unlit;
uniform vec3 u_weights;
uniform bool u_dimming;  // write what the surface lets through instead of its light

in vec2 v_uv;
in vec4 v_color;
layout(location = 0) out vec4 o_light;

void main() {
  vec3 normal = tilted_by_map();
  vec4 base = u_base_color * v_color * texture_along(u_base_texture, v_uv);
  // As the depth pass cuts.
  float cut = u_base_color.a * v_color.a * texture(u_base_texture, v_uv).a;
  if (u_alpha_cutoff >= 0.0 && (cut < u_alpha_cutoff) != u_covers) discard;
  float coverage = u_covers ? clamp(base.a, 0.0, 1.0) : 1.0;
  vec3 reflectance = u_unlit ? vec3(0.0) : reflectance_of(normal);
  if (u_dimming) {
    vec3 through = u_unlit ? vec3(0.0) : base.rgb * u_transmission * (1.0 - max_channel(reflectance));
    o_light = vec4(1.0 - coverage + coverage * through, 1.0);
    return;
  }
  vec3 irradiance = irradiance_on(normal);
  vec3 light = u_weights.x * diffuse_light(base.rgb * u_diffuse_share, reflectance, irradiance);
  light += u_weights.y * ambient_reflection(reflectance, irradiance);
  light += u_weights.z * u_emission * texture_along(u_emission_texture, v_uv).rgb;
  if (u_unlit) light = u_weights.z * u_emission * base.rgb;
  o_light = vec4(coverage * light, coverage);
}
