#include "bake/radiance/reproject.h"

namespace oriel {

Vec2 map_point(const RadianceMap& map, const Vec2& pixel) {
  return map.lower + pixel / Vec2(map.width, map.height) * (map.upper - map.lower);
}

Vec2 map_pixel(const RadianceMap& map, const Vec3& p) {
  const float disparity = disparity_of(map, p.z);
  const Vec2 q = Vec2(map.eye) + Vec2(p - map.eye) * disparity;
  return (q - map.lower) / (map.upper - map.lower) * Vec2(map.width, map.height);
}

float disparity_of(const RadianceMap& map, float z) {
  return -map.eye.z / (z - map.eye.z);
}

Vec4 unproject(const RadianceMap& map, const Vec2& pixel, float disparity) {
  const Vec3 q(map_point(map, pixel), 0);
  return Vec4(q - map.eye + disparity * map.eye, disparity);
}

}  // namespace oriel
