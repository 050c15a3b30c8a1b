// The emitters that a glossy reflector's maps leave out, in closed form, times R: added to compose.
#include "lib/kernel.glsl"
#include "lib/lobe_light.glsl"
#include "passes/reflector_reflectance.glsl"
#include "passes/reflector_emitters.glsl"

uniform sampler2D u_lobes;       // see upload_lobe_fits(); columns as the rows of kernel_row()
uniform int u_lobe_rows;
layout(location = 0) out vec4 o_light;

const float kLeastCosine = 1e-3;  // of the incidences that lobes are known for

vec3 s_eye;            // of the pixel, surface frame
float s_mean_factor;  // F over its lobe

// F where the half vector is at that cosine (x), and its mean over the lobe at that incidence (y).
vec2 fresnel_factors(float cosine) {
  vec2 at = kernel_row(cosine, u_lobe_rows);
  vec2 low = texelFetch(u_lobes, ivec2(int(at.x), 1), 0).xy;
  return mix(low, texelFetch(u_lobes, ivec2(min(int(at.x) + 1, u_lobe_rows - 1), 1), 0).xy, at.y);
}

// R is the whole lobe's; a lamp at its side is reflected as the facets do that turn it to the eye.
float share_of_polygon(vec4 lobe, vec3 corners[4]) {
  vec3 seen = reflected_vector(lobe, corners);
  if (seen.z == 0.0) return 0.0;
  vec3 half_vector = normalize(from_lobe(lobe, seen.z < 0.0 ? -seen : seen)) + s_eye;
  return seen.z * fresnel_factors(dot(s_eye, normalize(half_vector))).x / s_mean_factor;
}

void main() {
  float cos_theta = reflector_cosine();
  vec2 row = kernel_row(cos_theta, u_lobe_rows);
  vec4 below = texelFetch(u_lobes, ivec2(int(row.x), 0), 0);
  vec4 above = texelFetch(u_lobes, ivec2(min(int(row.x) + 1, u_lobe_rows - 1), 0), 0);
  s_eye = vec3(sqrt(max(0.0, 1.0 - cos_theta * cos_theta)), 0.0, cos_theta);
  s_mean_factor = max(fresnel_factors(cos_theta).y, 1e-6);
  vec4 lobe = lobe_in_surface_frame(mix_lobes(below, above, row.y), max(cos_theta, kLeastCosine));
  o_light = vec4(light_of_emitters(lobe) * reflector_reflectance(cos_theta), 1.0);
}
