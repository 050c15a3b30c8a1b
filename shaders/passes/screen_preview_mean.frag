// The frame so far: the mean of passes, and of whole paths by as much as those are trusted.
uniform sampler2D u_sum;     // of passes
uniform sampler2D u_paths;   // their mean; alpha: weight, [0,1]
uniform bool u_has_paths;
uniform float u_passes;
layout(location = 0) out vec4 o_light;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 light = texelFetch(u_sum, at, 0).rgb / u_passes;
  if (u_has_paths) {
    ivec2 size = textureSize(u_paths, 0);
    vec4 paths = texelFetch(u_paths, ivec2(at.x, size.y - 1 - at.y), 0);
    light = mix(light, paths.rgb, paths.a);
  }
  o_light = vec4(light, 1.0);
}
