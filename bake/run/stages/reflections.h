// Reflectors, the eyes they are planned for, and what their maps show.
#pragma once

#include "bake/radiance/plan/samples.h"
#include "bake/run/assemble.h"
#include "bake/run/options.h"
#include "formats/pack/pack.h"

namespace oriel {

struct ReflectionReport {
  std::vector<ViewQuality> quality;    // by reflector: what its maps show to eyes that were not planned for
  std::vector<std::string> omissions;  // what was not modelled, and why
  std::uint64_t rays = 0;              // of capture
};

// Finds the eye region and the reflectors, plans and captures their maps, all into the pack, whose lightmaps are there.
// Error kStopped.
Result<ReflectionReport> bake_reflections(const BakeOptions& options, const Accel& accel, const Atlas& atlas,
                                          const MaterialMaps& materials, const AssembledMesh& mesh, Context& context,
                                          Pack& pack);

}  // namespace oriel
