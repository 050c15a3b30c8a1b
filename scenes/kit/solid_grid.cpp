#include "scenes/kit/solid_grid.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace oriel::sample {
namespace {

using Millimetres = std::int64_t;

Millimetres to_mm(float metres) {
  return std::llround(static_cast<double>(metres) * 1000.0);
}
float to_metres(Millimetres mm) {
  return static_cast<float>(static_cast<double>(mm) / 1000.0);
}

struct Cell {
  bool solid = false;
  int tag = kOutside;
};

struct Grid {
  std::array<std::vector<Millimetres>, 3> planes;
  std::array<int, 3> size{};  // cells
  std::vector<Cell> cells;

  // Outside of the grid is air.
  Cell at(const std::array<int, 3>& i) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (i[a] < 0 || i[a] >= size[a]) return {};
    }
    return cells[static_cast<std::size_t>((i[2] * size[1] + i[1]) * size[0] + i[0])];
  }
};

int index_of(const std::vector<Millimetres>& planes, Millimetres value) {
  return static_cast<int>(std::lower_bound(planes.begin(), planes.end(), value) - planes.begin());
}

Grid fill_grid(std::span<const Block> blocks) {
  Grid grid;
  for (int a = 0; a < 3; ++a) {
    auto& planes = grid.planes[static_cast<std::size_t>(a)];
    for (const Block& block : blocks) {
      planes.push_back(to_mm(block.lower[a]));
      planes.push_back(to_mm(block.upper[a]));
    }
    std::sort(planes.begin(), planes.end());
    planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    grid.size[static_cast<std::size_t>(a)] = std::max(0, static_cast<int>(planes.size()) - 1);
  }
  const auto [nx, ny, nz] = grid.size;
  grid.cells.resize(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz));
  for (const Block& block : blocks) {
    std::array<int, 3> first{}, last{};
    for (int a = 0; a < 3; ++a) {
      const auto s = static_cast<std::size_t>(a);
      first[s] = index_of(grid.planes[s], to_mm(block.lower[a]));
      last[s] = index_of(grid.planes[s], to_mm(block.upper[a]));
    }
    for (int z = first[2]; z < last[2]; ++z) {
      for (int y = first[1]; y < last[1]; ++y) {
        for (int x = first[0]; x < last[0]; ++x) {
          grid.cells[static_cast<std::size_t>((z * ny + y) * nx + x)] = {block.solid, block.tag};
        }
      }
    }
  }
  return grid;
}

using Corner = std::array<int, 3>;
struct PatchInProgress {
  SolidPatch patch;
  std::map<Corner, std::uint32_t> vertices;
};

std::uint32_t vertex(PatchInProgress& out, const Grid& grid, const Corner& corner, const Vec3& normal) {
  auto& mesh = out.patch.mesh;
  const auto [it, is_new] = out.vertices.try_emplace(corner, static_cast<std::uint32_t>(mesh.positions.size()));
  if (is_new) {
    Vec3 p;
    for (std::size_t a = 0; a < 3; ++a)
      p[static_cast<int>(a)] = to_metres(grid.planes[a][static_cast<std::size_t>(corner[a])]);
    mesh.positions.push_back(p);
    mesh.normals.push_back(normal);
  }
  return it->second;
}

// The face of the cell on the side (axis, up), counter-clockwise seen from that side.
void add_face(PatchInProgress& out, const Grid& grid, Corner cell, std::size_t axis, bool up) {
  Vec3 normal(0);
  normal[static_cast<int>(axis)] = up ? 1.0f : -1.0f;
  const std::size_t u = (axis + (up ? 1 : 2)) % 3, v = (axis + (up ? 2 : 1)) % 3;
  if (up) ++cell[axis];
  std::array<Corner, 4> corners{cell, cell, cell, cell};
  ++corners[1][u];
  ++corners[2][u];
  ++corners[2][v];
  ++corners[3][v];
  std::array<std::uint32_t, 4> i{};
  for (std::size_t k = 0; k < 4; ++k) i[k] = vertex(out, grid, corners[k], normal);
  out.patch.mesh.indices.insert(out.patch.mesh.indices.end(), {i[0], i[1], i[2], i[0], i[2], i[3]});
}

}  // namespace

std::vector<SolidPatch> boundary_patches(std::span<const Block> blocks) {
  const Grid grid = fill_grid(blocks);
  std::map<std::tuple<int, int, int>, PatchInProgress> patches;
  Corner i{};
  for (i[2] = 0; i[2] < grid.size[2]; ++i[2]) {
    for (i[1] = 0; i[1] < grid.size[1]; ++i[1]) {
      for (i[0] = 0; i[0] < grid.size[0]; ++i[0]) {
        const Cell cell = grid.at(i);
        if (!cell.solid) continue;
        for (std::size_t side = 0; side < 6; ++side) {
          const std::size_t axis = side / 2;
          const bool up = side % 2 == 1;
          Corner beyond = i;
          beyond[axis] += up ? 1 : -1;
          const Cell air = grid.at(beyond);
          if (air.solid) continue;
          PatchInProgress& out = patches[{air.tag, cell.tag, static_cast<int>(side)}];
          out.patch.air_tag = air.tag;
          out.patch.solid_tag = cell.tag;
          out.patch.facing = static_cast<Facing>(side);
          add_face(out, grid, i, axis, up);
        }
      }
    }
  }
  std::vector<SolidPatch> result;
  for (auto& [key, out] : patches) result.push_back(std::move(out.patch));
  return result;
}

}  // namespace oriel::sample
