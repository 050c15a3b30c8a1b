#include "bake/cli/plan/plan_arguments.h"
#include "bake/plan/plan.h"
#include "formats/core/file.h"

namespace oriel {
namespace {

constexpr const char* kFooter = R"(Examples:
  oriel-bake plan house.glb                        what a bake would do, what it would cost, what looks wrong
  oriel-bake plan house.glb --no-pilot --strict    the scene's check for a pipeline: exit code 5 with any finding
  oriel-bake plan house.glb --error 1% --time 5min --json plan.json    can that be had together?

Every option of the bake is taken, and --error and --time together.)";

}  // namespace

CLI::App* add_plan(CLI::App& app, std::filesystem::path& scene, PlanArguments& args) {
  CLI::App* plan = app.add_subcommand(
      "plan", "Tells what a bake would model, leave out and why, what it would cost, and what is wrong with the scene");
  plan->footer(kFooter);
  plan->add_option("SCENE", scene, "The scene: .glb, or .gltf with its buffers and textures")->required();
  plan->add_option("--json", args.json, "Write the plan as JSON (docs/plan.md); - is stdout, instead of the text")
      ->type_name("FILE|-");
  plan->add_flag("!--no-pilot", args.pilot, "Predict nothing: no small bakes, an answer in seconds");
  plan->add_flag("--strict", args.strict, "Exit code 5 where there is any finding");
  return plan;
}

Status run_plan(const PlanArguments& args, const BakeOptions& bake, Context& context) {
  ORIEL_TRY(const ScenePlan plan, make_plan(bake, args.pilot, context));
  const bool to_stdout = args.json == "-";
  ORIEL_TRY_VOID(print(to_stdout ? plan_as_json(plan) : plan_text(plan)));
  if (!args.json.empty() && !to_stdout) {
    const std::string json = plan_as_json(plan);
    ORIEL_TRY_VOID(write_file_atomically(args.json, std::as_bytes(std::span(json))));
  }
  if (args.strict && !plan.findings.empty())
    return fail(ErrorCode::kDifferent, plan.scene, "found {} finding{}, expected none (--strict)", plan.findings.size(),
                plan.findings.size() == 1 ? "" : "s");
  return {};
}

}  // namespace oriel
