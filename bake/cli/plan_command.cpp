#include "bake/cli/commands.h"
#include "bake/plan/plan.h"
#include "bake/run/option_table.h"
#include "formats/core/file.h"

namespace oriel {
namespace {

constexpr const char* kFooter = R"(Examples:
  oriel-bake plan house.glb                        what a bake would do, what it would cost, what looks wrong
  oriel-bake plan house.glb --no-pilot --strict    the scene's check for a pipeline: exit code 5 with any finding
  oriel-bake plan house.glb --error 1% --time 5min --json plan.json    can that be had together?

Every option of the bake is taken, and --error and --time together.)";

struct PlanArguments {
  BakeOptions bake = command_line_defaults();
  std::filesystem::path json;  // "-": stdout instead of text; empty: none
  bool pilot = true;           // predict
  bool strict = false;         // findings fail
};

Status run_plan(const PlanArguments& args, BakeSession& session) {
  const bool to_stdout = args.json == "-";
  if (!args.json.empty() && !to_stdout)
    ORIEL_TRY_VOID(check_output(args.json, inputs_of(args.bake.scene, args.bake.import)));
  ORIEL_TRY(const ScenePlan plan, make_plan(args.bake, args.pilot, session.context));
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

}  // namespace

ToolCommand plan_command(BakeSession& session) {
  const auto args = std::make_shared<PlanArguments>();
  ToolCommand out{
      .name = "plan",
      .help = "Tells what a bake would model, leave out and why, what it would cost, and what is wrong with the scene",
      .footer = kFooter,
      .options = {scene_argument(args->bake.scene),
                  {"--json", "Run", "Write the plan as JSON (docs/plan.md); - is stdout, instead of the text",
                   path(args->json, "FILE|-"), Use::kEveryday},
                  {"--no-pilot", "Run", "Predict nothing: no small bakes, an answer in seconds",
                   flag(args->pilot, false), Use::kEveryday},
                  {"--strict", "Run", "Exit code 5 where there is any finding", flag(args->strict), Use::kEveryday}}};
  append(out.options, bake_options(args->bake));
  append(out.options, run_options(session));
  out.settle = [args](const Given& given) { return settle(args->bake, given); };
  out.run = [args, &session] { return run_plan(*args, session); };
  return out;
}

}  // namespace oriel
