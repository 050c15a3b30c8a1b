// How a bake ended, for programs: the file of --report, which is there whatever happens.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bake/run/pipeline.h"

namespace oriel {

struct Outcome {
  enum class Kind {
    kRunning,   // it has not ended: a report that stays so belongs to a bake that was killed
    kComplete,  // all that was asked for
    kPartial,   // a pack is written that is less (BakeResult::shortfalls, ::left_out)
    kFindings,  // the pack is written, but misses --require
    kFailed,    // no pack
    kStopped,   // by the user: no pack
  };
  Kind kind = Kind::kRunning;
  int exit_code = -1;  // -1: not known yet
  Error error{};       // of kFailed and kStopped
  std::vector<Warning> warnings;
  const BakeResult* result = nullptr;  // where there is one
};
const char* name_of(Outcome::Kind kind);

// docs/report.schema.json describes it.
std::string outcome_json(const Outcome& outcome, const std::filesystem::path& scene, const std::filesystem::path& pack);

}  // namespace oriel
