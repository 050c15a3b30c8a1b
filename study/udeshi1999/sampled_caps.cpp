#include "study/udeshi1999/sampled_caps.h"

#include <algorithm>

namespace oriel::study {
namespace {

constexpr int kMostLayers = 4096;  // that a ray is followed through

// A point of the view plane, [0,1] across and up.
Vec3 on_view_plane(const Mat4& pack_from_clip, const Vec2& at) {
  const Vec4 place = pack_from_clip * Vec4(2.0f * at - 1.0f, -1, 1);
  return Vec3(place) / place.w;
}

}  // namespace

std::vector<std::uint32_t> sampled_occluders(const Accel& accel, const View& view, const Vec4& light,
                                             std::uint32_t rays, Sampler& sampler) {
  const Mat4 pack_from_clip = glm::inverse(view.clip_from_pack);
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<float>(rays))));
  const std::uint32_t rows = (rays + columns - 1) / columns;
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < rays; ++i) {
    const std::uint32_t column = i % columns, row = i / columns;
    const Vec2 cell(static_cast<float>(column), static_cast<float>(row));
    const Vec2 at = (cell + sampler.next2()) / Vec2(static_cast<float>(columns), static_cast<float>(rows));
    Ray ray{on_view_plane(pack_from_clip, at), Vec3(light)};
    if (light.w > 0) {
      const Vec3 to = Vec3(light) - ray.origin;
      ray.max_distance = glm::length(to);
      ray.direction = to / std::max(ray.max_distance, 1e-30f);
    }
    for (int layer = 0; layer < kMostLayers; ++layer) {
      const Hit hit = accel.intersect(ray);
      if (!hit) break;
      found.push_back(hit.triangle);
      ray.origin = spawn_origin(accel.scene(), hit.triangle, hit.barycentric, ray.direction);
      ray.max_distance -= hit.distance;
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace oriel::study
