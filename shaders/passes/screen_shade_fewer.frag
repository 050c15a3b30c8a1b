// One of u_step² pixels.
uniform usampler2D u_surfaces;
uniform int u_step;
layout(location = 0) out uvec4 o_surface;

void main() {
  ivec2 pixel = min(ivec2(gl_FragCoord.xy) * u_step + u_step / 2, textureSize(u_surfaces, 0) - 1);
  o_surface = texelFetch(u_surfaces, pixel, 0);
}
