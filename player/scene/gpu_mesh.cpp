#include "player/scene/gpu_mesh.h"

#include <algorithm>
#include <tuple>

namespace oriel {

std::vector<DrawRange> sorted_ranges(const Mesh& mesh, std::vector<std::uint32_t>& indices) {
  std::vector<std::uint32_t> order(mesh.parts.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const MeshPart &p = mesh.parts[a], &q = mesh.parts[b];
    return std::tie(p.material, p.lightmap_page) < std::tie(q.material, q.lightmap_page);
  });
  indices.reserve(indices.size() + mesh.indices.size());
  std::vector<DrawRange> ranges;
  for (const std::uint32_t i : order) {
    const MeshPart& part = mesh.parts[i];
    if (part.index_count == 0) continue;
    DrawRange range{
        static_cast<std::uint32_t>(indices.size()), part.index_count, part.material, part.lightmap_page, {}};
    for (std::uint32_t k = 0; k < part.index_count; ++k) {
      indices.push_back(mesh.indices[part.first_index + k]);
      range.bounds.extend(mesh.positions[indices.back()]);
    }
    ranges.push_back(range);
  }
  return ranges;
}

void upload_vertices(const Mesh& mesh, std::vector<gpu::Buffer>& buffers) {
  gpu::add_attribute(buffers, 0, mesh.positions, 3, GL_FLOAT, false);
  gpu::add_attribute(buffers, 1, mesh.normals, 3, GL_FLOAT, false);
  gpu::add_attribute(buffers, 2, mesh.uvs, 2, GL_FLOAT, false);
  gpu::add_attribute(buffers, 3, mesh.lightmap_uvs, 2, GL_FLOAT, false);
  if (mesh.colors.empty()) {
    glVertexAttrib4f(4, 1, 1, 1, 1);
  } else {
    gpu::add_attribute(buffers, 4, mesh.colors, 4, GL_UNSIGNED_BYTE, true);
  }
  if (!mesh.normal_uvs.empty()) {
    gpu::add_attribute(buffers, 5, mesh.normal_uvs, 2, GL_FLOAT, false);
    gpu::add_attribute(buffers, 6, mesh.tangents, 4, GL_FLOAT, false);
  }
}

GpuMover upload_mover(const Mover& mover) {
  GpuMover out;
  std::vector<std::uint32_t> indices;
  out.ranges = sorted_ranges(mover.mesh, indices);
  for (const DrawRange& range : out.ranges) out.bounds.extend(range.bounds);
  out.vertex_array = gpu::make_vertex_array();
  glBindVertexArray(out.vertex_array.name());
  upload_vertices(mover.mesh, out.buffers);
  gpu::add_attribute(out.buffers, 7, mover.transfer.cluster, 1, GL_UNSIGNED_BYTE, false);
  out.buffers.emplace_back(GLenum{GL_ELEMENT_ARRAY_BUFFER}, std::span<const std::uint32_t>(indices));
  glBindVertexArray(0);

  const auto components = static_cast<std::size_t>(mover.transfer.components);
  out.texels_a_vertex = mover.transfer.components / 4 + (mover.transfer.components % 4 != 0 ? 1 : 0);
  const auto texels = static_cast<std::size_t>(out.texels_a_vertex);
  const std::size_t rows =
      std::max<std::size_t>(1, (mover.transfer.vertices() * texels + kWeightsWidth - 1) / kWeightsWidth);
  std::vector<std::int16_t> codes(rows * kWeightsWidth * 4);
  for (std::size_t v = 0; v < mover.transfer.vertices(); ++v)
    std::copy_n(mover.transfer.weight.begin() + static_cast<std::ptrdiff_t>(v * components), components,
                codes.begin() + static_cast<std::ptrdiff_t>(v * texels * 4));
  out.weights = gpu::Texture(gpu::kRgba16i, kWeightsWidth, static_cast<int>(rows), codes.data());
  return out;
}

}  // namespace oriel
