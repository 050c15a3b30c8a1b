#include "player/navigation/floors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oriel {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kMostStrides = 64;
constexpr float kSettled = 1e-3f;  // of a step: less is not seen

// The cell at a place, if it is one to stand on.
std::optional<std::size_t> cell_at(const WalkGrid& grid, const Vec2& at) {
  const Vec2 cell = glm::floor((at - grid.lower) / grid.cell_m);
  if (!(cell.x >= 0 && cell.y >= 0 && cell.x < static_cast<float>(grid.width) &&
        cell.y < static_cast<float>(grid.height)))
    return std::nullopt;
  const std::size_t index = static_cast<std::size_t>(cell.y) * grid.width + static_cast<std::size_t>(cell.x);
  return grid.walkable(index) ? std::optional(index) : std::nullopt;
}

}  // namespace

namespace {

// Cells whose floor an eye belongs to: not under it, and not much higher than one who stands there, so that a camera
// at a table's height is in the room all the same.
auto is_storey_of(const Vec3& eye, const StepOptions& options) {
  return [eye, step = options.step_m](const WalkGrid& grid, std::size_t cell) {
    return eye.y > grid.floor_y[cell] && eye.y <= grid.eye(cell).y + 2 * step;
  };
}

}  // namespace

Floors::Floors(std::vector<WalkGrid> grids, float eye_height_m) : grids_(std::move(grids)) {
  if (eye_height_m > 0)
    for (WalkGrid& grid : grids_) grid.eye_height_m = eye_height_m;
}

Vec3 Floors::floor_of(const Stand& stand) const {
  return stand.eye - Vec3(0, grids_[stand.grid].eye_height_m, 0);
}

std::optional<Stand> Floors::stand(const Vec2& at, float eye_y, const StepOptions& options) const {
  std::optional<Stand> highest;
  for (std::uint32_t i = 0; i < grids_.size(); ++i) {
    const auto cell = cell_at(grids_[i], at);
    if (!cell) continue;
    const Vec3 eye = grids_[i].eye(*cell);
    if (eye.y <= eye_y + options.step_m && (!highest || eye.y > highest->eye.y)) highest = {i, *cell, eye};
  }
  return highest;
}

std::optional<float> Floors::eye_level(const Vec2& at, float eye_y, const StepOptions& options) const {
  const auto found = stand(at, eye_y, options);
  return found ? std::optional(found->eye.y) : std::nullopt;
}

template <class Suits>
std::optional<Stand> Floors::nearest(const Vec3& place, float reach_m, const Suits& suits) const {
  std::optional<Stand> found;
  float nearest = reach_m;
  for (std::uint32_t i = 0; i < grids_.size(); ++i) {
    const WalkGrid& grid = grids_[i];
    const Vec2 middle = (on_map(place) - grid.lower) / grid.cell_m;
    const float reach = reach_m / grid.cell_m;
    const Vec2 size(grid.width, grid.height);
    const IVec2 first(glm::clamp(glm::floor(middle - reach), Vec2(0), size));
    const IVec2 end(glm::clamp(glm::ceil(middle + reach), Vec2(0), size));
    for (int y = first.y; y < end.y; ++y)
      for (int x = first.x; x < end.x; ++x) {
        const std::size_t cell = static_cast<std::size_t>(y) * grid.width + static_cast<std::size_t>(x);
        if (!grid.walkable(cell) || !suits(grid, cell)) continue;
        const Vec3 eye = grid.eye(cell);
        const float distance = glm::distance(on_map(eye), on_map(place));
        if (distance > nearest || (found && distance == nearest)) continue;
        nearest = distance;
        found = {i, cell, eye};
      }
  }
  return found;
}

std::optional<Stand> Floors::nearest_stand(const Vec3& eye, float reach_m, const StepOptions& options) const {
  if (const auto here = stand(on_map(eye), eye.y, options)) return here;
  return nearest(eye, reach_m, is_storey_of(eye, options));
}

std::optional<Stand> Floors::nearest_stand_on(const Vec3& floor, float reach_m, const StepOptions& options) const {
  return nearest(floor, reach_m, [&](const WalkGrid& grid, std::size_t cell) {
    return std::fabs(grid.floor_y[cell] - floor.y) <= options.step_m;
  });
}

std::optional<Stand> Floors::nearest_to(const Vec3& point) const {
  std::optional<Stand> found;
  float nearest = kFar;
  for (std::uint32_t i = 0; i < grids_.size(); ++i)
    for (std::size_t cell = 0; cell < grids_[i].floor_y.size(); ++cell) {
      if (!grids_[i].walkable(cell)) continue;
      const Stand here{i, cell, grids_[i].eye(cell)};
      const float distance = glm::distance(floor_of(here), point);
      if (distance >= nearest) continue;
      nearest = distance;
      found = here;
    }
  return found;
}

std::optional<Stand> Floors::below(const Vec3& place) const {
  std::optional<Stand> highest;
  for (std::uint32_t i = 0; i < grids_.size(); ++i) {
    const WalkGrid& grid = grids_[i];
    const auto cell = cell_at(grid, on_map(place));
    if (!cell || grid.floor_y[*cell] > place.y) continue;
    if (!highest || grid.floor_y[*cell] > floor_of(*highest).y) highest = {i, *cell, grid.eye(*cell)};
  }
  return highest;
}

std::optional<Vec3> Floors::floor_below(const Vec3& place) const {
  const auto found = below(place);
  return found ? std::optional(Vec3(place.x, floor_of(*found).y, place.z)) : std::nullopt;
}

float Floors::coarsest_cell_m() const {
  float coarsest = 0;
  for (const WalkGrid& grid : grids_) coarsest = std::max(coarsest, grid.cell_m);
  return coarsest;
}

float Floors::distance_to_floor(const Vec3& eye, const StepOptions& options) const {
  const auto found = nearest(eye, options.beside_m, is_storey_of(eye, options));
  return found ? glm::distance(on_map(found->eye), on_map(eye)) : kFar;
}

Vec3 Floors::walk(const Vec3& from, const Vec3& to, float dt_s, float& fall_m_s, const StepOptions& options) const {
  auto standing = eye_level(on_map(from), from.y, options);
  // A camera near the floor, or one of somebody smaller: it rises as it walks.
  if (const auto floor = standing ? std::nullopt : below(from)) standing = floor->eye.y;
  if (!standing) {
    // Beside a floor, as a camera at a wall: on to the floor, or nearer to it.
    const float distance = distance_to_floor(from, options);
    fall_m_s = 0;
    if (distance == kFar || eye_level(on_map(to), from.y, options) || distance_to_floor(to, options) < distance)
      return to;
    // Along the floor's edge, as along a wall.
    for (const Vec3& slid : {Vec3(to.x, from.y, from.z), Vec3(from.x, from.y, to.z)})
      if (slid != from && distance_to_floor(slid, options) <= distance) return slid;
    return from;
  }
  float cell = kFar, step = options.step_m;
  for (const WalkGrid& grid : grids_) {
    cell = std::min(cell, grid.cell_m);
    step = std::max(step, grid.cell_m);  // coarse columns take a stair's several steps at once
  }
  const Vec2 way = on_map(to) - on_map(from);
  const float strides = std::clamp(std::ceil(glm::length(way) / (0.5f * cell)), 1.0f, kMostStrides);
  const Vec2 stride = way / std::max(strides, glm::length(way) / (0.5f * cell));
  Vec2 at = on_map(from);
  float level = *standing;
  const auto try_step = [&](const Vec2& by) {
    const auto next = eye_level(at + by, level, {.step_m = step});
    if (!next || level - *next > step) return false;
    at += by;
    level = *next;
    return true;
  };
  for (int i = 0; i < static_cast<int>(strides); ++i)
    if (!try_step(stride) && !try_step({stride.x, 0}) && !try_step({0, stride.y})) break;
  const float dt = std::clamp(dt_s, 0.0f, 0.1f);
  float y = from.y;
  if (y - level > 2 * options.step_m) {
    fall_m_s += options.gravity_m_s2 * dt;
    y = std::max(y - fall_m_s * dt, level);
  } else {
    fall_m_s = 0;
    y += (level - y) * (1 - std::exp(-dt / options.settle_s));
    if (std::fabs(level - y) < kSettled * options.step_m) y = level;  // it stands still
  }
  return {at.x, y, at.y};
}

}  // namespace oriel
