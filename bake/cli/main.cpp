// oriel-bake: a glTF scene into one .oriel pack.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bake/cli/arguments.h"
#include "bake/run/pipeline.h"
#include "formats/core/file.h"
#include "formats/pack/writer.h"

namespace oriel {
namespace {

Context* g_context = nullptr;  // for the signal handler alone

void on_signal(int) {
  if (g_context) g_context->stop.store(true);
}

int print_error(const Error& error, ProgressPrinter::Style style, ProgressPrinter& printer) {
  printer.finish();
  if (style == ProgressPrinter::Style::kJson) {
    const nlohmann::ordered_json json = {
        {"event", "error"}, {"code", static_cast<int>(error.code)}, {"message", error.message}, {"where", error.where}};
    std::fprintf(stderr, "%s\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  } else {
    std::fprintf(stderr, "oriel-bake: %s\n", error.code == ErrorCode::kStopped ? "stopped; nothing was written" : error.text().c_str());
  }
  return static_cast<int>(error.code);
}

// Fails before hours of work where the pack could not be written at their end.
Status check_output(const std::filesystem::path& output) {
  const std::filesystem::path folder = output.has_parent_path() ? output.parent_path() : ".";
  if (!std::filesystem::is_directory(folder)) return fail(ErrorCode::kIo, output.string(), "there is no folder {}", folder.string());
  if (std::filesystem::is_directory(output)) return fail(ErrorCode::kIo, output.string(), "is a folder, expected a file name");
  return {};
}

// The first few; the pack's plan and the report hold them all.
void print_omissions(const std::vector<std::string>& omissions, ProgressPrinter& printer) {
  constexpr std::size_t kShown = 8;
  for (std::size_t i = 0; i < std::min(kShown, omissions.size()); ++i) printer.note("omitted: " + omissions[i]);
  if (omissions.size() > kShown)
    printer.note(fmt::format("omitted: {} more, see oriel-inspect info or --report", omissions.size() - kShown));
}

Status run(const Arguments& args, Context& context, ProgressPrinter& printer) {
  ORIEL_TRY_VOID(check_output(args.bake.output));
  ORIEL_TRY(const BakeResult result, bake(args.bake, context));
  print_omissions(result.omissions, printer);
  ORIEL_TRY_VOID(write_pack(args.bake.output, result.pack));
  if (!args.report.empty()) {
    const std::string report = report_json(result);
    ORIEL_TRY_VOID(write_file_atomically(args.report, std::as_bytes(std::span(report))));
  }
  double seconds = 0;
  for (const StageTime& time : result.times) seconds += time.seconds;
  printer.note(fmt::format("wrote {}: {:.1f} MB, baked in {:.1f} s", args.bake.output.string(),
                           static_cast<double>(std::filesystem::file_size(args.bake.output)) * 1e-6, seconds));
  return {};
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
  g_context = &context;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  const Status status = run(args, context, printer);
  g_context = nullptr;
  return status ? 0 : print_error(status.error(), args.style, printer);
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) { return oriel::main_of_bake(argc, argv); }
