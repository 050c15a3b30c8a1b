// M: light, and 1 / distance to the eye along the mirrored ray, which is 0 only where no point was drawn.
flat in vec4 v_light;
layout(location = 0) out vec4 o_light;

void main() { o_light = v_light; }
