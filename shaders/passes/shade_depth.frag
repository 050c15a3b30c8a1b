// What lies in another face is that face's. Only cut-outs need the texture.
uniform vec2 u_signs;
#ifndef PLAIN
uniform sampler2D u_base_texture;
uniform float u_alpha;
uniform float u_alpha_cutoff;
#endif
in vec2 v_across;
in vec2 v_uv;
in float v_alpha;

void main() {
  if (min(v_across.x * u_signs.x, v_across.y * u_signs.y) < 0.0) discard;
#ifndef PLAIN
  if (texture(u_base_texture, v_uv).a * u_alpha * v_alpha < u_alpha_cutoff) discard;
#endif
}
