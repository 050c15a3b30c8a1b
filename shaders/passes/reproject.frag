// M: light, and 1 / distance to the eye along the mirrored ray, which is 0 only where no point was drawn. A point covers the
// cell of its map's lattice, not the square around it: the anisotropic size of eq. (3).
flat in vec4 v_light;
flat in vec4 v_cell;
flat in vec3 v_depth;
flat in vec2 v_margin;
layout(location = 0) out vec4 o_light;

void main() {
  vec2 offset = vec2(gl_PointCoord.x - 0.5, 0.5 - gl_PointCoord.y);
  vec2 cell = vec2(dot(v_cell.xz, offset), dot(v_cell.yw, offset));
  if (any(greaterThan(abs(cell), v_margin))) discard;
  gl_FragDepth = clamp(v_depth.x + dot(v_depth.yz, clamp(cell, -0.5, 0.5)), 0.0, 0.9999999);
  o_light = v_light;
}
