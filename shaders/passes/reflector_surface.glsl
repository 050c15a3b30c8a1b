// A vertex of a reflector.
layout(location = 0) in vec3 a_position;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = a_position;
}
