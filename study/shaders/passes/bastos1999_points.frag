// M: light, and 1 / distance to the eye along the mirrored ray, which is 0 only where no point was drawn. A point is a box
// aligned with the screen (Bastos et al. 1999, section 8.1.3, "Reconstruction").
flat in vec4 v_light;
flat in vec2 v_half_box;
layout(location = 0) out vec4 o_light;

void main() {
  if (any(greaterThan(abs(gl_PointCoord - 0.5), v_half_box))) discard;
  o_light = v_light;
}
