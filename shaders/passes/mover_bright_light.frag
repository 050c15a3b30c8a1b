// What movers change of up to four points of a bright light, lux: on a mover, the light that reaches it; on the scene around, the
// light that movers take from it, which its lightmap holds.
#include "lib/light_samples.glsl"
#include "lib/lit_surface.glsl"

uniform usampler2D u_surfaces;
uniform sampler2D u_taken;  // share by point
uniform vec4 u_at[4];       // LightSamples
uniform int u_points;
uniform vec3 u_intensity;  // of one point
uniform vec3 u_axis;
uniform vec2 u_cones;
uniform bool u_cosine;
uniform int u_receiver;  // LitSurface::id
uniform mat4 u_box_from_pack;
uniform vec4 u_share;  // of the light, linear over the mover's box
layout(location = 0) out vec4 o_lux;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  LitSurface surface = unpack_surface(texelFetch(u_surfaces, pixel, 0));
  if (surface.id != u_receiver) discard;
  vec4 taken = texelFetch(u_taken, pixel, 0);
  float sum = 0.0;
  for (int i = 0; i < u_points; ++i) {
    vec3 towards;
    float lux = facing_irradiance(u_at[i], u_axis, u_cones, u_cosine, surface.position, towards);
    sum += lux * max(dot(surface.normal, towards), 0.0) * (u_receiver == 0 ? taken[i] : 1.0 - taken[i]);
  }
  float share = 1.0;
  if (u_receiver != 0) share = clamp(dot(u_share, vec4(1.0, (u_box_from_pack * vec4(surface.position, 1.0)).xyz)), 0.0, 1.0);
  o_lux = vec4(u_intensity * (share * sum), 0.0);
}
