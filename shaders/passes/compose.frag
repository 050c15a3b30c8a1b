// (M * K) R on a reflector (Bastos et al. 1999, section 8.2.2).
#include "lib/reflectance.glsl"
#include "lib/shading.glsl"

uniform sampler2D u_image;       // M * K
uniform vec2 u_texture_size;
uniform vec2 u_image_size;       // pixels in use
uniform vec2 u_origin;           // of the image in the frame, pixels
uniform float u_scale;           // image pixels per frame pixel
uniform vec3 u_missing;          // light where no map shows anything
uniform vec4 u_eye;
uniform vec3 u_normal;           // of the reflector, unit, pack space
uniform sampler2D u_reflectance; // tables, or the sphere map
uniform int u_reflectance_row;   // -1: reflects nothing
uniform int u_reflectance_count; // entries of the table, or width of the sphere map
uniform bool u_sphere_map;
uniform bool u_modulate;         // by R
in vec3 v_position;
layout(location = 0) out vec4 o_light;

void main() {
  vec2 at = clamp((gl_FragCoord.xy - u_origin) * u_scale, vec2(0.5), max(u_image_size - 0.5, vec2(0.5)));
  vec4 image = textureLod(u_image, at / u_texture_size, 0.0);
  vec3 light = image.a > 0.0 ? image.rgb : u_missing;
  if (u_modulate) {
    vec3 reflectance = vec3(0.0);
    if (u_reflectance_row >= 0) {
      float cos_theta = view_cosine(u_normal, u_normal, v_position, u_eye);
      reflectance = u_sphere_map
          ? texture(u_reflectance, sphere_map_uv(cos_theta, vec2(0.70710678), float(u_reflectance_count))).rgb
          : reflectance_from_table(u_reflectance, u_reflectance_row, u_reflectance_count, cos_theta);
    }
    light *= reflectance;
  }
  o_light = vec4(light, 1.0);
}
