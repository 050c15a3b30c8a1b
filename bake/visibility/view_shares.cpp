#include "bake/visibility/view_shares.h"

#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"

namespace oriel {
namespace {
constexpr std::uint32_t kRays = 8;   // an eye
constexpr double kSeenBack = 0.002;  // of what eyes see, before a wall is worth a word
}  // namespace

ViewShares look_around(const Accel& accel, std::span<const Vec3> eyes, std::uint64_t seed) {
  const Scene& scene = accel.scene();
  ViewShares shares{std::vector<double>(scene.triangles.size()), std::vector<double>(scene.triangles.size())};
  const double one = 1.0 / (static_cast<double>(eyes.size()) * kRays);
  for (std::uint32_t i = 0; i < eyes.size() * kRays; ++i) {
    Sampler sampler(seed + 0x5ee, 0, i);
    const Hit hit = accel.intersect({eyes[i / kRays], square_to_sphere(sampler.next2())});
    if (!hit) continue;
    const bool both = scene.material_of(hit.triangle).double_sided;
    (hit.front || both ? shares.front : shares.back)[hit.triangle] += one;
  }
  return shares;
}

std::vector<SeenBack> seen_backs(const Scene& scene, const ViewShares& views) {
  std::vector<SeenBack> seen;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    double back = 0;
    const Surface& surface = scene.surfaces[s];
    for (std::uint32_t i = 0; i < surface.triangle_count; ++i) back += views.back[surface.first_triangle + i];
    if (back >= kSeenBack) seen.push_back({s, back});
  }
  return seen;
}

}  // namespace oriel
