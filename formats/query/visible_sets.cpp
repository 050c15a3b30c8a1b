#include "formats/query/visible_sets.h"

#include <algorithm>
#include <array>

namespace oriel {
namespace {

void add(Hasher& hasher, const auto& values) {
  hasher.add(std::as_bytes(std::span(values)));
}

}  // namespace

EyeCells number_eye_cells(std::span<const WalkGrid> grids, std::uint32_t side) {
  EyeCells cells;
  for (const WalkGrid& grid : grids) {
    const std::size_t columns = (std::size_t{grid.width} + side - 1) / side;
    const std::size_t rows = (std::size_t{grid.height} + side - 1) / side;
    const auto square = [&](std::size_t cell) { return cell / grid.width / side * columns + cell % grid.width / side; };
    std::vector<std::int32_t> number(columns * rows, -1);
    for (std::size_t c = 0; c < grid.floor_y.size(); ++c)
      if (grid.walkable(c)) number[square(c)] = 0;
    for (std::int32_t& n : number)
      if (n == 0) n = static_cast<std::int32_t>(cells.count++);
    auto& of = cells.of_walk_cell.emplace_back(grid.floor_y.size(), -1);
    for (std::size_t c = 0; c < of.size(); ++c)
      if (grid.walkable(c)) of[c] = number[square(c)];
  }
  return cells;
}

Hash128 visibility_hash(const Mesh& mesh, std::span<const Material> materials, std::span<const WalkGrid> grids) {
  Hasher hasher;
  add(hasher, mesh.positions);
  add(hasher, mesh.indices);
  // What sight goes through, and which sides of it are drawn.
  std::vector<std::uint32_t> parts;
  for (const MeshPart& part : mesh.parts) {
    const Material m = part.material < materials.size() ? materials[part.material] : Material();
    for (const std::uint32_t value : {part.first_index, part.index_count, static_cast<std::uint32_t>(m.alpha_mode),
                                      m.double_sided ? 1u : 0u, m.transmission > 0 ? 1u : 0u})
      parts.push_back(value);
  }
  add(hasher, parts);
  for (const WalkGrid& grid : grids) {
    const std::array<float, 4> place{grid.lower.x, grid.lower.y, grid.cell_m, grid.eye_height_m};
    const std::array<std::uint32_t, 2> size{grid.width, grid.height};
    add(hasher, place);
    add(hasher, size);
    // Not a number is not one pattern of bits.
    std::vector<float> floors;
    for (std::size_t c = 0; c < grid.floor_y.size(); ++c) {
      floors.push_back(grid.walkable(c) ? 1.0f : 0.0f);
      floors.push_back(grid.walkable(c) ? grid.floor_y[c] : 0.0f);
    }
    add(hasher, floors);
  }
  return hasher.result();
}

Hash128 reflected_hash(const VisibleSets& sets, std::span<const Reflector> reflectors) {
  Hasher hasher;
  const std::array<std::uint64_t, 2> groups{sets.made_for.high, sets.made_for.low};
  add(hasher, groups);
  for (const Reflector& r : reflectors) {
    const std::array<float, 17> place = [&] {
      std::array<float, 17> numbers{};
      for (int i = 0; i < 16; ++i) numbers[static_cast<std::size_t>(i)] = r.pack_from_reflector[i / 4][i % 4];
      numbers[16] = r.flatness_m;
      return numbers;
    }();
    add(hasher, place);
    add(hasher, r.indices);
  }
  return hasher.result();
}

bool made_for(const VisibleSets& sets, const Mesh& mesh, std::span<const Material> materials,
              std::span<const WalkGrid> grids) {
  return !sets.empty() && sets.made_for == visibility_hash(mesh, materials, grids);
}

SeenGroups::SeenGroups(const VisibleSets& sets, std::span<const WalkGrid> grids)
    : sets_(&sets), grids_(grids), cells_(number_eye_cells(grids, sets.side)) {}

std::optional<std::vector<std::uint8_t>> SeenGroups::from(const Vec3& eye) const {
  if (sets_ == nullptr || sets_->seen.empty() || !is_finite(eye)) return std::nullopt;
  std::vector<std::int32_t> places;
  for (std::size_t g = 0; g < grids_.size(); ++g) {
    const WalkGrid& grid = grids_[g];
    const Vec2 middle = glm::floor((Vec2(eye.x, eye.z) - grid.lower) / grid.cell_m);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const Vec2 at = middle + Vec2(static_cast<float>(dx), static_cast<float>(dy));
        if (!(at.x >= 0 && at.y >= 0 && at.x < static_cast<float>(grid.width) &&
              at.y < static_cast<float>(grid.height)))
          continue;
        const std::size_t cell = static_cast<std::size_t>(at.y) * grid.width + static_cast<std::size_t>(at.x);
        if (!grid.walkable(cell)) continue;
        const float up = eye.y - grid.eye(cell).y;
        if (up < -sets_->below_m || up > sets_->above_m) continue;
        const std::int32_t place = cells_.of_walk_cell[g][cell];
        if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
      }
  }
  if (places.empty()) return std::nullopt;
  std::vector<std::uint8_t> seen(sets_->groups);
  for (const std::int32_t place : places) {
    const std::uint8_t* set = sets_->seen.data() + static_cast<std::size_t>(place) * sets_->set_bytes();
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i] |= set[i / 8] >> (i % 8) & 1;
  }
  return seen;
}

}  // namespace oriel
