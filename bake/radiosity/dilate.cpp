#include "bake/radiosity/dilate.h"

#include <algorithm>
#include <array>
#include <unordered_set>

namespace oriel {
namespace {

constexpr std::array<IVec2, 8> kNeighbours{IVec2{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}};

struct MeanLight {
  Vec3 irradiance{0}, direction{0};  // direction only where the page has it
};

// The mean light of those neighbours that `usable` accepts; false where there is none.
template <class Usable>
bool mean_of_neighbours(const LightmapPage& page, std::uint32_t texel, const Usable& usable, MeanLight& mean) {
  const int width = static_cast<int>(page.width), height = static_cast<int>(page.height);
  const int x = static_cast<int>(texel) % width, y = static_cast<int>(texel) / width;
  MeanLight sum;
  int count = 0;
  for (const IVec2& step : kNeighbours) {
    const int nx = x + step.x, ny = y + step.y;
    if (nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
    const auto neighbour = static_cast<std::uint32_t>(ny * width + nx);
    if (!usable(neighbour)) continue;
    sum.irradiance += page.irradiance[neighbour];
    if (!page.direction.empty()) sum.direction += page.direction[neighbour];
    ++count;
  }
  const auto n = static_cast<float>(count);
  if (count > 0) mean = {sum.irradiance / n, sum.direction / n};
  return count > 0;
}

// Repeats rounds in which every pending texel with a usable neighbour is filled; a round reads only earlier rounds, so
// the result does not depend on the order within it.
template <class Usable, class Fill>
void spread(LightmapPage& page, std::vector<std::uint32_t> pending, int rounds, const Usable& usable,
            const Fill& fill) {
  std::vector<std::pair<std::uint32_t, MeanLight>> found;
  for (int round = 0; round < rounds && !pending.empty(); ++round) {
    found.clear();
    std::vector<std::uint32_t> left;
    for (const std::uint32_t texel : pending) {
      MeanLight mean;
      if (mean_of_neighbours(
              page, texel, [&](std::uint32_t n) { return usable(texel, n); }, mean))
        found.emplace_back(texel, mean);
      else
        left.push_back(texel);
    }
    if (found.empty()) return;
    for (const auto& [texel, value] : found) {
      page.irradiance[texel] = value.irradiance;
      if (!page.direction.empty()) page.direction[texel] = value.direction;
      fill(texel);
    }
    pending = std::move(left);
  }
}

}  // namespace

void fill_buried(const Atlas& atlas, const TexelMapPage& map, LightmapPage& page) {
  std::vector<std::uint32_t> chart(page.state.size(), ~0u);
  std::vector<char> filled(page.state.size(), 0);
  std::unordered_set<std::uint32_t> lit;  // charts with a valid texel; others have nothing to spread
  std::vector<std::uint32_t> pending;
  for (std::size_t i = 0; i < map.texel.size(); ++i) {
    const std::uint32_t texel = map.texel[i];
    chart[texel] = atlas.chart[map.fragments[map.first[i]].triangle];
    filled[texel] = page.state[texel] == TexelState::kValid;
    if (filled[texel]) lit.insert(chart[texel]);
  }
  for (const std::uint32_t texel : map.texel)
    if (!filled[texel] && lit.contains(chart[texel])) pending.push_back(texel);
  const int rounds = static_cast<int>(std::max(page.width, page.height));
  spread(
      page, std::move(pending), rounds,
      [&](std::uint32_t at, std::uint32_t n) { return filled[n] && chart[n] == chart[at]; },
      [&](std::uint32_t texel) { filled[texel] = 1; });
}

void dilate(int texels, LightmapPage& page) {
  std::vector<std::uint32_t> pending;
  for (std::uint32_t texel = 0; texel < page.state.size(); ++texel)
    if (page.state[texel] == TexelState::kEmpty) pending.push_back(texel);
  // A chart that is buried whole is black and must not darken its neighbours.
  const auto usable = [&](std::uint32_t, std::uint32_t n) {
    return page.state[n] != TexelState::kEmpty &&
           (page.state[n] != TexelState::kBuried || max_component(page.irradiance[n]) > 0);
  };
  spread(page, std::move(pending), texels, usable,
         [&](std::uint32_t texel) { page.state[texel] = TexelState::kDilated; });
}

}  // namespace oriel
