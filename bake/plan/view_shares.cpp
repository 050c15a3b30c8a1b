#include "bake/plan/view_shares.h"

#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"

namespace oriel {
namespace {
constexpr std::uint32_t kRays = 8;  // an eye
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

}  // namespace oriel
