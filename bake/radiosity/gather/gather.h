// The final gather: cosine-distributed rays from every texel into the cached light.
#pragma once

#include "bake/radiosity/gather/cached_light.h"
#include "bake/radiosity/gather/gather_site.h"
#include "bake/radiosity/gather/surroundings.h"
#include "bake/radiosity/texels/extra_sample_points.h"

namespace oriel {

// Both halves of an estimate, by texel: sums over the samples taken so far.
struct HalfSums {
  std::array<std::vector<Vec3>, kHalves> sum;    // lux * samples
  std::array<std::vector<Vec3>, kHalves> slope;  // the part of it that CachedTexel's slopes brought
  std::vector<std::uint32_t> samples;            // of each half
  // Light that no gather ray looks for (lamp_paths.h), lux, and the mean of its moments.
  std::array<std::vector<Vec3>, kHalves> beside;
  std::vector<Vec4> beside_moments;
  // Σ of luminance over the sphere, both halves: vector (xyz) and mean (w) as LightmapPage::direction wants them, times
  // samples. Empty unless asked for.
  std::vector<Vec4> moments;
  std::array<GroupedLight, kHalves> grouped, beside_grouped;  // of `sum` and `beside`, by group of lamps

  HalfSums(std::size_t texels, bool directional, std::size_t groups = 0)
      : samples(texels),
        beside_moments(directional ? texels : 0),
        moments(directional ? texels : 0),
        grouped{GroupedLight(texels, groups), GroupedLight(texels, groups)},
        beside_grouped(grouped) {
    for (auto& s : sum) s.resize(texels);
    for (auto& s : slope) s.resize(texels);
    for (auto& b : beside) b.resize(texels);
  }
  void forget(std::size_t i) {
    for (int h = 0; h < kHalves; ++h) sum[h][i] = slope[h][i] = Vec3(0);
    if (!moments.empty()) moments[i] = Vec4(0);
    for (GroupedLight& half : grouped) std::ranges::fill(half.of(i), Vec3(0));
    samples[i] = 0;
  }
  void take(std::size_t i, const HalfSums& from, std::size_t k) {
    for (int h = 0; h < kHalves; ++h) sum[h][i] = from.sum[h][k], slope[h][i] = from.slope[h][k];
    if (!from.moments.empty()) moments[i] = from.moments[k];
    samples[i] = from.samples[k];
  }
  void take_beside(std::size_t i, const HalfSums& from) {
    for (int h = 0; h < kHalves; ++h) beside[h][i] = from.beside[h][i];
    if (!beside_moments.empty()) beside_moments[i] = from.beside_moments[i];
  }
  // Stands for a sample that was not taken: light known from elsewhere, uncertain by that share of it. of_groups: the
  // same by group of lamps, of all texels.
  void assume(std::size_t i, const Vec3& light, float uncertain, const GroupedLight& of_groups) {
    sum[0][i] = (1 + uncertain) * light, sum[1][i] = (1 - uncertain) * light;
    samples[i] = 1;
    for (GroupedLight& half : grouped) std::ranges::copy(of_groups.of(i), half.of(i).begin());
  }
  Vec3 half(int h, std::size_t i) const {
    return beside[h][i] + (samples[i] ? sum[h][i] / static_cast<float>(samples[i]) : Vec3(0));
  }
  Vec3 mean(std::size_t i) const { return 0.5f * (half(0, i) + half(1, i)); }
  // Of the halves' light by group.
  std::array<GroupedLight, kHalves> grouped_halves() const {
    std::array<GroupedLight, kHalves> halves = beside_grouped;
    for (int h = 0; h < kHalves; ++h)
      for (std::size_t i = 0; i < samples.size(); ++i)
        for (std::size_t g = 0; g < halves[h].groups && samples[i] > 0; ++g)
          halves[h].of(i)[g] += grouped[h].of(i)[g] / static_cast<float>(samples[i]);
    return halves;
  }
};

// From where rays leave, what they meet, and the light that is there.
struct FinalGather {
  const ExtraSamplePoints& sample_points;
  const Surroundings& around;
  const CachedLight& cached;

  // Adds samples to the listed texels (in coherent_order) until each half has `per_half` of them. Directions are
  // a net (ShiftedNet) of each texel's and half's own. Error kStopped.
  Status run(std::span<const std::uint32_t> list, std::uint32_t per_half, const Stage& stage, HalfSums& sums) const;
};

}  // namespace oriel
