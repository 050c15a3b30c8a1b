// Radiance maps' meshes on the device.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "formats/assets/map_mesh.h"
#include "player/gpu/buffer.h"

namespace oriel {

struct GpuMapMesh {
  gpu::VertexArray vertex_array;  // attribute 0: x, y, disparity / scale, 0 to 1
  std::vector<gpu::Buffer> buffers;
  int index_count = 0;
  GLenum index_type = GL_UNSIGNED_INT;
  float scale = 1;  // of disparities
  std::size_t bytes = 0;
  void draw() const;
};

// Of all maps of a pack: each is uploaded when it is first asked for, and kept.
class GpuMapMeshes {
 public:
  GpuMapMeshes() = default;
  explicit GpuMapMeshes(std::size_t count) : meshes_(count) {}
  const GpuMapMesh& get(std::size_t i, std::span<const MapMesh> all);
  std::size_t bytes() const { return bytes_; }

 private:
  std::vector<std::optional<GpuMapMesh>> meshes_;
  std::size_t bytes_ = 0;
};

}  // namespace oriel
