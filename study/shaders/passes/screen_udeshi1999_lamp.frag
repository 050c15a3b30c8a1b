// The light of a point of a lamp on what pixels see, lux; the stencil has what is in its shadow.
#include "lib/incidence.glsl"
uniform sampler2D u_place, u_normal, u_face;
uniform int u_kind;    // 0 flat, 1 punctual, 2 from afar
uniform vec4 u_light;  // homogeneous
uniform vec3 u_front;  // of a flat lamp; a spot's direction
uniform vec3 u_power;
uniform vec2 u_cone;   // cosines of the outer and inner angle; x < -1: none
layout(location = 0) out vec4 o_light;

// Relative to u_power, in a direction that leaves the lamp.
float intensity(vec3 direction) {
  if (u_cone.x < -1.0) return 1.0;
  float t = clamp((dot(u_front, direction) - u_cone.x) / (u_cone.y - u_cone.x), 0.0, 1.0);
  return t * t;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 place = texelFetch(u_place, at, 0);
  if (place.a == 0.0) discard;
  vec3 to = u_light.xyz - place.xyz * u_light.w;
  float d2 = dot(to, to);
  vec3 direction = to * inversesqrt(max(d2, 1e-30));
  vec3 normal = texelFetch(u_normal, at, 0).xyz, face = texelFetch(u_face, at, 0).xyz;
  float light = u_kind == 0 ? incidence(normal, face, direction) * max(-dot(u_front, direction), 0.0)
                            : punctual_incidence(normal, face, direction);
  if (u_kind == 1) light *= intensity(-direction);
  if (u_kind != 2) light /= max(d2, 1e-30);
  o_light = vec4(light * u_power, 1.0);
}
