// M R on a mirror (Bastos et al. 1999, section 8.2.2).
#include "passes/reflector_reflectance.glsl"

uniform sampler2D u_image;       // M
uniform vec2 u_texture_size;
uniform vec2 u_image_size;       // pixels in use
uniform vec2 u_origin;           // of the image in the frame, pixels
uniform vec3 u_missing;          // light where no map shows anything
uniform bool u_with_distance;     // a: the image's 1 / distance; else the kind of light
layout(location = 0) out vec4 o_light;

void main() {
  vec2 at = clamp(gl_FragCoord.xy - u_origin, vec2(0.5), max(u_image_size - 0.5, vec2(0.5)));
  vec4 image = textureLod(u_image, at / u_texture_size, 0.0);
  vec3 light = image.a > 0.0 ? image.rgb : u_missing;
  o_light = vec4(light * reflector_reflectance(reflector_cosine()), u_with_distance ? image.a : 1.0);
}
