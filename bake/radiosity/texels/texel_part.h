// The part of a texel that its light is taken from, where a wall stands on the texel.
#pragma once

#include <array>
#include <optional>

#include "bake/atlas/texel_map.h"
#include "bake/trace/onlookers.h"
#include "bake/trace/path.h"
#include "formats/core/archive.h"

namespace oriel {

// Gaps behind panels and under plinths are narrower than texels; rays in them end within so many of these, and within
// so many metres: closets are no gaps, however large the texels of what nobody sees.
inline constexpr float kGapTexels = 4, kGapReach_m = 0.2f;

// A texel on its page: TexelMapPage::texel[texel].
struct PageTexel {
  const Atlas& atlas;
  const TexelMapPage& map;
  std::size_t texel;
};

// A texel under a thin wall sees light on both of the wall's sides; the mean of both would leak into the dark room. It
// gets the light of the side of which eyes see most, or else of that on which most of it lies: of those points that see
// one of its anchors, along segments a tenth of a texel above the surface, so that thresholds and carpets are no walls.
// So the floor before a hollow plinth is not that inside. What lies lower still under another body is no side: nobody
// looks in there. Which side is taken depends on the texel and on where people look alone, not on seeds or estimators:
// all of them speak of the same light.
// A texel that lies outdoors, on the far side of a floor or wall as a whole, where nobody sees it, has no light of its
// own either: it would shine through to the texel beside it, which somebody sees, as far as textures are interpolated.
// Indoors it keeps it: rays that meet it there would find the light of the other side.
// Nor is the mean of a lit gap between a lamp and a ceiling, and of the ceiling beside it, what anybody sees: a texel
// that reaches under a lamp has the light beside it, where one next to it lies under the lamp as a whole.
class TexelPart {
 public:
  // The whole texel where nothing stands on its diagonals nor lies on its middle: a few rays. Adds to rays.
  TexelPart(const Transport& transport, const PageTexel& place, const Onlookers& onlookers, std::uint64_t& rays);

  // All of a texel, for fields() to fill.
  explicit TexelPart(const Accel& accel) : accel_(accel) {}

  bool whole() const { return anchors_.empty() && gap_m_ == 0; }
  // Of a point that it does not hold: the texel that lies under the lamp, in texels of the page.
  bool has_lamp() const { return gap_m_ > 0; }
  IVec2 towards_lamp() const { return towards_lamp_; }
  // Other bodies lie on all of the texel that is not inside them: cracks between things, the wall behind a picture.
  bool covered() const { return covered_; }
  // For points of the texel that are not buried.
  bool holds(std::uint32_t triangle, const Vec2& barycentric, std::uint64_t& rays) const;
  // Whether nothing stands between a site of a texel beside and such a point.
  bool is_beside(const Vec3& site, std::uint32_t triangle, const Vec2& barycentric, std::uint64_t& rays) const;

 private:
  friend void fields(Archive& archive, TexelPart& part) {
    archive(part.lift_, part.anchors_, part.gap_m_, part.towards_lamp_);
  }

  // The four corners of a texel in space, in turn.
  struct Square {
    std::array<Vec3, 4> corners;
    Vec3 normal;
  };
  struct Side {
    std::vector<Vec3> anchors, points;
    std::size_t seen = 0;  // points that eyes see
    bool is_before(const Side& other) const {
      return std::pair(seen, points.size()) > std::pair(other.seen, other.points.size());
    }
  };
  // Takes one side's points from those left (at least one).
  Side take_side(std::vector<Vec3>& left, std::uint64_t& rays) const;
  // A point of a texel beside it that people see, while nobody sees its own middle and a surface parts them; lifted.
  std::optional<Vec3> seen_beyond(const PageTexel& place, const Square& square, const Onlookers& onlookers,
                                  std::uint64_t& rays) const;
  // Whether a quarter of what a point faces is the sky, as beneath an overhang.
  bool is_outdoors(const Vec3& point, const Vec3& normal, std::uint64_t& rays) const;
  void look_for_lamp(const std::array<Vec3, 4>& corners, const Vec3& up, std::uint64_t& rays);
  bool is_under_lamp(const Vec3& p, const Vec3& up, float reach_m, std::uint64_t& rays) const;
  Vec3 lifted(const SurfacePoint& point) const;
  bool is_free(const Vec3& from, const Vec3& to, std::uint64_t& rays) const;

  const Accel& accel_;
  float lift_ = 0;             // metres
  std::vector<Vec3> anchors_;  // lifted
  bool covered_ = false;
  float gap_m_ = 0;  // how far from the texel a lamp is at most; 0: none
  IVec2 towards_lamp_{0};
};

}  // namespace oriel
