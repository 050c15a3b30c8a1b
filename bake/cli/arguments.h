// The command line of oriel-bake.
#pragma once

#include "bake/cli/farm/farm_arguments.h"
#include "bake/cli/material/material_arguments.h"
#include "bake/cli/plan/plan_arguments.h"
#include "bake/cli/progress.h"
#include "bake/cli/trade/trade_arguments.h"
#include "bake/reference/reference.h"
#include "bake/run/measure.h"
#include "bake/run/options.h"
#include "formats/motion/mover_pose.h"

namespace oriel {

struct RenderArguments {
  bool wanted = false;  // the subcommand was asked for
  std::filesystem::path scene, output;
  std::string camera;  // as written; empty: the scene's first
  std::vector<MoverMove> moves;
  ImportOptions import;
  ReferenceOptions frame{.width = 1280, .height = 720, .samples = 256};
  bool reproducible = false;  // the same pixels on every CPU type
};

struct Arguments {
  BakeOptions bake;
  bool wants_lux = false;  // the subcommand: measure `lux` instead of baking `bake`
  MeasureJob lux;
  std::filesystem::path lux_output;  // empty: stdout
  RenderArguments render;            // the subcommand `render` instead, where wanted
  MaterialArguments material;        // the subcommand `material` instead, where wanted
  PlanArguments plan;                // the subcommand `plan` of `bake` instead, where wanted
  TradeArguments trade;              // the subcommand `trade` instead, where wanted
  CacheArguments cache;              // of the bake and of workers
  bool works = false;                // the subcommand `worker` of `bake` instead: no pack is written
  VerifyArguments verify;            // the subcommand `verify` of `bake` instead, where wanted; bake.output is read
  SubmitArguments submit;            // the subcommand `submit` instead, where wanted
  PruneArguments prune;              // the subcommand `cache` instead, where wanted
  int threads = 0;
  std::uint64_t seed = 1;
  ProgressPrinter::Style style = ProgressPrinter::Style::kPlain;
  std::filesystem::path report;  // empty: none
  bool strict = false;           // findings of a bake are an exit code
  int exit_code = -1;            // >= 0: end at once with it (--help, --version, a usage error already printed)
};

Arguments parse_arguments(int argc, char** argv);

}  // namespace oriel
