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

const float kConnected = 0.2;  // neighbours whose disparities differ by less, relatively, lie on one surface
const float kStretch = 3.0;    // a surface seen steeply by the map is magnified by at most this over eq. (3)
const float kBias = 0.03;      // a point seen by its map from one radian off loses against points 3 % farther away

void main() {
  ivec2 cell = ivec2(gl_VertexID % u_columns, gl_VertexID / u_columns);
  ivec2 pixel = min(cell * u_step + u_step / 2, u_map_size - 1);
  vec4 texel = texelFetch(u_map, pixel, 0);
  gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // outside
  gl_PointSize = 1.0;
  v_light = vec4(0.0);
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

  // Eq. (3) is the pixel's step at the point's own depth; where the next pixels lie on the same surface, their depths give
  // the step along it.
  float next_x = texelFetch(u_map, ivec2(min(pixel.x + 1, u_map_size.x - 1), pixel.y), 0).a;
  float next_y = texelFetch(u_map, ivec2(pixel.x, min(pixel.y + 1, u_map_size.y - 1)), 0).a;
  vec4 flat_clip = u_clip_from_mirrored * point;
  vec4 step_x = u_clip_from_mirrored * map_point_step(u_map_eye, vec2(pixel_size.x, 0.0), 0.0);
  vec4 step_y = u_clip_from_mirrored * map_point_step(u_map_eye, vec2(0.0, pixel_size.y), 0.0);
  float size = covering_size(screen_step(flat_clip, step_x, u_viewport), screen_step(flat_clip, step_y, u_viewport));
  bool same_x = next_x >= 0.0 && abs(next_x - texel.a) < kConnected * max(texel.a, next_x);
  bool same_y = next_y >= 0.0 && abs(next_y - texel.a) < kConnected * max(texel.a, next_y);
  if (same_x) step_x += u_clip_from_mirrored * vec4(u_map_eye, 1.0) * (next_x - texel.a);
  if (same_y) step_y += u_clip_from_mirrored * vec4(u_map_eye, 1.0) * (next_y - texel.a);
  vec2 dx = screen_step(flat_clip, step_x, u_viewport);
  vec2 dy = screen_step(flat_clip, step_y, u_viewport);
  // A surface that its map saw from the front and the eye would see from behind is not there for the eye.
  if (same_x && same_y && dx.x * dy.y - dx.y * dy.x < -0.05 * size * size) return;
  size = clamp(covering_size(dx, dy), size, kStretch * size) * float(u_step);

  clip.z = min(clip.z, clip.w * 0.9999999);  // the sky is never beyond the far plane
  gl_Position = clip;
  gl_PointSize = clamp(size + 0.5, 1.0, u_point_max);
  float distance_inverse = point.w / max(away, 1e-30);
  if (u_ortho > 0.5) distance_inverse = point.w / max(dot(u_depth_row, point), 1e-30);
  v_light = vec4(texel.rgb, clamp(distance_inverse, u_closest, 1e18));
}
