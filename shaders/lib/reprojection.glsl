// Pixels of a radiance map as points in space (formats/assets/radiance_map.h), the same as tests/player/twins/map_point.h.
// Reflector space: the plane is z = 0, the reflected world z > 0, the map's eye z < 0.

// The point that a pixel saw, homogeneous: xyz / w, or the direction xyz where w = 0 (nothing but sky). on_plane: where the
// pixel's ray crosses the plane. From disparity s = (0 - eye.z) / (hit.z - eye.z): hit = eye + (on_plane - eye) / s.
vec4 map_point(vec3 eye, vec2 on_plane, float disparity) {
  return vec4(disparity * eye + vec3(on_plane, 0.0) - eye, disparity);
}
