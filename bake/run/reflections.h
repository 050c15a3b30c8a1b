// Reflectors, the eyes they are planned for, and what their maps show.
#pragma once

#include "bake/radiance/curved_reflectors.h"
#include "bake/radiance/samples.h"
#include "bake/run/assemble.h"
#include "bake/run/judge.h"
#include "bake/run/task.h"

namespace oriel {

// What shines, and who sees it.
struct FoundReflections {
  EyeRegion region;
  std::vector<Vec3> eyes;                // that maps are planned for, scene space
  std::vector<ReflectorMaterial> lobes;  // by material
  FoundReflectors found;                 // planar ones that eyes see, most important first, and what is not planar
  FoundCurvedReflectors curved;          // without texels
  std::vector<Warning> omissions;        // what was left out, and why
  bool empty() const { return found.reflectors.empty() && curved.reflectors.empty(); }
};

// Finds the reflectors of a scene that eyes of its region see, once its lightmap is laid out. Traces no ray where no
// material may be one. Error kStopped.
Result<FoundReflections> find_reflections(const BakeOptions& options, const PreparedScene& prepared,
                                          std::span<const MaterialSummary> materials, double seconds, Context& context);

// By triangle: the surfaces whose lobes are traced where maps see them. No ray is mirrored by curved things, and those
// of surround maps by nothing: there planar ones are among them.
std::vector<bool> curved_triangles(const Scene& scene, const FoundReflections& all);
std::vector<bool> shiny_triangles(const Scene& scene, const FoundReflections& all);

struct ReflectionReport {
  std::vector<ViewQuality> quality;    // by reflector: what its maps show to eyes that were not planned for
  std::vector<ReflectedError> errors;  // by reflector: and how right that is
  std::vector<std::string> ways;       // by reflector: why it is drawn as it is
  std::vector<Warning> omissions;      // what was not modelled, and why
  std::uint64_t rays = 0;              // of capture and judging
};

// Reflections before there is light: what needs none of it.
struct PlannedReflections {
  FoundReflections all;
  ViewPlan plan;                   // of the planar reflectors; without pixels
  double seconds = 0;              // that planning takes where nothing of it is known already
  std::uint32_t divisor = 1;       // of its samples
  double capture_s = 0;            // that the rest is likely to take; 0 unless asked for
  double surround_s = 0;           // of these, surround maps
  double planar_pixels() const;    // of all maps of planar reflectors
  double surround_pixels() const;  // of those of curved ones
  bool has_images() const { return !plan.maps.empty() || !all.curved.reflectors.empty(); }
  bool empty() const { return all.empty(); }
};

// Plans the maps of reflectors that have maps. Nothing is planned where there is no reflector or no
// light. Planning is first tried with a 16th of its samples, which stay where all of them would take longer than
// `seconds`; infinite: all at once. Error kStopped.
Result<PlannedReflections> plan_reflections(const BakeTask& bake, FoundReflections found, double seconds);

// As a pack holds them.
struct BakedReflections {
  std::vector<Reflector> reflectors;
  std::vector<RadianceMap> radiance_maps;
  std::vector<MapMesh> map_meshes;
  std::vector<Emitter> emitters;
  std::vector<CurvedReflector> curved_reflectors;
  std::vector<SurroundMap> surround_maps;
  ReflectionReport report;
};

// Captures the planned maps, in the light of the lightmaps, and judges them. Error kStopped.
Result<BakedReflections> bake_reflections(const BakeTask& bake, PlannedReflections planned,
                                          const MaterialMaps& materials, const AssembledMesh& mesh);

// In place of that where there is no time for images: planar reflectors are drawn as mirrored geometry, which needs
// none. Curved ones show their light as if their lobes were wide. why: for people.
BakedReflections mirror_geometry(PlannedReflections planned, const AssembledMesh& mesh, const Warning& why);

}  // namespace oriel
