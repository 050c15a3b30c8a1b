// K and R of a material as tables and as a gnuplot script (after Bastos et al. 1999, figure 6).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bake/material/reflectance.h"
#include "bake/material/slices.h"

namespace oriel {

// A smooth or rough surface of one substance in air.
struct NamedMaterial {
  std::string name;
  std::string index;  // n + ik, for people
  SpecularLobe lobe;  // alpha 0
};
// The measured metals, and a few dielectrics.
std::vector<NamedMaterial> named_materials();
// One of them by name, or a metal by its symbol, in any case: "gold", "Au".
std::optional<NamedMaterial> material_by_name(std::string_view name);

struct PlotFile {
  std::string name, text;
};

// NAME_reflectance.csv: R by angle; NAME_incidence.csv and NAME_radial.csv: where K's lobe lies and how it spreads, by
// incidence; NAME_lobe_ANGLE.csv: the lobe around the mirror direction, relative to its peak; NAME.gp, last: the script
// that draws NAME_reflectance.png and NAME_kernel.png of them. material.lobe.alpha: [1e-4, 1].
std::vector<PlotFile> plot_files(const NamedMaterial& material, FacetModel model);

}  // namespace oriel
