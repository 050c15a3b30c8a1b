// oriel-bake: a glTF scene into one .oriel pack, a table of illuminance, a path-traced frame, or what these cost.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "bake/cache/checking_store.h"
#include "bake/cache/unit_cache.h"
#include "bake/cli/render_arguments.h"
#include "bake/lux/table.h"
#include "bake/run/pipeline.h"
#include "formats/core/file.h"
#include "formats/pack/reader.h"
#include "formats/pack/writer.h"

namespace oriel {
namespace {

// What the signal handlers need; set before they are installed.
Context* g_context = nullptr;
bool g_keeps = false;  // a stop keeps what is finished, and is waited for
bool g_works = false;  // a worker, which has nothing to finish
char g_temporary[4096] = "";

// Stages look at the flag many times a second, but libraries' long calls do not: after a second the process ends
// itself. That loses nothing: a pack exists only once it is renamed into place.
void on_alarm(int) {
  ::unlink(g_temporary);
  static constexpr char kText[] = "\noriel-bake: stopped; nothing was written\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kText, sizeof(kText) - 1);
  ::_exit(static_cast<int>(ErrorCode::kStopped));
}

// The first time the bake ends with what is there, if that makes a pack; else, and the second time, at once.
void on_stop(int) {
  if (!g_works && g_context->finishable && !g_context->finish.exchange(true)) {
    static constexpr char kText[] = "\noriel-bake: finishing with what is there; again to stop at once\n";
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kText, sizeof(kText) - 1);
    return;
  }
  g_context->stop.store(true);
  if (!g_keeps) ::alarm(1);
}

void install_signal_handlers(Context& context, const std::filesystem::path& output) {
  g_context = &context;
  const std::string temporary = output.empty() ? "" : temporary_name(output).string();
  if (temporary.size() < sizeof(g_temporary)) std::copy(temporary.begin(), temporary.end(), g_temporary);
  std::signal(SIGALRM, on_alarm);
  std::signal(SIGINT, on_stop);
  std::signal(SIGTERM, on_stop);
}

int print_error(const Error& error, ProgressPrinter::Style style, ProgressPrinter& printer) {
  printer.finish();
  if (style == ProgressPrinter::Style::kJson) {
    const nlohmann::ordered_json json = {
        {"event", "error"}, {"code", static_cast<int>(error.code)}, {"message", error.message}, {"where", error.where}};
    std::fprintf(stderr, "%s\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  } else {
    std::fprintf(stderr, "oriel-bake: %s\n",
                 error.code == ErrorCode::kStopped && !g_keeps ? "stopped; nothing was written" : error.text().c_str());
  }
  return static_cast<int>(error.code);
}

std::vector<std::filesystem::path> inputs_of(const std::filesystem::path& scene, const ImportOptions& import) {
  std::vector<std::filesystem::path> inputs{scene, import.sky_file};
  for (const auto& [node, file] : import.ies) inputs.push_back(file);
  return inputs;
}

// Fails before hours of work where their result could not be written, or would replace what is read.
Status check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs) {
  namespace fs = std::filesystem;
  std::error_code ec;
  const fs::path folder = output.has_parent_path() ? output.parent_path() : ".";
  if (!fs::is_directory(folder, ec))
    return fail(ErrorCode::kIo, output.string(), "there is no folder {}", folder.string());
  if (::access(folder.c_str(), W_OK) != 0)
    return fail(ErrorCode::kIo, output.string(), "the folder {} cannot be written: {}", folder.string(),
                std::strerror(errno));
  if (fs::is_directory(output, ec)) return fail(ErrorCode::kIo, output.string(), "is a folder, expected a file name");
  for (const fs::path& input : inputs)
    if (fs::equivalent(output, input, ec))
      return fail(ErrorCode::kUsage, output.string(), "is an input, which would be overwritten: expected another name");
  return {};
}

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
void print_omissions(const std::vector<std::string>& omissions, ProgressPrinter& printer) {
  constexpr std::size_t kShown = 8;
  for (std::size_t i = 0; i < std::min(kShown, omissions.size()); ++i) printer.note("omitted: " + omissions[i]);
  if (omissions.size() > kShown)
    printer.note(fmt::format("omitted: {} more, see oriel-inspect info or --report", omissions.size() - kShown));
}

Status run_lux(const Arguments& args, Context& context) {
  if (!args.lux_output.empty()) {
    auto inputs = inputs_of(args.lux.scene, args.lux.import);
    inputs.push_back(args.lux.points);
    ORIEL_TRY_VOID(check_output(args.lux_output, inputs));
  }
  ORIEL_TRY(const Measurement measured, measure(args.lux, context));
  const std::string csv = lux_csv(measured.points, measured.results);
  if (!args.lux_output.empty()) return write_file_atomically(args.lux_output, std::as_bytes(std::span(csv)));
  return print(csv);
}

void print_share(const UnitShare& share, const std::filesystem::path& folder, ProgressPrinter& printer) {
  printer.note(fmt::format("reused {} of {} units ({:.0f} % of the work) in {}", share.reused, share.units(),
                           100 * share.work(), folder.string()));
}

// The folder that finished units go to and come from; nothing where they shall not.
std::optional<UnitCache> open_cache(const Arguments& args, Context& context) {
  std::filesystem::path folder = args.cache.folder;
  if (folder.empty()) folder = args.bake.output.parent_path() / kDefaultCache;
  if (args.cache.off) return std::nullopt;
  const std::string program = program_identity() + instruction_sets(args.bake.reproducible);
  return std::optional<UnitCache>(std::in_place, folder, program, context.warn);
}

// Computes what a bake would, for those who share the cache.
Status run_worker(const Arguments& args, Context& context, ProgressPrinter& printer) {
  std::optional<UnitCache> cache = open_cache(args, context);
  context.units = &*cache;
  ORIEL_TRY_VOID(bake(args.bake, context));
  print_share(cache->share(), args.cache.folder, printer);
  return {};
}

// Bakes again, mostly from the cache, and compares.
Status run_verify(const Arguments& args, Context& context, ProgressPrinter& printer) {
  const std::filesystem::path& pack = args.bake.output;
  ORIEL_TRY(const Bytes written, read_file(pack));
  ORIEL_TRY(const Pack before, decode_pack(written));
  std::optional<UnitCache> cache = open_cache(args, context);
  CheckingStore checking(*cache, args.verify.sample, std::random_device()());
  context.units = &checking;
  ORIEL_TRY(const BakeResult again, bake(args.bake, context));
  printer.note(fmt::format("{} of {} units were found in {}; {} that are there were computed again: {} differ",
                           again.units.reused - checking.checked(), again.units.units(), cache->folder().string(),
                           checking.checked(), checking.differing()));
  if (before.provenance != again.pack.provenance)
    return fail(ErrorCode::kDifferent, pack.string(),
                "was baked of other files, with other options or by another version: see oriel-inspect info");
  ORIEL_TRY(const Bytes bytes, encode_pack(again.pack));
  if (checking.differing() > 0 || bytes != written)
    return fail(ErrorCode::kDifferent, pack.string(),
                "found other bytes than a bake of {} gives now, expected the same", args.bake.scene.string());
  return print("the same\n");
}

Status run_bake(const Arguments& args, Context& context, ProgressPrinter& printer) {
  const auto inputs = inputs_of(args.bake.scene, args.bake.import);
  ORIEL_TRY_VOID(check_output(args.bake.output, inputs));
  if (!args.report.empty()) {
    ORIEL_TRY_VOID(check_output(args.report, inputs));
    if (args.report.lexically_normal() == args.bake.output.lexically_normal())
      return fail(ErrorCode::kUsage, args.report.string(), "is the output too: expected another name for the report");
  }
  std::optional<UnitCache> cache = open_cache(args, context);
  context.units = cache ? &*cache : nullptr;
  ORIEL_TRY(const BakeResult result, bake(args.bake, context));
  if (cache) print_share(result.units, cache->folder(), printer);
  if (result.radiosity.ended_early || context.finish)
    printer.note("ended early: the pack holds what was there, with the error that is stated");
  print_omissions(result.omissions, printer);
  printer.note(light_line(result.radiosity));
  if (const MapReuse& reuse = result.map_reuse; reuse.kept > 0)
    printer.note(fmt::format(
        "radiance maps: {} of {} bands keep the pixels of the bake before, with {:.2g} % of error in all of them",
        reuse.kept, reuse.bands, 100 * reuse.error));
  if (result.ledger.emitted_lm() > 0) printer.note(ledger_line(result.ledger));
  ORIEL_TRY_VOID(write_pack(args.bake.output, result.pack));
  if (!args.report.empty()) {
    const std::string report = report_json(result);
    ORIEL_TRY_VOID(write_file_atomically(args.report, std::as_bytes(std::span(report))));
  }
  double seconds = 0;
  for (const StageTime& time : result.times) seconds += time.seconds;
  std::error_code ec;
  const auto size = std::filesystem::file_size(args.bake.output, ec);
  printer.note(fmt::format("wrote {}: {:.1f} MB, baked in {:.1f} s", args.bake.output.string(),
                           ec ? 0.0 : static_cast<double>(size) * 1e-6, seconds));
  if (!result.left_out.empty())
    return fail(kIncomplete, args.bake.output.string(), "was written without {}", result.left_out[0]);
  if (args.strict && !result.findings.empty())
    return fail(ErrorCode::kDifferent, args.bake.output.string(), "was written; --strict: {}", result.findings[0]);
  return {};
}

// Our code throws nothing, but the libraries and the allocator may.
Status run(const Arguments& args, Context& context, ProgressPrinter& printer) {
  try {
    if (args.material.wanted) return run_material(args.material);
    if (args.plan.wanted) {
      if (!args.plan.json.empty() && args.plan.json != "-")
        ORIEL_TRY_VOID(check_output(args.plan.json, inputs_of(args.bake.scene, args.bake.import)));
      return run_plan(args.plan, args.bake, context);
    }
    if (args.prune.wanted) return run_cache(args.prune);
    if (args.works) return run_worker(args, context, printer);
    if (args.verify.wanted) return run_verify(args, context, printer);
    if (args.submit.wanted) return run_submit(args.submit);
    if (args.trade.wanted) return run_trade(args.trade, context, [&](const std::string& text) { printer.note(text); });
    if (args.render.wanted) {
      ORIEL_TRY_VOID(check_output(args.render.output, inputs_of(args.render.scene, args.render.import)));
      return run_render(args.render, context);
    }
    return args.wants_lux ? run_lux(args, context) : run_bake(args, context, printer);
  } catch (const std::bad_alloc&) {
    if (args.wants_lux) return fail(ErrorCode::kRuntime, "", "not enough memory: try a larger spacing of --grid");
    if (args.render.wanted) return fail(ErrorCode::kRuntime, "", "not enough memory: try a smaller --size");
    return fail(ErrorCode::kRuntime, "",
                "not enough memory: try a larger --texel, fewer --views or a smaller --memory");
  } catch (const std::exception& error) {
    return fail(ErrorCode::kRuntime, "", "{}", error.what());
  }
}

int main_of_bake(int argc, char** argv) {
  const Arguments args = parse_arguments(argc, argv);
  if (args.exit_code >= 0) return args.exit_code;
  Context context;
  context.threads = args.threads;
  context.seed = args.seed;
  ProgressPrinter printer(args.style);
  context.progress = [&](const Progress& progress) { printer(progress); };
  context.warn = [&](const std::string& message) { printer.warning(message); };
  g_keeps = args.trade.wanted;
  g_works = args.works || args.verify.wanted;
  install_signal_handlers(context, args.wants_lux       ? args.lux_output
                                   : args.render.wanted ? args.render.output
                                   : args.verify.wanted ? std::filesystem::path()
                                                        : args.bake.output);
  const Status status = run(args, context, printer);
  ::alarm(0);
  return status ? 0 : print_error(status.error(), args.style, printer);
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  return oriel::main_of_bake(argc, argv);
}
