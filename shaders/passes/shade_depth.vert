// A mover as one face of a light's map has it.
layout(location = 0) in vec3 a_position;
layout(location = 2) in vec2 a_uv;
layout(location = 4) in vec4 a_color;
uniform mat4 u_clip_from_object;
uniform mat4 u_light_from_object;
out vec2 v_across;
out vec2 v_uv;
out float v_alpha;

void main() {
  gl_Position = u_clip_from_object * vec4(a_position, 1.0);
  v_across = (u_light_from_object * vec4(a_position, 1.0)).xy;
  v_uv = a_uv;
  v_alpha = a_color.a;
}
