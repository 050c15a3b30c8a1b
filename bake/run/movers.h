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

struct BakedMovers {
  std::vector<Mover> movers;
  std::vector<MoverReport> reports;  // by mover
};

// Every mover with its transfer, compressed. The summaries of the materials that only movers have go into `materials`.
// Adds to `rays`. Errors kStopped, kUsage.
Result<BakedMovers> bake_movers(const BakeTask& bake, double seconds, MaterialMaps& materials, std::uint64_t& rays);

// The light field over where people walk (`floors`), or over the scene where that is not known, and over where the
// movers' animations take them: from the lightmaps. It takes `left` seconds, which may be infinite. Adds to `rays`.
// Errors kStopped, kUsage.
Result<LightField> bake_light_field(const BakeTask& bake, std::span<const WalkGrid> floors,
                                    std::function<double()> left, std::uint64_t& rays);

}  // namespace oriel
