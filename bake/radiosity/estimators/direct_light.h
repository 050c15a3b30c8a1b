// Direct light of texels: closed-form irradiance times sampled visibility.
#pragma once

#include "bake/radiosity/texels/extra_sample_points.h"
#include "bake/radiosity/texels/grouped_light.h"
#include "bake/radiosity/texels/neighbours.h"
#include "bake/radiosity/texels/sharp_charts.h"

namespace oriel {

// The direct-light estimate by texel, lux; variances in lux².
struct DirectSums {
  std::vector<Vec3> value;
  std::vector<Vec3> difference;         // half 0 minus half 1, which are independent
  std::vector<Vec3> variance;           // noise of value: closed forms by their visibility samples, the rest by halves
  std::vector<Vec3> uneven;             // variance of the closed forms' mean over the texel, by halves
  std::vector<std::uint32_t> per_half;  // samples of each half and light
  std::vector<Vec4> moments;            // of luminance over the sphere (moments.h); empty unless directional
  GroupedLight grouped, grouped_difference;  // value and difference by light group
  std::vector<Vec3> sharp;                   // of value: what is computed by pixel; no other sum has it
  GroupedLight grouped_sharp;                // likewise, of grouped

  DirectSums(std::size_t texels, bool directional, std::size_t groups = 0)
      : value(texels),
        difference(texels),
        variance(texels),
        uneven(texels),
        per_half(texels),
        moments(directional ? texels : 0),
        grouped(texels, groups),
        grouped_difference(texels, groups),
        sharp(texels),
        grouped_sharp(texels, groups) {}

  // Both halves by light group, without what is computed by pixel.
  std::array<GroupedLight, kHalves> grouped_halves() const {
    std::array<GroupedLight, kHalves> halves{grouped, grouped};
    for (GroupedLight& half : halves) half.add(grouped_sharp, -1);
    halves[0].add(grouped_difference, 0.5f), halves[1].add(grouped_difference, -0.5f);
    return halves;
  }
};

inline constexpr float kUncertain = 0.1f;  // relative error of direct light
// Removes texels with a reliable estimate from the list. Those stay whose direct light, or a neighbour's, has a
// relative error above `share`, and those in whose wide neighbourhood (typical_errors) it is uncertain. The latter
// avoids a bias: where few samples hit a light, as the sky through a window, only texels with a lucky hit would be
// refined, and would become darker, while the others stayed dark.
void keep_uncertain(const DirectSums& sums, const TexelGraph& graph, float share, Context& context,
                    std::vector<std::uint32_t>& list);

// Which light is computed by pixel, and what becomes of it: DirectSums::sharp has it apart, or it is not estimated.
struct SharpPart {
  const SharpCharts* charts = nullptr;  // null: there is none
  bool left_out = false;

  bool has(std::uint32_t light, std::uint32_t chart) const { return charts && charts->apart(light, chart); }
};

class DirectLight {
 public:
  DirectLight(const Transport& transport, const Texels& texels, const ExtraSamplePoints& sample_points,
              std::uint64_t seed, const SharpPart& sharp = {});

  // True if every emitting surface has a closed form. False: surfaces are left to light sampling (LightSet), because of
  // textured emitters, or of too many polygons to visit one by one.
  bool closed_form() const { return closed_form_; }
  // True if some lights are chosen randomly: emitters without closed forms, the sky, many punctual lights, frosted
  // panes.
  bool samples_lights() const {
    return !closed_form_ || t_.lights.samples_sky() || many_punctual_ || !t_.lights.frosted().empty();
  }

  // Estimates the listed texels again with `per_half` samples a half and light. Error kStopped.
  Status estimate(std::span<const std::uint32_t> list, std::uint32_t per_half, const Stage& stage,
                  DirectSums& sums) const;

 private:
  friend class DirectGroup;
  const Transport& t_;
  const Texels& texels_;
  const ExtraSamplePoints& sample_points_;
  std::uint64_t seed_;
  SharpPart sharp_;
  std::vector<PolygonLight> polygons_;
  bool many_punctual_ = false;  // light sampling chooses among them
  bool closed_form_ = true;
};

}  // namespace oriel
