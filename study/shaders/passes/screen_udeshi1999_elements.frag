// Reflected light: that of elements, which reflect what comes to them, without shadows (Udeshi & Hansen 1999, section 3).
#include "lib/incidence.glsl"
uniform sampler2D u_place, u_normal, u_face;
uniform int u_count;
uniform vec4 u_elements[64];  // a: added to squares of distances (LampPoint::soft)
uniform vec3 u_fronts[64];
uniform vec3 u_powers[64];    // radiance times area: what leaves along the normal, cd
layout(location = 0) out vec4 o_light;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 place = texelFetch(u_place, at, 0);
  if (place.a == 0.0) discard;
  vec3 normal = texelFetch(u_normal, at, 0).xyz, face = texelFetch(u_face, at, 0).xyz, sum = vec3(0.0);
  for (int i = 0; i < u_count; ++i) {
    vec3 to = u_elements[i].xyz - place.xyz;
    float d2 = dot(to, to);
    vec3 direction = to * inversesqrt(max(d2, 1e-30));
    float share = max(-dot(u_fronts[i], direction), 0.0) * incidence(normal, face, direction);
    sum += share / (d2 + u_elements[i].a) * u_powers[i];
  }
  o_light = vec4(sum, 1.0);
}
