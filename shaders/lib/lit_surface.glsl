// What is seen at a pixel, as bright lights on movers need it: position, normal, and the mover (1 and up; 0: the scene).
#include "lib/octahedral.glsl"

struct LitSurface {
  vec3 position;
  vec3 normal;
  int id;  // -1: nothing that is lit
};

const int kNoSurface = 1023;

uvec4 pack_surface(vec3 position, vec3 normal, int id) {
  uvec2 n = uvec2((0.5 + 0.5 * octahedral_from_direction(normal)) * 2047.0 + 0.5);
  return uvec4(floatBitsToUint(position), n.x | n.y << 11 | uint(id) << 22);
}

LitSurface unpack_surface(uvec4 texel) {
  int id = int(texel.w >> 22);
  vec2 p = vec2(texel.w & 2047u, texel.w >> 11 & 2047u) / 1023.5 - 1.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return LitSurface(uintBitsToFloat(texel.xyz), normalize(n), id == kNoSurface ? -1 : id);
}
