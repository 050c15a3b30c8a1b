// Bounces: a coarse radiosity problem over patches of a few texels, whose answer the final gather refines. A block of
// texels that walls divide is a patch for each part of it.
#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/gather/cache_query.h"
#include "bake/radiosity/gather/gather_point.h"
#include "bake/radiosity/texels/grouped_light.h"
#include "bake/radiosity/texels/neighbours.h"

namespace oriel {

struct SweepOptions {
  // Patches are squares of so many texels. What is dark because it is hidden is hardly seen either; patches that mix it
  // with what is lit and seen lose light: 0.25 % a bounce with 2, 0.5 % with 4 in a furnished room of 13 cm texels.
  std::uint32_t side = 1;
  std::uint32_t rays_per_patch = 64;
  std::optional<int> most = {};       // sweeps; none: until the tolerance holds, or as many as paths have bounces
  std::function<bool()> enough = {};  // asked after some hundred sweeps: true ends them; may be empty
  double tolerance = 1e-3;            // of the light, bound on what further sweeps could add: see Sweeps::tail
  double seconds = std::numeric_limits<double>::infinity();  // that the rays may take: less than they need are coarser
};

// For so many texels, as a part of the error asked for.
inline SweepOptions sweep_options(const RadiosityOptions& options, double error, std::size_t texels) {
  constexpr double kTailShare = 0.05;           // of the error: what further bounces may add
  constexpr double kCoarseTarget = 0.04;        // errors from which coarser bounces do
  constexpr double kTime = 0.3;                 // of what is left
  constexpr std::size_t kMaxLinks = 64u << 20;  // 1 GiB
  SweepOptions how{.enough = options.enough};
  if (options.bounces > 0) how.most = options.bounces - 1;  // the gather itself is one
  how.tolerance = kTailShare * std::max(error, 1e-3);
  if (options.left) how.seconds = kTime * options.left();
  how.side = error >= kCoarseTarget ? 2 : 1;
  while (texels / (how.side * how.side) * how.rays_per_patch > kMaxLinks) ++how.side;
  return how;
}

struct Sweeps {
  std::vector<Vec3> gathered;  // by texel: irradiance that gather rays would find, interpolated from the patches, lux
  GroupedLight grouped;        // the same by group of lamps, if asked
  int count = 0;
  double tail = 0;    // the bound reached: what all further sweeps together add at most; the larger of that relative to
                      // the mean and of the mean over patches, each relative to its own light
  double growth = 0;  // of the last sweep's change over the one's before: below 1 where light dies away
  std::size_t bounded = 0;  // patches whose weights were bounded
  std::size_t patches = 0;
};

// Texels, what is around them, and the light that bounces.
struct SweepScene {
  const Texels& texels;
  const TexelGraph& graph;
  const CacheQuery& query;
  std::span<const Vec3> direct;           // irradiance by texel that gather rays do not find (closed forms), lux
  const GroupedLight* grouped = nullptr;  // `direct` by group of lamps; null: nobody asks
};

// Each patch traces its rays once; then Jacobi sweeps run over what they found, until the geometric bound on the rest,
// |ΔB| q/(1 - q) with q the ratio of successive changes, is below tolerance, for all light and for each patch beside
// its own. Where the changes grow instead, noise of few rays makes patches hand on more than they get: those whose
// light grows get weights that sum to no more than those of their surroundings, and in the end all sum to at most 1, so
// that no sweep adds more than the one before: with direct light E₀ the result is at most (count + 1) max E₀. Where
// light does not die away (a closed scene that absorbs nothing) as many bounces are added up as paths follow, and a
// warning tells the energy balance. Error kStopped.
Result<Sweeps> sweep(const SweepScene& scene, const SweepOptions& options, const Stage& stage);

}  // namespace oriel
