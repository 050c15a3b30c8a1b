// A vertex of a reflector; or of a grid over its bounds, where its sphere map is looked up by the reflected vectors at vertices
// (Bastos et al. 1999, section 8.2.2).
#include "lib/reflectance.glsl"

layout(location = 0) in vec3 a_position;
uniform mat4 u_clip_from_pack;
uniform int u_grid;        // of the grid along a side; 0: a_position is the vertex
uniform vec3 u_grid_corners[3];  // of the bounds: a corner, and the two beside it
uniform vec4 u_eye;
uniform vec3 u_normal;
invariant gl_Position;
out vec3 v_position;
out vec2 v_sphere;  // where the reflected vector lies in the sphere map

vec2 grid_vertex(int vertex) {
  int cell = vertex / 6, corner = vertex % 6;
  int of_half = corner % 3;
  ivec2 steps = ivec2(of_half & 1, of_half >> 1);
  if (corner > 2) steps = 1 - steps;
  return vec2(ivec2(cell % u_grid, cell / u_grid) + steps) / float(u_grid);
}

void main() {
  vec3 position = a_position;
  v_sphere = vec2(0.5);
  if (u_grid > 0) {
    vec2 at = grid_vertex(gl_VertexID);
    vec3 x = u_grid_corners[1] - u_grid_corners[0], y = u_grid_corners[2] - u_grid_corners[0];
    position = u_grid_corners[0] + at.x * x + at.y * y;
    vec3 to_eye = normalize(u_eye.xyz - position * u_eye.w);
    vec2 across = vec2(-dot(to_eye, normalize(x)), -dot(to_eye, normalize(y)));
    float length2 = dot(across, across);
    v_sphere = sphere_map_uv(dot(to_eye, u_normal), length2 > 0.0 ? across * inversesqrt(length2) : vec2(0.0));
  }
  gl_Position = u_clip_from_pack * vec4(position, 1.0);
  v_position = position;
}
