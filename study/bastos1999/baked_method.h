// What the paper computes before frames: the radiosity solution, and of each planar reflector radiance maps from a
// hemisphere behind it, a kernel K and a sphere map of R (Bastos et al. 1999, section 8).
#pragma once

#include "bake/run/options.h"
#include "formats/pack/pack.h"
#include "player/images/map_choice.h"
#include "study/bastos1999/lobes.h"

namespace oriel::study {

// Which R the sphere maps hold: the paper's, or the directional albedo that the product's tables hold.
enum class SphereOf { kEquation4, kAlbedo };

struct MethodOptions {
  std::uint32_t views = 64, map_side = 128;  // of an element; pixels: four of the paper's five reflectors
  Facets facets = Facets::kBeckmann;
  SphereOf sphere_of = SphereOf::kEquation4;
  std::uint32_t sphere_side = 64;
  std::uint64_t memory_bytes = std::uint64_t{128} << 20;  // of all maps, kMapBytesPerPixel each
};

struct BakedReflector {
  std::vector<ReflectorElement> elements;  // with their maps
  float mean_distance = 0;                 // from the plane to what its maps show, metres; the sky does not count
  BrdfKernel kernel;                       // at one incidence; size 1: a mirror
  SphereMap sphere;
};

struct BakedMethod {
  Pack pack;                               // whose reflectors have no maps, and none of which is curved
  std::vector<BakedReflector> reflectors;  // by Pack::reflectors
  std::vector<RadianceMap> maps;           // of the radiosity solution: lobes as if wide, lamps, no mirrors in mirrors
  std::vector<std::string> omitted;        // what was reduced or left out and why, one line each
};

// Maps of the elements that the reflectors cover, in order, without pixels; their elements and maps are set. Fewer
// views of all where the memory asks for it. Viewpoints whose mirror image is outside the scene are left out.
std::vector<RadianceMap> plan_hemispheres(const Scene& scene, std::vector<FoundReflector>& reflectors,
                                          const MethodOptions& options, std::vector<std::string>& omitted);

// bake: settled, of a scene file. Errors of a bake.
Result<BakedMethod> bake_method(BakeOptions bake, const MethodOptions& options);

}  // namespace oriel::study
