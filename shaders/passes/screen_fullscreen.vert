#include "lib/fullscreen.glsl"

void main() { gl_Position = fullscreen_position(gl_VertexID); }
