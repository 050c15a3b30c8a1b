// What the reader makes of sections before they are one pack.
#pragma once

#include "formats/pack/index.h"
#include "formats/pack/sections.h"

namespace oriel {

// A pack, and what waits for the sections that it belongs to. Sections of one element have their place from the start,
// so that all sections can be decoded side by side.
struct PackParts {
  explicit PackParts(const PackIndex& index);

  Pack pack;
  std::vector<DirectionPage> directions;
  std::vector<NormalMapping> normal_mapping;
  std::vector<KernelSlices> kernel_slices;
  std::vector<KernelFits> kernel_fits;
  std::vector<FresnelFactor> fresnel_factors;
  std::vector<ResidualMap> residuals;
  std::vector<ReflectorEmitters> reflector_emitters;
};

// Puts them where they belong. Error kInvalid names the section.
Status attach(PackParts& parts);

}  // namespace oriel
