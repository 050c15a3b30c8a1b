// Where a curved reflector is and how it is turned, by pixel.
#include "passes/surface.glsl"
#include "lib/mirrored.glsl"

layout(location = 0) out vec4 o_place;   // a: how far the directions part that neighbouring pixels are mirrored into, radians
layout(location = 1) out vec4 o_normal;  // unit

void main() {
  vec3 tilted = tilted_by_map(), normal;
  float cos_theta;
  vec3 mirror = mirrored(tilted, normalize(v_position * u_eye.w - u_eye.xyz), normal, cos_theta);
  o_place = vec4(v_position, spread_of(mirror));
  o_normal = vec4(normal, 1.0);
}
