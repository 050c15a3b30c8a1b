#include "tools/trade/front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oriel::trade {
namespace {

std::optional<double> bake_seconds(const Measures& m) {
  if (!m.bake) return {};
  return m.bake->seconds;
}

std::optional<double> megabytes(const Measures& m) {
  if (!m.bake) return {};
  return 1e-6 * static_cast<double>(m.bake->bytes);
}

std::optional<double> frame_ms(const Measures& m) {
  return m.frame_ms;
}

std::optional<double> texel_relrmse(const Measures& m) {
  if (!m.texels) return {};
  return m.texels->rel_rmse;
}

std::optional<double> frame_relrmse(const Measures& m) {
  return frame_error(m, &CameraError::sum);
}

constexpr std::array<FrontKind, 4> kKinds = {{
    {"texels_by_bake", "Lightmap error against bake time", "bake, s", "texels, relRMSE %", bake_seconds, texel_relrmse},
    {"frames_by_bake", "Frame error against bake time", "bake, s", "frames, relRMSE %", bake_seconds, frame_relrmse},
    {"frames_by_ms", "Frame error against frame time", "frame, ms", "frames, relRMSE %", frame_ms, frame_relrmse},
    {"frames_by_bytes", "Frame error against size", "pack, MB", "frames, relRMSE %", megabytes, frame_relrmse},
}};

}  // namespace

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
