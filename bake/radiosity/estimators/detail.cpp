#include "bake/radiosity/estimators/detail.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "bake/radiosity/estimators/blocks.h"
#include "bake/radiosity/estimators/level_grid.h"
#include "bake/radiosity/texels/frame_error.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kFewPoints = 1 << 14;  // lower limit on points of a pass
constexpr double kUsualError = 0.02;         // without a requested error
constexpr double kNegligible = 0.4;          // of the error allowed: points of cells below it are not stored

// The floor of frame pixels (texels/frame_error.h), for one view of the whole scene, luminance, lux.
double floor_of(const RadiosityTask& task, const Radiosity& light, std::span<const float> importance) {
  double sum = 0, all = 0;
  std::size_t number = 0;
  for (std::size_t p = 0; p < task.map.size(); ++p)
    for (const std::uint32_t texel : task.map[p].texel) {
      const double share = importance[number++];
      Vec3 lux = light.pages[p].irradiance[texel];
      if (!light.sharp.empty()) lux += light.sharp[p].irradiance[texel];
      sum += share * double{luminance(lux)}, all += share;
    }
  return all > 0 ? kFrameFloor * sum / all : 0;
}

// The largest side so that a page's points need at most 2^30 mask bits, 128 MiB.
std::uint32_t most_side(const Atlas& atlas) {
  std::uint64_t largest = 1;
  for (const AtlasPage& page : atlas.pages)
    largest = std::max(largest, (std::uint64_t{page.width} + 2) * (std::uint64_t{page.height} + 2));
  std::uint32_t side = kMostCellSide;
  while (side > 1 && largest * side * side > std::uint64_t{1} << 30u) side /= 2;
  return side;
}

class DetailMaker {
 public:
  DetailMaker(const RadiosityTask& task, const TexelLight& texel_light, const CellGoal& goal, Radiosity& light)
      : task_(task), texel_light_(texel_light), goal_(goal), light_(light) {}

  // Lights two steps first, wherever the estimate requires it, and more where their measured error does.
  Status run() {
    CellGoal first = goal_;
    first.most_side = 2;
    std::vector<CellCandidate> found = find_cells(task_.atlas, task_.map, light_,
                                                  {texel_light_.importance, texel_light_.texels.occlusion_heavy,
                                                   texel_light_.reflected.value, texel_light_.reflected.variance},
                                                  goal_);
    mark_gathering(found);
    CellLevels levels = choose_cells(light_.pages, found, first);
    ORIEL_TRY_VOID(light_cells(levels, 1, 0));
    const std::vector<CellCandidate> predicted = std::exchange(found, measured(levels, found));
    mark_gathering(found);
    CellGoal further = goal_;
    further.lit_level = 1;
    levels = choose_cells(light_.pages, found, further);
    for (const CellCandidate& cell : found)
      if (std::uint8_t& level = levels[cell.page][cell.place]; level == 0 && cell.error > kNegligible * goal_.error)
        level = 1;
    for (std::uint8_t level = 2; level <= kDetailLevels; ++level)
      ORIEL_TRY_VOID(light_cells(levels, level, level == 2 ? 0.3 : 0.6));
    add_all_blocks(levels, light_.pages);
    report(levels);
    light_.report.detail.unresolved = unresolved(predicted, levels);
    add_groups(levels);
    return {};
  }

 private:
  void mark_gathering(std::span<const CellCandidate> cells) {
    gathers_.clear();
    for (const LightmapPage& page : light_.pages) gathers_.emplace_back(page.state.size());
    for (const CellCandidate& cell : cells) gathers_[cell.page][cell.place] = cell.gathers;
  }

  void add_all_blocks(const CellLevels& levels, std::vector<LightmapPage>& pages) const {
    std::array<const PointLight*, kDetailLevels> points{};
    std::ranges::transform(points_, points.begin(), &std::unique_ptr<PointLight>::get);
    for (std::uint32_t p = 0; p < pages.size(); ++p) add_blocks(task_.map[p], levels[p], p, points, pages[p]);
  }

  // Adds the blocks of each light group; a group's share of the variance is taken as its share of the light.
  void add_groups(const CellLevels& levels) {
    std::array<std::vector<Vec3>, kDetailLevels> light, variance;
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (points_[k]) light[k] = points_[k]->light, variance[k] = points_[k]->variance;
    for (std::size_t g = 0; g < light_.groups.size(); ++g) {
      for (std::size_t k = 0; k < points_.size(); ++k)
        for (std::size_t i = 0; i < light[k].size(); ++i) {
          const Vec3 own = points_[k]->grouped.of(i)[g];
          const float all = luminance(light[k][i]);
          points_[k]->light[i] = own;
          points_[k]->variance[i] = variance[k][i] * (all > 0 ? luminance(glm::max(own, Vec3(0))) / all : 0.0f);
        }
      add_all_blocks(levels, light_.groups[g]);
    }
  }

  Status light_cells(const CellLevels& levels, std::uint8_t level, double done) {
    const auto lacks = [&](const auto& page) { return std::ranges::find(page, level) == page.end(); };
    if (std::ranges::all_of(levels, lacks)) return {};
    task_.context.foretell("detail", done);
    ORIEL_TRY(const DetailPoints points, list_points(task_.atlas, levels, level, task_.context));
    ORIEL_TRY(PointLight lit, light_points(own_, texel_light_, points, gathers_));
    points_[level - 1u] = std::make_unique<PointLight>(std::move(lit));
    return {};
  }

  // The lit candidates, with the error measured by their points.
  std::vector<CellCandidate> measured(const CellLevels& levels, std::span<const CellCandidate> found) {
    std::vector<CellCandidate> measured;
    for (std::uint32_t p = 0; points_[0] && p < levels.size(); ++p) {
      const LevelGrid& grid = grids_.emplace_back(light_.pages[p], levels[p], LevelGrid::Points{1, *points_[0]}, p);
      const std::uint32_t width = light_.pages[p].width;
      for (CellCandidate cell : found)
        if (cell.page == p && levels[p][cell.place] > 0)
          if (const auto missed = grid.missed(cell.place % width, cell.place / width)) {
            const CellErrors errors = evaluate_points(p, cell.place);
            cell.error = std::sqrt(*missed * *missed + errors.uneven) / cell.light * cell.weight;
            cell.gathers = cell.gathers && errors.reflected_missed / cell.light * cell.weight > goal_.error;
            measured.push_back(cell);
          }
    }
    return measured;
  }

  // Errors in a cell by its points, luminance. Next to a lamp light varies so much within the points that the filter
  // takes it for noise.
  struct CellErrors {
    double reflected_missed = 0;  // rms difference of reflected light from the texels, beyond noise
    double uneven = 0;            // mean of PointLight::uneven
  };
  CellErrors evaluate_points(std::uint32_t page, std::uint32_t place) const {
    const PointLight& lit = *points_[0];
    const std::uint32_t width = light_.pages[page].width;
    double squares = 0, uneven = 0, count = 0;
    for (std::uint32_t j = 0; j <= 2; ++j)
      for (std::uint32_t i = 0; i <= 2; ++i) {
        const std::uint32_t point = lit.texels.at(page, static_cast<int>(DetailPoints::fine(place % width, i, 2)),
                                                  static_cast<int>(DetailPoints::fine(place / width, j, 2)));
        if (point == kNoTexel || lit.texels.visible[point] == 0) continue;
        squares += std::pow(double{lit.reflected_change[point]}, 2) - double{lit.reflected_noise[point]}, ++count;
        uneven += double{lit.uneven[point]};
      }
    count = std::max(1.0, count);
    return {std::sqrt(std::max(0.0, squares) / count), uneven / count};
  }

  // The remaining error of interpolation, rms over frame pixels. At an edge each further level halves the area in
  // error. Cells without points have the predicted error, scaled by measured over predicted error of the cells with
  // points.
  double unresolved(std::span<const CellCandidate> predicted, const CellLevels& levels) const {
    std::vector<std::vector<const CellCandidate*>> at;
    for (const auto& page : levels) at.emplace_back(page.size());
    for (const CellCandidate& cell : predicted) at[cell.page][cell.place] = &cell;
    std::array<double, 2> predicted_sum{}, measured_sum{}, rest{};  // squares, of evaluated and of unevaluated cells
    double left = 0;
    for (const FramePixel& pixel : task_.pixels) {
      const CellCandidate* cell = at[pixel.page][pixel.texel[0]];
      if (cell == nullptr) continue;
      const double guess = std::pow(cell->error / cell->weight, 2);
      const Vec2 within(pixel.share[1] + pixel.share[3], pixel.share[2] + pixel.share[3]);
      const std::uint32_t width = light_.pages[pixel.page].width;
      const auto missed = grids_.empty()
                              ? std::nullopt
                              : grids_[pixel.page].missed_at(pixel.texel[0] % width, pixel.texel[0] / width, within);
      if (!missed) {
        rest[cell->unevaluated] += guess;
        continue;
      }
      const double light2 = cell->light * cell->light, square = missed->square / light2;
      const std::uint8_t level = levels[pixel.page][pixel.texel[0]];
      predicted_sum[cell->unevaluated] += guess, measured_sum[cell->unevaluated] += square;
      left += std::ldexp(square, -level) + (level > 0 ? missed->noise / light2 : 0);
    }
    for (int k = 0; k < 2; ++k) left += predicted_sum[k] > 0 ? rest[k] * measured_sum[k] / predicted_sum[k] : rest[k];
    return std::sqrt(left / static_cast<double>(std::max<std::size_t>(1, task_.pixels.size())));
  }

  void report(const CellLevels& levels) {
    DetailReport& report = light_.report.detail;
    report = {};
    for (const auto& page : levels)
      report.cells += page.size() - static_cast<std::size_t>(std::count(page.begin(), page.end(), 0));
    double squares = 0;
    for (const auto& lit : points_) {
      if (!lit) continue;
      report.points += lit->texels.count();
      for (std::size_t i = 0; i < lit->light.size(); ++i) {
        const double shown = luminance(lit->light[i]);
        squares += double{luminance(lit->variance[i])} / (shown * shown + goal_.floor * goal_.floor + 1e-30);
      }
    }
    if (report.points > 0) report.relative_error = std::sqrt(squares / static_cast<double>(report.points));
    report.rays = rays_ + quick_rays_;
  }

  const RadiosityTask& task_;
  const TexelLight& texel_light_;
  const CellGoal goal_;
  Radiosity& light_;
  // Counted apart from the refinement of texels, which may go on.
  std::atomic<std::uint64_t> rays_{0}, quick_rays_{0};
  const RadiosityTask own_{
      task_,      task_.pixels, task_.options, task_.context, {task_.context, &rays_}, {task_.context, &quick_rays_},
      task_.sharp};
  std::array<std::unique_ptr<PointLight>, kDetailLevels> points_;
  std::vector<LevelGrid> grids_;            // by page, of the first pass
  std::vector<std::vector<char>> gathers_;  // by page and place: cells whose points gather light
};

}  // namespace

Status add_detail(const RadiosityTask& task, const TexelLight& texel_light, Radiosity& light) {
  CellGoal goal{.error = task.options.error > 0 ? task.options.error : kUsualError,
                .floor = floor_of(task, light, texel_light.importance),
                .most_side = std::min(task.options.detail, most_side(task.atlas))};
  if (goal.most_side < 2) {
    task.context.warning("coarser-detail", "the lightmap's pages are too large for finer cells");
    return {};
  }
  const double finer = std::clamp(kUsualError / goal.error, 1.0, 4.0);
  goal.most_points =
      std::max(kFewPoints, static_cast<std::size_t>(finer * static_cast<double>(texel_light.texels.count())));
  return DetailMaker(task, texel_light, goal, light).run();
}

}  // namespace oriel
