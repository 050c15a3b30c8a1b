// Pixels without light take it from the next coarser level, bilinearly; levels above have no holes left.
uniform sampler2D u_fine;    // one level, with holes
uniform sampler2D u_coarse;  // the level above, filled
uniform ivec2 u_coarse_size; // pixels in use; 0: there is no level above
layout(location = 0) out vec4 o_light;

vec4 coarse_at(ivec2 at) { return texelFetch(u_coarse, clamp(at, ivec2(0), u_coarse_size - 1), 0); }

void main() {
  o_light = texelFetch(u_fine, ivec2(gl_FragCoord.xy), 0);
  if (o_light.a > 0.0 || u_coarse_size.x == 0) return;
  vec2 at = 0.5 * gl_FragCoord.xy - 0.5;
  ivec2 low = ivec2(floor(at));
  vec2 t = at - vec2(low);
  vec4 bottom = mix(coarse_at(low), coarse_at(low + ivec2(1, 0)), t.x);
  vec4 top = mix(coarse_at(low + ivec2(0, 1)), coarse_at(low + ivec2(1, 1)), t.x);
  o_light = mix(bottom, top, t.y);
}
