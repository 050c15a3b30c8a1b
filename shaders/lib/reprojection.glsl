// Pixels of a radiance map as points in space (formats/assets/radiance_map.h), the same as tests/player/twins/map_point.h.
// Reflector space: the plane is z = 0, the reflected world z > 0, the map's eye z < 0.

// The point that a pixel saw, homogeneous: xyz / w, or the direction xyz where w = 0 (nothing but sky). on_plane: where the
// pixel's ray crosses the plane. From disparity s = (0 - eye.z) / (hit.z - eye.z): hit = eye + (on_plane - eye) / s.
vec4 map_point(vec3 eye, vec2 on_plane, float disparity) {
  return vec4(disparity * eye + vec3(on_plane, 0.0) - eye, disparity);
}

// Change of map_point over one pixel along an axis, given the change of the disparity and the pixel's width on the plane.
vec4 map_point_step(vec3 eye, vec2 plane_step, float disparity_step) {
  return vec4(disparity_step * eye + vec3(plane_step, 0.0), disparity_step);
}

// How far a step in clip space moves the picture, in pixels. viewport: pixels.
vec2 screen_step(vec4 clip, vec4 clip_step, vec2 viewport) {
  return 0.5 * viewport * (clip_step.xy * clip.w - clip.xy * clip_step.w) / (clip.w * clip.w);
}

// The same for the depth in the depth buffer, [0,1].
float depth_step(vec4 clip, vec4 clip_step) {
  return 0.5 * (clip_step.z * clip.w - clip.z * clip_step.w) / (clip.w * clip.w);
}

// Side of the smallest axis-aligned square whose copies at the lattice of a and b leave no gap.
float covering_size(vec2 a, vec2 b) { return max(abs(a.x) + abs(b.x), abs(a.y) + abs(b.y)); }
