// The command line of `oriel-bake material`.
#pragma once

#include <CLI/CLI.hpp>

#include "bake/cli/material/material_plot.h"
#include "bake/material/evaluate.h"
#include "formats/core/result.h"

namespace oriel {

struct MaterialArguments {
  bool wanted = false;  // the subcommand was asked for
  bool evaluate = false;
  EvaluateOptions evaluation;
  bool json = false;
  MaterialPlotArguments plot;
  std::vector<double> fit_alphas;  // not empty: print Phong's lobe fitted to Ward's of these widths
};

// Values as typed, until resolve_material() turns them into options.
struct MaterialTexts {
  std::string model = "ggx", metal;
  std::vector<double> eta, k, angles_deg;
  CLI::App *material = nullptr, *eval = nullptr;
};

// Adds the subcommand.
CLI::App* add_material(CLI::App& app, MaterialTexts& texts, MaterialArguments& args);
// Error kUsage.
Status resolve_material(const MaterialTexts& texts, MaterialArguments& args);
// Prints to stdout. Error kIo.
Status run_material(const MaterialArguments& args);

}  // namespace oriel
