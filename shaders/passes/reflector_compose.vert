#include "passes/reflector_surface.glsl"
