// Light between the pixels of a picture of fewer, where all four around are of this pixel's surface; elsewhere it is marked, to be
// found by itself (Barczak 2006, section 4.3.3).
#include "lib/lit_surface.glsl"

uniform usampler2D u_surfaces;
uniform usampler2D u_fewer;
uniform sampler2D u_light;  // of the fewer
uniform int u_step;
layout(location = 0) out vec4 o_lux;
layout(location = 1) out vec4 o_mask;

const float kSamePlane = 0.02;   // of the distance
const float kSameNormal = 0.98;  // cosine

void main() {
  LitSurface here = unpack_surface(texelFetch(u_surfaces, ivec2(gl_FragCoord.xy), 0));
  o_lux = vec4(0.0);
  o_mask = vec4(here.id == 0 ? 1.0 : 0.0);
  if (here.id != 0) return;
  vec2 at = (gl_FragCoord.xy - 0.5 - float(u_step / 2)) / float(u_step), first = floor(at), part = at - first;
  ivec2 last = textureSize(u_light, 0) - 1;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 step = ivec2(i & 1, i >> 1), texel = clamp(ivec2(first) + step, ivec2(0), last);
    if (any(greaterThanEqual(texel * u_step + u_step / 2, textureSize(u_surfaces, 0)))) return;
    LitSurface there = unpack_surface(texelFetch(u_fewer, texel, 0));
    vec3 off = there.position - here.position;
    if (there.id != 0 || dot(there.normal, here.normal) < kSameNormal || abs(dot(off, here.normal)) > kSamePlane * length(off) + 1e-6) return;
    vec2 near = mix(1.0 - part, part, vec2(step));
    sum += near.x * near.y * texelFetch(u_light, texel, 0).rgb;
  }
  o_lux = vec4(sum, 0.0);
  o_mask = vec4(0.0);
}
