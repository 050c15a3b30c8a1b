#include "bake/radiosity/estimators/cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr float kEdge = 0.25f;      // of a second difference: error of interpolation at an edge
constexpr double kNeighbour = 0.4;  // of the error allowed: neighbours of a chosen cell above it are chosen too
constexpr double kNextLevel = 3;    // factor of the error
// Assumed relative error where texels cannot give one: in narrow charts, and at the rim of a chart with an occluder
// near.
constexpr double kUnevaluated = 0.1;
constexpr double kCoarser = 1.25;  // factor of the error, until there are few enough points
constexpr float kNoise = 3;        // standard errors of a texel: second differences by noise
constexpr std::uint32_t kNone = ~0u;

// Texel data of a page, by place.
class PageCells {
 public:
  PageCells(const Atlas& atlas, const TexelMapPage& map, const Radiosity& all, std::uint32_t p,
            const CellTexels& texels)
      : map_(map),
        page_(all.pages[p]),
        sharp_(all.sharp.empty() ? nullptr : &all.sharp[p]),
        visible_(all.visible[p]),
        number_(page_.state.size(), kNone),
        texels_(texels) {
    for (std::uint32_t i = 0; i < map.texel.size(); ++i) {
      number_[map.texel[i]] = i;
      chart_.push_back(atlas.chart[map.fragments[map.first[i]].triangle]);
    }
    const auto error = [&](std::uint32_t i) { return luminance(page_.standard_error[map.texel[i]]); };
    const auto reflected = [&](std::uint32_t i) { return luminance(texels.reflected[i]); };
    const auto its_error = [&](std::uint32_t i) { return std::sqrt(luminance(texels.reflected_variance[i])); };
    for (std::uint32_t i = 0; i < map.texel.size(); ++i) {
      bend_.push_back(bend_at(
          i, [&](std::uint32_t at) { return light(at); }, error));
      if (!texels.reflected.empty()) reflected_bend_.push_back(bend_at(i, reflected, its_error).value_or(0));
    }
  }

  // usual: mean importance of a texel. left: cells to leave as they are; may be empty.
  void add(std::uint32_t page_number, const CellGoal& goal, double usual, const std::vector<bool>& left,
           std::vector<CellCandidate>& found) const {
    for (std::uint32_t y = 0; y + 1 < page_.height; ++y)
      for (std::uint32_t x = 0; x + 1 < page_.width; ++x) {
        const std::uint32_t place = y * page_.width + x;
        const bool stays = !left.empty() && left[place];
        add_cell({.page = page_number, .place = place, .stays = stays}, goal, usual, found);
      }
  }

 private:
  bool valid(std::uint32_t i) const { return page_.state[map_.texel[i]] == TexelState::kValid; }
  float light(std::uint32_t i) const { return luminance(page_.irradiance[map_.texel[i]]); }

  std::uint32_t neighbour(std::uint32_t i, int dx, int dy) const {
    const int x = static_cast<int>(map_.texel[i] % page_.width) + dx,
              y = static_cast<int>(map_.texel[i] / page_.width) + dy;
    if (x < 0 || y < 0 || x >= static_cast<int>(page_.width) || y >= static_cast<int>(page_.height)) return kNone;
    const std::uint32_t other = number_[static_cast<std::size_t>(y) * page_.width + static_cast<std::size_t>(x)];
    return other != kNone && valid(other) && chart_[other] == chart_[i] ? other : kNone;
  }

  // The largest second difference less its noise; nothing where a chart is too narrow for one.
  template <class Light, class Error>
  std::optional<float> bend_at(std::uint32_t i, const Light& light, const Error& error) const {
    if (!valid(i)) return std::nullopt;
    float most = -1;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
      const std::uint32_t before = neighbour(i, -dx, -dy), after = neighbour(i, dx, dy);
      if (before != kNone && after != kNone)
        most = std::max(most, std::fabs(light(before) - 2 * light(i) + light(after)));
      // At the foot of an object the second difference is taken one texel away from it.
      else if (const std::uint32_t further = after != kNone ? neighbour(after, dx, dy) : kNone; further != kNone)
        most = std::max(most, std::fabs(light(i) - 2 * light(after) + light(further)));
      else if (const std::uint32_t back = before != kNone ? neighbour(before, -dx, -dy) : kNone; back != kNone)
        most = std::max(most, std::fabs(light(i) - 2 * light(before) + light(back)));
    }
    if (most < 0) return std::nullopt;
    return std::max(0.0f, most - kNoise * error(i));
  }

  void add_cell(CellCandidate cell, const CellGoal& goal, double usual, std::vector<CellCandidate>& found) const {
    float bend = 0, reflected_bend = 0;
    double light_sum = 0, share = 0;
    int corners = 0;
    bool occlusion_heavy = false, narrow = true;
    for (const std::uint32_t corner :
         {cell.place, cell.place + 1, cell.place + page_.width, cell.place + page_.width + 1}) {
      const std::uint32_t i = number_[corner];
      cell.contact = cell.contact || (i != kNone && visible_[i] < kWholeTexel);
      if (i == kNone || !valid(i)) continue;
      if (bend_[i]) bend = std::max(bend, *bend_[i]), narrow = false;
      if (!reflected_bend_.empty()) reflected_bend = std::max(reflected_bend, reflected_bend_[i]);
      occlusion_heavy = occlusion_heavy || texels_.occlusion_heavy[i];
      light_sum += double{light(i)} + (sharp_ ? double{luminance(sharp_->irradiance[corner])} : 0),
          share += double{texels_.importance[i]};
      ++corners;
    }
    if (corners == 0 || share <= 0) return;
    const double mean = light_sum / corners;
    cell.light = std::sqrt(mean * mean + goal.floor * goal.floor + 1e-30);
    cell.weight = std::sqrt(share / corners / usual);
    cell.error = double{kEdge} * double{bend} / cell.light * cell.weight;
    cell.unevaluated = narrow || (corners < 4 && occlusion_heavy);
    if (cell.unevaluated) cell.error = std::max(cell.error, kUnevaluated * cell.weight);
    cell.gathers = reflected_bend_.empty() || occlusion_heavy || narrow || cell.contact ||
                   double{kEdge} * double{reflected_bend} / cell.light * cell.weight > goal.error;
    if (cell.contact || cell.error > kNeighbour * goal.error) found.push_back(cell);
  }

  const TexelMapPage& map_;
  const LightmapPage& page_;
  const LightmapPage* sharp_;               // null: it has all light
  const std::vector<float>& visible_;       // by texel of the map
  std::vector<std::uint32_t> number_;       // by place, into the map
  std::vector<std::uint32_t> chart_;        // by texel of the map
  std::vector<std::optional<float>> bend_;  // likewise
  std::vector<float> reflected_bend_;       // likewise
  CellTexels texels_;                       // likewise
};

// A further level halves the error at an edge for four times the points, which is best used at about three times the
// error. Points at a quarter of the cost are used from half of that error on.
std::uint8_t level_for(double error, bool gathers, const CellGoal& goal) {
  if (!gathers) error *= std::sqrt(double{kDirectPoints});
  std::uint8_t level = 1;
  for (double next = kNextLevel * goal.error; (2u << level) <= goal.most_side && error > next; next *= kNextLevel)
    ++level;
  return level;
}

// The number of points as CellGoal::most_points counts them, times kDirectPoints. Adjacent cells share border points.
std::uint64_t points_of(std::uint8_t level, bool gathers, const CellGoal& goal) {
  if (level <= goal.lit_level) return 0;
  const std::uint64_t side = std::uint64_t{1} << level;
  return side * (side + 1) * (gathers ? kDirectPoints : 1);
}

// Chooses cells among the candidates.
class Chooser {
 public:
  Chooser(std::span<const LightmapPage> pages, std::span<const CellCandidate> found) : found_(found) {
    for (const LightmapPage& page : pages) {
      width_.push_back(static_cast<int>(page.width));
      at_.emplace_back(page.state.size(), kNone);
    }
    for (std::uint32_t k = 0; k < found.size(); ++k) at_[found[k].page][found[k].place] = k;
    // Partly hidden texels give poor second differences: their neighbours' are used.
    for (std::uint32_t k = 0; k < found.size(); ++k) {
      error_.push_back(found[k].stays ? 0 : found[k].error);
      if (found[k].contact && !found[k].stays)
        for_each_neighbour(k, [&](std::uint32_t other) { error_[k] = std::max(error_[k], found[other].error); });
    }
  }

  // Chooses cells with too large an error. A neighbour with nearly as large an error gets as many steps, so that edges
  // are continuous.
  CellLevels choose(const CellGoal& goal, std::uint64_t& points) const {
    CellLevels levels;
    for (const auto& page : at_) levels.emplace_back(page.size());
    std::vector<std::uint32_t> chosen;
    points = 0;
    const auto choose_cell = [&](std::uint32_t k, std::uint8_t level) {
      std::uint8_t& now = levels[found_[k].page][found_[k].place];
      if (level <= now) return;
      points += points_of(level, found_[k].gathers, goal) - points_of(now, found_[k].gathers, goal);
      now = level;
      chosen.push_back(k);
    };
    for (std::uint32_t k = 0; k < found_.size(); ++k)
      if (error_[k] > goal.error) choose_cell(k, level_for(error_[k], found_[k].gathers, goal));
    for (std::size_t next = 0; next < chosen.size(); ++next) {
      const std::uint8_t own = levels[found_[chosen[next]].page][found_[chosen[next]].place];
      for_each_neighbour(chosen[next], [&](std::uint32_t k) {
        if (const double nearly = error_[k] / kNeighbour; nearly > goal.error)
          choose_cell(k, std::min(own, level_for(nearly, found_[k].gathers, goal)));
      });
    }
    return levels;
  }

 private:
  template <class Body>
  void for_each_neighbour(std::uint32_t k, const Body& body) const {
    for (const int dy : {-1, 0, 1})
      for (const int dx : {-1, 0, 1}) {
        const std::size_t place = found_[k].place + static_cast<std::size_t>(dy * width_[found_[k].page] + dx);
        const auto& page = at_[found_[k].page];
        if (place < page.size() && page[place] != kNone && page[place] != k) body(page[place]);
      }
  }

  std::span<const CellCandidate> found_;
  std::vector<int> width_;                      // by page
  std::vector<std::vector<std::uint32_t>> at_;  // by page and place: number of the candidate
  std::vector<double> error_;                   // by candidate
};

}  // namespace

CellTexels CellTexels::of(std::size_t first, std::size_t count) const {
  CellTexels some{importance.subspan(first, count), occlusion_heavy.subspan(first, count), {}, {}};
  if (reflected.empty()) return some;
  some.reflected = reflected.subspan(first, count), some.reflected_variance = reflected_variance.subspan(first, count);
  return some;
}

std::vector<CellCandidate> find_cells(const Atlas& atlas, std::span<const TexelMapPage> map, const Radiosity& light,
                                      const CellTexels& texels, const CellGoal& goal) {
  std::vector<CellCandidate> found;
  const double usual = std::accumulate(texels.importance.begin(), texels.importance.end(), 0.0) /
                       std::max<double>(1, static_cast<double>(texels.importance.size()));
  std::size_t first = 0;
  for (std::uint32_t p = 0; p < map.size(); ++p) {
    const std::size_t count = map[p].texel.size();
    PageCells(atlas, map[p], light, p, texels.of(first, count))
        .add(p, goal, usual, light.at_seam.empty() ? std::vector<bool>() : light.at_seam[p], found);
    first += count;
  }
  return found;
}

CellLevels choose_cells(std::span<const LightmapPage> pages, std::span<const CellCandidate> found,
                        const CellGoal& goal) {
  const Chooser chooser(pages, found);
  CellGoal allowed = goal;
  for (;; allowed.error *= kCoarser) {
    std::uint64_t points = 0;
    CellLevels levels = chooser.choose(allowed, points);
    if (points <= kDirectPoints * goal.most_points) return levels;
  }
}

}  // namespace oriel
