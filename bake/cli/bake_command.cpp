#include <cmath>
#include <new>
#include <optional>

#include "bake/cli/cache_options.h"
#include "bake/cli/commands.h"
#include "bake/cli/outcome.h"
#include "bake/cli/requirements.h"
#include "bake/cli/up_to_date.h"
#include "bake/run/option_table.h"
#include "formats/core/file.h"
#include "formats/pack/writer.h"

namespace oriel {
namespace {

constexpr const char* kHelp =
    "Bakes the light of a glTF 2.0 scene into one .oriel pack: radiosity textures with their error, radiance maps\n"
    "with depth behind planar reflectors, BRDF kernels and Fresnel maps. Play it with oriel-play, look into it with "
    "oriel-inspect.";

constexpr const char* kBakeFooter = R"(Examples:
  oriel-bake house.glb -o house.oriel                      sensible defaults: 10 cm texels, 2 % error, reflections
  oriel-bake house.glb -o house.oriel --texel 5cm --error 1%         finer, with half the error
  oriel-bake house.gltf -o house.oriel --atlas uv1 --resolution 512  the artist's own lightmap coordinates
  oriel-bake house.glb -o house.oriel --sky noon.exr --sky-scale 1000 --ies "lamp=downlight.ies"  measured light
  oriel-bake house.glb -o house.oriel --only radiosity     no radiance maps: a small pack without mirror images
  oriel-bake plan house.glb                                what that would do and cost, and what looks wrong

Exit codes: 0 done, 1 usage, 2 a file cannot be read or written, 3 invalid input, 4 failed at run time, 5 other bytes
with verify, 6 the pack is less than what was asked for: the bake ended early, missed an --error or a --time that was named,
left out a stage for want of time (0 with --require nothing), or a part that failed its checks; 7 it misses --require or -W;
130 stopped by the user before there was a first estimate, or by a second interrupt (nothing half-written is left).)";

struct BakeArguments {
  BakeOptions bake = command_line_defaults();
  std::string cache;             // "off": none
  std::filesystem::path report;  // empty: none
  Requirements required;
  std::string keep;  // a pack that misses them: "partial", "none"; empty: partial where none are given
};

// Of the lightmap beside unbiased paths.
std::string brightness_text(const HeldOutError& c) {
  if (std::fabs(c.bias) <= c.bias_interval)
    return fmt::format("as bright on the mean as unbiased paths, to {:.2g} %", 100 * c.bias_interval);
  return fmt::format("on the mean {:.2g} ± {:.2g} % {} than unbiased paths", 100 * std::fabs(c.bias),
                     100 * c.bias_interval, c.bias > 0 ? "brighter" : "darker");
}

std::string light_line(const RadiosityReport& r) {
  std::string line = fmt::format("light: {} texels, stated error {:.2g} %", r.texels, 100 * r.stated());
  if (r.detail.unresolved > 0)
    line +=
        fmt::format(" ({:.2g} % noise, {:.2g} % between texels)", 100 * r.relative_error, 100 * r.detail.unresolved);
  if (const HeldOutError& c = r.held_out_error; c.pixels > 0)
    line += fmt::format("; measured {} on {} held-out pixels, {}", measured_text(c), c.pixels, brightness_text(c));
  return line;
}

std::string ledger_line(const Ledger& l) {
  const auto share = [&](double lm) { return 100 * lm / l.emitted_lm(); };
  return fmt::format(
      "ledger: of {:.4g} lm {:.3g} % are absorbed, {:.3g} % escape, {:.3g} % are lost behind surfaces; off by "
      "{:.2g} % ± {:.2g} %",
      l.emitted_lm(), share(l.absorbed.value), share(l.escaped.value), share(l.lost_behind.value), 100 * l.closure(),
      100 * l.closure_error());
}

// The first few, and matte materials as a number: nothing of them is missing but mirror images that they have not. The
// pack's plan and the report hold them all.
void print_omissions(const std::vector<Warning>& omissions, BakeSession& session) {
  constexpr std::size_t kShown = 8;
  std::vector<std::string> lines;
  std::size_t matte = 0;
  for (const Warning& omission : omissions)
    if (omission.code == "no-image")
      ++matte;
    else
      lines.push_back(omission.text);
  if (matte > 0)
    lines.push_back(
        fmt::format("{} material{} baked and shown, but their reflections without an image: rough, faint or "
                    "shining; --report names them",
                    matte, matte == 1 ? " is" : "s are"));
  for (std::size_t i = 0; i < std::min(kShown, lines.size()); ++i) session.note("left out: " + lines[i]);
  if (lines.size() > kShown)
    session.note(fmt::format("left out: {} more, see oriel-inspect info or --report", lines.size() - kShown));
}

void print_result(const BakeResult& result, BakeSession& session) {
  print_omissions(result.omissions, session);
  session.note(light_line(result.radiosity));
  if (result.ledger.emitted_lm() > 0) session.note(ledger_line(result.ledger));
}

Status write_result(const BakeArguments& args, const BakeResult& result, BakeSession& session) {
  const std::filesystem::path& output = args.bake.output;
  ORIEL_TRY_VOID(write_pack(output, result.pack));
  double seconds = 0;
  for (const StageTime& time : result.times) seconds += time.seconds;
  std::error_code ec;
  const auto size = std::filesystem::file_size(output, ec);
  session.note(fmt::format("wrote {}: {:.1f} MB, baked in {:.1f} s", output.string(),
                           ec ? 0.0 : static_cast<double>(size) * 1e-6, seconds));
  return {};
}

// What its requirements, and how it ended, are to who asks whether it has to be baked again. A texture that was missing
// may be there by then.
void record_verdict(const std::vector<std::string>& met, BakeResult& result) {
  std::vector<std::string> shortfalls = texts_of(result.shortfalls);
  shortfalls.insert(shortfalls.end(), result.left_out.begin(), result.left_out.end());
  for (const Warning& warning : result.warnings)
    if (warning.code == "missing-texture") shortfalls.push_back(warning.text);
  if (met.empty() && shortfalls.empty()) return;
  Json plan = Json::parse(result.pack.plan).value();
  if (!shortfalls.empty()) plan["shortfalls"] = shortfalls;
  if (!met.empty()) plan["met"] = met;
  result.pack.plan = plan.dump(2);
}

// Before anything else: that it will be there is the point of a report.
Status begin_report(const BakeArguments& args) {
  if (args.report.empty()) return {};
  ORIEL_TRY_VOID(check_output(args.report, inputs_of(args.bake.scene, args.bake.import)));
  if (args.report.lexically_normal() == args.bake.output.lexically_normal())
    return fail(ErrorCode::kUsage, args.report.string(), "is the output too: expected another name for the report");
  Outcome stopped;
  stopped.kind = Outcome::Kind::kStopped;
  stopped.exit_code = static_cast<int>(ErrorCode::kStopped);
  stopped.error = {ErrorCode::kStopped, "stopped; nothing was written", "bake"};
  report_hard_stop(args.report, outcome_json(stopped, args.bake.scene, args.bake.output));
  return write_text_atomically(args.report, outcome_json({}, args.bake.scene, args.bake.output));
}

// Where the pack is there already. A report tells more than a pack knows of its bake.
Result<std::optional<BakeResult>> find_made(const BakeArguments& args, const std::vector<std::string>& met,
                                            BakeSession& session) {
  std::error_code ec;
  if (args.cache == "off" || !args.report.empty() || !std::filesystem::exists(args.bake.output, ec))
    return std::nullopt;
  const auto records = read_records(args.bake.output);
  const auto wanted = records ? wanted_provenance(args.bake, session.context) : tl::unexpected(records.error());
  if (!wanted || !is_up_to_date(*records, *wanted, met)) return std::nullopt;
  std::filesystem::last_write_time(args.bake.output, std::filesystem::file_time_type::clock::now(), ec);
  session.note(fmt::format("{} is up to date: nothing is baked (--cache off bakes)", args.bake.output.string()));
  BakeResult result;
  result.pack.provenance = records->provenance.dump();
  result.pack.plan = records->plan.dump();
  return result;
}

Status make_pack(const BakeArguments& args, BakeSession& session, std::optional<BakeResult>& made, bool& written) {
  ORIEL_TRY_VOID(check_output(args.bake.output, inputs_of(args.bake.scene, args.bake.import)));
  std::vector<std::string> met = args.required.given;
  std::erase(met, "nothing");
  met.insert(met.end(), session.errors.begin(), session.errors.end());
  ORIEL_TRY(made, find_made(args, met, session));
  written = made.has_value();
  if (written) return {};
  const auto cache = args.cache == "off" ? nullptr : open_cache(args.cache, args.bake, session.context);
  session.context.units = cache.get();
  ORIEL_TRY(made, bake(args.bake, session.context));
  ORIEL_TRY_VOID(session.judged({}));
  if (cache) print_share(made->units, cache->folder(), session);
  print_result(*made, session);
  Status verdict = judge(args.required, *made, session);
  if (verdict || args.keep == "partial" || (args.keep.empty() && met.empty())) {
    record_verdict(verdict ? met : std::vector<std::string>(), *made);
    ORIEL_TRY_VOID(write_result(args, *made, session));
    written = true;
  }
  if (!verdict)
    return fail(verdict.error().code, args.bake.output.string(), "{} {}",
                written ? "was written, but" : "was not written (--keep partial keeps it): the pack",
                verdict.error().message);
  return {};
}

Outcome::Kind kind_of(const Status& status, bool written, const BakeResult* result) {
  if (!written) return status.error().code == ErrorCode::kStopped ? Outcome::Kind::kStopped : Outcome::Kind::kFailed;
  if (!result->shortfalls.empty() || !result->left_out.empty()) return Outcome::Kind::kPartial;
  return status ? Outcome::Kind::kComplete : Outcome::Kind::kFindings;
}

Status run_bake(const BakeArguments& args, BakeSession& session) {
  ORIEL_TRY(const OutputLock lock, OutputLock::take(args.bake.output));
  stop_on_signals(session.context, args.bake.output, OnStop::kFinish);
  ORIEL_TRY_VOID(begin_report(args));
  Outcome outcome;
  std::optional<WarningLog> log(std::in_place, session.context, outcome.warnings);
  std::optional<BakeResult> made;
  bool written = false;
  Status status;
  try {
    status = session.judged(make_pack(args, session, made, written));
  } catch (const std::bad_alloc&) {
    status = fail(ErrorCode::kRuntime, "", "not enough memory: try {}", session.less_memory);
  } catch (const std::exception& error) {
    status = fail(ErrorCode::kRuntime, "", "{}", error.what());
  }
  log.reset();
  if (args.report.empty()) return status;
  outcome.kind = kind_of(status, written, made ? &*made : nullptr);
  outcome.exit_code = status ? 0 : static_cast<int>(status.error().code);
  if (!status) outcome.error = status.error();
  if (made) outcome.warnings = made->warnings, outcome.result = &*made;
  ORIEL_TRY_VOID(write_text_atomically(args.report, outcome_json(outcome, args.bake.scene, args.bake.output)));
  return status;
}

}  // namespace

ToolCommand bake_command(BakeSession& session) {
  const auto args = std::make_shared<BakeArguments>();
  ToolCommand out{.name = "oriel-bake", .help = kHelp, .footer = kBakeFooter, .options = {}};
  out.options = {scene_argument(args->bake.scene),
                 {"-o,--output", "Run", "The pack to write. It appears whole or not at all",
                  path(args->bake.output, "PACK"), Use::kRequired}};
  append(out.options, bake_options(args->bake));
  append(
      out.options,
      {{"--cache", "Run",
        "Folder of finished units of work: a bake that was killed, or is repeated after a change, computes only what "
        "is not there; off: computes everything, and keeps nothing but the pack. Default: .oriel-cache beside the pack",
        text(args->cache, "DIR|off"), Use::kEveryday, "", "pipelines.md#the-cache"},
       {"--report", "Run",
        "Write how it ended, what was done, omitted and measured, and how long it took, as JSON "
        "(docs/report.schema.json). It is there on failure too",
        path(args->report, "FILE"), Use::kEveryday},
       {"--require", "Run",
        "What the pack must be, or exit code 7, comma-separated: error<=SHARE, light, textures, reflections, sound (no "
        "findings such as an energy ledger that does not close). nothing: exit code 0, too, where it is less than what "
        "was asked for",
        requirements(args->required, session), Use::kRare, "", "pipelines.md#exit-codes"},
       {"--keep", "Run",
        "Whether a pack that misses what was asked for is written. Default: none with --require or -W, else partial",
        one_of(args->keep, {"partial", "none"})}});
  append(out.options, run_options(session));
  out.settle = [args](const Given& given) { return settle(args->bake, given); };
  out.run = [args, &session] { return run_bake(*args, session); };
  return out;
}

}  // namespace oriel
