// The command line of `oriel-bake plan`: the bake's own options, and what becomes of the plan.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "bake/jobs/context.h"
#include "bake/run/options.h"

namespace oriel {

struct PlanArguments {
  bool wanted = false;         // the subcommand was asked for
  std::filesystem::path json;  // "-": stdout instead of text; empty: none
  bool pilot = true;           // predict
  bool strict = false;         // findings fail
};

// Adds the subcommand without the bake's options, which the caller adds to it.
CLI::App* add_plan(CLI::App& app, std::filesystem::path& scene, PlanArguments& args);

// Plans and prints. Errors: as make_plan; kDifferent where findings are to fail; kIo.
Status run_plan(const PlanArguments& args, const BakeOptions& bake, Context& context);

}  // namespace oriel
