// The visible part of a texel that a wall divides: only that part is sampled.
#pragma once

#include <array>
#include <optional>

#include "bake/atlas/texel_map.h"
#include "bake/trace/path.h"
#include "bake/trace/view_samples.h"
#include "formats/core/archive.h"

namespace oriel {

// Rays in a gap, as behind a panel or under a plinth, end within kGapTexels texels and within kGapReach_m. The second
// bound keeps closets from counting as gaps where texels are large.
inline constexpr float kGapTexels = 4, kGapReach_m = 0.2f;

// A texel on its page: TexelMapPage::texel[texel].
struct PageTexel {
  const Atlas& atlas;
  const TexelMapPage& map;
  std::size_t texel;
};

// The part of a texel's surface that is sampled.
//
// A texel under a thin wall has points on both sides of the wall, and their mean would leak light into a dark room.
// Only one side is sampled: the one with the most points visible to the views, or else the one with the most points. A
// side is the set of points that see one of its anchors along segments a tenth of a texel above the surface, so
// thresholds and carpets are no walls. Points below another body belong to no side. The choice depends on the texel and
// the views alone, not on seeds or estimators: all estimators sample the same part.
//
// A texel wholly outdoors, on the far side of a wall or floor where no view sees it, has no part of its own either:
// bilinear filtering would let its light show through to the visible texel next to it. Indoors such a texel keeps its
// light, which rays may meet.
//
// A texel that reaches under a lamp on the ceiling excludes the lit gap: it holds the light outside the gap, provided
// that one of its neighbours lies under the lamp as a whole.
class TexelPart {
 public:
  // The common case, nothing on the texel's diagonals or its middle, takes a few rays: the whole texel. Adds to rays.
  TexelPart(const Transport& transport, const PageTexel& place, const ViewSamples& views, std::uint64_t& rays);

  // The whole texel, to be filled by fields().
  explicit TexelPart(const Accel& accel) : accel_(accel) {}

  bool whole() const { return anchors_.empty() && gap_m_ == 0; }
  // True where a lamp hangs over part of the texel. The step then leads to the texel that lies under the lamp, in
  // texels of the page.
  bool has_lamp() const { return gap_m_ > 0; }
  IVec2 towards_lamp() const { return towards_lamp_; }
  // True where other bodies cover all of the texel that is not inside them, as the wall behind a picture.
  bool covered() const { return covered_; }
  // True for points of this part. The point must lie on the texel and not be buried.
  bool holds(std::uint32_t triangle, const Vec2& barycentric, std::uint64_t& rays) const;
  // True if a segment just above the surface joins a neighbour's sample point and such a point.
  bool is_visible_from(const Vec3& from, std::uint32_t triangle, const Vec2& barycentric, std::uint64_t& rays) const;

 private:
  friend void fields(Archive& archive, TexelPart& part) {
    archive(part.lift_, part.anchors_, part.gap_m_, part.towards_lamp_);
  }

  // The four corners of a texel in space, in order around it.
  struct Square {
    std::array<Vec3, 4> corners;
    Vec3 normal;
  };
  struct Side {
    std::vector<Vec3> anchors, points;
    std::size_t seen = 0;  // points that views see
    bool is_before(const Side& other) const {
      return std::pair(seen, points.size()) > std::pair(other.seen, other.points.size());
    }
  };
  // Moves the points of one side out of `left`, which has at least one.
  Side extract_side(std::vector<Vec3>& left, std::uint64_t& rays) const;
  // A visible point of a neighbour, lifted, if no view sees this texel's own middle and a surface separates the two.
  std::optional<Vec3> visible_beyond(const PageTexel& place, const Square& square, const ViewSamples& views,
                                     std::uint64_t& rays) const;
  // True if the sky fills a quarter or more of the cosine-weighted hemisphere, as beneath an overhang.
  bool is_outdoors(const Vec3& point, const Vec3& normal, std::uint64_t& rays) const;
  void find_lamp(const std::array<Vec3, 4>& corners, const Vec3& up, std::uint64_t& rays);
  bool is_under_lamp(const Vec3& p, const Vec3& up, float reach_m, std::uint64_t& rays) const;
  Vec3 lifted(const SurfacePoint& point) const;
  bool is_free(const Vec3& from, const Vec3& to, std::uint64_t& rays) const;

  const Accel& accel_;
  float lift_ = 0;             // metres
  std::vector<Vec3> anchors_;  // lifted
  bool covered_ = false;
  float gap_m_ = 0;  // the largest distance of a lamp over the texel; 0: none
  IVec2 towards_lamp_{0};
};

}  // namespace oriel
