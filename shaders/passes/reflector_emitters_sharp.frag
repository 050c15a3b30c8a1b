// The emitters that a reflector lists, as a mirror shows them, times R: added to compose. What is smaller than a pixel has its light
// spread over one, so that it does not come and go.
#include "lib/lobe_light.glsl"
#include "passes/reflector_reflectance.glsl"
#include "passes/reflector_emitters.glsl"

layout(location = 0) out vec4 o_light;

float s_pixel;  // the angle that the pixel sees
float s_way;    // from the eye to the pixel's point

// As the eye behind the mirror sees it.
float share_of_polygon(vec4 lobe, vec3 corners[4]) {
  vec3 seen[4];
  for (int i = 0; i < 4; ++i) seen[i] = corners[i] + s_way * lobe.xyz;
  return polygon_share(seen, lobe.xyz, s_pixel);
}

void main() {
  vec3 way = normalize(v_position * u_eye.w - u_eye.xyz);
  s_pixel = sqrt(length(cross(dFdx(way), dFdy(way))));
  s_way = u_eye.w * length(mat3(u_emitters_from_pack) * (v_position - u_eye.xyz));
  float cos_theta = reflector_cosine();
  vec4 mirror = vec4(-sqrt(max(0.0, 1.0 - cos_theta * cos_theta)), 0.0, cos_theta, 0.0);
  o_light = vec4(light_of_emitters(mirror) * reflector_reflectance(cos_theta), 1.0);
}
