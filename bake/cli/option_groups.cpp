#include "bake/cli/option_groups.h"

#include <unistd.h>

namespace oriel {

void add_light_options(CLI::App& app, SharedTexts& texts, Arguments& args) {
  app.add_option(
         "--sky", texts.sky,
         "The sky: radiance in cd/m² all around (one value, or R,G,B), or an HDRI: a latitude-longitude .hdr or "
         ".exr whose centre is +X and whose right is +Z, as in Blender")
      ->check(checked(parse_sky, "L|R,G,B|FILE"))
      ->capture_default_str();
  app.add_option("--sky-scale", args.bake.import.sky_scale, "Radiance in cd/m² of a 1 in the sky's file")
      ->check(CLI::Range(0.0f, 1e30f))
      ->capture_default_str();
  app.add_option("--sky-rotation", args.bake.import.sky_rotation_deg,
                 "Turns the sky's file, counter-clockwise seen from above, degrees")
      ->check(CLI::Range(-360.0f, 360.0f))
      ->capture_default_str();
  app.add_option("--sun-angle", args.bake.import.sun_angle_deg,
                 "How large directional lights appear, degrees across: 0.53 gives the sun's soft shadows. Otherwise as "
                 "the file says (extras.oriel.angular_diameter_deg), which is a point")
      ->check(CLI::Range(0.0f, 180.0f));
  app.add_option(
         "--ies", texts.ies,
         "A measured luminaire (IES LM-63, type C) for the point or spot light of a node: it replaces intensity "
         "and cone, the colour stays. Nadir is the node's -Z, horizontal 0 its +X. May be repeated")
      ->check(checked(parse_ies_option, "NODE=FILE"))
      ->take_all();
}

void add_mover_option(CLI::App& app, Arguments& args) {
  app.add_option("--mover", args.bake.import.movers,
                 "A node that moves, with what is below it, beside those that the file marks (extras.oriel.mover) or "
                 "animates. May be repeated")
      ->type_name("NODE")
      ->take_all();
}

void add_run_options(CLI::App& app, SharedTexts& texts, Arguments& args) {
  app.add_option("--scene", args.bake.import.scene, "Which scene of the file; -1: its default")->capture_default_str();
  app.add_flag("--double-sided", args.bake.import.double_sided,
               "Every material reflects and emits on both sides, as renderers that know no single-sided ones have it: "
               "for models with walls turned the wrong way");
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

std::vector<std::string> as_typed(const CLI::Option& option) {
  std::vector<std::string> words;
  for (const std::string& value : option.results()) {
    words.push_back(option.get_name());
    if (option.get_items_expected_max() > 0) words.push_back(value);
  }
  return words;
}

Status resolve_shared(const SharedTexts& texts, Arguments& args) {
  ORIEL_TRY(SkyChoice sky, parse_sky(texts.sky));
  args.bake.import.sky = sky.radiance;
  args.bake.import.sky_file = std::move(sky.file);
  for (const std::string& text : texts.ies) {
    ORIEL_TRY(auto profile, parse_ies_option(text));
    args.bake.import.ies.push_back(std::move(profile));
  }
  args.style = texts.json_log            ? ProgressPrinter::Style::kJson
               : texts.quiet             ? ProgressPrinter::Style::kQuiet
               : ::isatty(STDERR_FILENO) ? ProgressPrinter::Style::kBar
                                         : ProgressPrinter::Style::kPlain;
  return {};
}

}  // namespace oriel
