#include "preview/frame/ray_shadows.h"

#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

// To the lamp, but for its own thickness of rounding.
Ray ray_to(const LampPoint& lamp, const Scene& scene, const Vec4& place, const Vec3& face) {
  const UVec3& t = scene.triangles[static_cast<std::size_t>(place.w) - 1];
  float magnitude = 0;
  for (int k = 0; k < 3; ++k) magnitude = std::max(magnitude, max_component(glm::abs(scene.positions[t[k]])));
  const Vec3 origin = offset_origin(Vec3(place), face, magnitude);
  if (lamp.place.w == 0) return {origin, Vec3(lamp.place)};
  const Vec3 to = Vec3(lamp.place) - origin;
  const float distance = glm::length(to);
  return {origin, to / std::max(distance, 1e-20f), distance};
}

}  // namespace

Result<std::vector<std::uint8_t>> shadow_mask(const SeenPoints& points, const LampPoint& lamp, const Accel& accel,
                                              Context& context) {
  const auto width = static_cast<std::size_t>(points.width);
  std::vector<std::uint8_t> mask(4 * points.place.size());
  const auto row = [&](std::size_t y) {
    std::vector<Ray> rays;
    std::vector<std::size_t> pixels;
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      if (points.place[i].w == 0) continue;
      const Vec3 face(points.face[i]);
      const Ray ray = ray_to(lamp, accel.scene(), points.place[i], face);
      if (glm::dot(face, ray.direction) <= 0) continue;
      if (lamp.kind == LampKind::kFlat && glm::dot(lamp.normal, ray.direction) >= 0) continue;
      rays.push_back(ray);
      pixels.push_back(i);
    }
    std::vector<Vec3> passed(rays.size());
    accel.transmittance(rays, passed);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      for (int c = 0; c < 3; ++c)
        mask[4 * pixels[k] + static_cast<std::size_t>(c)] =
            static_cast<std::uint8_t>(255 * std::clamp(passed[k][c], 0.0f, 1.0f) + 0.5f);
      mask[4 * pixels[k] + 3] = 255;
    }
  };
  ORIEL_TRY_VOID(parallel_for(context, "", static_cast<std::size_t>(points.height), row));
  return mask;
}

}  // namespace oriel
