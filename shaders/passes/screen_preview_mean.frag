// The frame so far: the mean of passes, or what these and whole paths make together.
uniform sampler2D u_sum;     // of passes
uniform sampler2D u_paths;   // both together (blend_paths.h)
uniform bool u_has_paths;
uniform float u_passes;
layout(location = 0) out vec4 o_light;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 light = texelFetch(u_sum, at, 0).rgb / u_passes;
  if (u_has_paths) {
    ivec2 size = textureSize(u_paths, 0);
    light = texelFetch(u_paths, ivec2(at.x, size.y - 1 - at.y), 0).rgb;
  }
  o_light = vec4(light, 1.0);
}
