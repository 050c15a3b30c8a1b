// Importance sampling of texels that are far brighter than the rest: sunlit floors, ceilings over lamps, gaps that a
// lamp shines into. Cosine-distributed rays hit them rarely, so they are sampled like area lights.
#pragma once

#include <optional>

#include "bake/radiosity/gather/cache_query.h"
#include "bake/radiosity/texels/extra_sample_points.h"

namespace oriel {

struct CachedLight;

// The light estimate before the final gather, from which bright texels are chosen.
struct InitialLight {
  const Texels& texels;
  const ExtraSamplePoints& sample_points;
  std::span<const float> importance;  // by texel: the fraction of frame pixels that it fills
  std::vector<float> radiance;        // luminance by texel, cd/m²
  float reflected = 0;                // mean reflected illuminance, weighted by importance, lux

  // gathered: reflected irradiance by texel, lux.
  InitialLight(const Texels& texels, const ExtraSamplePoints& sample_points, const CachedLight& cached,
               std::span<const Vec3> gathered, std::span<const float> importance);
};

// Combines cosine-distributed rays and light samples of bright texels by the balance heuristic (Veach 1997, section
// 9.2). The density of the light samples depends on the texel that a direction hits first, whatever is looked up or
// traced from there.
class BrightTexels {
 public:
  BrightTexels() = default;
  // Chooses texels with kBright times the mean reflected light, and the parts of texels in the gap under a lamp as
  // bright. None is chosen where a share of kCommon of the frames is as bright. A few rays from each cluster measure
  // how far its light comes.
  BrightTexels(const CacheQuery& query, const InitialLight& light, std::uint64_t seed);

  bool empty() const { return regions_.empty(); }

  // The cumulative importance of the clusters for a receiver: the unoccluded irradiance from each, lux. Empty where the
  // sum is below kMinImportance times the mean reflected light: no light sample is taken there.
  using ImportanceCdf = std::vector<float>;
  ImportanceCdf importance_cdf(const SamplePoint& receiver) const;

  struct Target {
    Vec3 point{0};
    std::uint32_t region = 0;
  };
  // Draws a point of a bright region; u: [0,1)². Nothing if the point lies on another part of the texel: the estimate
  // is then 0, without a ray.
  std::optional<Target> sample(const ImportanceCdf& cdf, int half, const Vec2& u) const;
  // The region of a first hit; kNoTexel without one.
  std::uint32_t region(const Texels::Place& place) const;
  // The density of light samples in a direction that hits that region first, sr⁻¹.
  float density(const ImportanceCdf& cdf, std::uint32_t region, const Ray& ray, const Hit& hit) const;

  // A hash of the regions, for cache keys that have scene, seed and light in them.
  const Hash128& content_hash() const { return content_hash_; }

 private:
  static constexpr float kBright = 4;                        // times the mean reflected light
  static constexpr std::size_t kTexels = 4096;               // at most, those with the most power
  static constexpr std::size_t kClusters = 256;              // at most, likewise
  static constexpr std::uint32_t kPoints = 1u << 17;         // of all regions together, about
  static constexpr std::uint32_t kFewest = 16, kMost = 256;  // points a region and half
  static constexpr float kFar_m = 1;             // clusters whose light ends nearer have little importance beyond it
  static constexpr float kMinImportance = 0.1f;  // of the mean reflected light
  static constexpr double kCommon = 0.25;        // of the frames: texels as common are hit by cosine-distributed rays

  // The part of a texel outside a gap, or the part in it.
  struct Region {
    std::uint32_t cluster = 0;
    float area_texels2 = 0;  // surface of the whole texel on its page, in texels
    float power = 0;         // of the part, luminance, lm
    Vec3 normal{0};
    std::array<std::vector<std::optional<Vec3>>, kHalves>
        points;  // uniform over the whole texel; empty: on the other part
  };
  struct Cluster {
    Vec3 centre{0}, normal{0};
    float radius_m = 0, power = 0;
    float shines_far = 0;              // fraction of its light that comes further than kFar_m
    std::uint32_t first = 0, end = 0;  // of regions_
  };

  std::vector<std::uint32_t> find_bright(const InitialLight& light) const;
  void add_regions(const InitialLight& light, std::uint32_t texel, std::uint32_t count);
  void cluster_regions(const Texels& texels);
  void describe(Cluster& cluster, std::uint64_t stream, std::uint64_t seed) const;
  void keep_strongest();

  const Accel* accel_ = nullptr;
  const Texels* texels_ = nullptr;
  std::vector<Region> regions_;
  std::vector<std::uint32_t> texel_of_;  // by region
  std::vector<float> power_until_;       // by region: cumulative power within its cluster
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> open_region_, gap_region_;  // region by texel
  float min_importance_ = 0;                             // lux
  Hash128 content_hash_;
};

}  // namespace oriel
