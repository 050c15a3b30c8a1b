// The composition root: the only place that wires stages together.
#pragma once

#include <map>

#include "bake/jobs/units.h"
#include "bake/radiosity/ledger.h"
#include "bake/run/options.h"
#include "bake/run/stopwatch.h"
#include "formats/pack/pack.h"

namespace oriel {

inline constexpr ErrorCode kIncomplete{6};  // the exit code of a pack that is less than what was asked for

struct BakeResult {
  // In report.cpp, so that not every file compiles them.
  BakeResult();
  ~BakeResult();
  BakeResult(const BakeResult&);
  BakeResult(BakeResult&&) noexcept;
  BakeResult& operator=(const BakeResult&);
  BakeResult& operator=(BakeResult&&) noexcept;

  Pack pack;
  std::vector<StageTime> times;  // wall clock; not in the pack, whose bytes depend on input and options only
  RadiosityReport radiosity;
  Ledger ledger;
  UnitShare units;                 // not in the pack either: empty without a store of units
  std::vector<Warning> omissions;  // what was not modelled, and why
  std::vector<Warning> findings;   // what is likely wrong with the light, each with its size; warned of
  std::vector<Warning> warnings;   // all others that were told meanwhile
  // Why it is less than what was asked for: it ended early, missed an error or a time that was named, or left a stage
  // out for want of time. A bake that ends by its default share of rays has none.
  std::vector<Warning> shortfalls;
  // By name of a surface or mesh: the glTF node path of the first that is called so.
  std::map<std::string, std::string> node_paths;
  std::vector<std::string> left_out;  // what failed the pack's own checks and is not in it; among the omissions too
};

// Scene file → pack in memory. Errors as the stages give them; kStopped when context.stop was set.
Result<BakeResult> bake(const BakeOptions& options, Context& context);

// The bake as JSON for people's dashboards: the pack's plan and provenance, and the times that it does not hold.
std::string report_json(const BakeResult& result);

}  // namespace oriel
