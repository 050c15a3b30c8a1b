// `oriel-bake material --list | --plot NAME -o DIR`.
#pragma once

#include <filesystem>
#include <string>

#include "bake/material/plot.h"
#include "formats/cli/option.h"

namespace oriel {

struct MaterialPlotArguments {
  bool list = false;
  std::string plot;  // a name; empty: none
  std::filesystem::path folder;
  float alpha = 0.1f;
  FacetModel model = FacetModel::kGgx;
  bool pictures = true;
};

std::vector<Option> plot_options(MaterialPlotArguments& args);
// To stdout, or into the folder. Errors kUsage for an unknown name, kIo, kRuntime without gnuplot: the tables are there
// then.
Status run_material_plot(const MaterialPlotArguments& args);

}  // namespace oriel
