// Tiles of the zone that reflections were planned for, to be shown as they are.
#include "lib/color.glsl"
in vec4 v_color;
layout(location = 0) out vec4 o_light;

void main() { o_light = vec4(linear_from_srgb(v_color.rgb), 2.0); }
