#include "bake/radiosity/estimators/blocks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bake/radiosity/estimators/level_grid.h"

namespace oriel {
namespace {

class PageBlocks {
 public:
  PageBlocks(const TexelMapPage& map, const std::vector<std::uint8_t>& levels, std::uint32_t page_number,
             const std::array<const PointLight*, kDetailLevels>& points, LightmapPage& page)
      : levels_(levels), page_(page), covered_(page.state.size()) {
    for (const std::uint32_t texel : map.texel) covered_[texel] = true;
    for (std::uint8_t level = 1; level <= kDetailLevels; ++level)
      if (points[level - 1u] != nullptr)
        grids_[level].emplace(page, levels, LevelGrid::Points{level, *points[level - 1u]}, page_number);
  }

  void fill() {
    const std::vector<std::uint32_t> order = place_blocks();
    page_.detail.resize(std::size_t{page_.detail_width} * page_.detail_height);
    for (const std::uint32_t place : order) fill_block(place % page_.width, place / page_.width);
  }

 private:
  enum class Side { kLow, kHigh };

  // Level of a cell; nothing where it has no surface, or lies beyond the page.
  std::optional<std::uint8_t> level_of(int x, int y) const {
    if (x < 0 || y < 0 || x + 1 >= static_cast<int>(page_.width) || y + 1 >= static_cast<int>(page_.height))
      return std::nullopt;
    const std::size_t place = static_cast<std::size_t>(y) * page_.width + static_cast<std::size_t>(x);
    if (!covered_[place] && !covered_[place + 1] && !covered_[place + page_.width] &&
        !covered_[place + page_.width + 1])
      return std::nullopt;
    return levels_[place];
  }

  // The mean change by all cells around a texel's centre; 0 where one of them has no points.
  Vec3 change_at_texel(int x, int y) const {
    Vec3 sum(0);
    float count = 0;
    for (const auto& [dx, dy] : {std::pair{-1, -1}, {0, -1}, {-1, 0}, {0, 0}}) {
      const auto level = level_of(x + dx, y + dy);
      if (!level) continue;
      if (*level == 0) return Vec3(0);
      const LevelGrid& grid = *grids_[*level];
      sum += grid.at(static_cast<std::uint32_t>(x + dx), static_cast<std::uint32_t>(y + dy), dx < 0 ? grid.side() : 0,
                     dy < 0 ? grid.side() : 0);
      ++count;
    }
    return count > 0 ? sum / count : Vec3(0);
  }

  // The change of a cell of `level` at (x, y) at point (i, j), relative to its texels' interpolation.
  Vec3 change_in(std::uint8_t level, std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t n = 1u << level;
    if (i % n == 0 && j % n == 0) return change_at_texel(static_cast<int>(x + i / n), static_cast<int>(y + j / n));
    return grids_[level]->at(x, y, i, j);
  }

  // Interpolated light of the texels of the cell at (x, y); f: [0,1]².
  Vec3 between_texels(std::uint32_t x, std::uint32_t y, const Vec2& f) const {
    const std::size_t place = std::size_t{y} * page_.width + x;
    const auto& light = page_.irradiance;
    return glm::mix(glm::mix(light[place], light[place + 1], f.x),
                    glm::mix(light[place + page_.width], light[place + page_.width + 1], f.x), f.y);
  }

  // Light at a point of a cell of that level, not 0, without regard to coarser neighbours.
  Vec3 light_in(std::uint8_t level, std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    const Vec2 f = Vec2(i, j) / static_cast<float>(1u << level);
    return glm::max(between_texels(x, y, f) + change_in(level, x, y, i, j), Vec3(0));
  }

  // Light at a position on a side of a cell, f: [0,1]², interpolated between its points, or its texels for level 0.
  Vec3 light_on_side(std::uint8_t level, std::uint32_t x, std::uint32_t y, const Vec2& f) const {
    if (level == 0) return between_texels(x, y, f);
    const std::uint32_t n = 1u << level;
    const Vec2 at = f * static_cast<float>(n);
    const UVec2 low(at), high = glm::min(low + 1u, UVec2(n));
    const Vec2 share = at - Vec2(low);
    const Vec3 first = light_in(level, x, y, low.x, low.y);
    if (share.x > 0) return glm::mix(first, light_in(level, x, y, high.x, low.y), share.x);
    if (share.y > 0) return glm::mix(first, light_in(level, x, y, low.x, high.y), share.y);
    return first;
  }

  void fill_block(std::uint32_t x, std::uint32_t y) {
    const std::size_t place = std::size_t{y} * page_.width + x;
    const DetailBlock block = DetailBlock::of(page_.cell[place]);
    for (std::uint32_t j = 0; j <= block.side(); ++j)
      for (std::uint32_t i = 0; i <= block.side(); ++i)
        page_.detail[std::size_t{block.y + j} * page_.detail_width + block.x + i] =
            light_at(levels_[place], x, y, i, j);
  }

  // Light at a point; on a side shared with a coarser cell it is that cell's.
  Vec3 light_at(std::uint8_t level, std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t n = 1u << level;
    std::uint8_t fewest = level;
    IVec2 from(0);
    const auto check_side = [&](bool on_side, int dx, int dy) {
      const auto other = on_side ? level_of(static_cast<int>(x) + dx, static_cast<int>(y) + dy) : std::nullopt;
      if (other && *other < fewest) fewest = *other, from = {dx, dy};
    };
    check_side(i == 0, -1, 0), check_side(i == n, 1, 0), check_side(j == 0, 0, -1), check_side(j == n, 0, 1);
    if (fewest == level) return light_in(level, x, y, i, j);
    return light_on_side(fewest, x + static_cast<std::uint32_t>(from.x), y + static_cast<std::uint32_t>(from.y),
                         Vec2(i, j) / static_cast<float>(n) - Vec2(from));
  }

  // Places blocks in rows from the left, the largest first. Returns the cells' places in that order.
  std::vector<std::uint32_t> place_blocks() {
    std::vector<std::uint32_t> order;
    std::size_t area = 0;
    for (std::uint32_t place = 0; place < levels_.size(); ++place)
      if (levels_[place] > 0) {
        order.push_back(place);
        const std::size_t points = (std::size_t{1} << levels_[place]) + 1;
        area += points * points;
      }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return levels_[a] > levels_[b]; });
    if (order.empty()) return order;
    page_.cell.assign(levels_.size(), 0);
    const auto width = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(area))));
    page_.detail_width = std::max(width, (1u << levels_[order[0]]) + 1);
    std::uint32_t x = 0, y = 0, height = (1u << levels_[order[0]]) + 1;
    for (const std::uint32_t place : order) {
      const std::uint32_t points = (1u << levels_[place]) + 1;
      if (x + points > page_.detail_width) x = 0, y += height, height = points;
      page_.cell[place] = DetailBlock{x, y, levels_[place]}.code();
      x += points;
    }
    page_.detail_height = y + height;
    return order;
  }

  const std::vector<std::uint8_t>& levels_;
  LightmapPage& page_;
  std::vector<bool> covered_;
  std::array<std::optional<LevelGrid>, kDetailLevels + 1> grids_;  // by level
};

}  // namespace

void add_blocks(const TexelMapPage& map, const std::vector<std::uint8_t>& levels, std::uint32_t page_number,
                const std::array<const PointLight*, kDetailLevels>& points, LightmapPage& page) {
  page.cell.clear(), page.detail.clear(), page.detail_width = page.detail_height = 0;
  PageBlocks(map, levels, page_number, points, page).fill();
}

}  // namespace oriel
