#include <algorithm>

#include "bake/cli/cache_options.h"
#include "bake/cli/commands.h"
#include "bake/plan/plan.h"
#include "bake/run/option_table.h"
#include "formats/core/file.h"

namespace oriel {
namespace {

constexpr const char* kPlanFooter = R"(Examples:
  oriel-bake plan house.glb                        what a bake would do, what it would cost, what looks wrong
  oriel-bake plan house.glb --no-pilot --strict    the scene's check for a pipeline: exit code 5 with any finding
  oriel-bake plan house.glb --error 1% --time 5min --json plan.json    can that be had together?

Every option of the bake is taken, and --error and --time together.)";

struct PlanArguments {
  BakeOptions bake = command_line_defaults();
  std::filesystem::path json;  // "-": stdout instead of text; empty: none
  bool pilot = true;           // predict
  bool strict = false;         // findings fail
  std::vector<AllowedFinding> allowed;
  std::filesystem::path cache;
};

// The folder of finished units where there is one: sides of surfaces are told once, for plans and bakes.
std::unique_ptr<UnitCache> plan_cache(const PlanArguments& args, const Context& context) {
  std::error_code ec;
  if (args.cache.empty() && !std::filesystem::is_directory(kDefaultCache, ec)) return nullptr;
  return open_cache(args.cache, args.bake, context);
}

OptionValue allowed(std::vector<AllowedFinding>& list) {
  OptionValue out{"LIST|@FILE",
                  [&list](const std::string& typed) -> Status {
                    ORIEL_TRY(const auto more, parse_allowed(typed));
                    list.insert(list.end(), more.begin(), more.end());
                    return {};
                  },
                  [] { return std::string(); }};
  out.repeats = true;
  return out;
}

Status run_plan(const PlanArguments& args, BakeSession& session) {
  const bool to_stdout = args.json == "-";
  if (!args.json.empty() && !to_stdout)
    ORIEL_TRY_VOID(check_output(args.json, inputs_of(args.bake.scene, args.bake.import)));
  const auto cache = plan_cache(args, session.context);
  session.context.units = cache.get();
  ORIEL_TRY(ScenePlan plan, make_plan(args.bake, args.pilot, session.context));
  plan.allowed = args.allowed;
  ORIEL_TRY_VOID(print(to_stdout ? plan_as_json(plan) : plan_text(plan)));
  if (!args.json.empty() && !to_stdout) {
    const std::string json = plan_as_json(plan);
    ORIEL_TRY_VOID(write_text_atomically(args.json, json));
  }
  const auto taken = std::count_if(plan.findings.begin(), plan.findings.end(),
                                   [&](const Finding& f) { return is_allowed(f, plan.allowed); });
  const auto left = static_cast<std::ptrdiff_t>(plan.findings.size()) - taken;
  if (args.strict && left > 0)
    return fail(ErrorCode::kDifferent, plan.scene,
                "found {} finding{} that --allow does not name, expected none (--strict)", left, left == 1 ? "" : "s");
  return {};
}

}  // namespace

ToolCommand plan_command(BakeSession& session) {
  const auto args = std::make_shared<PlanArguments>();
  ToolCommand out{
      .name = "plan",
      .help = "Tells what a bake would model, leave out and why, what it would cost, and what is wrong with the scene",
      .footer = kPlanFooter,
      .options = {
          scene_argument(args->bake.scene),
          {"--json", "Run", "Write the plan as JSON (docs/notes/plan.md); - is stdout, instead of the text",
           path(args->json, "FILE|-"), Use::kEveryday},
          {"--no-pilot", "Run", "Predict nothing: no small bakes, an answer in seconds", flag(args->pilot, false),
           Use::kEveryday},
          {"--strict", "Run", "Exit code 5 where there is any finding that --allow does not name", flag(args->strict),
           Use::kEveryday},
          {"--allow", "Run",
           "Findings that are known and taken: kinds, or kinds with objects, as \"albedo,one-sided "
           "wall:Curtain*\", or @FILE with one a line. May be repeated",
           allowed(args->allowed), Use::kEveryday},
          {"--cache", "Run",
           "Folder of finished units of work, for plans and bakes. Default: .oriel-cache in this folder, if there "
           "is one",
           path(args->cache, "DIR"), Use::kRare, "", "cache.md"}}};
  append(out.options, bake_options(args->bake));
  append(out.options, run_options(session));
  out.settle = [args](const Given& given) { return settle(args->bake, given); };
  out.run = [args, &session] { return run_plan(*args, session); };
  return out;
}

}  // namespace oriel
