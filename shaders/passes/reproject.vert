// Each pixel of a radiance map as a point of the mirrored world (Bastos et al. 1999, section 8.1.3).
#include "lib/reprojection.glsl"

uniform sampler2D u_map;  // rgb radiance; a disparity, negative: nothing usable was seen
uniform ivec2 u_map_size;
uniform int u_step;     // draws each u_step-th pixel of each u_step-th row
uniform int u_columns;  // pixels drawn of a row
uniform vec3 u_map_eye;
uniform vec2 u_lower;
uniform vec2 u_upper;
uniform mat4 u_clip_from_mirrored;  // from reflector space, z mirrored by it
uniform vec4 u_mirrored_eye;        // reflector space; w = 0: the direction to it
uniform vec2 u_viewport;
uniform float u_point_max;
uniform float u_bias_scale;
uniform float u_closest;  // 1 / distance is never stored smaller: marks the sky as seen
uniform float u_ortho;    // 1: distances run along the view direction
uniform vec4 u_depth_row; // view-space -z of a mirrored point = dot(row, point)
flat out vec4 v_light;
flat out vec4 v_cell;  // offsets on the screen, as shares of the point's size, to the map's lattice: columns
flat out vec3 v_depth;   // of the point, and its change along the lattice
flat out vec2 v_margin;  // half a cell and a little, so that neighbours leave no cracks

const float kConnected = 0.2;  // neighbours whose disparities differ by more, relatively, lie on different surfaces
const float kStretch = 3.0;    // a surface seen steeply by the map is magnified by at most this over eq. (3)
const float kOverlap = 0.08;  // pixels
const float kBias = 0.03;      // a point seen by its map from one radian off loses against points 3 % farther away

// Change of the disparity over one pixel along an axis of the map (x). y: 1 if a neighbour lies on the same surface, 0 if
// none does. Disparity is linear over a plane, so that both sides agree within one; at an edge the flatter side is this surface.
vec2 slope(ivec2 pixel, ivec2 axis, float disparity) {
  ivec2 after = pixel + axis, before = pixel - axis;
  float a = all(lessThan(after, u_map_size)) ? texelFetch(u_map, after, 0).a : -1.0;
  float b = all(greaterThanEqual(before, ivec2(0))) ? texelFetch(u_map, before, 0).a : -1.0;
  float rise = a < 0.0 ? 1e9 : a - disparity;
  float fall = b < 0.0 ? 1e9 : disparity - b;
  float flatter = abs(rise) < abs(fall) ? rise : fall;
  return abs(flatter) < kConnected * disparity ? vec2(flatter, 1.0) : vec2(0.0);
}

void main() {
  ivec2 cell = ivec2(gl_VertexID % u_columns, gl_VertexID / u_columns);
  ivec2 pixel = min(cell * u_step + u_step / 2, u_map_size - 1);
  vec4 texel = texelFetch(u_map, pixel, 0);
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // outside
  gl_PointSize = 1.0;
  v_light = vec4(0.0);
  v_cell = vec4(0.0);
  v_margin = vec2(0.0);
  v_depth = vec3(1.0, 0.0, 0.0);
  if (texel.a < 0.0) return;

  vec2 pixel_size = (u_upper - u_lower) / vec2(u_map_size);
  vec2 on_plane = u_lower + (vec2(pixel) + 0.5) * pixel_size;
  vec4 point = map_point(u_map_eye, on_plane, texel.a);
  vec3 from_eye = point.xyz * u_mirrored_eye.w - u_mirrored_eye.xyz * point.w;
  vec3 from_map = vec3(on_plane, 0.0) - u_map_eye;
  float away = length(from_eye);
  float cos_between = dot(from_eye, from_map) / max(away * length(from_map), 1e-30);
  float bias = kBias * sqrt(max(2.0 - 2.0 * cos_between, 0.0));
  vec4 clip = u_clip_from_mirrored * vec4(point.xyz + bias * u_bias_scale * from_eye, point.w);
  if (clip.w <= 0.0) return;

  // Eq. (3) is the pixel's step at the point's own depth; where neighbours lie on the same surface, their depths give the
  // step along it.
  vec4 flat_clip = u_clip_from_mirrored * point;
  vec4 step_x = u_clip_from_mirrored * map_point_step(u_map_eye, vec2(pixel_size.x, 0.0), 0.0);
  vec4 step_y = u_clip_from_mirrored * map_point_step(u_map_eye, vec2(0.0, pixel_size.y), 0.0);
  float size = covering_size(screen_step(flat_clip, step_x, u_viewport), screen_step(flat_clip, step_y, u_viewport));
  vec2 slope_x = slope(pixel, ivec2(1, 0), texel.a);
  vec2 slope_y = slope(pixel, ivec2(0, 1), texel.a);
  vec4 along_ray = u_clip_from_mirrored * vec4(u_map_eye, 1.0);
  step_x += along_ray * slope_x.x;
  step_y += along_ray * slope_y.x;
  vec2 dx = screen_step(flat_clip, step_x, u_viewport);
  vec2 dy = screen_step(flat_clip, step_y, u_viewport);
  float area = dx.x * dy.y - dx.y * dy.x;
  // A surface that its map saw from the front and the eye would see from behind is not there for the eye.
  if (slope_x.y * slope_y.y > 0.0 && area < -0.05 * size * size) return;
  // The cell of the lattice that this point stands for, no longer than kStretch.
  float longest = float(u_step) * min(1.0, kStretch * size / max(max(length(dx), length(dy)), 1e-30));
  v_depth.y = longest * depth_step(flat_clip, step_x);
  v_depth.z = longest * depth_step(flat_clip, step_y);
  dx *= longest;
  dy *= longest;
  area = dx.x * dy.y - dx.y * dy.x;
  float least = 1e-3 * length(dx) * length(dy) + 1e-12;
  // Seen edge-on the cell's axes fall together, and where a pixel lies between them says nothing of its depth.
  v_depth.yz *= smoothstep(0.02, 0.3, abs(area) / (length(dx) * length(dy) + 1e-12));
  area = abs(area) < least ? (area < 0.0 ? -least : least) : area;
  vec4 to_cell = vec4(dy.y, -dx.y, -dy.x, dx.x) / area;
  v_margin = 0.5 + kOverlap * vec2(abs(to_cell.x) + abs(to_cell.z), abs(to_cell.y) + abs(to_cell.w));
  gl_PointSize = clamp(covering_size(dx, dy) + 2.0 * kOverlap, 1.0, u_point_max);
  v_cell = to_cell * gl_PointSize;

  clip.z = min(clip.z, clip.w * 0.9999999);  // the sky is never beyond the far plane
  gl_Position = clip;
  v_depth.x = 0.5 + 0.5 * clip.z / clip.w;
  float distance_inverse = point.w / max(away, 1e-30);
  if (u_ortho > 0.5) distance_inverse = point.w / max(dot(u_depth_row, point), 1e-30);
  v_light = vec4(texel.rgb, clamp(distance_inverse, u_closest, 1e18));
}
