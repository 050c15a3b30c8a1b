#include "bake/radiance/pixel_planes.h"

#include <cmath>

#include "bake/radiance/capture.h"
#include "bake/radiance/reproject.h"

namespace oriel {
namespace {

constexpr float kSamePlane = 1e-3f;  // relative: of a surface that is looked at again
constexpr float kEdgeOn = 1e-4f;     // cosine at which a plane has no image

bool is_depth_enough(const SeenSurface&) {
  return false;
}

// The plane through p (reflector space) as the map's eye has it.
Vec2 slope_of(const RadianceMap& map, const Vec3& p, const Vec3& normal) {
  const Vec3 way = p - map.eye;
  const float facing = glm::dot(normal, way);
  if (std::abs(facing) < kEdgeOn * glm::length(way)) return Vec2(0);
  // s = n·(q - e) / n·(p - e), from n·(q - e + s e) = s n·p.
  const Vec2 pixel = (map.upper - map.lower) / Vec2(map.width, map.height);
  return Vec2(normal) * pixel / facing;
}

PixelPlane plane_of(const ReflectedSurroundings& surroundings, const RadianceMap& map, std::size_t at) {
  if (map.valid[at] == 0) return {};
  if (map.valid[at] == 2) return {0, Vec2(0)};
  PixelPlane plane{map.disparity[at], Vec2(0)};
  const Reflector& reflector = surroundings.reflectors()[map.reflector].reflector;
  const CaptureRay ray = capture_ray(reflector, map, Vec2(at % map.width, at / map.width) + 0.5f);
  const Mat3 to_reflector = glm::transpose(Mat3(reflector.pack_from_reflector));
  const Sight sight = surroundings.look(map.reflector, ray.from, ray.direction, is_depth_enough);
  if (!(glm::length(sight.offset) > 0)) return plane;
  const Vec3 p = reflector_from_pack(reflector, ray.from + sight.offset);
  if (std::abs(disparity_of(map, p.z) - plane.disparity) <= kSamePlane * plane.disparity + 1e-6f)
    plane.slope = slope_of(map, p, to_reflector * sight.normal);
  return plane;
}

}  // namespace

std::vector<PixelPlane> find_planes(const ReflectedSurroundings& surroundings, const RadianceMap& map) {
  std::vector<PixelPlane> planes(map.disparity.size());
  for (std::size_t i = 0; i < planes.size(); ++i) planes[i] = plane_of(surroundings, map, i);
  return planes;
}

}  // namespace oriel
