// A vertex of what bright lights may change: a mover's, or the scene's.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_uv;
layout(location = 4) in vec4 a_color;
uniform mat4 u_clip_from_pack;  // from the object
uniform mat4 u_pack_from_object;
invariant gl_Position;
out vec3 v_position;
out vec3 v_normal;
out vec2 v_uv;
out float v_alpha;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = (u_pack_from_object * vec4(a_position, 1.0)).xyz;
  v_normal = mat3(u_pack_from_object) * a_normal;
  v_uv = a_uv;
  v_alpha = a_color.a;
}
