// A mover as one face of a light's map has it.
layout(location = 0) in vec3 a_position;
uniform mat4 u_clip_from_object;
uniform mat4 u_light_from_object;
out vec2 v_across;

void main() {
  gl_Position = u_clip_from_object * vec4(a_position, 1.0);
  v_across = (u_light_from_object * vec4(a_position, 1.0)).xy;
}
