#include "passes/surface_vertex.glsl"
