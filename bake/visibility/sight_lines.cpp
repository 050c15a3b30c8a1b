#include "bake/visibility/sight_lines.h"

#include <array>
#include <limits>

namespace oriel {
namespace {

constexpr float kNear = 1e-3f, kNear_m = 1e-4f;  // a target, of a line's length and in metres
constexpr int kMostLayers = 64;                  // that hide nothing, along a line
constexpr std::size_t kBatch = 64;

}  // namespace

SightLines::SightLines(const Accel& accel) : accel_(accel), scene_(accel.scene()) {}

bool SightLines::is_drawn(std::uint32_t triangle, const Vec3& eye) const {
  if (two_sided(triangle)) return true;
  const Vec3& corner = scene_.positions[scene_.triangles[triangle][0]];
  return glm::dot(geometric_normal(scene_, triangle), eye - corner) > 0;
}

bool SightLines::meets(const Hit& hit, std::size_t line,
                       const std::function<void(std::size_t, std::uint32_t)>& seen) const {
  const SceneMaterial& m = material(hit.triangle);
  if (!hit.front && !m.double_sided) return false;
  seen(line, hit.triangle);
  return m.alpha_mode == AlphaMode::kOpaque && !(m.transmission > 0);
}

float SightLines::follow(Ray ray, Hit hit, std::size_t line,
                         const std::function<void(std::size_t, std::uint32_t)>& seen) const {
  float gone = 0;
  for (int layer = 0; hit && layer < kMostLayers; ++layer) {
    gone += hit.distance;
    if (meets(hit, line, seen)) return gone;
    ray.origin = spawn_origin(scene_, hit.triangle, hit.barycentric, ray.direction);
    ray.max_distance -= hit.distance;
    hit = ray.max_distance > 0 ? accel_.intersect(ray) : Hit();
  }
  return std::numeric_limits<float>::max();
}

void SightLines::trace(std::span<const Line> lines,
                       const std::function<void(std::size_t line, std::uint32_t triangle)>& seen) const {
  std::array<Ray, kBatch> rays;
  std::array<Hit, kBatch> hits;
  for (std::size_t first = 0; first < lines.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, lines.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Line& line = lines[first + i];
      const Vec3 way = line.target - line.eye;
      rays[i] = {line.eye, normalize_or(way, {0, 0, 1}), glm::length(way) * (1 + kNear) + kNear_m};
    }
    accel_.intersect(std::span<const Ray>(rays.data(), count), std::span(hits.data(), count));
    for (std::size_t i = 0; i < count; ++i) {
      const Line& line = lines[first + i];
      const float reach = glm::distance(line.eye, line.target) * (1 - kNear) - kNear_m;
      const float hidden = follow(rays[i], hits[i], first + i, seen);
      if (line.triangle != ~0u && hidden >= reach) seen(first + i, line.triangle);
    }
  }
}

}  // namespace oriel
