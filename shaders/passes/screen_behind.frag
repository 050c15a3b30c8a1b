// The frame as glass sees what lies behind it: light, and the depth.
uniform sampler2D u_light;
uniform sampler2D u_depth;
layout(location = 0) out vec4 o_behind;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  o_behind = vec4(texelFetch(u_light, at, 0).rgb, texelFetch(u_depth, at, 0).r);
}
