// The part of a reflector's plane that an element's maps serve.
uniform vec2 u_from;  // reflector space
uniform vec2 u_to;
uniform mat4 u_clip_from_reflector;
out vec2 v_on_plane;

void main() {
  v_on_plane = mix(u_from, u_to, vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)));
  gl_Position = u_clip_from_reflector * vec4(v_on_plane, 0.0, 1.0);
}
