// What a pack says of itself, as JSON.
#pragma once

#include "bake/radiosity/lit_sides.h"
#include "bake/run/movers.h"
#include "bake/run/pipeline.h"
#include "bake/run/reflections.h"
#include "bake/run/start.h"
#include "bake/run/visibility.h"

namespace oriel {

// Facts of one bake that the plan tells of. Nothing here depends on the clock or the number of threads.
struct BakeFacts {
  const Scene& scene;
  const Atlas& atlas;
  const SidesReport& sides;
  const RadiosityReport& radiosity;
  const Ledger& ledger;
  const Pack& pack;
  const std::vector<Warning>& omissions;
  DVec3 emitted_lm{0};
  const ReflectionReport& reflections;
  std::span<const MoverReport> movers;
  const VisibilityReport& visibility;
  bool cached = true;  // the estimator
  double asked = 0;    // error of the lightmap; 0: none
  Start start = Start::kOfScene;
  const std::vector<Warning>& findings;
  const std::vector<Warning>& warnings;
};

std::string plan_json(const BakeFacts& facts);

std::string provenance_json(const BakeOptions& options, std::uint64_t seed,
                            const std::vector<std::pair<std::string, std::string>>& inputs);

}  // namespace oriel
