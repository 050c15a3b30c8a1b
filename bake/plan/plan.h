// `oriel-bake plan`: what a bake of a scene would model, what it would leave out and why, what is likely wrong with the
// scene, and what the bake would cost (docs/notes/plan.md).
#pragma once

#include "bake/plan/census.h"
#include "bake/plan/doctor.h"
#include "bake/plan/predict.h"

namespace oriel {

struct ScenePlan {
  std::string scene;  // the file
  Census census;
  std::vector<Finding> findings;         // by kind
  std::vector<AllowedFinding> allowed;   // of them, by the user
  std::optional<Prediction> prediction;  // where a pilot was asked for
};

// Runs what a bake begins with (import to lightmap layout, materials, reflectors), looks around from where people walk,
// and where `with_pilot` is set runs small bakes to predict the whole. The scene's coordinates that --atlas uv1 cannot
// take are a finding; automatic ones stand in. Errors as the stages give them.
Result<ScenePlan> make_plan(const BakeOptions& options, bool with_pilot, Context& context);

// For people, and for programs: docs/notes/plan.md lists the fields.
std::string plan_text(const ScenePlan& plan);
std::string plan_as_json(const ScenePlan& plan);

}  // namespace oriel
