// A rectangle of a plane, whatever lies beyond the near and far planes.
uniform mat4 u_clip_from_pack;
uniform vec3 u_corners[4];

void main() {
  gl_Position = u_clip_from_pack * vec4(u_corners[gl_VertexID], 1.0);
  gl_Position.z = 0.0;
}
