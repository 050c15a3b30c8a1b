// Reflectors, the eyes they are planned for, and what their maps show.
#pragma once

#include "bake/radiance/curved/curved_reflectors.h"
#include "bake/radiance/plan/samples.h"
#include "bake/run/assemble.h"
#include "bake/run/options.h"
#include "bake/run/stages/baked_light.h"
#include "formats/pack/pack.h"

namespace oriel {

// What shines, and who sees it.
struct FoundReflections {
  EyeRegion region;
  std::vector<Vec3> eyes;                // that maps are planned for, scene space
  std::vector<ReflectorMaterial> lobes;  // by material
  FoundReflectors found;                 // planar ones that eyes see, most important first, and what is not planar
  FoundCurvedReflectors curved;          // without texels
  std::vector<std::string> omissions;    // what was left out, and why
  bool empty() const { return found.reflectors.empty() && curved.reflectors.empty(); }
};

// Finds the eye region and the reflectors of a scene. Traces no ray for reflectors where no material may be one. Error
// kStopped.
Result<FoundReflections> find_reflections(const BakeOptions& options, const Accel& accel,
                                          std::span<const MaterialSummary> materials, Context& context);

struct ReflectionReport {
  std::vector<ViewQuality> quality;    // by reflector: what its maps show to eyes that were not planned for
  std::vector<std::string> omissions;  // what was not modelled, and why
  std::uint64_t rays = 0;              // of capture
};

// Finds the eye region and the reflectors, plans and captures their maps, all into the pack, whose lightmaps are there.
// Nothing is planned or traced where there is no reflector or no light. Error kStopped; the pack is then as it was but
// for its emitters.
Result<ReflectionReport> bake_reflections(const BakeOptions& options, const BakedScene& baked,
                                          const MaterialMaps& materials, const AssembledMesh& mesh, Context& context,
                                          Pack& pack);

}  // namespace oriel
