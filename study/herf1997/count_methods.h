// Ways to find which texels each light sample does not reach. All give the same bits; Herf 1997, chapter 4, has the
// first three.
#pragma once

#include <memory>

#include "study/herf1997/blocked_rows.h"
#include "study/herf1997/projected_edges.h"

namespace oriel::study {

enum class CountMethod {
  kImages,       // 4.2: an image a sample, faces filled texel by texel
  kSpanBuffers,  // 4.3.1: spans a row and sample, sorted by their start, those that overlap made one
  kEdgeFlags,    // 4.3.1: events where a silhouette crosses a row, in lists by texel; running sums by sample
  kBitRows,      // bits of a row and sample, eight rows at once, filled word by word
};

// What eight samples see, and the bits of the whole light to fill: sample first + i is lane i.
struct SampleBatch {
  const OccluderView& view;
  const ProjectedEdges& projected;
  const std::array<std::vector<FaceEdges>, kLanes>& beside_light;  // by lane
  int first = 0, count = 0;
};

void fill_images(const SampleBatch& batch, BlockedRows& rows);
void fill_span_buffers(const SampleBatch& batch, BlockedRows& rows);
void fill_edge_flags(const SampleBatch& batch, BlockedRows& rows);
void fill_bit_rows(const SampleBatch& batch, Simd simd, BlockedRows& rows);

// Whether lane i's shadow needs face f: of bodies that light enters and leaves, the side turned to it does.
inline bool casts(const SampleBatch& batch, std::size_t f, int lane) {
  return batch.projected.sides[f][lane] != 0 && (!batch.view.faces[f].one_side || batch.projected.sides[f][lane] > 0);
}

}  // namespace oriel::study
