// What a pixel sees of the scene, for the passes that light it.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_uv0;
layout(location = 3) in vec2 a_uv1;
layout(location = 4) in vec4 a_color;
layout(location = 5) in vec4 a_tangent;
uniform mat4 u_clip_from_pack;
invariant gl_Position;
out vec3 v_position;
out vec3 v_normal;
out vec2 v_uv0;
out vec2 v_uv1;
out vec4 v_color;
out vec4 v_tangent;

void main() {
  gl_Position = u_clip_from_pack * vec4(a_position, 1.0);
  v_position = a_position;
  v_normal = a_normal;
  v_uv0 = a_uv0;
  v_uv1 = a_uv1;
  v_color = a_color;
  v_tangent = a_tangent;
}
