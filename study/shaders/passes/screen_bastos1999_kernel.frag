// M * K by one kernel for the whole image, (Bastos et al. 1999, section 8.2.1).
uniform sampler2D u_image;   // M; a 1 / distance, and black where nothing is known
uniform ivec2 u_image_size;  // pixels in use
uniform sampler2D u_kernel;  // see study/bastos1999/pixel_kernel.h
uniform int u_radius;
layout(location = 0) out vec4 o_light;

void main() {
  ivec2 middle = ivec2(gl_FragCoord.xy);
  o_light = vec4(0.0);
  for (int y = -u_radius; y <= u_radius; ++y)
    for (int x = -u_radius; x <= u_radius; ++x) {
      ivec2 at = clamp(middle + ivec2(x, y), ivec2(0), u_image_size - 1);
      o_light += texelFetch(u_kernel, ivec2(x, y) + u_radius, 0).r * texelFetch(u_image, at, 0);
    }
}
