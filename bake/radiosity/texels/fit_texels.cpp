#include "bake/radiosity/texels/fit_texels.h"

#include <array>

namespace oriel {
namespace {

constexpr int kIterations = 8;    // the finest pattern is left at (3/4)^8, a tenth
constexpr float kWhole = 0.999f;  // of a texel's square
constexpr float kNoiseGate = 2;   // standard errors
constexpr std::uint32_t kNone = ~0u;

constexpr std::array<std::array<int, 2>, 8> kNeighbourSteps = {
    {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
// Weights of the texels around one in the mean of the interpolation over its square.
constexpr std::array<float, 8> kShare = {6.f / 64, 6.f / 64, 6.f / 64, 6.f / 64,
                                         1.f / 64, 1.f / 64, 1.f / 64, 1.f / 64};

struct FittedTexel {
  std::uint32_t texel = 0;                    // of the page
  std::array<std::uint32_t, 8> neighbours{};  // in kNeighbourSteps's order, of the list; itself where there is none
  bool whole = false;
};

std::vector<FittedTexel> valid_texels(const Atlas& atlas, const TexelMapPage& map, const LightmapPage& page) {
  std::vector<FittedTexel> list;
  std::vector<std::uint32_t> number(page.state.size(), kNone), chart;
  for (std::size_t i = 0; i < map.texel.size(); ++i) {
    if (page.state[map.texel[i]] != TexelState::kValid) continue;
    number[map.texel[i]] = static_cast<std::uint32_t>(list.size());
    list.push_back({.texel = map.texel[i], .neighbours = {}, .whole = covered_share(map, i) > kWhole});
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
  std::vector<Vec3> fitted = mean, next = mean;
  for (int i = 0; i < kIterations; ++i) {
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (!list[k].whole) continue;
      Vec3 change = mean[k] - fitted[k];
      for (std::size_t n = 0; n < kShare.size(); ++n) change -= kShare[n] * (fitted[list[k].neighbours[n]] - fitted[k]);
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

void fit_texels(const Atlas& atlas, const TexelMapPage& map, LightmapPage& page,
                std::span<LightmapPage* const> groups) {
  const std::vector<FittedTexel> list = valid_texels(atlas, map, page);
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
