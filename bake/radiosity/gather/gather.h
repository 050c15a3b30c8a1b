// The final gather: cosine-distributed rays from every texel into the cached light.
#pragma once

#include "bake/radiosity/gather/cache_query.h"
#include "bake/radiosity/gather/cached_light.h"
#include "bake/radiosity/gather/gather_point.h"
#include "bake/radiosity/texels/extra_sample_points.h"

namespace oriel {

// Sums over the gather samples so far, for both halves of the estimate, by texel.
struct HalfSums {
  std::array<std::vector<Vec3>, kHalves> sum;    // lux * samples
  std::array<std::vector<Vec3>, kHalves> slope;  // the contribution of CachedTexel's slopes to `sum`
  std::vector<std::uint32_t> samples;            // of each half
  // An additional term that gather rays leave out: light of lamps by specular paths (lamp_paths.h), lux, and the mean
  // of its moments.
  std::array<std::vector<Vec3>, kHalves> additional;
  std::vector<Vec4> additional_moments;
  // First moment (xyz) and mean (w) of luminance over the sphere, of both halves, times samples, for
  // LightmapPage::direction. Empty unless directional.
  std::vector<Vec4> moments;
  std::array<GroupedLight, kHalves> grouped, additional_grouped;  // `sum` and `additional` by light group

  HalfSums(std::size_t texels, bool directional, std::size_t groups = 0)
      : samples(texels),
        additional_moments(directional ? texels : 0),
        moments(directional ? texels : 0),
        grouped{GroupedLight(texels, groups), GroupedLight(texels, groups)},
        additional_grouped(grouped) {
    for (auto& s : sum) s.resize(texels);
    for (auto& s : slope) s.resize(texels);
    for (auto& b : additional) b.resize(texels);
  }
  // Sets one sample by an assumed irradiance, lux, instead of a gathered one. uncertain: its relative error. of_groups:
  // irradiance by light group, of all texels.
  void set_assumed(std::size_t i, const Vec3& light, float uncertain, const GroupedLight& of_groups) {
    sum[0][i] = (1 + uncertain) * light, sum[1][i] = (1 - uncertain) * light;
    samples[i] = 1;
    for (GroupedLight& half : grouped) std::ranges::copy(of_groups.of(i), half.of(i).begin());
  }
  Vec3 half(int h, std::size_t i) const {
    return additional[h][i] + (samples[i] ? sum[h][i] / static_cast<float>(samples[i]) : Vec3(0));
  }
  Vec3 mean(std::size_t i) const { return 0.5f * (half(0, i) + half(1, i)); }
  // Both halves by light group: gathered and additional light, lux.
  std::array<GroupedLight, kHalves> grouped_halves() const {
    std::array<GroupedLight, kHalves> halves = additional_grouped;
    for (int h = 0; h < kHalves; ++h)
      for (std::size_t i = 0; i < samples.size(); ++i)
        for (std::size_t g = 0; g < halves[h].groups && samples[i] > 0; ++g)
          halves[h].of(i)[g] += grouped[h].of(i)[g] / static_cast<float>(samples[i]);
    return halves;
  }
};

// The final gather: sample points, the cache query for their rays, and the cache.
struct FinalGather {
  const ExtraSamplePoints& sample_points;
  const CacheQuery& query;
  const CachedLight& cached;

  // Adds samples to the listed texels (in coherent_order) until each half has `per_half` of them. Each texel and half
  // has its own shifted low-discrepancy net (ShiftedNet) of directions. Error kStopped.
  Status run(std::span<const std::uint32_t> list, std::uint32_t per_half, const Stage& stage, HalfSums& sums) const;
};

}  // namespace oriel
