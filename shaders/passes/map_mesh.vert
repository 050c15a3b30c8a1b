// The triangles of a radiance map (formats/assets/map_mesh.h), mirrored. What is linear in x, y and disparity is linear over them
// in the frame's perspective too, as long as points stay homogeneous.
#include "lib/reprojection.glsl"

layout(location = 0) in vec3 a_vertex;  // shares of the map's width and height, and of u_scale
uniform float u_scale;
uniform vec3 u_map_eye;
uniform vec2 u_lower;
uniform vec2 u_upper;
uniform vec2 u_size;                // of the map, pixels
uniform mat4 u_clip_from_mirrored;  // from reflector space, z mirrored by it
uniform vec4 u_mirrored_eye;        // reflector space; w = 0: the direction to it
uniform float u_near;               // metres along the view; 0: as the matrix has it (orthographic)
uniform float u_behind;             // moved away from the eye: relative to the distance, or metres
out vec3 v_place;                   // pixels of the map, disparity
out vec4 v_point;                   // homogeneous, from the mirrored eye; w: disparity

void main() {
  float disparity = a_vertex.z * u_scale;
  vec4 point = map_point(u_map_eye, mix(u_lower, u_upper, a_vertex.xy), disparity);
  vec3 from_eye = point.xyz * u_mirrored_eye.w - u_mirrored_eye.xyz * point.w;
  v_place = vec3(a_vertex.xy * u_size, disparity);
  v_point = vec4(u_mirrored_eye.w > 0.0 ? from_eye : point.xyz, point.w);
  gl_Position = u_clip_from_mirrored * vec4(point.xyz + u_behind * from_eye, point.w);
  // No far plane: neither the sky nor what only maps know of is beyond it.
  if (u_near > 0.0) gl_Position.z = gl_Position.w - 2.0 * u_near * point.w;
  else gl_Position.z = min(gl_Position.z, 0.999999 * gl_Position.w);
}
