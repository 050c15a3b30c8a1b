#include "trade/front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oriel::trade {
namespace {

constexpr std::array<FrontKind, 4> kKinds = {{
    {"texels_by_bake", "Lightmap error against bake time", "bake, s", "texels, relRMSE %", "bake_s", "texel_relRMSE"},
    {"frames_by_bake", "Frame error against bake time", "bake, s", "frames, relRMSE %", "bake_s", "frame_sum"},
    {"frames_by_ms", "Frame error against frame time", "frame, ms", "frames, relRMSE %", "frame_ms", "frame_sum"},
    {"frames_by_bytes", "Frame error against size", "pack, MB", "frames, relRMSE %", "bytes", "frame_sum"},
}};

const Quantity& quantity(std::string_view name) {
  return *std::ranges::find(quantities(), name, &Quantity::name);
}

}  // namespace

std::optional<double> FrontKind::cost_of(const Measures& m) const {
  const auto value = quantity(cost).value(m);
  return value ? std::optional(quantity(cost).scale * *value) : value;
}

std::optional<double> FrontKind::error_of(const Measures& m) const {
  return quantity(error).value(m);
}

std::vector<std::size_t> pareto_front(std::span<const CostError> points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::isfinite(points[i].cost) && std::isfinite(points[i].error)) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const CostError &p = points[a], &q = points[b];
    return p.cost < q.cost || (p.cost == q.cost && p.error < q.error);
  });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order)
    if (points[i].error < least) {
      least = points[i].error;
      front.push_back(i);
    }
  return front;
}

std::span<const FrontKind> front_kinds() {
  return kKinds;
}

}  // namespace oriel::trade
