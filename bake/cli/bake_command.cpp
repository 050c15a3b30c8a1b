#include "bake/cli/cache_options.h"
#include "bake/cli/commands.h"
#include "bake/run/option_table.h"
#include "formats/core/file.h"
#include "formats/pack/writer.h"

namespace oriel {
namespace {

constexpr const char* kHelp =
    "Bakes the light of a glTF 2.0 scene into one .oriel pack: radiosity textures with their error, radiance maps\n"
    "with depth behind planar reflectors, BRDF kernels and Fresnel maps. Play it with oriel-play, look into it with "
    "oriel-inspect.";

constexpr const char* kFooter = R"(Examples:
  oriel-bake house.glb -o house.oriel                      sensible defaults: 10 cm texels, 2 % error, reflections
  oriel-bake house.glb -o house.oriel --texel 5cm --error 1%         finer, with half the error
  oriel-bake house.gltf -o house.oriel --atlas uv1 --resolution 512  the artist's own lightmap coordinates
  oriel-bake house.glb -o house.oriel --sky noon.exr --sky-scale 1000 --ies "lamp=downlight.ies"  measured light
  oriel-bake house.glb -o house.oriel --only radiosity     no radiance maps: a small pack without mirror images
  oriel-bake plan house.glb                                what that would do and cost, and what looks wrong

Exit codes: 0 done (after one interrupt with what was there), 1 usage, 2 a file cannot be read or written, 3 invalid input,
4 failed at run time, 5 findings with --strict or other bytes with verify, 6 the pack was written without a part that failed its checks,
130 stopped by the user before there was a first estimate, or by a
second interrupt (nothing half-written is left).)";

struct BakeArguments {
  BakeOptions bake = command_line_defaults();
  std::filesystem::path cache;
  bool no_cache = false;
  std::filesystem::path report;  // empty: none
  bool strict = false;           // findings are an exit code
};

std::string light_line(const RadiosityReport& r) {
  std::string line = fmt::format("light: {} texels, stated error {:.2g} %", r.texels, 100 * r.relative_error);
  if (const Certificate& c = r.certificate; c.pixels > 0)
    line += fmt::format(
        "; measured {:.2g} % ({:.2g} to {:.2g} %) on {} held-out pixels, which are {:+.2g} % ± {:.2g} % brighter",
        100 * c.relative_error, 100 * c.error_low, 100 * c.error_high, c.pixels, 100 * c.bias, 100 * c.bias_interval);
  if (r.reuse.asked > 0)
    line += fmt::format("; {} of {} tiles keep the light of the bake before, with {:.2g} % of error in all of it",
                        r.reuse.kept, r.reuse.tiles, 100 * r.reuse.error);
  if (r.refinements > 0) line += fmt::format("; refined {} times after that", r.refinements);
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

// The first few; the pack's plan and the report hold them all.
void print_omissions(const std::vector<std::string>& omissions, BakeSession& session) {
  constexpr std::size_t kShown = 8;
  for (std::size_t i = 0; i < std::min(kShown, omissions.size()); ++i) session.note("omitted: " + omissions[i]);
  if (omissions.size() > kShown)
    session.note(fmt::format("omitted: {} more, see oriel-inspect info or --report", omissions.size() - kShown));
}

void print_result(const BakeResult& result, BakeSession& session) {
  if (result.radiosity.ended_early || session.context.finish)
    session.note("ended early: the pack holds what was there, with the error that is stated");
  print_omissions(result.omissions, session);
  session.note(light_line(result.radiosity));
  if (const MapReuse& reuse = result.map_reuse; reuse.kept > 0)
    session.note(fmt::format(
        "radiance maps: {} of {} bands keep the pixels of the bake before, with {:.2g} % of error in all of them",
        reuse.kept, reuse.bands, 100 * reuse.error));
  if (result.ledger.emitted_lm() > 0) session.note(ledger_line(result.ledger));
}

Status write_result(const BakeArguments& args, const BakeResult& result, BakeSession& session) {
  const std::filesystem::path& output = args.bake.output;
  ORIEL_TRY_VOID(write_pack(output, result.pack));
  if (!args.report.empty()) {
    const std::string report = report_json(result);
    ORIEL_TRY_VOID(write_file_atomically(args.report, std::as_bytes(std::span(report))));
  }
  double seconds = 0;
  for (const StageTime& time : result.times) seconds += time.seconds;
  std::error_code ec;
  const auto size = std::filesystem::file_size(output, ec);
  session.note(fmt::format("wrote {}: {:.1f} MB, baked in {:.1f} s", output.string(),
                           ec ? 0.0 : static_cast<double>(size) * 1e-6, seconds));
  if (!result.left_out.empty()) return fail(kIncomplete, output.string(), "was written without {}", result.left_out[0]);
  if (args.strict && !result.findings.empty())
    return fail(ErrorCode::kDifferent, output.string(), "was written; --strict: {}", result.findings[0]);
  return {};
}

Status run_bake(const BakeArguments& args, BakeSession& session) {
  stop_on_signals(session.context, args.bake.output, OnStop::kFinish);
  const auto inputs = inputs_of(args.bake.scene, args.bake.import);
  ORIEL_TRY_VOID(check_output(args.bake.output, inputs));
  if (!args.report.empty()) {
    ORIEL_TRY_VOID(check_output(args.report, inputs));
    if (args.report.lexically_normal() == args.bake.output.lexically_normal())
      return fail(ErrorCode::kUsage, args.report.string(), "is the output too: expected another name for the report");
  }
  const auto cache = args.no_cache ? nullptr : open_cache(args.cache, args.bake, session.context);
  session.context.units = cache.get();
  ORIEL_TRY(const BakeResult result, bake(args.bake, session.context));
  if (cache) print_share(result.units, cache->folder(), session);
  print_result(result, session);
  return write_result(args, result, session);
}

}  // namespace

ToolCommand bake_command(BakeSession& session) {
  const auto args = std::make_shared<BakeArguments>();
  ToolCommand out{.name = "oriel-bake", .help = kHelp, .footer = kFooter, .options = {}};
  out.options = {scene_argument(args->bake.scene),
                 {"-o,--output", "Run", "The pack to write. It appears whole or not at all",
                  path(args->bake.output, "PACK"), Use::kRequired}};
  append(out.options, bake_options(args->bake));
  append(
      out.options,
      {{"--cache",
        "Run",
        "Folder of finished units of work: a bake that was killed, or is repeated after a change, computes only what "
        "is not there. Default: .oriel-cache beside the pack",
        path(args->cache, "DIR"),
        Use::kEveryday,
        {},
        "cache.md"},
       {"--no-cache",
        "Run",
        "Compute everything, and keep nothing but the pack",
        flag(args->no_cache),
        Use::kRare,
        {},
        {},
        {"--cache"}},
       {"--report", "Run", "Write what was done, omitted, measured and how long it took, as JSON",
        path(args->report, "FILE"), Use::kEveryday},
       {"--strict", "Run",
        "Exit code 5 where something is found to be likely wrong with the light, such as an energy ledger that does "
        "not close. The pack is written all the same",
        flag(args->strict)}});
  append(out.options, run_options(session));
  out.settle = [args](const Given& given) { return settle(args->bake, given); };
  out.run = [args, &session] { return run_bake(*args, session); };
  return out;
}

}  // namespace oriel
