#include "bake/import/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <vector>

namespace oriel {
namespace {

using gltf::TriangleMesh;

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
    std::vector<UVec3> coarse(part.triangles.size());
    const auto most = std::max<std::size_t>(
        12, static_cast<std::size_t>(share * static_cast<double>(coarse.size())));  // 12: a box stays one
    if (coarse.size() <= most) continue;
    coarse.resize(meshopt_simplifySloppy(&coarse.data()->x, &part.triangles.data()->x, 3 * coarse.size(),
                                         &part.positions.data()->x, part.positions.size(), sizeof(Vec3), 3 * most, 1,
                                         nullptr) /
                  3);
    std::erase_if(coarse, [&](const UVec3& t) {
      return gltf::degenerate(part.positions[t.x], part.positions[t.y], part.positions[t.z]);
    });
    if (coarse.empty()) continue;
    part.triangles = std::move(coarse);
    drop_unused(part);
  }
  return out;
}

}  // namespace oriel
