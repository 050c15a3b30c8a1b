// Few triangles in place of many: what stands between a small square and a sun's disk, as areas between real edges.
#pragma once

#include <bitset>
#include <optional>
#include <span>

#include "bake/radiosity/shadow_beam.h"
#include "bake/trace/accel.h"

namespace oriel {

inline constexpr std::uint32_t kFitSide = 16, kFitRays = kFitSide * kFitSide;  // from a square of places
inline constexpr double kScreen = 4;  // half a screen's edge, in radii of the beam or sides of the square

// A triangle that stands for others, and by bit k whether their shadow ends at its edge from corner k to k + 1.
struct Screen {
  BeamTriangle corners;
  std::uint8_t edges = 0;
};

class ScreenFit {
 public:
  // middle, reach: of a square, to its corners. sun: has a radius.
  ScreenFit(const Light& sun, const DVec3& middle, double reach);

  // An edge at which a shadow may end, of a triangle with that third corner.
  void add_edge(const DVec3& a, const DVec3& b, const DVec3& third);
  // Whether the square is no wider than a few penumbrae of each edge: then what all rays miss does not show.
  bool is_soft() const;
  // What stops the rays that are not lit, and no other; none: no few screens do. rays: kFitRays of them, from all over
  // the square to all over the disk.
  std::optional<std::vector<Screen>> fit(std::span<const Ray> rays, const std::bitset<kFitRays>& lit) const;

 private:
  using Rays = std::bitset<kFitRays>;
  // By places in a plane that faces the sun, `depth` away from the square's middle: those with at * inwards >= off.
  struct HalfPlane {
    DVec2 inwards{0};
    double off = 0, depth = 0;
  };
  // Where a ray meets such planes: at + depth * slope.
  struct SeenRay {
    DVec2 at{0}, slope{0};
  };
  using Area = std::vector<HalfPlane>;  // common to all

  static Rays within(std::span<const HalfPlane> area, double depth, std::span<const SeenRay> rays);
  DVec2 across(const DVec3& v) const { return {glm::dot(v, u_), glm::dot(v, v_)}; }
  void add_screens(const Area& area, double depth, std::vector<Screen>& out) const;

  DVec3 middle_, towards_, u_, v_;
  double reach_, tangent_;
  std::vector<HalfPlane> edges_;
};

}  // namespace oriel
