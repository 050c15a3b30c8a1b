// Triangles on the device: of the scene that stands still, and of movers.
#pragma once

#include "formats/assets/mover.h"
#include "player/gpu/buffer.h"
#include "player/gpu/texture.h"
#include "player/view/culling.h"

namespace oriel {

// Triangles of one part: one material, one lightmap page.
struct DrawRange {
  std::uint32_t first_index = 0, index_count = 0;  // into the index buffer
  std::uint32_t material = 0;
  std::int32_t lightmap_page = -1;
  Bounds bounds;  // the mesh's space
};

// The mesh's parts sorted by material and page; appends their indices in that order.
std::vector<DrawRange> sorted_ranges(const Mesh& mesh, std::vector<std::uint32_t>& indices);

// Attributes 0 to 6 of the bound vertex array: those of shaders/passes/surface_vertex.glsl.
void upload_vertices(const Mesh& mesh, std::vector<gpu::Buffer>& buffers);

struct GpuMover {
  gpu::VertexArray vertex_array;  // attribute 7: the cluster of its transfer
  std::vector<gpu::Buffer> buffers;
  std::vector<DrawRange> ranges;
  Bounds bounds;         // object space
  gpu::Texture weights;  // of its transfer, four 16-bit codes a texel, vertex by vertex, kWeightsWidth texels a row
  int texels_a_vertex = 1;
};
inline constexpr int kWeightsWidth = 2048;
GpuMover upload_mover(const Mover& mover);

}  // namespace oriel
