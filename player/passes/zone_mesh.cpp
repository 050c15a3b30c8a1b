#include "player/passes/zone_mesh.h"

#include <array>
#include <cmath>

namespace oriel {
namespace {

std::uint32_t rgba(const Vec3& color) {
  const auto channel = [](float v) { return static_cast<std::uint32_t>(255 * v + 0.5f); };
  return channel(color.r) | channel(color.g) << 8 | channel(color.b) << 16 | 255u << 24;
}

void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t color, ZoneMesh& mesh) {
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.colors.insert(mesh.colors.end(), 3, color);
}

struct Tile {
  float y = std::nanf("");  // nobody stands there
  bool edge = false;
  bool same(const Tile& other) const { return y == other.y && edge == other.edge; }
};

// Of a cell of the grid, or of one just beside it.
Tile tile_of(const WalkGrid& grid, int x, int y) {
  const auto floor = [&](int i, int j) {
    const bool inside = i >= 0 && j >= 0 && i < static_cast<int>(grid.width) && j < static_cast<int>(grid.height);
    return inside ? grid.floor_y[static_cast<std::size_t>(j) * grid.width + static_cast<std::size_t>(i)]
                  : std::nanf("");
  };
  Tile tile{floor(x, y), false};
  if (!std::isnan(tile.y)) return tile;
  tile.edge = true;
  for (int j = y - 1; j <= y + 1; ++j)
    for (int i = x - 1; i <= x + 1; ++i)
      if (const float beside = floor(i, j); !std::isnan(beside) && !(beside <= tile.y)) tile.y = beside;
  return tile;
}

// Cells of one height in a row become one tile.
void add_grid(const WalkGrid& grid, ZoneMesh& mesh) {
  for (int y = -1; y <= static_cast<int>(grid.height); ++y)
    for (int x = -1; x <= static_cast<int>(grid.width);) {
      const Tile tile = tile_of(grid, x, y);
      const int first = x++;
      if (std::isnan(tile.y)) continue;
      while (x <= static_cast<int>(grid.width) && tile_of(grid, x, y).same(tile)) ++x;
      const Vec2 lower = grid.lower + grid.cell_m * Vec2(first, y), upper = grid.lower + grid.cell_m * Vec2(x, y + 1);
      const float height = tile.y + kTileHeight_m;
      const std::uint32_t color = rgba(tile.edge ? kZoneEdgeColor : kZoneColor);
      const Vec3 a(lower.x, height, lower.y), b(lower.x, height, upper.y), c(upper.x, height, upper.y),
          d(upper.x, height, lower.y);
      add_triangle(a, b, c, color, mesh);
      add_triangle(a, c, d, color, mesh);
    }
}

void add_eye(const Vec3& eye, ZoneMesh& mesh) {
  const float r = kEyeSize_m;
  const std::array<Vec3, 4> around{Vec3(r, 0, 0), Vec3(0, 0, -r), Vec3(-r, 0, 0), Vec3(0, 0, r)};
  const std::uint32_t above = rgba(kZoneEyeColor), below = rgba(0.6f * kZoneEyeColor);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 from = eye + around[i], to = eye + around[(i + 1) % 4];
    add_triangle(from, to, eye + Vec3(0, r, 0), above, mesh);
    add_triangle(to, from, eye - Vec3(0, r, 0), below, mesh);
  }
}

}  // namespace

ZoneMesh zone_mesh(const Zone& zone) {
  ZoneMesh mesh;
  for (const WalkGrid& grid : zone.grids) add_grid(grid, mesh);
  for (const Vec3& eye : zone.eyes) add_eye(eye, mesh);
  return mesh;
}

}  // namespace oriel
