// `oriel-bake material --list | --plot NAME -o DIR`.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "bake/material/plot.h"
#include "formats/core/result.h"

namespace oriel {

struct MaterialPlotArguments {
  bool list = false;
  std::string plot;  // a name; empty: none
  std::filesystem::path folder;
  float alpha = 0.1f;
  KernelModel model = KernelModel::kGgx;
  bool pictures = true;
  bool wanted() const { return list || !plot.empty(); }
};

void add_material_plot(CLI::App& material, MaterialPlotArguments& args);
// What is contradictory. Error kUsage.
Status check_material_plot(const MaterialPlotArguments& args);
// To stdout, or into the folder. Errors kUsage for an unknown name, kIo, kRuntime without gnuplot: the tables are there
// then.
Status run_material_plot(const MaterialPlotArguments& args);

}  // namespace oriel
