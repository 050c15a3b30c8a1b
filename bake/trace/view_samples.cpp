#include "bake/trace/view_samples.h"

#include <algorithm>

#include "bake/trace/warp.h"

namespace oriel {
namespace {

constexpr int kProbes = 12, kEscapes = 2;  // rays, and those that leave a gap by chance, less than which make it one
constexpr int kLampSamples = 4;            // of lamps, bright and near ones first
constexpr std::size_t kNearest = 16;       // eyes that are asked
constexpr std::size_t kVeryMany = 256;     // where that must not be wrong
constexpr std::uint64_t kSeed = 0x0e1e5;

}  // namespace

bool is_lamp(const Scene& scene, std::uint32_t triangle, bool front) {
  const SceneMaterial& m = scene.material_of(triangle);
  return !m.unlit && max_component(m.emission) > 0 && (front || m.double_sided);
}

bool ViewSamples::in_dark_gap(const SurfacePoint& surface, float reach_m, Sampler& sampler, std::uint64_t& rays) const {
  if (is_lamp(accel_.scene(), surface.triangle, surface.front)) return false;
  const Mat3 frame = frame_from_normal(surface.geometric_normal);
  const Vec3 origin = spawn_origin(surface, surface.geometric_normal);
  int escaped = 0;
  for (int probe = 0; probe < kProbes; ++probe) {
    const Vec3 direction = glm::normalize(frame * square_to_cosine_hemisphere(sampler.next2()));
    ++rays;
    const Hit hit = accel_.intersect({origin, direction, reach_m});
    if ((!hit && ++escaped == kEscapes) || (hit && is_lamp(accel_.scene(), hit.triangle, hit.front))) return false;
  }
  return !is_lit_from_near(surface, reach_m, sampler, rays);
}

// Lamps too small for the probes.
bool ViewSamples::is_lit_from_near(const SurfacePoint& surface, float reach_m, Sampler& sampler,
                                   std::uint64_t& rays) const {
  const Vec3 origin = spawn_origin(surface, surface.geometric_normal);
  for (int i = 0; i < kLampSamples; ++i) {
    const float u = sampler.next1();
    const LightSample s = lights_.sample(origin, u, sampler.next2());
    if (!(max_component(s.estimate) > 0) || s.distance > reach_m) continue;
    if (glm::dot(s.direction, surface.geometric_normal) <= 0) continue;
    ++rays;
    if (max_component(accel_.transmittance({origin, s.direction, s.distance})) > 0) return true;
  }
  return false;
}

std::vector<Vec3> ViewSamples::nearest_to(const Vec3& point, const Vec3& normal, std::size_t most) const {
  std::vector<std::pair<float, std::uint32_t>> before;  // squared distance, eye
  for (std::uint32_t e = 0; e < eyes_.size(); ++e)
    if (const Vec3 way = eyes_[e] - point; glm::dot(way, normal) > 0) before.emplace_back(glm::dot(way, way), e);
  const std::size_t count = std::min(before.size(), most);
  std::partial_sort(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(count), before.end());
  std::vector<Vec3> eyes;
  for (std::size_t i = 0; i < count; ++i) eyes.push_back(eyes_[before[i].second]);
  return eyes;
}

bool ViewSamples::sees(const SurfacePoint& surface, float reach_m, const SampleId& id, Nearest& nearest,
                       std::uint64_t& rays) const {
  if (eyes_.empty()) return true;
  Sampler sampler(mix64(id.seed + kSeed), id.stream, id.sample);
  if (!in_dark_gap(surface, reach_m, sampler, rays)) return true;
  return in_sight(spawn_origin(surface, surface.geometric_normal), surface.geometric_normal, nearest, rays);
}

bool ViewSamples::in_sight(const Vec3& origin, const Vec3& normal, Nearest& nearest, std::uint64_t& rays) const {
  if (!nearest) nearest = nearest_to(origin, normal, kNearest);
  for (const Vec3& eye : *nearest) {
    const float distance = glm::distance(eye, origin);
    if (distance > 0 && glm::dot(eye - origin, normal) <= 0) continue;
    ++rays;
    if (!(distance > 0) || max_component(accel_.transmittance({origin, (eye - origin) / distance, distance})) > 0)
      return true;
  }
  return false;
}

bool ViewSamples::in_sight_of_any(const Vec3& point, const Vec3& normal, std::uint64_t& rays) const {
  Nearest eyes = nearest_to(point, normal, kVeryMany);
  return in_sight(point, normal, eyes, rays);
}

}  // namespace oriel
