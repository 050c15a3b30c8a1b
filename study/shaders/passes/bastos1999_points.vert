// Each pixel of a radiance map as a point of the mirrored world (Bastos et al. 1999, section 8.1.3): an instance is a node of the
// map's quadtree, whose points are all of one size.
#include "lib/reprojection.glsl"

layout(location = 0) in vec4 a_node;   // first pixel, pixels along x and y
layout(location = 1) in vec2 a_step;   // of which every so many are drawn
layout(location = 2) in vec2 a_box;    // of a point on the screen, pixels
uniform sampler2D u_map;  // rgb radiance; a disparity, negative: nothing usable was seen
uniform ivec2 u_map_size;
uniform vec3 u_map_eye;
uniform vec2 u_lower;
uniform vec2 u_upper;
uniform mat4 u_clip_from_mirrored;  // from reflector space, z mirrored by it
uniform vec4 u_mirrored_eye;        // reflector space; w = 0: the direction to it
uniform float u_point_max;
uniform float u_closest;  // 1 / distance is never stored smaller: marks the sky as seen
uniform float u_ortho;    // 1: distances run along the view direction
uniform vec4 u_depth_row; // view-space -z of a mirrored point = dot(row, point)
flat out vec4 v_light;
flat out vec2 v_half_box;  // as a share of the point's size

void main() {
  ivec2 size = ivec2(a_node.zw), step = ivec2(a_step);
  int columns = (size.x + step.x - 1) / step.x;
  ivec2 within = ivec2(gl_VertexID % columns, gl_VertexID / columns) * step;
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // outside
  gl_PointSize = 1.0;
  v_light = vec4(0.0);
  v_half_box = vec2(0.5);
  if (within.y >= size.y) return;
  ivec2 pixel = ivec2(a_node.xy) + min(within + step / 2, size - 1);
  vec4 texel = texelFetch(u_map, pixel, 0);
  if (texel.a < 0.0) return;

  vec2 on_plane = u_lower + (vec2(pixel) + 0.5) * (u_upper - u_lower) / vec2(u_map_size);
  vec4 point = map_point(u_map_eye, on_plane, texel.a);
  vec4 clip = u_clip_from_mirrored * point;
  if (clip.w <= 0.0) return;
  clip.z = min(clip.z, clip.w * 0.9999999);  // the sky is never beyond the far plane
  gl_Position = clip;
  gl_PointSize = clamp(max(a_box.x, a_box.y), 1.0, u_point_max);
  v_half_box = 0.5 * a_box / gl_PointSize;
  float away = length(point.xyz * u_mirrored_eye.w - u_mirrored_eye.xyz * point.w);
  float distance_inverse = point.w / max(u_ortho > 0.5 ? dot(u_depth_row, point) : away, 1e-30);
  v_light = vec4(texel.rgb, clamp(distance_inverse, u_closest, 1e18));
}
