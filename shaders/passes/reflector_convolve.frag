// (M * K) R on a reflector (Bastos et al. 1999, section 8.2.2).
#include "passes/reflector_reflectance.glsl"
#include "passes/screen_convolve.glsl"

uniform vec2 u_origin;           // of the image in the frame, pixels
uniform sampler2D u_blurred;     // M * K at a pixel in u_coarse
uniform vec3 u_missing;          // light where no map shows anything
uniform bool u_with_distance;     // a: the image's 1 / distance; else the kind of light
layout(location = 0) out vec4 o_light;

// The least radius of the lobe in coarse pixels for those to do.
const float kLeastRadius = 1.0;

void main() {
  vec2 pixel = gl_FragCoord.xy - u_origin;
  vec4 image;
  if (u_coarse > 1 && lobe_radius(pixel) >= kLeastRadius * float(u_coarse)) {
    vec2 size = vec2(u_image_size) / float(u_coarse);
    vec2 at = clamp(pixel / float(u_coarse), vec2(0.5), max(size - 0.5, vec2(0.5)));
    image = textureLod(u_blurred, at / u_texture_size, 0.0);
  } else {
    image = convolved(pixel);
  }
  vec3 light = image.a > 0.0 ? image.rgb : u_missing;
  o_light = vec4(light * reflector_reflectance(reflector_cosine()), u_with_distance ? image.a : 1.0);
}
