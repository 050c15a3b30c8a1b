#include "bake/radiance/sun_emitter.h"

#include <algorithm>

namespace oriel {
namespace {

constexpr double kFar = 1000;          // times the scene's radius
constexpr double kLeastRadius = 9e-4;  // rad
constexpr double kMostRadius = 0.175;

}  // namespace

std::optional<PolygonLight> sun_polygon(const Scene& scene, const Light& light) {
  const double angle = std::max(double{light.angular_radius_rad}, kLeastRadius);
  if (light.type != LightType::kDirectional || angle > kMostRadius || !(max_component(light.intensity) > 0))
    return std::nullopt;
  const double distance = kFar * std::max(double{scene.radius()}, 1e-6), steradians = 2 * kPiD * (1 - std::cos(angle));
  const DMat3 frame(frame_from_normal(light.direction));
  const DVec3 centre = 0.5 * (DVec3(scene.lower) + DVec3(scene.upper)) - distance * frame[2];
  const double half = 0.5 * distance * std::sqrt(steradians);
  const auto corner = [&](double u, double v) { return Vec3(centre + half * (u * frame[0] + v * frame[1])); };
  const Vec3 a = corner(-1, -1), b = corner(1, -1), c = corner(1, 1), d = corner(-1, 1);  // u × v is its direction
  PolygonLight sun;
  sun.radiance = light.intensity / static_cast<float>(steradians);
  sun.normal = light.direction;
  sun.corners = {{a, b, c}, {a, c, d}};
  sun.boundary = {{a, b}, {b, c}, {c, d}, {d, a}};
  sun.cumulative_area = {2 * half * half, 4 * half * half};
  sun.center = Vec3(centre);
  sun.radius = static_cast<float>(std::sqrt(2.0) * half);
  sun.magnitude = max_component(glm::abs(sun.center)) + sun.radius;
  return sun;
}

std::uint32_t sun_of_corners(const Scene& scene, const std::vector<Vec3>& corners) {
  for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
    const auto sun = sun_polygon(scene, scene.lights[l]);
    if (sun && std::ranges::find(corners, sun->corners[0][0]) != corners.end()) return l;
  }
  return ~0u;
}

}  // namespace oriel
