// The commands of oriel-inspect. Each returns an exit code (docs/notes/conventions.md), puts its result on stdout or
// into files and its complaints on stderr.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "formats/core/result.h"
#include "formats/export/ktx2.h"
#include "formats/pack/pack.h"

namespace oriel::inspect {

// The text of --version, from CMake.
inline constexpr const char* kVersion = ORIEL_VERSION;

// The schema number in every JSON result. It rises when a field changes its meaning or goes.
inline constexpr int kJsonSchema = 2;

// What is inside: sections with sizes, maps with resolutions and statistics, options. All checksums are checked.
int info(const std::filesystem::path& path, bool json);

// All checksums, and every issue with its number. With a scene file: also whether the pack was baked of it as it is now
// (exit code 5 where not), by the hashes that its provenance holds.
int validate(const std::filesystem::path& path, const std::filesystem::path& scene, bool json);

// What a bake read and has changed since: a line for each file, with what was found and expected.
Result<std::vector<std::string>> changed_inputs(const Pack& pack, const std::filesystem::path& scene);

struct ExtractOptions {
  std::string kind = "all";
  std::filesystem::path folder;
};

// The kinds of --kind, "all" last, as one text: "lightmap, radiance_map, …".
const std::string& extract_kinds();

// Every map as EXR or PNG, and index.json that names them.
int extract(const std::filesystem::path& path, const ExtractOptions& options);

struct DiffOptions {
  bool json = false;
  double tolerance = std::numeric_limits<double>::infinity();  // share of what may change
  std::size_t surfaces = 20;  // so many are printed, those that changed most; JSON holds all
};

// What changed between two packs: light by surface and camera, materials, lamps, shapes, cameras, sections, options;
// Markdown or JSON. Exit code 5 where any of these changed by more than the tolerance, was added or has gone.
int diff(const std::filesystem::path& before, const std::filesystem::path& after, const DiffOptions& options);

struct WhyRequest {
  std::string at, from;  // "x,y,z" in world metres; from: the eye, empty where nobody in particular asks
  bool json = false;
};

// Why the surface at a place is lit as it is (formats/analysis). Error kInvalid where there is none.
int why(const std::filesystem::path& path, const WhyRequest& request);

// The pack as one HTML page to look at (formats/export).
int page(const std::filesystem::path& path, const std::filesystem::path& output);

struct ExportOptions {
  std::string as = "emissive";        // or "lightmap", "probes"
  std::optional<TexelCoding> coding;  // of KTX2 files; none: chosen by what it costs
};

// The scene as binary glTF with its light as emissive textures or with EXR and KTX2 files beside it; as probes a folder
// of cubes (formats/export).
int export_pack(const std::filesystem::path& path, const std::filesystem::path& output, const ExportOptions& options);

struct WebRequest {
  std::filesystem::path folder, picture;
  std::string title;  // empty: the pack's file name
};

// The pack as a folder of static files, a walkthrough for browsers (formats/export).
int web(const std::filesystem::path& path, const WebRequest& request);

// Prints "oriel-inspect: error: …" to stderr; gives the exit code.
int report(const Error& error);

}  // namespace oriel::inspect
