// oriel-inspect: what a pack holds, and whether it can be trusted. docs/oriel-inspect.md is its page.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <system_error>

#include "formats/inspect/commands.h"

namespace oriel::inspect {
namespace {

constexpr const char* kFooter = R"(
Exit codes:
  0  done; for validate: the pack is valid
  1  usage: an unknown option, command or value
  2  a file cannot be read or written
  3  the pack is damaged or invalid
  4  failed at run time: memory
  5  for diff: the light changed by more than the tolerance; for validate --scene: the scene changed

Examples:
  oriel-inspect info house.oriel               what is inside, for people
  oriel-inspect info house.oriel --json        the same for programs
  oriel-inspect validate house.oriel           every checksum and every number
  oriel-inspect diff old.oriel new.oriel --tolerance 0.02
                                               which rooms changed, as Markdown; exit code 5 beyond 2 %
  oriel-inspect extract house.oriel --kind lightmap -o maps
                                               maps/lightmap_000.exr holds irradiance in lux
  oriel-inspect report house.oriel -o house.html
                                               maps, surfaces, errors and sizes as one page
  oriel-inspect export house.oriel -o house.glb
                                               the lit scene for any glTF viewer

docs/oriel-inspect.md explains every line of the output, docs/format.md the file.)";

int run(int argc, char** argv) {
  CLI::App app("oriel-inspect: tells what an .oriel pack holds and whether it can be trusted.", "oriel-inspect");
  app.set_version_flag("--version", std::string("oriel-inspect ") + kVersion);
  app.footer(kFooter);
  app.require_subcommand(1);

  std::string pack;
  bool json = false;
  ExtractOptions options;

  auto* info_command = app.add_subcommand("info", "Show sections, sizes, maps, statistics and the options of the bake");
  info_command->add_option("PACK", pack, "The .oriel file")->required();
  info_command->add_flag("--json", json, "Print JSON: stable names, one object, for programs to read");

  auto* validate_command = app.add_subcommand("validate", "Check all checksums and the meaning of every number");
  validate_command->add_option("PACK", pack, "The .oriel file")->required();
  validate_command->add_flag("--json", json, "Print the issues as JSON");
  std::string scene;
  validate_command->add_option("--scene", scene,
                               "The scene file: tell which files changed since it was baked; then exit code 5");

  auto* diff_command =
      app.add_subcommand("diff", "Tell two packs of one building apart: light by surface, sections, options");
  std::string after;
  DiffOptions diff_options;
  diff_command->add_option("BEFORE", pack, "An .oriel file")->required();
  diff_command->add_option("AFTER", after, "The one to compare with it")->required();
  diff_command->add_flag("--json", diff_options.json, "Print JSON: all surfaces");
  diff_command
      ->add_option("--tolerance", diff_options.tolerance,
                   "Share of a surface's light that may change beyond noise, for instance 0.02: more is exit code 5")
      ->check(CLI::Range(0.0, 1e6));
  diff_command
      ->add_option("--surfaces", diff_options.surfaces, "How many surfaces to list, those that changed most first")
      ->capture_default_str();

  auto* extract_command = app.add_subcommand("extract", "Write the maps as EXR and PNG files, and index.json");
  extract_command->add_option("PACK", pack, "The .oriel file")->required();
  extract_command->add_option("--kind", options.kind, "What to write: " + extract_kinds())->capture_default_str();
  extract_command->add_option("-o,--output", options.folder, "The folder to write to; it is made where it is missing")
      ->required();

  std::filesystem::path output;
  auto* report_command = app.add_subcommand("report", "Write one HTML page: maps, surfaces, errors, sizes, options");
  report_command->add_option("PACK", pack, "The .oriel file")->required();
  report_command->add_option("-o,--output", output, "The page to write")->required();

  std::string light = "emissive";
  auto* export_command = app.add_subcommand("export", "Write the scene as .glb with its light, for other programs");
  export_command->add_option("PACK", pack, "The .oriel file")->required();
  export_command->add_option("-o,--output", output, "The .glb file to write")->required();
  export_command
      ->add_option("--as", light,
                   "emissive: any viewer shows the light as it is; lightmap: EXR files in lux beside the scene")
      ->check(CLI::IsMember({"emissive", "lightmap"}))
      ->capture_default_str();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? 0 : static_cast<int>(ErrorCode::kUsage);
  }
  if (info_command->parsed()) return info(pack, json);
  if (diff_command->parsed()) return diff(pack, after, diff_options);
  if (validate_command->parsed()) return validate(pack, scene, json);
  if (report_command->parsed()) return page(pack, output);
  if (export_command->parsed()) return export_scene(pack, output, light == "lightmap");
  return extract(pack, options);
}

}  // namespace

int report(const Error& error) {
  std::fprintf(stderr, "oriel-inspect: error: %s\n", error.text().c_str());
  return static_cast<int>(error.code);
}

}  // namespace oriel::inspect

int main(int argc, char** argv) {
  try {
    const int code = oriel::inspect::run(argc, argv);
    // A full disk or a closed pipe shows here at the latest.
    if (std::fflush(stdout) != 0)
      return oriel::inspect::report({oriel::ErrorCode::kIo, "the result cannot be written", "stdout"});
    return code;
  } catch (const std::system_error& e) {  // fmt, when stdout takes no more
    return oriel::inspect::report({oriel::ErrorCode::kIo, e.what(), "stdout"});
  } catch (const std::exception& e) {
    return oriel::inspect::report({oriel::ErrorCode::kRuntime, e.what(), ""});
  }
}
