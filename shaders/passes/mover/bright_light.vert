// A vertex that a bright light shines on: of a mover, or of the scene around.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_uv;
layout(location = 4) in vec4 a_color;
uniform mat4 u_clip_from_pack;  // from the object
uniform mat4 u_pack_from_object;
uniform vec3 u_box_center;
uniform vec3 u_box_scale;  // one over half its size, 0 where flat
invariant gl_Position;
out vec3 v_position;
out vec3 v_normal;
out vec3 v_in_box;
out vec2 v_uv;
out float v_alpha;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = (u_pack_from_object * vec4(a_position, 1.0)).xyz;
  v_normal = mat3(u_pack_from_object) * a_normal;
  v_in_box = (a_position - u_box_center) * u_box_scale;
  v_uv = a_uv;
  v_alpha = a_color.a;
}
