// A picture as glass sees what lies behind it: light, and the depth. Beyond its edges its last pixels go on.
uniform sampler2D u_light;
uniform sampler2D u_depth;
uniform ivec2 u_size;      // of the picture, pixels
uniform bool u_oblique;    // its near plane is a mirror's: depth becomes that without it
uniform vec4 u_depth_row;  // which is this times x, y, z, 1 in normalised device coordinates
layout(location = 0) out vec4 o_behind;

void main() {
  ivec2 at = min(ivec2(gl_FragCoord.xy), u_size - 1);
  float depth = texelFetch(u_depth, at, 0).r;
  if (u_oblique && depth < 1.0) {
    vec3 ndc = 2.0 * vec3((vec2(at) + 0.5) / vec2(u_size), depth) - 1.0;
    depth = clamp(0.5 * dot(u_depth_row, vec4(ndc, 1.0)) + 0.5, 0.0, 0.9999999);
  }
  o_behind = vec4(texelFetch(u_light, at, 0).rgb, depth);
}
