#include "player/walk/floors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oriel {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kMostStrides = 64;

Vec2 on_map(const Vec3& eye) {
  return {eye.x, eye.z};
}

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

std::optional<float> Floors::eye_level(const Vec2& at, float eye_y, const StepOptions& options) const {
  std::optional<float> highest;
  for (const WalkGrid& grid : grids_) {
    const auto cell = cell_at(grid, at);
    if (!cell) continue;
    const float level = grid.eye(*cell).y;
    if (level <= eye_y + options.step_m && (!highest || level > *highest)) highest = level;
  }
  return highest;
}

float Floors::distance_to_floor(const Vec3& eye, const StepOptions& options) const {
  float nearest = kFar;
  for (const WalkGrid& grid : grids_) {
    const Vec2 middle = (on_map(eye) - grid.lower) / grid.cell_m;
    const float reach = options.beside_m / grid.cell_m;
    const Vec2 size(grid.width, grid.height);
    const IVec2 first(glm::clamp(glm::floor(middle - reach), Vec2(0), size));
    const IVec2 end(glm::clamp(glm::ceil(middle + reach), Vec2(0), size));
    for (int y = first.y; y < end.y; ++y)
      for (int x = first.x; x < end.x; ++x) {
        const std::size_t cell = static_cast<std::size_t>(y) * grid.width + static_cast<std::size_t>(x);
        if (!grid.walkable(cell) || std::fabs(grid.eye(cell).y - eye.y) > 2 * options.step_m) continue;
        nearest = std::min(nearest, glm::distance(on_map(grid.eye(cell)), on_map(eye)));
      }
  }
  return nearest <= options.beside_m ? nearest : kFar;
}

Vec3 Floors::walk(const Vec3& from, const Vec3& to, float dt_s, float& fall_m_s, const StepOptions& options) const {
  const auto standing = eye_level(on_map(from), from.y, options);
  if (!standing) {
    // Beside a floor, as a camera at a wall: on to the floor, or nearer to it.
    const float distance = distance_to_floor(from, options);
    fall_m_s = 0;
    if (distance == kFar || eye_level(on_map(to), from.y, options) || distance_to_floor(to, options) < distance)
      return to;
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
  }
  return {at.x, y, at.y};
}

}  // namespace oriel
