// The emitters that a glossy reflector's maps leave out, where the mirror ray meets them, times R: added to compose.
#include "lib/lobe_light.glsl"
#include "passes/reflector_reflectance.glsl"
#include "passes/reflector_emitters.glsl"

layout(location = 0) out vec4 o_light;

float share_of_polygon(vec4 lobe, vec3 corners[4]) { return polygon_met(corners, lobe.xyz); }

void main() {
  float cos_theta = reflector_cosine();
  vec4 mirror = vec4(-sqrt(max(0.0, 1.0 - cos_theta * cos_theta)), 0.0, cos_theta, 0.0);
  o_light = vec4(light_of_emitters(mirror) * reflector_reflectance(cos_theta), 1.0);
}
