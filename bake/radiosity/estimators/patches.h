// Multiple bounces: a coarse radiosity problem over patches of a few texels, whose solution the final gather refines. A
// block of texels that walls divide has a patch for each connected part.
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
  // Side of a patch in texels. A patch that mixes hidden, dark texels with lit and visible ones loses light: 0.25 % a
  // bounce with 2, 0.5 % with 4, in a furnished room of 13 cm texels.
  std::uint32_t side = 1;
  std::uint32_t rays_per_patch = 64;
  std::optional<int> most = {};       // limit on sweeps; none: the tolerance, or the bounces of paths
  std::function<bool()> enough = {};  // polled after some hundred sweeps: true ends them; may be empty
  double tolerance = 1e-3;            // relative, for Sweeps::tail
  double seconds = std::numeric_limits<double>::infinity();  // for the rays: a shorter time gives coarser patches
};

// Options by number of texels. error: the relative error requested, of which the bounces get a part.
inline SweepOptions sweep_options(const RadiosityOptions& options, double error, std::size_t texels) {
  constexpr double kTailShare = 0.05;            // of the error: for the bounces left out
  constexpr double kCoarseTarget = 0.04;         // errors from which coarse patches suffice
  constexpr double kTime = 0.3, kLeast_s = 0.1;  // of the time left, and some light where there is none
  constexpr std::size_t kMaxLinks = 64u << 20;   // 1 GiB
  SweepOptions how{.enough = options.enough};
  if (options.bounces > 0) how.most = options.bounces - 1;  // the gather itself is one
  how.tolerance = kTailShare * std::max(error, 1e-3);
  if (options.left) how.seconds = std::max(kTime * options.left(), kLeast_s);
  how.side = error >= kCoarseTarget ? 2 : 1;
  while (texels / (how.side * how.side) * how.rays_per_patch > kMaxLinks) ++how.side;
  return how;
}

struct Sweeps {
  std::vector<Vec3> gathered;  // reflected irradiance by texel, interpolated from the patches, lux
  GroupedLight grouped;        // the same by light group; may be empty
  int count = 0;
  // A bound on the light of all further sweeps, relative: the larger of that for the mean and of the mean over patches,
  // each relative to its own light.
  double tail = 0;
  double growth = 0;        // change of the last sweep over that of the one before: below 1 where light dies away
  std::size_t bounded = 0;  // patches whose weights were bounded
  std::size_t patches = 0;
};

// The texels, the cache query for their rays, and the light to be reflected.
struct SweepScene {
  const Texels& texels;
  const TexelGraph& graph;
  const CacheQuery& query;
  std::span<const Vec3> direct;           // irradiance by texel that gather rays leave out (closed forms), lux
  const GroupedLight* grouped = nullptr;  // `direct` by light group; null: not wanted
};

// Solves the radiosity problem. Each patch traces its rays once. Jacobi iterations then run over the links until a
// geometric bound on the remaining light, |ΔB| q/(1 - q) with q the ratio of successive changes, is below the
// tolerance, for the sum and for each patch relative to its own light.
//
// Noise of few rays can give a patch a weight sum above its reflectance, so that the changes grow. Then the patches
// whose light grows get their weights bounded by the mean sum of their neighbourhood, and in the end all sums by 1. No
// sweep adds more than the one before then: with direct light E₀ the result is at most (count + 1) max E₀. Where light
// does not die away (a closed scene that absorbs nothing), as many bounces are added as paths have, with a warning.
// Error kStopped.
Result<Sweeps> sweep(const SweepScene& scene, const SweepOptions& options, const Stage& stage);

}  // namespace oriel
