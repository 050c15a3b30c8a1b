#include "bake/radiosity/texels/fit_texels.h"

#include <array>

namespace oriel {
namespace {

constexpr int kIterations = 8;   // the finest pattern is left at (3/4)^8, a tenth
constexpr float kNoiseGate = 2;  // standard errors
constexpr std::uint32_t kNone = ~0u;

constexpr std::array<std::array<int, 2>, 8> kNeighbourSteps = {
    {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

struct FittedTexel {
  std::uint32_t texel = 0;                    // of the page
  std::array<std::uint32_t, 8> neighbours{};  // in kNeighbourSteps's order, of the list; itself where there is none
  std::array<float, 8> share{};               // of these in the mean of the interpolation over the sampled part
  bool whole = false;
};

std::array<float, 8> shares_of(const Reach& reach) {
  const auto along = [&](int axis, int step) {
    const float before = reach.before[axis], after = reach.after[axis];
    return step < 0 ? before : step > 0 ? after : 1 - before - after;
  };
  std::array<float, 8> share{};
  for (std::size_t n = 0; n < share.size(); ++n)
    share[n] = along(0, kNeighbourSteps[n][0]) * along(1, kNeighbourSteps[n][1]);
  return share;
}

std::vector<FittedTexel> valid_texels(const SampledPage& sampled, const LightmapPage& page) {
  const auto& [atlas, map, reach] = sampled;
  std::vector<FittedTexel> list;
  std::vector<std::uint32_t> number(page.state.size(), kNone), chart;
  for (std::size_t i = 0; i < map.texel.size(); ++i) {
    if (page.state[map.texel[i]] != TexelState::kValid) continue;
    number[map.texel[i]] = static_cast<std::uint32_t>(list.size());
    const bool whole = covered_share(map, i) > kWholeTexel && (reach.empty() || reach[i].whole());
    list.push_back({.texel = map.texel[i], .whole = whole});
    if (whole || !reach.empty()) list.back().share = shares_of(reach.empty() ? Reach() : reach[i]);
    chart.push_back(atlas.chart[map.fragments[map.first[i]].triangle]);
  }
  const auto width = static_cast<int>(page.width), height = static_cast<int>(page.height);
  for (std::uint32_t k = 0; k < list.size(); ++k) {
    const auto x = static_cast<int>(list[k].texel % page.width), y = static_cast<int>(list[k].texel / page.width);
    for (std::size_t n = 0; n < kNeighbourSteps.size(); ++n) {
      const int u = x + kNeighbourSteps[n][0], v = y + kNeighbourSteps[n][1];
      const bool inside = u >= 0 && v >= 0 && u < width && v < height;
      const std::uint32_t other =
          inside ? number[static_cast<std::size_t>(v) * page.width + static_cast<std::size_t>(u)] : kNone;
      list[k].neighbours[n] = other != kNone && chart[other] == chart[k] ? other : k;
    }
  }
  return list;
}

// Values whose interpolation has the means.
std::vector<Vec3> fitted_to(const std::vector<FittedTexel>& list, const std::vector<Vec3>& mean) {
  std::vector<Vec3> lower = mean, upper = mean;
  for (std::size_t k = 0; k < list.size(); ++k)
    for (const std::uint32_t other : list[k].neighbours)
      lower[k] = glm::min(lower[k], mean[other]), upper[k] = glm::max(upper[k], mean[other]);
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (list[k].whole) continue;
    // A neighbour with twice the light lies beyond an edge: it tells of no slope.
    const auto beyond = [&](const Vec3& d) { return d * glm::max(Vec3(0), 1.0f - d / (mean[k] + 1e-30f)); };
    const Vec3 down = beyond(upper[k] - mean[k]), up = beyond(mean[k] - lower[k]);
    lower[k] = glm::min(lower[k], mean[k] - down), upper[k] = glm::max(upper[k], mean[k] + up);
  }
  std::vector<Vec3> fitted = mean, next = mean;
  for (int i = 0; i < kIterations; ++i) {
    for (std::size_t k = 0; k < list.size(); ++k) {
      Vec3 change = mean[k] - fitted[k];
      for (std::size_t n = 0; n < list[k].share.size(); ++n)
        change -= list[k].share[n] * (fitted[list[k].neighbours[n]] - fitted[k]);
      next[k] = glm::clamp(fitted[k] + change, lower[k], upper[k]);
    }
    std::swap(fitted, next);
  }
  return fitted;
}

std::vector<Vec3> means_of(const std::vector<FittedTexel>& list, const LightmapPage& page) {
  std::vector<Vec3> mean;
  for (const FittedTexel& t : list) mean.push_back(page.irradiance[t.texel]);
  return mean;
}

}  // namespace

void fit_texels(const SampledPage& sampled, LightmapPage& page, std::span<LightmapPage* const> groups) {
  const std::vector<FittedTexel> list = valid_texels(sampled, page);
  const std::vector<Vec3> mean = means_of(list, page), fitted = fitted_to(list, mean);
  std::vector<float> weight(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Vec3 change = fitted[k] - mean[k];
    const Vec3 noise = kNoiseGate * page.standard_error[list[k].texel];
    const float signal2 = length2(change), noise2 = length2(noise);
    weight[k] = signal2 > 0 ? signal2 / (signal2 + noise2) : 0;
    if (signal2 > 0) page.irradiance[list[k].texel] += weight[k] * change;
  }
  for (LightmapPage* group : groups) {
    const std::vector<Vec3> own = means_of(list, *group), fit = fitted_to(list, own);
    for (std::size_t k = 0; k < list.size(); ++k) group->irradiance[list[k].texel] += weight[k] * (fit[k] - own[k]);
  }
}

}  // namespace oriel
