// The box that holds a mover and its shadow (ShadowBox), whatever lies beyond the near and far planes.
uniform mat4 u_clip_from_pack;
uniform vec3 u_corners[8];

// Two triangles for each face, counter-clockwise from outside.
const int kCorners[36] = int[36](0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3,
                                 7, 1, 7, 5);

void main() {
  gl_Position = u_clip_from_pack * vec4(u_corners[kCorners[gl_VertexID]], 1.0);
  gl_Position.z = 0.0;
}
