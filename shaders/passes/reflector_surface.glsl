// A vertex of a reflector.
layout(location = 0) in vec3 a_position;
layout(location = 2) in vec2 a_uv;
layout(location = 4) in vec4 a_color;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;
out vec2 v_uv;
out vec4 v_color;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = a_position;
  v_uv = a_uv;
  v_color = a_color;
}
