// An energy balance of the scene by particles from its light sources: a check of the lightmap that shares nothing but
// the scene with its computation.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/radiosity.h"

namespace oriel {

// Luminous flux with its standard error, lm.
struct Lumens {
  double value = 0, error = 0;
};

struct Ledger {
  std::uint64_t particles = 0, rays = 0;
  double lamps_lm = 0;     // emitted by surfaces, point and spot lights, by definition
  Lumens from_afar;        // from the sky and directional lights, the part that hits a surface
  Lumens absorbed;         // at reflecting surfaces
  Lumens escaped;          // to the sky
  Lumens lost_behind;      // at backs of one-sided surfaces, which reflect nothing
  Lumens lost_guard;       // by the limit on bounces
  Lumens missing;          // emitted - absorbed - escaped - lost: 0 apart from noise
  Lumens on_texels;        // absorbed by fronts of evaluated texels, by particles …
  double lightmap_lm = 0;  // … and by the lightmap

  double emitted_lm() const { return lamps_lm + from_afar.value; }
  double closure() const { return emitted_lm() > 0 ? std::abs(missing.value) / emitted_lm() : 0; }
  double closure_error() const { return emitted_lm() > 0 ? missing.error / emitted_lm() : 0; }
  // The relative difference of on_texels and lightmap_lm, over the larger of the two, and its standard error.
  double disagreement() const;
  double disagreement_error() const;
};

inline constexpr double kLedgerTolerance = 0.005;  // of closure() and disagreement(), on top of three standard errors

// Traces particles for about `rays_at_most`, at least some thousand. The result does not depend on threads. Empty where
// the scene has no light. Stage name "ledger"; error kStopped.
Result<Ledger> keep_ledger(const LightmapScene& scene, const Radiosity& radiosity, std::uint64_t rays_at_most,
                           Context& context);

// One message for each imbalance beyond tolerance and noise, with its size.
std::vector<std::string> ledger_findings(const Ledger& ledger);

}  // namespace oriel
