// Shadows of a body by its silhouettes: what a rigid body between a flat lamp and a receiver blocks, from its edges
// alone (Herf 1997, sections 4.3.1, 4.3.3 and 4.4.2).
//
// A face that all of the lamp sees from one side hides no silhouette in it: of a fine mesh few edges are left for the
// lamp, and of these few are silhouettes for a sample. Where silhouettes cross a column of texels the count of faces
// changes; sums along the columns, 32 of them at once, tell where it is not zero.
#pragma once

#include <span>

#include "formats/shadow/blocked_rows.h"
#include "formats/shadow/projected_edges.h"

namespace oriel {

inline constexpr std::size_t kFacesAtOnce = 16;

// A body in its own space, ready for any place: what only moves rigidly is prepared once.
class ShadowBody {
 public:
  ShadowBody() = default;
  explicit ShadowBody(const Occluders& occluders);

  struct Edge {
    std::uint32_t a = 0, b = 0;                    // points
    std::array<std::uint32_t, 2> faces{~0u, ~0u};  // ~0: there is none
    std::array<std::int8_t, 2> along{0, 0};        // 1 where the face runs from a to b, -1 where from b to a
  };
  std::vector<DVec3> points;
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<std::array<std::uint32_t, 3>> face_edges;  // from corner k to the next
  std::vector<Edge> edges;                // of more than two faces on an edge each further pair has an edge of its own
  std::vector<float> nx, ny, nz, offset;  // by face and some more: dot(n, p) = offset in its plane, n unit
};

// What of a receiver is looked at: whole words and some rows.
struct TexelWindow {
  int column = 0, row = 0, columns = 0, rows = 0;  // of words of 32 texels; of texels
};

// Where a body is, as one lamp and one receiver have it: all in the body's space.
struct BodyPlace {
  ReceiverSpace space;
  std::span<const DVec3> samples;  // of the lamp, in front of the receiver
  std::span<const DVec3> apexes;   // the same in receiver space
  double touching = 0;             // as SoftShadowOptions
};

// Keeps its memory. Not for two threads at once.
class SilhouetteShadows {
 public:
  // Sets the bits of the texels in the window whose samples the body blocks. False, and nothing set, where some of the
  // body is as high as a sample: those are for SoftShadows. A texel whose centre a slanted edge goes through may go to
  // the other side of it than by CountMethod.
  bool add(const ShadowBody& body, const BodyPlace& place, const TexelWindow& window, Simd simd, BlockedRows& rows);

 private:
  struct Kernel;
  std::vector<double> px_, py_, pz_;               // points in receiver space, then those where edges are cut at it
  std::vector<std::int8_t> side_;                  // by face: +1 and -1 as all samples see it, 0 where they differ
  std::vector<ShadowBody::Edge> edges_;            // that may be silhouettes, in front of the receiver
  std::vector<std::uint32_t> mixed_, used_;        // faces whose side is by sample; points that are projected
  std::vector<std::uint32_t> mixed_of_, used_of_;  // by face and point: which of those
  std::vector<std::uint32_t> cut_of_;              // by edge: the point where it is cut
  std::vector<std::array<std::int8_t, 8>> mixed_side_;
  std::vector<std::array<double, 8>> x_, y_;
  std::vector<std::array<std::uint32_t, 2>> changing_;  // silhouettes of eight samples: their ends, of those projected
  std::vector<std::array<std::int8_t, 8>> changes_of_;  // and what the count of faces changes by across them
  std::vector<EdgeLanes> fixed_;
  std::vector<std::int16_t>
      changes_;  // of one sample, by row and column: 65 536 faces over a texel would count as none
};

}  // namespace oriel
