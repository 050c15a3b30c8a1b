// oriel-inspect: what a pack holds, and whether it can be trusted. docs/oriel-inspect.md is its page.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
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
  oriel-inspect why house.oriel --at 1.2,0,3.5
                                               why it is dark there, and what to do
  oriel-inspect report house.oriel -o house.html
                                               maps, surfaces, errors and sizes as one page
  oriel-inspect export house.oriel -o house.glb
                                               the lit scene for any glTF viewer
  oriel-inspect web house.oriel -o house
                                               a walkthrough in a browser: a folder for any web server;
                                               with --serve it can be looked at, at once

docs/oriel-inspect.md explains every line of the output, docs/format.md the file.)";

struct Arguments {
  std::string pack, after, scene, texture = "auto";
  std::filesystem::path output;
  bool json = false;
  WhyRequest why;
  ExtractOptions extract;
  DiffOptions diff;
  ExportOptions exported;
  WebRequest web;
  std::function<int()> run;  // the command that was named
};

CLI::App* add_command(CLI::App& app, const char* name, const char* description, Arguments& a,
                      std::function<int()> run) {
  CLI::App* command = app.add_subcommand(name, description);
  command->callback([&a, run = std::move(run)] { a.run = run; });
  return command;
}

ExportOptions with_coding(const Arguments& a) {
  ExportOptions out = a.exported;
  if (a.texture == "bc6h") out.coding = TexelCoding::kBc6h;
  if (a.texture == "rgb9e5") out.coding = TexelCoding::kRgb9e5;
  return out;
}

void add_checks(CLI::App& app, Arguments& a) {
  auto* info_command = add_command(app, "info", "Show sections, sizes, maps, statistics and the options of the bake", a,
                                   [&a] { return info(a.pack, a.json); });
  info_command->add_option("PACK", a.pack, "The .oriel file")->required();
  info_command->add_flag("--json", a.json, "Print JSON: stable names, one object, for programs to read");

  auto* validate_command = add_command(app, "validate", "Check all checksums and the meaning of every number", a,
                                       [&a] { return validate(a.pack, a.scene, a.json); });
  validate_command->add_option("PACK", a.pack, "The .oriel file")->required();
  validate_command->add_flag("--json", a.json, "Print the issues as JSON");
  validate_command->add_option("--scene", a.scene,
                               "The scene file: tell which files changed since it was baked; then exit code 5");
}

void add_why(CLI::App& app, Arguments& a) {
  auto* command = add_command(app, "why", "Tell why a place is lit, or dark, as it is: hidden by what, lit by what", a,
                              [&a] { return why(a.pack, a.why); });
  command->add_option("PACK", a.pack, "The .oriel file")->required();
  command->add_option("--at", a.why.at, "The place, world metres: the nearest surface within half a metre is asked")
      ->required()
      ->type_name("X,Y,Z");
  command->add_option("--from", a.why.from, "Where it is seen from: of two sides in one place the one that faces this")
      ->type_name("X,Y,Z");
  command->add_flag("--json", a.why.json, "Print JSON");
}

void add_diff(CLI::App& app, Arguments& a) {
  auto* command = add_command(app, "diff", "Tell two packs of one building apart: light by surface, sections, options",
                              a, [&a] { return diff(a.pack, a.after, a.diff); });
  command->add_option("BEFORE", a.pack, "An .oriel file")->required();
  command->add_option("AFTER", a.after, "The one to compare with it")->required();
  command->add_flag("--json", a.diff.json, "Print JSON: all surfaces");
  command
      ->add_option("--tolerance", a.diff.tolerance,
                   "Share of a surface's light that may change beyond noise, for instance 0.02: more is exit code 5")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("--surfaces", a.diff.surfaces, "How many surfaces to list, those that changed most first")
      ->capture_default_str();
}

void add_writers(CLI::App& app, Arguments& a) {
  auto* extract_command = add_command(app, "extract", "Write the maps as EXR and PNG files, and index.json", a,
                                      [&a] { return extract(a.pack, a.extract); });
  extract_command->add_option("PACK", a.pack, "The .oriel file")->required();
  extract_command->add_option("--kind", a.extract.kind, "What to write: " + extract_kinds())->capture_default_str();
  extract_command->add_option("-o,--output", a.extract.folder, "The folder to write to; it is made where it is missing")
      ->required();

  auto* report_command = add_command(app, "report", "Write one HTML page: maps, surfaces, errors, sizes, options", a,
                                     [&a] { return page(a.pack, a.output); });
  report_command->add_option("PACK", a.pack, "The .oriel file")->required();
  report_command->add_option("-o,--output", a.output, "The page to write")->required();

  auto* export_command = add_command(app, "export", "Write the scene with its light, or its probes, for other programs",
                                     a, [&a] { return export_pack(a.pack, a.output, with_coding(a)); });
  export_command->add_option("PACK", a.pack, "The .oriel file")->required();
  export_command->add_option("-o,--output", a.output, "The .glb file to write; with --as probes a folder")->required();
  export_command
      ->add_option("--as", a.exported.as,
                   "emissive: any viewer shows the light as it is; lightmap: EXR and KTX2 files beside the scene; "
                   "probes: what curved reflectors see as KTX2 cubes, and the split-sum table")
      ->check(CLI::IsMember({"emissive", "lightmap", "probes"}))
      ->capture_default_str();
  export_command
      ->add_option(
          "--texture", a.texture,
          "What KTX2 files hold: bc6h, rgb9e5, or auto: BC6H where it rounds light by at most a quarter of its "
          "standard error")
      ->check(CLI::IsMember({"auto", "bc6h", "rgb9e5"}))
      ->capture_default_str();
}

void add_web(CLI::App& app, Arguments& a) {
  auto* command = add_command(app, "web", "Write a folder for any web server: a walkthrough in a browser", a,
                              [&a] { return web(a.pack, a.web); });
  command->add_option("PACK", a.pack, "The .oriel file")->required();
  command->add_option("-o,--output", a.web.folder, "The folder to write to; it is made where it is missing")
      ->required();
  command->add_option("--title", a.web.title, "What the page is called; unless told the pack's file name");
  command->add_option("--picture", a.web.picture,
                      "A PNG file, as oriel-play writes them, for browsers in which the walkthrough cannot run");
  command
      ->add_option_function<std::string>(
          "--serve",
          [&a](const std::string& port) {
            a.web.serve = static_cast<std::uint16_t>(port.empty() ? 0 : std::stoi(port));
          },
          "Then show the folder to browsers on this machine, and to nobody else, until Ctrl-C; on this port, or on a "
          "free one")
      ->type_name("[PORT]")
      ->expected(0, 1)
      ->check(CLI::Range(0, 65535));
}

int run(int argc, char** argv) {
  CLI::App app("oriel-inspect: tells what an .oriel pack holds and whether it can be trusted.", "oriel-inspect");
  app.set_version_flag("--version", std::string("oriel-inspect ") + kVersion);
  app.footer(kFooter);
  app.require_subcommand(1);
  Arguments arguments;
  add_checks(app, arguments);
  add_why(app, arguments);
  add_diff(app, arguments);
  add_writers(app, arguments);
  add_web(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? 0 : static_cast<int>(ErrorCode::kUsage);
  }
  return arguments.run();
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
