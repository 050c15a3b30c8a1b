// Sweeps methods and knobs on one scene, and measures what each costs and errs (docs/trade.md). Everything is done by
// the programs that users have, as processes of their own, so that figures are those that users get.
#pragma once

#include "trade/configurations.h"
#include "trade/units.h"

namespace oriel::trade {

struct TradeOptions {
  std::filesystem::path scene, output;  // output: a folder, made where it is missing
  std::filesystem::path programs;       // the folder of oriel-bake and oriel-play
  bool quick = false;
  double time_s = 0;                   // nothing is started after so long; 0: no limit
  double texel_m = 0;                  // of the default; 0: fitting_texel_m()
  std::vector<std::string> cameras;    // whose frames are judged; empty: chosen by survey()
  std::vector<std::string> forwarded;  // options of every bake and reference frame: light, threads, …
  std::uint64_t seed = 1;              // of the bakes; references take others
};

struct Row {
  Configuration configuration;
  Measures measures;
  std::string failure;                          // why it has none, or not all; else empty
  std::vector<std::filesystem::path> pictures;  // by camera: reference, frame, FLIP side by side
  std::vector<std::string> fronts;              // ids of front_kinds() that it is on
};

struct Trade {
  std::string scene;
  SceneFacts facts;
  TradePlan plan;             // its configurations are those of the rows
  std::vector<Row> rows;      // in the plan's order; those that nothing is known of yet are left out
  int width = 0, height = 0;  // of the frames that are timed
  bool frames = true;         // false: oriel-play is missing or cannot draw here
  std::size_t started = 0, reused = 0, left = 0;  // units of work: run now, found finished, not finished
};

// note: progress, a line each. Errors: kIo; kUsage for a camera that is not there; those of the bake where not even the
// references can be made; kStopped where the user stopped before anything could be told of the scene. After a later
// stop the rows that are finished come back, with left > 0.
Result<Trade> sweep(const TradeOptions& options, Context& context, const Units::Note& note);

}  // namespace oriel::trade
