// Direct light of polygon lights and punctual lights per texel: closed forms times sampled visibility.
#pragma once

#include "bake/radiosity/texels/extra_sample_points.h"
#include "bake/radiosity/texels/grouped_light.h"
#include "bake/radiosity/texels/neighbours.h"

namespace oriel {

// What the direct estimate of a texel knows. Lux.
struct DirectSums {
  std::vector<Vec3> value;
  std::vector<Vec3> difference;  // of its halves, which share neither points nor rays
  std::vector<Vec3> variance;    // of value: closed forms by their mix of lit and dark samples, the rest by halves
  std::vector<Vec3> uneven;      // of the closed forms' means over the texel, likewise from one difference
  std::vector<std::uint32_t> per_half;       // samples of each half for each light
  std::vector<Vec4> moments;                 // of luminance over the sphere (moments.h); empty unless asked for
  GroupedLight grouped, grouped_difference;  // of value and difference, by group of lamps

  DirectSums(std::size_t texels, bool directional, std::size_t groups = 0)
      : value(texels),
        difference(texels),
        variance(texels),
        uneven(texels),
        per_half(texels),
        moments(directional ? texels : 0),
        grouped(texels, groups),
        grouped_difference(texels, groups) {}

  // Of the halves' light by group.
  std::array<GroupedLight, kHalves> grouped_halves() const {
    std::array<GroupedLight, kHalves> halves{grouped, grouped};
    halves[0].add(grouped_difference, 0.5f), halves[1].add(grouped_difference, -0.5f);
    return halves;
  }

  void copy(std::size_t i, const DirectSums& from, std::size_t k) {
    value[i] = from.value[k], difference[i] = from.difference[k];
    variance[i] = from.variance[k], uneven[i] = from.uneven[k];
    if (!from.moments.empty()) moments[i] = from.moments[k];
    per_half[i] = from.per_half[k];
  }
};

// Keeps those of the list whose direct light, or a neighbour's, is uncertain by more than that share of it, and those
// in whose wide surroundings (typical_errors) it is by a tenth. Where few samples meet a light, as the sky through a
// window, texels that were asked again because one did would come down to the truth and the others stay dark.
void keep_uncertain(const DirectSums& sums, const TexelGraph& graph, float share, Context& context,
                    std::vector<std::uint32_t>& list);

class DirectLight {
 public:
  DirectLight(const Transport& transport, const Texels& texels, const ExtraSamplePoints& sample_points,
              std::uint64_t seed);

  // True where every emitting surface has a closed form; false: surfaces are left to sampling (textured emitters, more
  // polygons than it pays to visit one by one), see LightSet.
  bool closed_form() const { return closed_form_; }
  // Some light is found by chance: emitters without closed forms, the sky, many punctual lights.
  bool samples_lights() const {
    return !closed_form_ || t_.lights.samples_sky() || many_punctual_ || !t_.lights.frosted().empty();
  }

  // Estimates the listed texels anew with so many samples a half and light. Error kStopped.
  Status estimate(std::span<const std::uint32_t> list, std::uint32_t per_half, const Stage& stage,
                  DirectSums& sums) const;

 private:
  friend class DirectGroup;
  const Transport& t_;
  const Texels& texels_;
  const ExtraSamplePoints& sample_points_;
  std::uint64_t seed_;
  std::vector<PolygonLight> polygons_;
  bool many_punctual_ = false;  // light sampling chooses among them
  bool closed_form_ = true;
};

}  // namespace oriel
