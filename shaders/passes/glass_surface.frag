// Where a body of glass is and how it is turned, by pixel.
#include "passes/surface.glsl"

uniform sampler2D u_base_texture;
in vec2 v_uv;
in vec4 v_color;
layout(location = 0) out vec4 o_place;   // a: 1
layout(location = 1) out vec4 o_normal;  // any length
layout(location = 2) out vec4 o_tint;    // of the material's

void main() {
  o_normal = vec4(tilted_by_map(), 1.0);
  o_place = vec4(v_position, 1.0);
  o_tint = v_color * texture(u_base_texture, v_uv);
}
