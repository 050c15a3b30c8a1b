// The emitters that a glossy reflector's maps leave out, in closed form, times R: added to compose.
#include "lib/lobe/emitters.glsl"
#include "lib/lobe/kernel.glsl"
#include "lib/lobe/lobe_light.glsl"
#include "passes/reflector/reflectance.glsl"

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
uniform bool u_sharp;            // without a lobe: what the mirror ray meets
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
    int count = int(abs(kind));
    float share = u_sharp ? polygon_met(corners, count, vec3(-sqrt(max(0.0, 1.0 - cos_theta * cos_theta)), 0.0, cos_theta))
                          : reflected_polygon(inverse, 1.0, corners, count);
    sum += visible * max(kind < 0.0 ? abs(share) : share, 0.0) * u_emitter_light[k];
  }
  return sum;
}

void main() {
  float cos_theta = reflector_cosine();
  o_light = vec4(emitters_in_lobe(cos_theta) * reflector_reflectance(cos_theta), 1.0);
}
