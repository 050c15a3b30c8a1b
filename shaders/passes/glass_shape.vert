layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
uniform mat4 u_clip_from_pack;
out vec3 v_position;
out vec3 v_normal;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = a_position;
  v_normal = a_normal;
}
