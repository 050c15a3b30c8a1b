// M from a coarse image of it, bilinearly: all of it (EVERYWHERE), or where the blur is wide enough for that.
#include "passes/screen_blur_width.glsl"

uniform sampler2D u_marched;
uniform vec2 u_marched_scale;  // texture coordinates a pixel of the image
uniform vec2 u_marched_last;   // of the last coarse pixel in use
uniform float u_least_radius;  // of the lobe, pixels
layout(location = 0) out vec4 o_light;

void main() {
  o_light = textureLod(u_marched, min(gl_FragCoord.xy * u_marched_scale, u_marched_last), 0.0);
#ifdef EVERYWHERE
  if (o_light.a < 0.0) o_light = vec4(0.0);
#else
  // By the nearest thing around: beside an edge the interpolated distance is neither's.
  vec2 texels = vec2(textureSize(u_marched, 0));
  ivec2 low = ivec2(floor(gl_FragCoord.xy * u_marched_scale * texels - 0.5)), last = ivec2(u_marched_last * texels);
  float inverse = o_light.a;
  for (int i = 0; i < 4; ++i)
    inverse = max(inverse, texelFetch(u_marched, clamp(low + ivec2(i & 1, i >> 1), ivec2(0), last), 0).a);
  PlaneHit hit = plane_hit(gl_FragCoord.xy);
  float radius = u_median * pixels_at(behind_plane(inverse, hit.distance), hit.distance);
  if (!hit.valid || !(o_light.a > 0.0 && radius >= u_least_radius)) discard;
#endif
}
