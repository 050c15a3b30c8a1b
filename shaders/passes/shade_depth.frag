// What lies in another face is that face's.
uniform vec2 u_signs;
in vec2 v_across;

void main() {
  if (min(v_across.x * u_signs.x, v_across.y * u_signs.y) < 0.0) discard;
}
