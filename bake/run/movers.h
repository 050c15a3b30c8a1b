// Movers and the light that they move through.
#pragma once

#include "bake/run/assemble.h"
#include "bake/run/task.h"

namespace oriel {

struct MoverReport {
  std::string name;
  std::size_t vertices = 0;
  float transfer_error = 0;     // standard error of the coefficients, relative
  float compression_error = 0;  // relative
  int bytes_per_vertex = 0;
  float coarse_share = 0;  // of the surface whose vertices are too far apart for what shades them
};

// Transfer of every mover, compressed, into pack.movers; the summaries of the materials that only movers have into
// `materials`. Adds to `rays`. Errors kStopped, kUsage.
Result<std::vector<MoverReport>> bake_movers(const BakeTask& bake, MaterialMaps& materials, std::uint64_t& rays);

// The light field over where people walk (pack.walk_grids), or over the scene where that is not known, and over where
// the movers' animations take them: from the pack's lightmaps. It is refined until there is `enough`. Adds to `rays`.
// Errors kStopped, kUsage.
Status bake_light_field(const BakeTask& bake, std::function<bool()> enough, std::uint64_t& rays);

}  // namespace oriel
