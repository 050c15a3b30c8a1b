// Texels that are far brighter than what is around them: sunlit floors, ceilings over lamps, gaps that a lamp shines
// into. Cosine-distributed rays meet them rarely, so that rays are aimed at them as at lamps.
#pragma once

#include <optional>

#include "bake/radiosity/gather/surroundings.h"
#include "bake/radiosity/texels/extra_sample_points.h"

namespace oriel {

struct CachedLight;

// What is known of light before any ray is aimed.
struct LightAround {
  const Texels& texels;
  const ExtraSamplePoints& sample_points;
  std::span<const float> importance;  // of frames, by texel
  std::vector<float> radiance;             // luminance by texel, cd/m²
  float reflected = 0;                     // of what eyes see: lit by reflected light alone, lux, mean

  // gathered: reflected light by texel, lux.
  LightAround(const Texels& texels, const ExtraSamplePoints& sample_points, const CachedLight& cached,
              std::span<const Vec3> gathered, std::span<const float> importance);
};

// Both kinds of ray add up to all light, weighted by the balance heuristic (Veach 1997, section 9.2): the density of
// aimed ones is taken by the texel that a direction meets first, whatever is looked up or followed from there.
class BrightTexels {
 public:
  BrightTexels() = default;
  // Those that are kBright times as bright as reflected light is, and what of a texel lies in the gap of such a lamp;
  // none where a good part of what is seen is as bright. A few rays from them tell how far they shine.
  BrightTexels(const Surroundings& around, const LightAround& light, std::uint64_t seed);

  bool empty() const { return regions_.empty(); }

  // How a receiver shares its rays among the clusters: sums of what each would bring, were nothing in the way, lux.
  // Empty: no ray is worth it.
  using Aim = std::vector<float>;
  Aim aim(const SamplePoint& receiver) const;

  struct Target {
    Vec3 point{0};
    std::uint32_t region = 0;
  };
  // None where the point drawn lies on another part of the texel: no ray is sent then, which is an estimate of 0.
  std::optional<Target> sample(const Aim& aim, int half, const Vec2& u) const;
  // The region in which a first hit lies; kNoTexel: none.
  std::uint32_t region(const Texels::Place& place) const;
  // Of aimed rays in a direction that first meets a region, per steradian.
  float density(const Aim& aim, std::uint32_t region, const Ray& ray, const Hit& hit) const;

  // Of what was found, beside the scene, the seed and the light.
  const Hash128& name() const { return name_; }

 private:
  static constexpr float kBright = 4;                        // times as bright as what is around
  static constexpr std::size_t kTexels = 4096;               // of those that are bright, the ones that send most
  static constexpr std::size_t kClusters = 256;              // likewise
  static constexpr std::uint32_t kPoints = 1u << 17;         // of all regions, about
  static constexpr std::uint32_t kFewest = 16, kMost = 256;  // of a region and half
  static constexpr float kFar_m = 1;       // beyond which what does not shine so far is hardly aimed at
  static constexpr float kWorth = 0.1f;    // of the light around, from which rays are aimed
  static constexpr double kCommon = 0.25;  // of what is seen: what is as common is met without aiming

  // A texel's part beside a lamp, or under it.
  struct Region {
    std::uint32_t cluster = 0;
    float area_texels2 = 0;  // the whole texel's surface on its page, in texels
    float power = 0;         // of the part, lm
    Vec3 normal{0};
    std::array<std::vector<std::optional<Vec3>>, kHalves> points;  // even over the whole texel; none: of another part
  };
  struct Cluster {
    Vec3 centre{0}, normal{0};
    float radius_m = 0, power = 0;
    float shines_far = 0;              // share of its light that comes further than kFar_m
    std::uint32_t first = 0, end = 0;  // of regions_
  };

  std::vector<std::uint32_t> bright(const LightAround& light) const;
  void add_regions(const LightAround& light, std::uint32_t texel, std::uint32_t count);
  void cluster_regions(const Texels& texels);
  void describe(Cluster& cluster, std::uint64_t stream, std::uint64_t seed) const;
  void keep_strongest();

  const Accel* accel_ = nullptr;
  const Texels* texels_ = nullptr;
  std::vector<Region> regions_;
  std::vector<std::uint32_t> texel_of_;  // by region
  std::vector<float> power_until_;       // by region: sums of power within its cluster
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> beside_, in_gap_;  // region by texel
  float worth_ = 0;                             // lux
  Hash128 name_;
};

}  // namespace oriel
