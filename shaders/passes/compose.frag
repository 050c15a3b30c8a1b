// (M * K) R on a reflector (Bastos et al. 1999, section 8.2.2), with the emitters that M leaves out in closed form.
#include "lib/emitters.glsl"
#include "lib/kernel.glsl"
#include "lib/lobe_light.glsl"
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
const int kEmitters = 16;
uniform int u_emitter_count;
uniform vec4 u_emitter_corners[4 * kEmitters];  // reflector space; w of the first: how many, negative where both sides shine
uniform vec3 u_emitter_light[kEmitters];        // cd/m2
uniform sampler2D u_visibility;  // see visible_share()
uniform ivec2 u_visibility_nodes;
uniform vec2 u_lower;            // bounds of the reflector
uniform vec2 u_upper;
uniform sampler2D u_lobes;       // inverse matrices in the mirror direction's frame by incidence, rows as kernel_row()
uniform int u_lobe_rows;
uniform mat4 u_reflector_from_pack;
in vec3 v_position;
layout(location = 0) out vec4 o_light;

const float kLeastCosine = 1e-3;  // of the incidences that lobes are known for

// What the lobe, of integral 1, shows of the emitters.
vec3 emitters_in_lobe(float cos_theta) {
  vec3 place = (u_reflector_from_pack * vec4(v_position, 1.0)).xyz;
  vec3 to_eye = mat3(u_reflector_from_pack) * (u_eye.xyz - v_position * u_eye.w);
  vec2 x = dot(to_eye.xy, to_eye.xy) > 0.0 ? normalize(to_eye.xy) : vec2(1.0, 0.0);
  vec2 row = kernel_row(cos_theta, u_lobe_rows);
  vec4 below = texelFetch(u_lobes, ivec2(int(row.x), 0), 0);
  vec4 above = texelFetch(u_lobes, ivec2(min(int(row.x) + 1, u_lobe_rows - 1), 0), 0);
  vec4 inverse = lobe_in_surface_frame(mix_lobes(below, above, row.y), max(cos_theta, kLeastCosine));
  vec3 sum = vec3(0.0);
  for (int k = 0; k < u_emitter_count; ++k) {
    float visible = visible_share(u_visibility, u_visibility_nodes, k, (place.xy - u_lower) / (u_upper - u_lower));
    if (visible <= 0.0) continue;
    vec3 corners[kMostCorners];
    for (int i = 0; i < 4; ++i) {
      vec3 v = u_emitter_corners[4 * k + i].xyz - vec3(place.xy, 0.0);
      corners[i] = vec3(dot(v.xy, x), dot(v.xy, vec2(-x.y, x.x)), v.z);
    }
    float kind = u_emitter_corners[4 * k].w;
    float share = reflected_polygon(inverse, 1.0, corners, int(abs(kind)));
    sum += visible * max(kind < 0.0 ? abs(share) : share, 0.0) * u_emitter_light[k];
  }
  return sum;
}

void main() {
  vec2 at = clamp((gl_FragCoord.xy - u_origin) * u_scale, vec2(0.5), max(u_image_size - 0.5, vec2(0.5)));
  vec4 image = textureLod(u_image, at / u_texture_size, 0.0);
  vec3 light = image.a > 0.0 ? image.rgb : u_missing;
  float cos_theta = view_cosine(u_normal, u_normal, v_position, u_eye);
  if (u_emitter_count > 0) light += emitters_in_lobe(cos_theta);
  if (u_modulate) {
    vec3 reflectance = vec3(0.0);
    if (u_reflectance_row >= 0) {
      reflectance = u_sphere_map
          ? texture(u_reflectance, sphere_map_uv(cos_theta, vec2(0.70710678), float(u_reflectance_count))).rgb
          : reflectance_from_table(u_reflectance, u_reflectance_row, u_reflectance_count, cos_theta);
    }
    light *= reflectance;
  }
  o_light = vec4(light, 1.0);
}
