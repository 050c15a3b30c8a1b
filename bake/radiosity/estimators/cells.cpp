#include "bake/radiosity/estimators/cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr float kEdge = 0.25f;     // of a second difference: what interpolation misses at an edge
constexpr double kBeside = 0.4;    // of the error allowed: from there on what lies beside a chosen cell is one too
constexpr float kWhole = 0.999f;   // of a texel that is visible
constexpr double kCoarser = 1.25;  // times the error, until there are few enough points
constexpr float kNoise = 3;        // standard errors of a texel: what may bend by chance
constexpr std::uint32_t kNone = ~0u;

struct Candidate {
  std::uint32_t page = 0, place = 0;
  double error = 0;      // what interpolation misses, relative, of what people notice
  bool contact = false;  // something stands or hangs on a corner
};

// What is known of the texels of a page, by place.
class PageCells {
 public:
  PageCells(const Atlas& atlas, const TexelMapPage& map, const LightmapPage& page, const std::vector<float>& visible,
            std::span<const float> shares)
      : map_(map), page_(page), visible_(visible), number_(page.state.size(), kNone), shares_(shares) {
    for (std::uint32_t i = 0; i < map.texel.size(); ++i) {
      number_[map.texel[i]] = i;
      chart_.push_back(atlas.chart[map.fragments[map.first[i]].triangle]);
    }
    bend_.resize(map.texel.size());
    for (std::uint32_t i = 0; i < map.texel.size(); ++i) bend_[i] = bend_at(i);
  }

  // usual: share of frames of a texel. left: cells to leave as they are, none where empty.
  void add(std::uint32_t page_number, const CellGoal& goal, double usual, const std::vector<bool>& left,
           std::vector<Candidate>& found) const {
    for (std::uint32_t y = 0; y + 1 < page_.height; ++y)
      for (std::uint32_t x = 0; x + 1 < page_.width; ++x) {
        const std::uint32_t place = y * page_.width + x;
        if (left.empty() || !left[place]) add_cell({page_number, place}, goal, usual, found);
      }
  }

 private:
  bool valid(std::uint32_t i) const { return page_.state[map_.texel[i]] == TexelState::kValid; }
  float light(std::uint32_t i) const { return luminance(page_.irradiance[map_.texel[i]]); }

  std::uint32_t beside(std::uint32_t i, int dx, int dy) const {
    const int x = static_cast<int>(map_.texel[i] % page_.width) + dx,
              y = static_cast<int>(map_.texel[i] / page_.width) + dy;
    if (x < 0 || y < 0 || x >= static_cast<int>(page_.width) || y >= static_cast<int>(page_.height)) return kNone;
    const std::uint32_t other = number_[static_cast<std::size_t>(y) * page_.width + static_cast<std::size_t>(x)];
    return other != kNone && valid(other) && chart_[other] == chart_[i] ? other : kNone;
  }

  // The larger of both axes' second differences, less what noise may bring.
  float bend_at(std::uint32_t i) const {
    if (!valid(i)) return 0;
    float most = 0;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
      const std::uint32_t before = beside(i, -dx, -dy), after = beside(i, dx, dy);
      if (before != kNone && after != kNone)
        most = std::max(most, std::fabs(light(before) - 2 * light(i) + light(after)));
      // At the foot of something light bends as it does a texel away from it.
      else if (const std::uint32_t further = after != kNone ? beside(after, dx, dy) : kNone; further != kNone)
        most = std::max(most, std::fabs(light(i) - 2 * light(after) + light(further)));
      else if (const std::uint32_t back = before != kNone ? beside(before, -dx, -dy) : kNone; back != kNone)
        most = std::max(most, std::fabs(light(i) - 2 * light(before) + light(back)));
    }
    return std::max(0.0f, most - kNoise * luminance(page_.standard_error[map_.texel[i]]));
  }

  void add_cell(Candidate cell, const CellGoal& goal, double usual, std::vector<Candidate>& found) const {
    float bend = 0;
    double light_sum = 0, share = 0;
    int corners = 0;
    for (const std::uint32_t corner :
         {cell.place, cell.place + 1, cell.place + page_.width, cell.place + page_.width + 1}) {
      const std::uint32_t i = number_[corner];
      cell.contact = cell.contact || (i != kNone && visible_[i] < kWhole);
      if (i == kNone || !valid(i)) continue;
      bend = std::max(bend, bend_[i]);
      light_sum += double{light(i)}, share += double{shares_[i]};
      ++corners;
    }
    if (corners == 0 || share <= 0) return;
    const double mean = light_sum / corners;
    cell.error = double{kEdge} * double{bend} / std::sqrt(mean * mean + goal.floor * goal.floor + 1e-30);
    cell.error *= std::sqrt(std::min(1.0, share / corners / usual));
    if (cell.contact || cell.error > kBeside * goal.error) found.push_back(cell);
  }

  const TexelMapPage& map_;
  const LightmapPage& page_;
  const std::vector<float>& visible_;  // by texel of the map
  std::vector<std::uint32_t> number_;  // by place, into the map
  std::vector<std::uint32_t> chart_;   // by texel of the map
  std::vector<float> bend_;            // likewise
  std::span<const float> shares_;      // likewise
};

std::uint8_t level_for(double error, const CellGoal& goal) {
  std::uint8_t level = 1;
  while ((2u << level) <= goal.most_side && error > goal.error * (1u << level)) ++level;
  return level;
}

// Those that miss more than is allowed; then those that miss somewhat less, or lie at a contact, where they touch a
// chosen one, with half of its steps at least: edges are not drawn in dashes.
CellLevels choose(std::span<const LightmapPage> pages, const std::vector<Candidate>& found, const CellGoal& goal,
                  std::uint64_t& points) {
  CellLevels levels(pages.size());
  std::vector<std::vector<std::uint32_t>> open(pages.size());  // by place: number in `found`, + 1
  for (std::size_t p = 0; p < pages.size(); ++p)
    levels[p].resize(pages[p].state.size()), open[p].resize(pages[p].state.size());
  std::vector<std::uint32_t> chosen;
  points = 0;
  const auto take = [&](std::uint32_t k, std::uint8_t level) {
    levels[found[k].page][found[k].place] = level;
    open[found[k].page][found[k].place] = 0;
    points += ((std::uint64_t{1} << level) + 1) * ((std::uint64_t{1} << level) + 1);
    chosen.push_back(k);
  };
  for (std::uint32_t k = 0; k < found.size(); ++k) {
    if (found[k].error > goal.error)
      take(k, level_for(found[k].error, goal));
    else if (found[k].contact || found[k].error > kBeside * goal.error)
      open[found[k].page][found[k].place] = k + 1;
  }
  for (std::size_t next = 0; next < chosen.size(); ++next) {
    const Candidate& cell = found[chosen[next]];
    const int own = levels[cell.page][cell.place], width = static_cast<int>(pages[cell.page].width);
    for (const int dy : {-1, 0, 1})
      for (const int dx : {-1, 0, 1}) {
        const std::size_t place = cell.place + static_cast<std::size_t>(dy * width + dx);
        if (place < open[cell.page].size() && open[cell.page][place] != 0)
          take(open[cell.page][place] - 1, static_cast<std::uint8_t>(std::max(own - 1, 1)));
      }
  }
  return levels;
}

}  // namespace

CellLevels choose_cells(const Atlas& atlas, std::span<const TexelMapPage> map, const Radiosity& light,
                        std::span<const float> shares, const CellGoal& goal) {
  std::vector<Candidate> found;
  const double usual = std::accumulate(shares.begin(), shares.end(), 0.0) / std::max<double>(1, shares.size());
  std::size_t first = 0;
  for (std::uint32_t p = 0; p < map.size(); ++p) {
    PageCells(atlas, map[p], light.pages[p], light.visible[p], shares.subspan(first, map[p].texel.size()))
        .add(p, goal, usual, light.at_seam.empty() ? std::vector<bool>() : light.at_seam[p], found);
    first += map[p].texel.size();
  }
  CellGoal allowed = goal;
  for (;; allowed.error *= kCoarser) {
    std::uint64_t points = 0;
    CellLevels levels = choose(light.pages, found, allowed, points);
    if (points <= goal.most_points) return levels;
  }
}

}  // namespace oriel
