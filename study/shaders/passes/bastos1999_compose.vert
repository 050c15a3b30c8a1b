// A vertex of a grid over a reflector's bounds, where its sphere map is looked up by the reflected vector
// (Bastos et al. 1999, section 8.2.2).
uniform mat4 u_clip_from_pack;
uniform int u_cells;         // of the grid along a side
uniform vec3 u_corners[3];   // of the bounds: a corner, and the two beside it
uniform vec4 u_eye;
uniform vec3 u_normal;
out vec2 v_sphere;           // where the reflected vector lies in the sphere map

vec2 grid_vertex(int vertex) {
  int cell = vertex / 6, corner = vertex % 6;
  int of_half = corner % 3;
  ivec2 steps = ivec2(of_half & 1, of_half >> 1);
  if (corner > 2) steps = 1 - steps;
  return vec2(ivec2(cell % u_cells, cell / u_cells) + steps) / float(u_cells);
}

// Where a direction at angle theta from the normal, with unit tangential direction `around`, lies in the sphere map: an
// equal-area disk, r = sqrt(2) sin(theta / 2). sin^2(theta / 2) = (1 - cos theta) / 2.
vec2 sphere_map_uv(float cos_theta, vec2 around) {
  return 0.5 + 0.5 * sqrt(1.0 - clamp(cos_theta, 0.0, 1.0)) * around;
}

void main() {
  vec2 at = grid_vertex(gl_VertexID);
  vec3 x = u_corners[1] - u_corners[0], y = u_corners[2] - u_corners[0];
  vec3 position = u_corners[0] + at.x * x + at.y * y;
  vec3 to_eye = normalize(u_eye.xyz - position * u_eye.w);
  vec2 across = vec2(-dot(to_eye, normalize(x)), -dot(to_eye, normalize(y)));
  float length2 = dot(across, across);
  v_sphere = sphere_map_uv(dot(to_eye, u_normal), length2 > 0.0 ? across * inversesqrt(length2) : vec2(0.0));
  gl_Position = u_clip_from_pack * vec4(position, 1.0);
}
