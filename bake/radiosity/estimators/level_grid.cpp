#include "bake/radiosity/estimators/level_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr float kBothNoises = 0.5f;  // times

}  // namespace

LevelGrid::LevelGrid(const LightmapPage& page, const std::vector<std::uint8_t>& levels, const Points& points,
                     std::uint32_t page_number)
    : side_(1u << points.level), width_((page.width + 2) * side_) {
  for (std::uint32_t place = 0; place < levels.size(); ++place) {
    if (levels[place] != points.level) continue;
    for (std::uint32_t j = 0; j <= side_; ++j)
      for (std::uint32_t i = 0; i <= side_; ++i) place_.push_back(number(place % page.width, place / page.width, i, j));
  }
  std::sort(place_.begin(), place_.end());
  place_.erase(std::unique(place_.begin(), place_.end()), place_.end());
  find_neighbours();
  change_.resize(place_.size()), noise_.resize(place_.size()), own_.resize(place_.size());
  for (std::size_t k = 0; k < place_.size(); ++k) {
    const std::uint32_t x = place_[k] % width_, y = place_[k] / width_;
    const std::uint32_t point = points.light.texels.at(page_number, static_cast<int>(x), static_cast<int>(y));
    if (point == kNoTexel || points.light.texels.visible[point] == 0) continue;
    change_[k] = points.light.light[point] - between_texels(page, x, y);
    noise_[k] = luminance(points.light.variance[point]);
    own_[k] = 1;
  }
  has_value_ = own_;
  remove_noise();
  remove_outliers();
  for (std::uint32_t pass = 0; pass <= side_ && spread(); ++pass) {
  }
  around_ = {};
}

std::optional<double> LevelGrid::missed(std::uint32_t x, std::uint32_t y) const {
  double squares = 0, count = 0;
  for (std::uint32_t j = 0; j <= side_; ++j)
    for (std::uint32_t i = 0; i <= side_; ++i) {
      const std::size_t k = find(number(x, y, i, j));
      if (k == place_.size() || !own_[k]) continue;
      squares += std::pow(double{luminance(change_[k])}, 2), ++count;
    }
  if (count == 0) return std::nullopt;
  return std::sqrt(squares / count);
}

std::optional<LevelGrid::Missed> LevelGrid::missed_at(std::uint32_t x, std::uint32_t y, const Vec2& within) const {
  const Vec2 at = within * static_cast<float>(side_);
  const auto first = glm::min(UVec2(at), UVec2(side_ - 1));
  const Vec2 f = at - Vec2(first);
  Vec3 change(0);
  Missed missed;
  for (const std::uint32_t j : {0u, 1u})
    for (const std::uint32_t i : {0u, 1u}) {
      const std::size_t k = find(number(x, y, first.x + i, first.y + j));
      if (k == place_.size()) return std::nullopt;
      const float share = (i ? f.x : 1 - f.x) * (j ? f.y : 1 - f.y);
      change += share * change_[k], missed.noise += double{share * noise_[k]};
    }
  missed.square = std::pow(double{luminance(change)}, 2);
  return missed;
}

std::size_t LevelGrid::find(std::uint32_t place) const {
  const auto found = std::lower_bound(place_.begin(), place_.end(), place);
  return found != place_.end() && *found == place ? static_cast<std::size_t>(found - place_.begin()) : place_.size();
}

// Places ascend along each of three rows at a time.
void LevelGrid::find_neighbours() {
  const auto none = static_cast<std::uint32_t>(place_.size());
  around_.resize(place_.size());
  std::array<std::uint32_t, 3> next{};
  for (std::size_t k = 0; k < place_.size(); ++k)
    for (std::uint32_t row = 0; row < 3; ++row) {
      const std::int64_t first = std::int64_t{place_[k]} + (std::int64_t{row} - 1) * width_ - 1;
      while (next[row] < none && place_[next[row]] < first) ++next[row];
      std::uint32_t found = next[row];
      for (std::uint32_t column = 0; column < 3; ++column)
        around_[k][row * 3 + column] = found < none && place_[found] == first + column ? found++ : none;
    }
}

Vec3 LevelGrid::between_texels(const LightmapPage& page, std::uint32_t x, std::uint32_t y) const {
  const Vec2 texel = Vec2(x, y) / static_cast<float>(side_) - 1.0f;
  return irradiance_at(page, (texel + 0.5f) / Vec2(page.width, page.height));  // without cells as yet
}

// Scales each change by its share of signal in the neighbourhood (Wiener): where points add nothing to texels, the
// texels are smoother.
void LevelGrid::remove_noise() {
  std::vector<float> share(place_.size());
  for (std::size_t k = 0; k < place_.size(); ++k) {
    float squares = 0, chance = 0;
    for_each_neighbour(k, [&](std::size_t other) {
      const float change = luminance(change_[other]);
      squares += change * change, chance += noise_[other];
    });
    share[k] = squares > 0 ? std::max(0.0f, 1 - kBothNoises * chance / squares) : 0;
  }
  for (std::size_t k = 0; k < place_.size(); ++k)
    if (own_[k]) change_[k] *= share[k], noise_[k] *= share[k] * share[k];
}

// Clamps points that differ more than all their neighbours: they are fireflies, as shadows are longer than a point.
void LevelGrid::remove_outliers() {
  const std::vector<Vec3> before = change_;
  for (std::size_t k = 0; k < place_.size(); ++k) {
    if (!own_[k]) continue;
    Vec3 least(std::numeric_limits<float>::max()), most(-std::numeric_limits<float>::max());
    for_each_neighbour(k, [&](std::size_t other) {
      if (other != k) least = glm::min(least, before[other]), most = glm::max(most, before[other]);
    });
    if (least.r <= most.r) change_[k] = glm::clamp(before[k], least, most);
  }
}

// Visits the points with a value among the nine around one.
template <class Body>
void LevelGrid::for_each_neighbour(std::size_t k, const Body& body) const {
  for (const std::uint32_t other : around_[k])
    if (other < place_.size() && has_value_[other]) body(other);
}

// Extrapolates to points without a value from their neighbours. False if none got one.
bool LevelGrid::spread() {
  std::vector<std::pair<std::size_t, Vec3>> found;
  for (std::size_t k = 0; k < place_.size(); ++k) {
    if (has_value_[k]) continue;
    Vec3 sum(0);
    float count = 0;
    for_each_neighbour(k, [&](std::size_t other) { sum += change_[other], ++count; });
    if (count > 0) found.emplace_back(k, sum / count);
  }
  for (const auto& [k, change] : found) change_[k] = change, has_value_[k] = 1;
  return !found.empty();
}

}  // namespace oriel
