#include "bake/atlas/texel_demand.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oriel {
namespace {

constexpr double kSameTexel = 1.25;  // a chart that wants texels so little larger than the finest gets these
constexpr double kLeastSeen = 0.01;  // of a chart's pixels on average: what no ray met may be seen as much
constexpr double kMostCoarse = 1e30;
constexpr double kLittle = 1.0 / 16, kMostSpared = 3;  // even_out()

}  // namespace

std::uint8_t TexelDemand::ring(std::uint32_t triangle) const {
  const double d = triangles[triangle].eye_distance_m;
  return d <= even_m ? 0 : static_cast<std::uint8_t>(std::min(1 + std::floor(std::log2(d / even_m)), 255.0));
}

ChartTexel texel_for(const TexelDemand& demand, std::span<const std::uint32_t> triangles, double area_m2,
                     double finest_m) {
  ChartTexel chart{.texel_m = finest_m, .area_m2 = area_m2};
  double inverse = 0, nearest = std::numeric_limits<double>::max();
  for (const std::uint32_t t : triangles) {
    const TriangleDemand& wanted = demand.triangles[t];
    chart.pixels += wanted.pixels, inverse += wanted.inverse_square;
    nearest = std::min(nearest, static_cast<double>(wanted.eye_distance_m));
  }
  const double wanted = chart.pixels > 0 ? demand.angle_rad * std::sqrt(chart.pixels / inverse)
                                         : demand.unseen * std::max(finest_m, demand.angle_rad * nearest);
  if (wanted > kSameTexel * finest_m) chart.texel_m = wanted;
  return chart;
}

void even_out(std::span<ChartTexel*> charts) {
  double pixels = 0, texels = 0;
  for (const ChartTexel* chart : charts) {
    if (chart->pixels <= 0) continue;
    pixels += chart->pixels;
    texels += chart->area_m2 / (chart->texel_m * chart->texel_m);
  }
  if (!(texels > 0)) return;
  const double least = kLittle * pixels / texels;
  for (ChartTexel* chart : charts)
    if (chart->pixels > 0)
      chart->texel_m =
          std::clamp(std::sqrt(chart->area_m2 * least / chart->pixels), chart->texel_m, kMostSpared * chart->texel_m);
}

std::size_t coarsen(std::span<ChartTexel*> charts, const std::function<bool()>& too_many) {
  if (charts.empty() || !too_many()) return 0;
  double pixels = 0;
  std::vector<double> before;
  for (const ChartTexel* chart : charts) pixels += chart->pixels, before.push_back(chart->texel_m);
  const double least = std::max(kLeastSeen * pixels / static_cast<double>(charts.size()), 1e-6);
  const auto show = [&](double q) {
    for (std::size_t i = 0; i < charts.size(); ++i)
      charts[i]->texel_m = std::max(before[i], std::sqrt(charts[i]->area_m2 * q / std::max(charts[i]->pixels, least)));
  };
  double enough = 1e-6;
  while (show(enough), too_many() && enough < kMostCoarse) enough *= 16;
  for (double low = enough / 16, step = 0; step < 30; ++step) {
    const double middle = std::sqrt(low * enough);
    show(middle);
    (too_many() ? low : enough) = middle;
  }
  show(enough);
  std::size_t larger = 0;
  for (std::size_t i = 0; i < charts.size(); ++i) larger += charts[i]->texel_m > before[i];
  return larger;
}

}  // namespace oriel
