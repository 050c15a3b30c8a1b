#include "bake/import/simplify.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "formats/core/position_hash.h"

namespace oriel {
namespace {

using gltf::TriangleMesh;

constexpr float kFinestGrid = 512;  // cells along the longest side
constexpr float kCoarsestGrid = 2;  // a box stays a box

// By vertex the first of its cell.
std::vector<std::uint32_t> first_of_cells(const TriangleMesh& mesh, float cells) {
  Vec3 lower = mesh.positions.front(), upper = lower;
  for (const Vec3& p : mesh.positions) lower = glm::min(lower, p), upper = glm::max(upper, p);
  const float side = max_component(upper - lower) / cells;
  std::unordered_map<Vec3, std::uint32_t, PositionHash> cell;
  std::vector<std::uint32_t> first;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
    first.push_back(cell.try_emplace(glm::round((mesh.positions[v] - lower) / side), v).first->second);
  return first;
}

std::vector<UVec3> joined_triangles(const TriangleMesh& mesh, float cells) {
  const std::vector<std::uint32_t> first = first_of_cells(mesh, cells);
  std::vector<UVec3> out;
  for (const UVec3& t : mesh.triangles) {
    const UVec3 joined(first[t.x], first[t.y], first[t.z]);
    if (!gltf::degenerate(mesh.positions[joined.x], mesh.positions[joined.y], mesh.positions[joined.z]))
      out.push_back(joined);
  }
  const auto key = [](const UVec3& t) {
    std::array<std::uint32_t, 3> corners{t.x, t.y, t.z};
    std::ranges::sort(corners);
    return corners;
  };
  std::ranges::stable_sort(out, {}, key);
  out.erase(std::ranges::unique(out, {}, key).begin(), out.end());
  return out;
}

// Keeps the vertices that triangles have.
void drop_unused(TriangleMesh& mesh) {
  std::vector<std::uint32_t> number(mesh.positions.size(), ~0u), kept;
  for (UVec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      if (number[t[k]] == ~0u) number[t[k]] = static_cast<std::uint32_t>(kept.size()), kept.push_back(t[k]);
      t[k] = number[t[k]];
    }
  const auto keep = [&](auto& values) {
    if (values.empty()) return;
    std::remove_cvref_t<decltype(values)> out;
    for (const std::uint32_t v : kept) out.push_back(values[v]);
    values = std::move(out);
  };
  keep(mesh.positions), keep(mesh.normals), keep(mesh.uv0), keep(mesh.uv1), keep(mesh.tangents), keep(mesh.colors);
}

}  // namespace

gltf::LoadedMesh simplified(const gltf::LoadedMesh& mesh, double share) {
  gltf::LoadedMesh out = mesh;
  for (TriangleMesh& part : out.primitives) {
    const double most = share * static_cast<double>(part.triangles.size());
    std::vector<UVec3> coarse;
    // A surface has about two triangles a cell, and as many cells as the square of those along a side.
    for (float cells = std::min(kFinestGrid, std::ceil(static_cast<float>(std::sqrt(most)))); cells >= kCoarsestGrid;
         cells = std::floor(0.8f * cells)) {
      coarse = joined_triangles(part, cells);
      if (static_cast<double>(coarse.size()) <= most) break;
    }
    if (coarse.empty()) continue;  // it has too few to begin with
    part.triangles = std::move(coarse);
    drop_unused(part);
  }
  return out;
}

}  // namespace oriel
