// What tells how far away a surface is, in pictures of what reflectors show.
#ifdef NO_DISTANCE
const int u_alpha_kind = 0;
#else
uniform int u_alpha_kind;  // 0: nothing does; 1 one over the distance from the eye, 2 over depth
#endif
uniform vec4 u_depth_row;  // depth of a point of pack space = dot(row, point)
uniform float u_closest;   // least 1 / distance that is stored

float inverse_distance(vec3 eye, vec3 point) {
  float away = u_alpha_kind == 1 ? distance(eye, point) : dot(u_depth_row, vec4(point, 1.0));
  return clamp(1.0 / max(away, 1e-18), u_closest, 1e18);
}
