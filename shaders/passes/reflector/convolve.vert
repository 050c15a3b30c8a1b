#include "passes/reflector/surface.glsl"
