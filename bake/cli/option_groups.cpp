#include "bake/cli/option_groups.h"

#include <unistd.h>

namespace oriel {

void add_light_options(CLI::App& app, SharedTexts& texts) {
  app.add_option("--sky", texts.sky, "Radiance of a constant sky, cd/m²: one value, or R,G,B")
      ->check(checked(parse_color, "L|R,G,B"))
      ->capture_default_str();
}

void add_run_options(CLI::App& app, SharedTexts& texts, Arguments& args) {
  app.add_option("--scene", args.bake.import.scene, "Which scene of the file; -1: its default")->capture_default_str();
  app.add_option("--threads", args.threads, "Threads; 0: all CPUs. The result does not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--seed", args.seed, "Of every random number: another seed gives another, equally good, estimate")
      ->capture_default_str();
  app.add_flag("--reproducible", args.bake.reproducible,
               "Pin Embree's instruction set, about 15 % slower: with one C library the same bytes on CPUs that differ "
               "in AVX only");
  auto* quiet = app.add_flag("--quiet", texts.quiet, "No progress; warnings and errors only");
  app.add_flag("--json-log", texts.json_log, "Progress, warnings and errors as JSON lines on stderr")->excludes(quiet);
}

Status resolve_shared(const SharedTexts& texts, Arguments& args) {
  ORIEL_TRY(args.bake.import.sky, parse_color(texts.sky));
  args.style = texts.json_log            ? ProgressPrinter::Style::kJson
               : texts.quiet             ? ProgressPrinter::Style::kQuiet
               : ::isatty(STDERR_FILENO) ? ProgressPrinter::Style::kBar
                                         : ProgressPrinter::Style::kPlain;
  return {};
}

}  // namespace oriel
