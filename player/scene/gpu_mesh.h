// Triangles on the device: of the scene that stands still, and of movers.
#pragma once

#include <functional>

#include "formats/assets/mover.h"
#include "formats/query/visible_sets.h"
#include "player/gpu/buffer.h"
#include "player/gpu/texture.h"
#include "player/navigation/culling.h"

namespace oriel {

// Triangles of one part: one material, one lightmap page.
struct DrawRange {
  std::uint32_t first_index = 0, index_count = 0;  // into the index buffer
  std::uint32_t material = 0;
  std::int32_t lightmap_page = -1;
  Bounds bounds;                   // the mesh's space
  std::uint32_t group = kNoGroup;  // of VisibleSets
  static constexpr std::uint32_t kNoGroup = ~0u;
};

// The mesh's parts sorted by material and page; appends their indices in that order. Parts whose material `divided`
// says yes to are divided into their runs, where there are any.
std::vector<DrawRange> sorted_ranges(
    const Mesh& mesh, std::vector<std::uint32_t>& indices, std::span<const TriangleRun> runs = {},
    const std::function<bool(std::uint32_t material)>& divided = [](std::uint32_t) { return true; });

// Whether the range is more the inside of a shell than its outside: its triangles face their middle.
bool faces_inward(const Mesh& mesh, std::span<const std::uint32_t> indices, const DrawRange& range);

// Ranges of one material and page, for one call.
struct DrawBatch {
  std::uint32_t material = 0;
  std::int32_t lightmap_page = -1;
  std::vector<std::int32_t> counts;  // of indices
  std::vector<const void*> offsets;  // bytes into the index buffer, as OpenGL wants them
};

// The opaque triangles that a frame shows.
struct ShownTriangles {
  std::vector<DrawBatch> batches;
  std::vector<std::uint32_t> indices;  // that the batches are ranges of
};

// By group one byte, 0: not seen. Nothing: all groups are.
using SeenMask = std::optional<std::vector<std::uint8_t>>;

// The ranges that the frustum and the groups seen leave, in their order, neighbours joined. ranges: sorted.
std::vector<DrawBatch> visible_batches(std::span<const DrawRange> ranges, const Frustum& frustum,
                                       const SeenMask& seen = std::nullopt);

// The indices of each batch put together: a range a batch, where there would be hundreds. indices: those that the
// batches are of. kept: by triangle of them, 0: it is left out; empty: all stay.
ShownTriangles gather(std::vector<DrawBatch> batches, std::span<const std::uint32_t> indices,
                      std::span<const std::uint32_t> kept = {});

// Attributes 0 to 6 of the bound vertex array: those of shaders/passes/surface_vertex.glsl.
void upload_vertices(const Mesh& mesh, std::vector<gpu::Buffer>& buffers);

struct GpuMover {
  gpu::VertexArray vertex_array;  // attribute 7: the cluster of its transfer
  std::vector<gpu::Buffer> buffers;
  std::vector<DrawRange> ranges;
  Bounds bounds;           // object space
  gpu::Texture2d weights;  // of its transfer, four 16-bit codes a texel, vertex by vertex, kWeightsWidth texels a row
  int texels_a_vertex = 1;
};
inline constexpr int kWeightsWidth = 2048;
GpuMover upload_mover(const Mover& mover);

}  // namespace oriel
