#include "study/herf1997/light_sum.h"

#include <algorithm>
#include <cmath>

#include "formats/core/check.h"
#include "study/herf1997/light_strip.h"

namespace oriel::study {
namespace {

// Chebyshev points for the precision of a float over a square of `half` half-width, when the light's lowest sample is
// `height` above the plane: the sum is analytic in the ellipse through that pole (Trefethen 2013, theorem 8.2).
int chebyshev_nodes(double half, double height) {
  const double t = height / half, rho = t + std::sqrt(t * t + 1);
  const double nodes = std::log(1e8) / std::log(rho) + 2;
  return nodes <= kMostNodes ? std::max(2, static_cast<int>(std::ceil(nodes))) : 0;
}

}  // namespace

LightSum::LightSum(const OccluderView& view, const ShadowReceiver& receiver, const ShadowLight& light,
                   std::span<const float> powers) {
  ORIEL_CHECK(powers.size() == view.apexes.size());
  double top = 0, low = 1e300;
  for (const DVec3& a : view.apexes) top = std::max(top, a.z), low = std::min(low, a.z);
  if (view.apexes.empty()) return;
  const double unit = 1 / top, length = glm::length(receiver.x);
  const DVec3 along = receiver.x / length, across = glm::cross(receiver.normal, along);
  steps_.along = static_cast<float>(length * unit);
  steps_.skew = static_cast<float>(glm::dot(receiver.y, along) * unit);
  steps_.across = static_cast<float>(glm::dot(receiver.y, across) * unit);
  for (std::size_t i = 0; i < view.apexes.size(); ++i) {
    const DVec3 from_corner = light.samples[view.apex_of[i]].position - receiver.corner;
    const double height = view.apexes[i].z * unit;
    samples_.along.push_back(static_cast<float>(glm::dot(from_corner, along) * unit));
    samples_.across.push_back(static_cast<float>(glm::dot(from_corner, across) * unit));
    samples_.height2.push_back(static_cast<float>(height * height));
    samples_.weight.push_back(static_cast<float>(powers[i] * height * unit * unit));
  }
  // cosθ' = -normal · (sample - texel) / r, the same plane for all samples.
  const DVec3 first = light.samples[view.apex_of.front()].position;
  steps_.emission = static_cast<float>(-glm::dot(light.normal, first - receiver.corner) * unit);
  steps_.emission_x = static_cast<float>(glm::dot(light.normal, receiver.x) * unit);
  steps_.emission_y = static_cast<float>(glm::dot(light.normal, receiver.y) * unit);
  steps_.double_sided = light.double_sided;
  steps_.nodes = chebyshev_nodes(16 * std::max(glm::length(receiver.x), glm::length(receiver.y)), low);
}

void LightSum::run(const BlockedRows& rows, Simd simd, std::span<float> out) const {
  if (samples_.weight.empty()) {
    std::ranges::fill(out, 0.0f);
    return;
  }
  sum_strips({samples_, steps_, rows, out}, simd);
}

}  // namespace oriel::study
