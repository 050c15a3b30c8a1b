// The part of a texel that its light is taken from, where a wall stands on the texel.
#pragma once

#include <optional>

#include "bake/atlas/texel_map.h"
#include "bake/trace/path.h"
#include "formats/core/archive.h"

namespace oriel {

// A texel under a thin wall sees light on both of the wall's sides; the mean of both would leak into the dark room. It
// gets the light of the side on which most of it lies: of those points that see one of its anchors, along segments a
// tenth of a texel above the surface, so that thresholds and carpets are no walls. Which side that is does not depend
// on a bake's seed.
class TexelPart {
 public:
  // The whole texel where nothing stands on its diagonals: two rays. texel: as TexelMapPage::texel[texel]. stream:
  // of the points tried. Adds to rays.
  TexelPart(const Transport& transport, const Atlas& atlas, const TexelMapPage& map, std::size_t texel,
            std::uint64_t stream, std::uint64_t& rays);

  // All of a texel, for fields() to fill.
  explicit TexelPart(const Accel& accel) : accel_(accel) {}

  bool whole() const { return anchors_.empty(); }
  // For points of the texel that are not buried.
  bool holds(std::uint32_t triangle, const Vec2& barycentric, std::uint64_t& rays) const;

 private:
  friend void fields(Archive& archive, TexelPart& part) { archive(part.lift_, part.anchors_); }

  struct Side {
    std::vector<Vec3> anchors;
    std::size_t points = 0;
  };
  // Takes one side's points from those left (at least one).
  Side take_side(std::vector<Vec3>& left, std::uint64_t& rays) const;
  Vec3 lifted(const SurfacePoint& point) const;
  bool is_free(const Vec3& from, const Vec3& to, std::uint64_t& rays) const;

  const Accel& accel_;
  float lift_ = 0;             // metres
  std::vector<Vec3> anchors_;  // lifted
};

}  // namespace oriel
