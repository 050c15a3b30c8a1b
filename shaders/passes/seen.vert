#include "passes/depth.vert"
