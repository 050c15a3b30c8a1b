#include "preview/frame/eye_points.h"

#include <algorithm>

#include "bake/trace/rounded.h"
#include "bake/trace/sampler.h"

namespace oriel {
namespace {

constexpr std::uint64_t kEyeStream = 0x657965;

}  // namespace

EyePoint eye_point(const SeenPoints& seen, std::size_t pixel, const Scene& scene) {
  const Vec3 place(seen.place[pixel]), face(seen.face[pixel]);
  const std::uint32_t triangle = static_cast<std::uint32_t>(seen.place[pixel].w) - 1;
  const UVec3& t = scene.triangles[triangle];
  float magnitude = 0;
  for (int k = 0; k < 3; ++k) magnitude = std::max(magnitude, max_component(glm::abs(scene.positions[t[k]])));
  // But for the surface's own thickness of rounding.
  const Vec3 normal(seen.normal[pixel]);
  const float rounded = normal != face ? height_of_rounded(scene, triangle, place, face) : 0;
  return {{place, normal, face, rounded}, offset_origin(place, face, magnitude)};
}

std::vector<EyePoint> eye_points(const SeenPoints& seen, const Scene& scene, std::uint32_t count, std::uint64_t seed,
                                 std::uint32_t pass) {
  std::vector<EyePoint> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    Sampler sampler(seed, kEyeStream, pass * count + i);
    const Vec2 at = sampler.next2() * Vec2(IVec2(seen.width, seen.height));
    const std::size_t pixel =
        static_cast<std::size_t>(at.y) * static_cast<std::size_t>(seen.width) + static_cast<std::size_t>(at.x);
    if (pixel < seen.place.size() && seen.place[pixel].w != 0) points.push_back(eye_point(seen, pixel, scene));
  }
  return points;
}

}  // namespace oriel
