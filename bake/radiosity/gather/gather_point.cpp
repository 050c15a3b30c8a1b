#include "bake/radiosity/gather/gather_point.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace oriel {

std::vector<std::uint32_t> coherent_order(const Texels& t) {
  constexpr std::uint32_t kBlock = 8;  // texels: their square is a group of gather()
  std::vector<std::uint32_t> order(t.count());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    return std::tuple(t.page[i], t.chart[i], t.y[i] / kBlock, t.x[i] / kBlock, i);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  return order;
}

}  // namespace oriel
