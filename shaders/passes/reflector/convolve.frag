// (M * K) R on a reflector, of an image as fine as the frame: convolved only where it is seen.
#include "passes/reflector/reflectance.glsl"
#include "passes/screen/convolve.glsl"

uniform vec2 u_origin;           // of the image in the frame, pixels
uniform vec3 u_missing;          // light where no map shows anything
layout(location = 0) out vec4 o_light;

void main() {
  vec4 image = convolved(gl_FragCoord.xy - u_origin);
  vec3 light = image.a > 0.0 ? image.rgb : u_missing;
  o_light = vec4(light * reflector_reflectance(reflector_cosine()), 1.0);
}
