#include "bake/radiosity/cached/directions.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "bake/trace/warp.h"

namespace oriel {

DirectionSets::DirectionSets(std::uint64_t seed, std::uint32_t per_half) : per_half_(per_half) {
  const std::uint32_t sets = kTables * kPattern * kPattern;
  directions_.reserve(std::size_t{sets} * kHalves * per_half);
  for (std::uint32_t set = 0; set < sets * kHalves; ++set)
    for (std::uint32_t i = 0; i < per_half; ++i)
      directions_.push_back(square_to_cosine_hemisphere(Sampler(mix64(seed + 0x9a7e), set, i).next2()));
}

std::uint32_t DirectionSets::set_of(std::uint32_t page, std::uint32_t x, std::uint32_t y) {
  const std::uint64_t tile = mix64(std::uint64_t{page} << 40 | std::uint64_t{y / kTile} << 20 | x / kTile);
  const std::uint32_t place = (y % kPattern) * kPattern + x % kPattern;
  return static_cast<std::uint32_t>(tile % kTables) * kPattern * kPattern + place;
}

std::vector<std::uint32_t> coherent_order(const Texels& t) {
  std::vector<std::uint32_t> order(t.count());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    const std::uint32_t tile = (t.y[i] / DirectionSets::kTile) << 16 | t.x[i] / DirectionSets::kTile;
    return std::tuple(t.page[i], t.chart[i], tile, DirectionSets::set_of(t.page[i], t.x[i], t.y[i]), i);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  return order;
}

}  // namespace oriel
