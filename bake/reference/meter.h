// The estimate behind illuminance_at: sums of scrambled sets, point by point.
#pragma once

#include <array>

#include "bake/reference/illuminance.h"
#include "bake/trace/polygon_light.h"

namespace oriel {

// Sets of samples a point: with 32 of them Student's t is within 4 % of the normal's 1.96.
inline constexpr std::uint32_t kReplicates = 32;
inline constexpr std::uint32_t kFirstSamples = 32;  // of a set: 1024 paths before a point is believed

// Direct light of polygons is their irradiance in closed form times sampled visibility, a ratio of weights (Heitz et
// al. 2018, "Combining Analytic Direct Illumination and Stochastic Shadows"): exact where all or nothing is hidden.
// Each polygon, each punctual light and the sky's image has samples of its own. Where emitters are textured, or more
// than it pays to visit one by one, one light a path is sampled instead, combined with the path's own hits by MIS.
class Meter {
 public:
  Meter(const Transport& transport, std::span<const MeasurePoint> points, const Context& context);

  // One round of set r of a point; different (p, r) may run at once. Rounds double the samples of the parts that need
  // it.
  void grow(std::size_t p, std::uint32_t r, std::uint64_t& rays);
  // What a point's sets say together, once all of them have grown. Plans its next round.
  PointIlluminance summarize(std::size_t p);
  bool buried(std::size_t p, std::uint64_t& rays) const;

 private:
  // Sums of one set: what needs no ratio.
  struct Sums {
    DVec3 direct{0}, indirect{0};
  };
  // Of one set and polygon: Σ weights, Σ weights · transmittance.
  struct Tally {
    double weight = 0;
    DVec3 passed{0};
  };
  // A polygon that faces a point, and its irradiance with nothing in the way.
  struct Facing {
    std::uint32_t light = 0;
    DVec3 open{0};
  };
  // Samples of each set: taken, and after the round at hand.
  struct Progress {
    std::uint32_t done = 0, goal = kFirstSamples;
    void advance(bool needed) {
      done = goal;
      if (needed) goal *= 2;
    }
  };
  // What receives at a point, and where its Facing begin.
  struct Place {
    SurfacePoint surface;
    Receiver receiver;
    std::size_t first_facing = 0, end_facing = 0;
    Progress polygons, rest;
  };
  using Spread = std::array<DVec3, kReplicates>;  // by set: its own estimate less that of all sets
  void add_point(const MeasurePoint& point);
  DVec3 add_polygons(const Place& place, Spread& spread) const;
  void sample_polygons(const Place& place, std::uint32_t r, std::uint64_t stream, std::uint32_t k, std::uint64_t& rays);
  Vec3 sample_punctual(const Place& place, std::uint64_t stream, std::uint32_t k, std::uint64_t& rays) const;
  Vec3 sample_mirrored(const Place& place, std::uint64_t stream, std::uint32_t k, std::uint64_t& rays) const;
  Vec3 sample_frosted(const Place& place, std::uint64_t stream, std::uint32_t k, std::uint64_t& rays) const;
  Vec3 sample_sky(const Place& place, std::uint64_t stream, std::uint32_t k, std::uint64_t& rays) const;
  IrradianceSample sample(const Place& place, std::uint64_t stream, std::uint32_t k, std::uint64_t& rays) const;

  const Transport& t_;
  const Context& context_;
  bool one_by_one_ = true;  // lights are visited one by one
  std::vector<PolygonLight> polygons_;
  std::vector<Place> places_;
  std::vector<Facing> facing_;
  std::vector<Sums> sums_;      // kReplicates a point
  std::vector<Tally> tallies_;  // kReplicates a Facing
};

}  // namespace oriel
