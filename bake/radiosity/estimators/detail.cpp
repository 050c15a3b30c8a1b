#include "bake/radiosity/estimators/detail.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "bake/radiosity/estimators/blocks.h"
#include "bake/radiosity/texels/frame_error.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kFewPoints = 1 << 14;  // small scenes may have more than texels
constexpr double kUsualError = 0.02;         // where none is asked for

// As pixels of frames are held against (texels/frame_error.h), for one eye that sees all.
double floor_of(const RadiosityTask& task, const Radiosity& light, std::span<const float> shares) {
  double sum = 0, all = 0;
  std::size_t number = 0;
  for (std::size_t p = 0; p < task.map.size(); ++p)
    for (const std::uint32_t texel : task.map[p].texel) {
      const double share = shares[number++];
      sum += share * double{luminance(light.pages[p].irradiance[texel])}, all += share;
    }
  return all > 0 ? kFrameFloor * sum / all : 0;
}

// Places of a finer page are counted with 32 bits, and a mask of them is kept: at most 2^29, 64 MiB.
std::uint32_t most_side(const Atlas& atlas) {
  std::uint64_t largest = 1;
  for (const AtlasPage& page : atlas.pages)
    largest = std::max(largest, (std::uint64_t{page.width} + 2) * (std::uint64_t{page.height} + 2));
  std::uint32_t side = kMostDetail;
  while (side > 1 && largest * side * side > std::uint64_t{1} << 29u) side /= 2;
  return side;
}

}  // namespace

Status add_detail(const RadiosityTask& task, const TexelLight& known, Radiosity& light) {
  CellGoal goal{.error = task.options.error > 0 ? task.options.error : kUsualError,
                .floor = floor_of(task, light, known.shares),
                .most_side = std::min(task.options.detail, most_side(task.atlas))};
  if (goal.most_side < 2) {
    task.context.warning(
        "the lightmap's pages are too large for finer cells: a smaller --max-page leaves room for them");
    return {};
  }
  goal.most_points = std::max(kFewPoints, 2 * known.texels.count());
  const CellLevels levels = choose_cells(task.atlas, task.map, light, known.shares, goal);
  std::array<std::unique_ptr<PointLight>, kDetailLevels> points;
  DetailReport& report = light.report.detail;
  report = {};
  double squares = 0;
  // Counted apart: the texels' refinement, which may go on, has so many rays of its own.
  std::atomic<std::uint64_t> rays{0}, quick_rays{0};
  const RadiosityTask own{task.transport, task.atlas,   task.map, task.pixels,
                          task.options,   task.context, rays,     quick_rays};
  const auto cells_of = [&](std::uint8_t level) {
    std::size_t cells = 0;
    for (const auto& page : levels) cells += static_cast<std::size_t>(std::count(page.begin(), page.end(), level));
    return cells;
  };
  // About as many points, each level's as many times finer.
  const auto points_of = [&](std::uint8_t level) {
    return std::ldexp(static_cast<double>(cells_of(level)), 2 * level);
  };
  double all = 0, done = 0;
  for (std::uint8_t level = 1; level <= kDetailLevels; ++level) all += points_of(level);
  for (std::uint8_t level = 1; level <= kDetailLevels; ++level) {
    const std::size_t cells = cells_of(level);
    if (cells == 0) continue;
    task.context.foretell("detail", done / all);
    done += points_of(level);
    ORIEL_TRY(const DetailPoints of_level, list_points(task.atlas, levels, level, task.context));
    ORIEL_TRY(PointLight lit, light_points(own, known, of_level));
    report.cells += cells, report.points += lit.texels.count();
    for (std::size_t i = 0; i < lit.light.size(); ++i) {
      const double shown = luminance(lit.light[i]);
      squares += double{luminance(lit.variance[i])} / (shown * shown + goal.floor * goal.floor + 1e-30);
    }
    points[level - 1u] = std::make_unique<PointLight>(std::move(lit));
  }
  report.rays = rays + quick_rays;
  if (report.points > 0) report.relative_error = std::sqrt(squares / static_cast<double>(report.points));
  const auto add_all_blocks = [&](std::vector<LightmapPage>& pages) {
    for (std::uint32_t p = 0; p < pages.size(); ++p)
      add_blocks(task.map[p], levels[p], p, {points[0].get(), points[1].get(), points[2].get()}, pages[p]);
  };
  add_all_blocks(light.pages);
  for (std::size_t g = 0; g < light.groups.size(); ++g) {
    for (auto& of_level : points)
      if (of_level) of_level->light = of_level->booked.of_group(g);
    add_all_blocks(light.groups[g]);
  }
  return {};
}

}  // namespace oriel
