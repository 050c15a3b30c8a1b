// Where the light of a scene goes, counted by particles from its sources: a check of the lightmap that shares nothing
// with how it was computed but the scene.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/radiosity.h"

namespace oriel {

// Lumens (luminance), each with its standard error.
struct Lumens {
  double value = 0, error = 0;
};

struct Ledger {
  std::uint64_t particles = 0, rays = 0;
  double lamps_lm = 0;     // emitted by surfaces, point and spot lights, by their definition
  Lumens from_afar;        // from the sky and directional lights, as far as it meets a surface
  Lumens absorbed;         // by surfaces that reflect
  Lumens escaped;          // left the scene, to the sky
  Lumens lost_behind;      // met the backs of one-sided surfaces, which reflect nothing
  Lumens lost_guard;       // was still on its way after so many bounces that nobody counts on
  Lumens missing;          // emitted - absorbed - escaped - lost: 0 but for noise
  Lumens on_texels;        // what fronts with told texels keep of what comes to them, by particles …
  double lightmap_lm = 0;  // … and by the lightmap

  double emitted_lm() const { return lamps_lm + from_afar.value; }
  double closure() const { return emitted_lm() > 0 ? std::abs(missing.value) / emitted_lm() : 0; }
  double closure_error() const { return emitted_lm() > 0 ? missing.error / emitted_lm() : 0; }
  // The lightmap beside the particles, relative to the larger.
  double disagreement() const;
  double disagreement_error() const;
};

inline constexpr double kLedgerTolerance = 0.005;  // of closure() and disagreement(), beside three standard errors

// Traces particles for about `rays_at_most`, at least some thousand. The same for any number of threads; nothing where
// the scene has no light. Stage name "ledger"; error kStopped.
Result<Ledger> keep_ledger(const LightmapScene& scene, const Radiosity& radiosity, std::uint64_t rays_at_most,
                           Context& context);

// Where the ledger does not close or the lightmap disagrees, beyond what noise explains: one line each, with its size.
std::vector<std::string> ledger_findings(const Ledger& ledger);

}  // namespace oriel
