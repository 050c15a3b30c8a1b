// The emitters that a glossy reflector's maps leave out, in closed form, times R: added to compose.
#include "lib/lobe/kernel.glsl"
#include "lib/lobe/lobe_light.glsl"
#include "passes/reflector/reflectance.glsl"
#include "passes/reflector/emitters.glsl"

uniform sampler2D u_lobes;       // inverse matrices in the mirror direction's frame by incidence, rows as kernel_row()
uniform int u_lobe_rows;
layout(location = 0) out vec4 o_light;

const float kLeastCosine = 1e-3;  // of the incidences that lobes are known for

float share_of_polygon(vec4 lobe, vec3 corners[4]) { return reflected_polygon(lobe, corners); }

void main() {
  float cos_theta = reflector_cosine();
  vec2 row = kernel_row(cos_theta, u_lobe_rows);
  vec4 below = texelFetch(u_lobes, ivec2(int(row.x), 0), 0);
  vec4 above = texelFetch(u_lobes, ivec2(min(int(row.x) + 1, u_lobe_rows - 1), 0), 0);
  vec4 lobe = lobe_in_surface_frame(mix_lobes(below, above, row.y), max(cos_theta, kLeastCosine));
  o_light = vec4(light_of_emitters(lobe) * reflector_reflectance(cos_theta), 1.0);
}
