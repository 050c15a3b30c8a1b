// How direct light is estimated: a group of texels at a time, light by light. For direct_light.cpp alone.
#pragma once

#include <array>

#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/direct_pilot.h"

namespace oriel {

// A group of texels, light by light.
class DirectGroup {
 public:
  static constexpr std::uint64_t kFrosted = 4;  // samples a point: what panes spread is noise from one
  static constexpr std::uint64_t kPicks = 16;   // of many punctual lights, by how bright they are from each point

  // directional: run() is asked for moments.
  DirectGroup(const DirectLight& direct, std::span<const std::uint32_t> list, std::uint32_t per_half, bool directional);

  void run(DirectSums& sums);
  std::uint64_t rays() const { return rays_; }

 private:
  static constexpr std::uint32_t kNoGroup = ~0u;
  static constexpr std::uint32_t kSamplesAPoint = 4;  // beyond those that texels keep: to find one takes more rays
  static constexpr int kTries = 16;                   // for a point of a light that is above the horizon

  struct Point {
    SamplePoint site;
    std::uint32_t texel = 0;  // of the list
    int half = 0;
    std::uint32_t k = 0;
    bool again = false;  // at the site of the point before
  };
  struct Shot {  // a shadow ray
    std::uint32_t point = 0;
    Vec3 weight{0};
    Vec3 direction{0};
    std::uint32_t group = kNoGroup;  // of a lamp that was found by chance: those done one by one are booked as a whole
    int legs = 1;                    // rays, all of which must pass
    Vec3 share{1};                   // of the weight that comes along them
  };
  // By texel: the light at hand, and what is known of all so far.
  struct Tally : LightTally {
    Vec3 total{0}, variance{0};
    Vec4 moments{0};
    Vec3 difference{0};  // of the halves' light
    Vec3 uneven{0};      // what the halves' points differ by, all lights together
  };

  std::uint64_t stream_of(std::uint32_t texel, int half) const;
  void add_points(std::uint32_t i);
  // Whether an estimate is a number; where not it is told.
  bool is_usable(const Point& point, const Vec3& light) const;
  void sample_polygon_lights();
  LightPilot end_pilot(std::uint32_t l);
  // Samples first <= k < end of each half: their light if nothing were before the lamp; with `shoot_rays` what is.
  void aim_at_polygon(std::uint32_t l, std::uint32_t first, std::uint32_t end, bool shoot_rays);
  // Points of the light below the horizon weigh nothing: others are tried, of a light that reaches barely above it too.
  void shoot_at_polygon(const PolygonView& view, const Receiver& receiver, std::uint32_t p, Sampler& sampler);
  void aim_at_punctual(std::uint32_t l);
  std::pair<DVec3, double> sphere_about_points() const;
  // A mirror's edge is taken for one of a shadow: what is beside it weighs as if the mirror were endless.
  void aim_at_mirrored(std::uint32_t i);
  void sample_frosted();
  void shoot(std::uint32_t point, const Ray& ray, const Vec3& weight, std::uint32_t group = kNoGroup);
  void receive(const Shot& shot, const Vec3& passed);
  void trace();
  // Visibility as a ratio of weights (Heitz et al. 2018): exact where all is lit or all is dark, noise in penumbrae
  // only. One ratio over all samples: its bias falls with their number. A half none of whose samples weigh anything,
  // the light being mostly below its points' horizon, knows no ratio of its own.
  void finish_light(const Vec3& radiance, std::uint32_t group, float hours, std::uint32_t per_half);
  // A sun of a day is seen without the other hours. Relative to its own light, a share of all, noise is so much more:
  // the mean square over hours, were they alike.
  float hours_of(const Light& light) const { return light.hour >= 0 ? static_cast<float>(scene().day.lit()) : 1.0f; }
  // The light of `value` came as the samples did.
  static void add_moments(Tally& t, const Vec3& value);
  static Vec3 ratio(const Vec3& a, const Vec3& b) { return a / glm::max(b, Vec3(1e-30f)); }
  static void forget_light(LightTally& t) { t = {}; }
  // Light without a closed form: one sampled light a point, combined with the gather's own hits on it.
  template <class Sample>
  void sample_lights(const Sample& sample);
  // hours: as hours_of().
  void finish_sampled(float hours = 1);
  // The same for points, spots and suns, which no ray meets.
  template <class Sample>
  void sample_punctual(const Sample& sample);
  const Scene& scene() const { return d_.t_.accel.scene(); }

  const DirectLight& d_;
  std::span<const std::uint32_t> list_;
  std::uint32_t per_half_;
  bool directional_;
  std::vector<Point> points_;
  std::vector<Tally> tallies_;
  GroupedLight grouped_, grouped_difference_;         // by texel of the list: of all lights so far,
  std::array<GroupedLight, kHalves> grouped_passed_;  // and by half of those found by chance now
  std::vector<Ray> rays_to_trace_;
  std::vector<Shot> shots_;
  std::vector<Vec3> passed_;
  std::uint64_t rays_ = 0;
};

}  // namespace oriel
