#include "player/movers/shade_shape.h"

#include <meshoptimizer.h>

namespace oriel {
namespace {

constexpr std::size_t kEnough = 3000;  // triangles
constexpr float kMostError = 0.02f;    // over the mover's size
constexpr float kWorthIt = 0.7f;       // of its triangles, at most

}  // namespace

std::optional<GpuMover> make_shade_shape(const Mover& mover) {
  const Mesh& mesh = mover.mesh;
  const std::size_t triangles = mesh.indices.size() / 3;
  if (triangles <= kEnough || mesh.positions.empty()) return std::nullopt;
  Mover fewer;
  fewer.mesh = mesh;
  fewer.mesh.indices.clear();
  for (MeshPart& part : fewer.mesh.parts) {
    const std::uint32_t* first = mesh.indices.data() + part.first_index;
    std::vector<std::uint32_t> left(part.index_count);
    left.resize(meshopt_simplify(left.data(), first, part.index_count, &mesh.positions[0].x, mesh.positions.size(),
                                 sizeof(Vec3), part.index_count / 3 * kEnough / triangles * 3, kMostError));
    part.first_index = static_cast<std::uint32_t>(fewer.mesh.indices.size());
    part.index_count = static_cast<std::uint32_t>(left.size());
    fewer.mesh.indices.insert(fewer.mesh.indices.end(), left.begin(), left.end());
  }
  if (static_cast<float>(fewer.mesh.indices.size()) > kWorthIt * static_cast<float>(mesh.indices.size()))
    return std::nullopt;
  fewer.transfer.cluster.assign(mesh.positions.size(), 0);
  return upload_mover(fewer);
}

}  // namespace oriel
