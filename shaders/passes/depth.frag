// Depth of the opaque scene. Only cut-outs need the texture.
uniform sampler2D u_base_texture;
uniform float u_alpha;
#ifdef PLAIN
const float u_alpha_cutoff = -1.0;
#else
uniform float u_alpha_cutoff;  // negative: no cut-outs
#endif
in vec2 v_uv;
in float v_alpha;

void main() {
  if (u_alpha_cutoff >= 0.0 && texture(u_base_texture, v_uv).a * u_alpha * v_alpha < u_alpha_cutoff) discard;
}
