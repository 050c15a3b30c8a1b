// M * K at a pixel in u_coarse, for lobes so wide that more would not show; where it would, reflector/convolve asks again.
#include "passes/screen_convolve.glsl"

layout(location = 0) out vec4 o_light;

void main() { o_light = convolved(gl_FragCoord.xy * float(u_coarse)); }
