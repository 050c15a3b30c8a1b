// oriel-inspect: what a pack holds, and whether it can be trusted. docs/oriel-inspect.md is its page.
#include <cmath>
#include <cstdio>
#include <system_error>

#include "formats/cli/command.h"
#include "formats/core/text.h"
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
  5  for diff: more changed than the tolerance allows; for validate --scene: the scene changed

Examples:
  oriel-inspect info house.oriel               what is inside, for people
  oriel-inspect info house.oriel --json        the same for programs
  oriel-inspect validate house.oriel           every checksum and every number
  oriel-inspect diff old.oriel new.oriel --tolerance 2%
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
                                               a walkthrough in a browser: a folder for any web server

docs/oriel-inspect.md explains every line of the output, docs/notes/format.md the file.)";

struct Arguments {
  std::filesystem::path pack, after, scene, output;
  std::string texture = "auto";
  bool json = false;
  WhyRequest why;
  ExtractOptions extract;
  DiffOptions diff;
  ExportOptions exported;
  WebRequest web;
  int code = 0;  // of the command that was named
};

constexpr const char *kArguments = "Arguments", *kOptions = "Options";

Option pack_argument(Arguments& a) {
  return {"PACK", kArguments, "The .oriel file", path(a.pack, "PACK"), Use::kRequired};
}

ToolCommand command(const char* name, const char* help, std::vector<Option> options, Arguments& a,
                    int (*run)(const Arguments&)) {
  return {.name = name, .help = help, .footer = "", .options = std::move(options), .run = [&a, run]() -> Status {
            a.code = run(a);
            return {};
          }};
}

ExportOptions with_coding(const Arguments& a) {
  ExportOptions out = a.exported;
  if (a.texture == "bc6h") out.coding = TexelCoding::kBc6h;
  if (a.texture == "rgb9e5") out.coding = TexelCoding::kRgb9e5;
  return out;
}

// A share, or 0.
OptionValue tolerance(double& out) {
  return {"SHARE",
          [&out](const std::string& typed) -> Status {
            const auto share = typed == "0" ? Result<double>(0.0) : parse_share(typed);
            if (share) out = *share;
            return share ? Status() : tl::unexpected(share.error());
          },
          [&out] { return std::isinf(out) ? "" : share_text(out); }};
}

std::vector<ToolCommand> readers(Arguments& a) {
  return {
      command("info", "Show sections, sizes, maps, statistics and the options of the bake",
              {pack_argument(a),
               {"--json", kOptions, "Print JSON: stable names, one object, for programs to read", flag(a.json),
                Use::kEveryday}},
              a, [](const Arguments& given) { return info(given.pack, given.json); }),
      command("validate", "Check all checksums and the meaning of every number",
              {pack_argument(a),
               {"--json", kOptions, "Print the issues as JSON", flag(a.json), Use::kEveryday},
               {"--scene", kOptions, "The scene file: tell which files changed since it was baked; then exit code 5",
                path(a.scene, "FILE"), Use::kEveryday}},
              a, [](const Arguments& given) { return validate(given.pack, given.scene, given.json); }),
      command("why", "Tell why a place is lit, or dark, as it is: hidden by what, lit by what",
              {pack_argument(a),
               {"--at", kOptions, "The place, world metres: the nearest surface within half a metre is asked",
                text(a.why.at, "X,Y,Z"), Use::kRequired},
               {"--from", kOptions, "Where it is seen from: of two sides in one place the one that faces this",
                text(a.why.from, "X,Y,Z"), Use::kEveryday},
               {"--json", kOptions, "Print JSON", flag(a.why.json), Use::kEveryday}},
              a, [](const Arguments& given) { return why(given.pack, given.why); }),
      command("diff", "Tell two packs of one building apart: light by surface, sections, options",
              {{"BEFORE", kArguments, "An .oriel file", path(a.pack, "PACK"), Use::kRequired},
               {"AFTER", kArguments, "The one to compare with it", path(a.after, "PACK"), Use::kRequired},
               {"--json", kOptions, "Print JSON: all surfaces", flag(a.diff.json), Use::kEveryday},
               {"--tolerance", kOptions,
                "Share of light (by surface, by camera, in sum), of materials, lamps and cameras that may change "
                "beyond noise, as 2%; 0: none. More, or another shape, is exit code 5",
                tolerance(a.diff.tolerance), Use::kEveryday},
               {"--surfaces", kOptions, "How many surfaces to list, those that changed most first",
                number(a.diff.surfaces, 0, 18446744073709551615.0), Use::kEveryday}},
              a, [](const Arguments& given) { return diff(given.pack, given.after, given.diff); })};
}

std::vector<ToolCommand> writers(Arguments& a) {
  static const std::string kKindHelp = "What to write: " + extract_kinds();
  return {
      command("extract", "Write the maps as EXR and PNG files, and index.json",
              {pack_argument(a),
               {"--kind", kOptions, kKindHelp.c_str(), text(a.extract.kind, "KIND"), Use::kEveryday},
               {"-o,--output", kOptions, "The folder to write to; it is made where it is missing",
                path(a.extract.folder, "DIR"), Use::kRequired}},
              a, [](const Arguments& given) { return extract(given.pack, given.extract); }),
      command(
          "report", "Write one HTML page: maps, surfaces, errors, sizes, options",
          {pack_argument(a), {"-o,--output", kOptions, "The page to write", path(a.output, "FILE"), Use::kRequired}}, a,
          [](const Arguments& given) { return page(given.pack, given.output); }),
      command("export", "Write the scene with its light, or its probes, for other programs",
              {pack_argument(a),
               {"-o,--output", kOptions, "The .glb file to write; with --as probes a folder",
                path(a.output, "FILE|DIR"), Use::kRequired},
               {"--as", kOptions,
                "emissive: any viewer shows the light as it is; lightmap: EXR and KTX2 files beside the scene; probes: "
                "what curved reflectors see as KTX2 cubes",
                one_of(a.exported.as, {"emissive", "lightmap", "probes"}), Use::kEveryday},
               {"--texture", kOptions,
                "What KTX2 files hold: bc6h, rgb9e5, or auto: BC6H where it rounds light by at most a quarter of its "
                "standard error",
                one_of(a.texture, {"auto", "bc6h", "rgb9e5"}), Use::kEveryday}},
              a, [](const Arguments& given) { return export_pack(given.pack, given.output, with_coding(given)); }),
      command("web", "Write a folder for any web server: a walkthrough in a browser",
              {pack_argument(a),
               {"-o,--output", kOptions, "The folder to write to; it is made where it is missing",
                path(a.web.folder, "DIR"), Use::kRequired},
               {"--title", kOptions, "What the page is called; unless told the pack's file name",
                text(a.web.title, "TEXT"), Use::kEveryday},
               {"--picture", kOptions,
                "A PNG file, as oriel-play writes them, for browsers in which the walkthrough cannot run",
                path(a.web.picture, "FILE"), Use::kEveryday}},
              a, [](const Arguments& given) { return web(given.pack, given.web); })};
}

int run(int argc, char** argv) {
  Arguments arguments;
  CommandLine line{kVersion,
                   {.name = "oriel-inspect",
                    .help = "oriel-inspect: tells what an .oriel pack holds and whether it can be trusted.",
                    .footer = kFooter,
                    .options = {},
                    .commands = readers(arguments)}};
  for (ToolCommand& writer : writers(arguments)) line.command.commands.push_back(std::move(writer));
  const auto parsed = parse(line, argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  const Status done = std::get<const ToolCommand*>(parsed)->run();
  return done ? arguments.code : report(done.error());
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
