#include "player/scene/gpu_map_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oriel {
namespace {

using Vertex = std::array<std::uint16_t, 4>;  // a multiple of four bytes, as devices want it

std::uint16_t share(float v) {
  return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(v, 0.0f, 1.0f)));
}

GpuMapMesh upload(const MapMesh& mesh) {
  GpuMapMesh out;
  out.scale = 1e-9f;
  for (const Vec3& v : mesh.vertices) out.scale = std::max(out.scale, v.z);
  std::vector<Vertex> vertices;
  for (const Vec3& v : mesh.vertices) vertices.push_back({share(v.x), share(v.y), share(v.z / out.scale), 0});
  out.vertex_array = gpu::make_vertex_array();
  glBindVertexArray(out.vertex_array.name());
  gpu::add_attribute(out.buffers, 0, vertices, {3, GL_UNSIGNED_SHORT, true});
  const auto upload_indices = [&]<class Index>(Index) {
    const std::vector<Index> indices(mesh.indices.begin(), mesh.indices.end());
    out.buffers.emplace_back(GLenum{GL_ELEMENT_ARRAY_BUFFER}, std::span<const Index>(indices));
    out.bytes = vertices.size() * sizeof(Vertex) + indices.size() * sizeof(Index);
  };
  out.index_count = static_cast<int>(mesh.indices.size());
  if (vertices.size() <= 65536) {
    out.index_type = GL_UNSIGNED_SHORT;
    upload_indices(std::uint16_t{});
  } else {
    upload_indices(std::uint32_t{});
  }
  glBindVertexArray(0);
  return out;
}

}  // namespace

void GpuMapMesh::draw() const {
  glBindVertexArray(vertex_array.name());
  glDrawElements(GL_TRIANGLES, index_count, index_type, nullptr);
}

const GpuMapMesh& GpuMapMeshes::get(std::size_t i, std::span<const MapMesh> all) {
  if (!meshes_[i]) {
    meshes_[i] = upload(all[i]);
    bytes_ += meshes_[i]->bytes;
  }
  return *meshes_[i];
}

}  // namespace oriel
