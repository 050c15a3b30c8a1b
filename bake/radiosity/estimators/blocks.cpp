#include "bake/radiosity/estimators/blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr float kBothNoises = 0.5f;  // times

// By how much the points of a page's cells of one level differ from the interpolation of its texels.
class LevelGrid {
 public:
  LevelGrid(const LightmapPage& page, const std::vector<std::uint8_t>& levels, std::uint8_t level,
            const PointLight& points, std::uint32_t page_number)
      : side_(1u << level), width_((page.width + 2) * side_) {
    for (std::uint32_t place = 0; place < levels.size(); ++place) {
      if (levels[place] != level) continue;
      for (std::uint32_t j = 0; j <= side_; ++j)
        for (std::uint32_t i = 0; i <= side_; ++i)
          place_.push_back(number(place % page.width, place / page.width, i, j));
    }
    std::sort(place_.begin(), place_.end());
    place_.erase(std::unique(place_.begin(), place_.end()), place_.end());
    change_.resize(place_.size()), known_.resize(place_.size());
    std::vector<float> noise(place_.size());
    for (std::size_t k = 0; k < place_.size(); ++k) {
      const std::uint32_t x = place_[k] % width_, y = place_[k] / width_;
      const std::uint32_t point = points.texels.at(page_number, static_cast<int>(x), static_cast<int>(y));
      if (point == kNoTexel || points.texels.visible[point] == 0) continue;
      change_[k] = points.light[point] - between_texels(page, x, y);
      noise[k] = luminance(points.variance[point]);
      known_[k] = true;
    }
    leave_noise(noise);
    leave_dots();
    for (std::uint32_t pass = 0; pass <= side_; ++pass) spread();
  }

  // Of point (i, j) of the cell at (x, y), which must be of this level or beside one.
  Vec3 at(std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    const std::size_t k = find(number(x, y, i, j));
    return k < place_.size() ? change_[k] : Vec3(0);
  }
  std::uint32_t side() const { return side_; }

 private:
  std::uint32_t number(std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    return DetailPoints::fine(y, j, side_) * width_ + DetailPoints::fine(x, i, side_);
  }
  std::size_t find(std::uint32_t place) const {
    const auto found = std::lower_bound(place_.begin(), place_.end(), place);
    return found != place_.end() && *found == place ? static_cast<std::size_t>(found - place_.begin()) : place_.size();
  }
  Vec3 between_texels(const LightmapPage& page, std::uint32_t x, std::uint32_t y) const {
    const Vec2 texel = Vec2(x, y) / static_cast<float>(side_) - 1.0f;
    return irradiance_at(page, (texel + 0.5f) / Vec2(page.width, page.height));  // which has no cells yet
  }
  // Of each change the share that is no noise, as the changes around tell (Wiener): where points do not tell more than
  // texels, these are smoother.
  void leave_noise(const std::vector<float>& noise) {
    std::vector<float> share(place_.size());
    for (std::size_t k = 0; k < place_.size(); ++k) {
      float squares = 0, chance = 0;
      for_each_around(k, [&](std::size_t other) {
        const float change = luminance(change_[other]);
        squares += change * change, chance += noise[other];
      });
      share[k] = squares > 0 ? std::max(0.0f, 1 - kBothNoises * chance / squares) : 0;
    }
    for (std::size_t k = 0; k < place_.size(); ++k) change_[k] *= share[k];
  }

  // A point alone that differs more than all around it is one lucky path: shadows are longer than a point.
  void leave_dots() {
    const std::vector<Vec3> before = change_;
    for (std::size_t k = 0; k < place_.size(); ++k) {
      Vec3 least(std::numeric_limits<float>::max()), most(-std::numeric_limits<float>::max());
      for_each_around(k, [&](std::size_t other) {
        if (other != k) least = glm::min(least, before[other]), most = glm::max(most, before[other]);
      });
      if (least.r <= most.r) change_[k] = glm::clamp(before[k], least, most);
    }
  }

  // Points that are known, of the nine around one.
  template <class Body>
  void for_each_around(std::size_t k, const Body& body) const {
    for (const int dy : {-1, 0, 1})
      for (const int dx : {-1, 0, 1}) {
        const std::size_t other = find(place_[k] + static_cast<std::uint32_t>(dy * static_cast<int>(width_) + dx));
        if (other < place_.size() && known_[other]) body(other);
      }
  }

  // To points that are not known, from those beside them.
  void spread() {
    std::vector<std::pair<std::size_t, Vec3>> found;
    for (std::size_t k = 0; k < place_.size(); ++k) {
      if (known_[k]) continue;
      Vec3 sum(0);
      float count = 0;
      for_each_around(k, [&](std::size_t other) { sum += change_[other], ++count; });
      if (count > 0) found.emplace_back(k, sum / count);
    }
    for (const auto& [k, change] : found) change_[k] = change, known_[k] = true;
  }

  std::uint32_t side_, width_;
  std::vector<std::uint32_t> place_;  // ascending
  std::vector<Vec3> change_;
  std::vector<bool> known_;
};

class PageBlocks {
 public:
  PageBlocks(const TexelMapPage& map, const std::vector<std::uint8_t>& levels, std::uint32_t page_number,
             const std::array<const PointLight*, kDetailLevels>& points, LightmapPage& page)
      : levels_(levels), page_(page), covered_(page.state.size()) {
    for (const std::uint32_t texel : map.texel) covered_[texel] = true;
    for (std::uint8_t level = 1; level <= kDetailLevels; ++level)
      if (points[level - 1u] != nullptr) grids_[level].emplace(page, levels, level, *points[level - 1u], page_number);
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

  // What all cells around a texel's centre add to its light there: nothing where one of them has no points of its own.
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

  // What a cell of `level` at (x, y) adds to its texels' interpolation at a place in it, both of [0,1].
  Vec3 change_in(std::uint8_t level, std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    const LevelGrid& grid = *grids_[level];
    const std::uint32_t n = grid.side();
    const Vec2 f = Vec2(i, j) / static_cast<float>(n);
    Vec3 change = grid.at(x, y, i, j);
    for (const std::uint32_t b : {0u, 1u})
      for (const std::uint32_t a : {0u, 1u}) {
        const float share = (a ? f.x : 1 - f.x) * (b ? f.y : 1 - f.y);
        if (share > 0)
          change +=
              share * (change_at_texel(static_cast<int>(x + a), static_cast<int>(y + b)) - grid.at(x, y, a * n, b * n));
      }
    return change;
  }

  // Light between the texels of the cell at (x, y); f: of [0,1].
  Vec3 between_texels(std::uint32_t x, std::uint32_t y, const Vec2& f) const {
    const std::size_t place = std::size_t{y} * page_.width + x;
    const auto& light = page_.irradiance;
    return glm::mix(glm::mix(light[place], light[place + 1], f.x),
                    glm::mix(light[place + page_.width], light[place + page_.width + 1], f.x), f.y);
  }

  // Light at a point of a cell of that level, not 0, as if it met none with fewer steps.
  Vec3 light_in(std::uint8_t level, std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    const Vec2 f = Vec2(i, j) / static_cast<float>(1u << level);
    return glm::max(between_texels(x, y, f) + change_in(level, x, y, i, j), Vec3(0));
  }

  // Light at a place on a side of a cell, f of [0,1]: between its points, or its texels where the level is 0.
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

  // On a side that it shares with a cell of fewer steps, what that one shows.
  Vec3 light_at(std::uint8_t level, std::uint32_t x, std::uint32_t y, std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t n = 1u << level;
    std::uint8_t fewest = level;
    IVec2 from(0);
    const auto look = [&](bool on_side, int dx, int dy) {
      const auto other = on_side ? level_of(static_cast<int>(x) + dx, static_cast<int>(y) + dy) : std::nullopt;
      if (other && *other < fewest) fewest = *other, from = {dx, dy};
    };
    look(i == 0, -1, 0), look(i == n, 1, 0), look(j == 0, 0, -1), look(j == n, 0, 1);
    if (fewest == level) return light_in(level, x, y, i, j);
    return light_on_side(fewest, x + static_cast<std::uint32_t>(from.x), y + static_cast<std::uint32_t>(from.y),
                         Vec2(i, j) / static_cast<float>(n) - Vec2(from));
  }

  // Largest first, in rows from the left. The cells' places in that order.
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
