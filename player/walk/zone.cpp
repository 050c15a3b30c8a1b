#include "player/walk/zone.h"

namespace oriel {
namespace {

bool holds(const WalkGrid& grid, const Vec3& eye) {
  if (!(grid.cell_m > 0) || !is_finite(eye)) return false;
  const Vec2 cell = (Vec2(eye.x, eye.z) - grid.lower) / grid.cell_m;
  const auto width = static_cast<float>(grid.width), height = static_cast<float>(grid.height);
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const Vec2 near = glm::floor(cell) + Vec2(static_cast<float>(dx), static_cast<float>(dy));
      if (!(near.x >= 0 && near.y >= 0 && near.x < width && near.y < height)) continue;
      const std::size_t at = static_cast<std::size_t>(near.y) * grid.width + static_cast<std::size_t>(near.x);
      if (grid.walkable(at) && std::fabs(grid.eye(at).y - eye.y) <= kZoneHeight_m) return true;
    }
  return false;
}

}  // namespace

bool in_walkable_zone(std::span<const WalkGrid> grids, const Vec3& eye) {
  if (grids.empty()) return true;
  for (const WalkGrid& grid : grids)
    if (holds(grid, eye)) return true;
  return false;
}

}  // namespace oriel
