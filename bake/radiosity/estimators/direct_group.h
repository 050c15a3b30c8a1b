// The estimator of direct light for a group of texels, one light at a time. Private to direct_light.cpp.
#pragma once

#include <array>
#include <cmath>

#include "bake/radiosity/estimators/direct_light.h"

namespace oriel {

// Sums of a ratio estimator for one light and texel, by half.
struct LightTally {
  std::array<Vec3, kHalves> unoccluded{}, proposal_weight{}, transmitted{};
  Vec4 transmitted_moments{0};  // Σ moments of `transmitted`, by luminance
};

inline constexpr std::uint32_t kFewSamples = 2;  // a half, that are taken of any light

// The number of samples a half for a light, at most per_half: faint ones get fewer. The variance of n samples falls as
// n^-1.5 (stratified points, a visibility edge), so one more sample reduces it by n^-2.5. That reduction is made equal
// for all lights (Neyman allocation, 1934). noise: variance by one sample; most: of the noisiest light.
inline std::uint32_t sample_count(float noise, float most, std::uint32_t per_half) {
  std::uint32_t samples = per_half;
  const auto has_enough = [&](std::uint32_t n) {
    return noise * std::pow(static_cast<float>(per_half) / static_cast<float>(n), 2.5f) <= most;
  };
  while (samples > 2 * kFewSamples && has_enough(samples / 2)) samples /= 2;
  return samples;
}

// Direct light of a group of texels.
class DirectGroup {
 public:
  // Samples a point of light by frosted panes; of so many groups in which the first find none one takes more.
  static constexpr int kFrosted = 4, kUnlitGroups = 8;
  static constexpr std::uint64_t kPicks = 16;  // of many punctual lights a point, by their estimated contribution

  // directional: run() fills DirectSums::moments.
  DirectGroup(const DirectLight& direct, std::span<const std::uint32_t> list, std::uint32_t per_half, bool directional);

  void run(DirectSums& sums);
  std::uint64_t rays() const { return rays_; }

 private:
  static constexpr std::uint32_t kNoGroup = ~0u;
  static constexpr std::uint32_t kSamplesAPoint = 4;  // of extra points: to find one takes several rays
  static constexpr std::size_t kTelling = 64;  // shadow rays to a light that agree: a texel's own few may by chance
  static constexpr int kTries = 16;            // to find a point of a light above the horizon

  struct Point {
    SamplePoint sample_point;
    std::uint32_t texel = 0;  // of the list
    int half = 0;
    std::uint32_t k = 0;
    bool repeats = false;  // same position as the previous point
  };
  struct ShadowRay {
    std::uint32_t point = 0;
    Vec3 weight{0};
    Vec3 direction{0};
    std::uint32_t group = kNoGroup;  // light group of a randomly chosen light; others are added by finish_lamp()
    int segments = 1;                // rays along the path
    bool punctual = false;           // of a point, a spot or a sun
    Vec3 share{1};                   // throughput apart from transmittance
  };
  struct Lamp {
    Vec3 radiance{1};
    std::uint32_t group = 0;
    float hours = 1;               // hours_of()
    std::uint32_t first = 0;       // samples a half, at least kFewSamples
    std::uint32_t punctual = ~0u;  // into Scene::lights; ~0u: a polygon, or by way of mirrors
  };
  // Sums of a texel: those of the current light, and those of all lights so far.
  struct Tally : LightTally {
    Vec3 total{0}, variance{0};
    Vec4 moments{0};
    Vec3 difference{0};  // half 0 minus half 1
    Vec3 uneven{0};      // half 0 minus half 1 of unoccluded light, all lights together
    Vec3 sharp{0};       // of total: what is computed by pixel
  };

  std::uint64_t stream_of(std::uint32_t texel, int half) const;
  void add_points(std::uint32_t i);
  // True for a finite estimate. Others are counted as dropped.
  bool is_usable(const Point& point, const Vec3& light) const;
  // Adds samples first <= k < end of each half: unoccluded irradiance, and shadow rays where the texel takes them.
  void sample_polygon(std::uint32_t l, std::uint32_t first, std::uint32_t end);
  // Adds a shadow ray to a random point of the light above the horizon. Points below it have no weight and are redrawn,
  // so that a light barely above the horizon gets samples, too.
  void add_polygon_sample(const PolygonView& view, const Receiver& receiver, std::uint32_t p, Sampler& sampler);
  // The variance of a lamp at a texel by one sample, lux², estimated from so many.
  static float noise_of(const LightTally& t, const Lamp& lamp, std::uint32_t per_half);
  // Calls sample(begin, end) for samples begin <= k < end of each half, at first a few of them. Where kTelling of them
  // or more see the lamp, and none does not, further ones of those texels take no rays (of a mirror's image they do);
  // where none does, there are none. Else as many as sample_count() says. Noise of what is computed by pixel is
  // nobody's.
  template <class Sample>
  void add_lamp(const Lamp& lamp, const Sample& sample);
  void sample_punctual_light(std::uint32_t l, std::uint32_t first, std::uint32_t end);
  std::pair<DVec3, double> sphere_about_points() const;
  // Samples the virtual image of a light. The unoccluded irradiance is that of an endless mirror: the mirror's edge
  // acts as an occluder.
  void sample_mirrored_light(std::uint32_t i, std::uint32_t first, std::uint32_t end);  // traces all of them
  void sample_frosted();
  void sample_frosted(std::uint32_t first, std::uint32_t end, float weight);
  void add_shadow_ray(std::uint32_t point, const Ray& ray, const Vec3& weight, std::uint32_t group = kNoGroup);
  void add_transmitted(const ShadowRay& shadow_ray, const Vec3& transmittance);
  void trace();
  // Adds the current light to all: unoccluded irradiance times visibility, estimated as a ratio of proposal weights
  // (Heitz et al. 2018). It is exact where all is lit or all is dark, so noise is in penumbrae only. The ratio is taken
  // over all samples, since its bias falls with their number. A half without any weight, the light being mostly below
  // its points' horizon, takes the ratio of both.
  void finish_lamp(const Lamp& lamp, std::uint32_t per_half);
  bool is_sharp(std::uint32_t l, std::uint32_t texel_of_list) const {
    return l != ~0u && d_.sharp_.charts && d_.sharp_.has(l, d_.texels_.chart[list_[texel_of_list]]);
  }
  // The factor on noise variance of a sun of a day. Each hour is shown without the others, so its noise is relative to
  // its own light: the number of hours, if all were alike.
  float hours_of(const Light& light) const { return light.hour >= 0 ? static_cast<float>(scene().day.lit()) : 1.0f; }
  // Adds the moments of `value`, distributed over directions as the transmitted samples are.
  static void add_moments(Tally& t, const Vec3& value);
  static Vec3 ratio(const Vec3& a, const Vec3& b) { return a / glm::max(b, Vec3(1e-30f)); }
  // Samples lights without a closed form, one a point, by multiple importance sampling with gather rays that hit them;
  // or many punctual ones, which no ray hits.
  template <class Sample>
  void sample_lights(const Sample& sample, std::uint64_t punctual_picks = 0);
  // Adds the samples of the current lights to all. hours: as in hours_of().
  void finish_sampled(float hours = 1);
  const Scene& scene() const { return d_.t_.accel.scene(); }

  const DirectLight& d_;
  std::span<const std::uint32_t> list_;
  std::uint32_t per_half_;
  bool directional_;
  std::vector<Point> points_;
  std::vector<Tally> tallies_;
  float noisiest_ = 0;        // noise_of(), sum over texels, of the noisiest light so far
  std::vector<char> traces_;  // by texel: samples of the current light take shadow rays
  GroupedLight grouped_, grouped_difference_, grouped_sharp_;  // by texel of the list, of all lights so far
  std::array<GroupedLight, kHalves> grouped_transmitted_;      // by half, of the randomly chosen lights now
  std::vector<Ray> rays_to_trace_;
  std::vector<ShadowRay> shadow_rays_;
  std::vector<Vec3> transmittances_;
  std::uint64_t rays_ = 0;
};

}  // namespace oriel
