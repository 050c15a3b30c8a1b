// M * K of a whole image.
#include "passes/screen/convolve.glsl"

layout(location = 0) out vec4 o_light;

void main() { o_light = convolved(gl_FragCoord.xy); }
