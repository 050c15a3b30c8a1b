layout(location = 0) in vec3 a_position;
uniform mat4 u_clip_from_pack;
out vec3 v_position;
invariant gl_Position;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = a_position;
}
