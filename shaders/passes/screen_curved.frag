// A curved reflector's light, once by pixel.
#include "passes/curved_lobe.glsl"
#include "lib/mirrored.glsl"

uniform sampler2D u_places;  // of curved_surface
uniform sampler2D u_normals;
uniform vec4 u_eye;
uniform float u_id;
layout(location = 0) out vec4 o_light;  // over u_light_scale; a: whose it is

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 place = texelFetch(u_places, at, 0);
  vec3 normal;
  float cos_theta;
  vec3 mirror = mirrored(texelFetch(u_normals, at, 0).xyz, normalize(place.xyz * u_eye.w - u_eye.xyz), normal, cos_theta);
  o_light = vec4(curved_light(place.xyz, normal, mirror, cos_theta, place.a), u_id);
}
