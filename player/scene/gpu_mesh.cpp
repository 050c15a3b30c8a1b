#include "player/scene/gpu_mesh.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace oriel {

namespace {

// The runs of a part; it alone, of no group, where there are none. starts: of the runs in the mesh's indices.
std::vector<TriangleRun> runs_of(const MeshPart& part, std::span<const TriangleRun> runs,
                                 const std::vector<std::uint32_t>& starts) {
  std::vector<TriangleRun> out;
  const auto at = std::lower_bound(starts.begin(), starts.end(), part.first_index) - starts.begin();
  std::uint32_t left = part.index_count;
  for (auto i = static_cast<std::size_t>(at); left > 0 && i < runs.size(); ++i) {
    out.push_back(runs[i]);
    left -= std::min(left, runs[i].index_count);
  }
  if (out.empty()) out.push_back({part.index_count, DrawRange::kNoGroup});
  return out;
}

}  // namespace

std::vector<DrawRange> sorted_ranges(const Mesh& mesh, std::vector<std::uint32_t>& indices,
                                     std::span<const TriangleRun> runs,
                                     const std::function<bool(std::uint32_t)>& divided) {
  std::vector<std::uint32_t> starts;
  for (std::uint32_t start = 0; const TriangleRun& run : runs)
    starts.push_back(std::exchange(start, start + run.index_count));
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
    const auto of_part = runs_of(part, divided(part.material) ? runs : std::span<const TriangleRun>(), starts);
    for (std::uint32_t from = part.first_index; const TriangleRun& run : of_part) {
      DrawRange range{static_cast<std::uint32_t>(indices.size()),
                      run.index_count,
                      part.material,
                      part.lightmap_page,
                      {},
                      run.group};
      for (const std::uint32_t end = from + run.index_count; from < end; ++from) {
        indices.push_back(mesh.indices[from]);
        range.bounds.extend(mesh.positions[indices.back()]);
      }
      ranges.push_back(range);
    }
  }
  return ranges;
}

bool faces_inward(const Mesh& mesh, std::span<const std::uint32_t> indices, const DrawRange& range) {
  const DVec3 middle(range.bounds.center());
  double volume = 0;
  for (std::uint32_t i = 0; i < range.index_count; i += 3) {
    std::array<DVec3, 3> p;
    for (std::uint32_t k = 0; k < 3; ++k) p[k] = DVec3(mesh.positions[indices[range.first_index + i + k]]) - middle;
    volume += glm::dot(p[0], glm::cross(p[1], p[2]));
  }
  return volume < 0;
}

std::vector<DrawBatch> visible_batches(std::span<const DrawRange> ranges, const Frustum& frustum,
                                       const SeenMask& seen) {
  std::vector<DrawBatch> batches;
  std::uint32_t end = 0;  // of the last range
  for (const DrawRange& range : ranges) {
    if (seen && range.group != DrawRange::kNoGroup && (*seen)[range.group] == 0) continue;
    if (!may_be_visible(frustum, range.bounds)) continue;
    if (batches.empty() || batches.back().material != range.material ||
        batches.back().lightmap_page != range.lightmap_page)
      batches.push_back({range.material, range.lightmap_page, {}, {}});
    DrawBatch& batch = batches.back();
    const auto count = static_cast<std::int32_t>(range.index_count);
    if (!batch.counts.empty() && end == range.first_index) {
      batch.counts.back() += count;
    } else {
      batch.counts.push_back(count);
      batch.offsets.push_back(reinterpret_cast<const void*>(std::uintptr_t{range.first_index} * sizeof(std::uint32_t)));
    }
    end = range.first_index + range.index_count;
  }
  return batches;
}

ShownTriangles gather(std::vector<DrawBatch> batches, std::span<const std::uint32_t> indices,
                      std::span<const std::uint32_t> kept) {
  ShownTriangles shown{std::move(batches), {}};
  for (DrawBatch& batch : shown.batches) {
    const std::size_t first = shown.indices.size();
    for (std::size_t i = 0; i < batch.counts.size(); ++i) {
      const auto from = reinterpret_cast<std::uintptr_t>(batch.offsets[i]) / sizeof(std::uint32_t);
      for (std::size_t k = from; k < from + static_cast<std::size_t>(batch.counts[i]); k += 3)
        if (kept.empty() || kept[k / 3] != 0) shown.indices.insert(shown.indices.end(), &indices[k], &indices[k] + 3);
    }
    batch.counts = {static_cast<std::int32_t>(shown.indices.size() - first)};
    batch.offsets = {reinterpret_cast<const void*>(first * sizeof(std::uint32_t))};
  }
  std::erase_if(shown.batches, [](const DrawBatch& batch) { return batch.counts[0] == 0; });
  return shown;
}

void upload_vertices(const Mesh& mesh, std::vector<gpu::Buffer>& buffers) {
  gpu::add_attribute(buffers, 0, mesh.positions, {3, GL_FLOAT});
  gpu::add_attribute(buffers, 1, mesh.normals, {3, GL_FLOAT});
  gpu::add_attribute(buffers, 2, mesh.uvs, {2, GL_FLOAT});
  gpu::add_attribute(buffers, 3, mesh.lightmap_uvs, {2, GL_FLOAT});
  if (mesh.colors.empty()) {
    glVertexAttrib4f(4, 1, 1, 1, 1);
  } else {
    gpu::add_attribute(buffers, 4, mesh.colors, {4, GL_UNSIGNED_BYTE, true});
  }
  if (!mesh.normal_uvs.empty()) {
    gpu::add_attribute(buffers, 5, mesh.normal_uvs, {2, GL_FLOAT});
    gpu::add_attribute(buffers, 6, mesh.tangents, {4, GL_FLOAT});
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
  gpu::add_attribute(out.buffers, 7, mover.transfer.cluster, {1, GL_UNSIGNED_BYTE});
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
  out.weights = gpu::Texture2d(gpu::kRgba16i, kWeightsWidth, static_cast<int>(rows), codes.data());
  return out;
}

}  // namespace oriel
