#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "formats/analysis/error_bands.h"
#include "formats/analysis/pack_diff.h"
#include "formats/analysis/texel_diff.h"
#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/inspect/commands.h"
#include "formats/pack/index.h"
#include "formats/pack/reader.h"

namespace oriel::inspect {
namespace {

constexpr std::size_t kLongest = 60;  // of an option's value in Markdown

struct KindSizes {
  std::uint64_t sections[2] = {0, 0}, bytes[2] = {0, 0};
};

struct Opened {
  Pack pack;
  PackIndex index;
};

Result<Opened> open(const std::filesystem::path& path) {
  ORIEL_TRY(const Bytes file, read_file(path));
  Opened opened;
  ORIEL_TRY(opened.index, read_index(file));
  auto pack = decode_pack(file);
  if (!pack) return fail(pack.error().code, path.string() + ": " + pack.error().where, "{}", pack.error().message);
  opened.pack = std::move(*pack);
  return opened;
}

std::string kind_text(std::uint32_t kind) {
  const SectionKind* known = find_section_kind(kind);
  return known == nullptr ? "unknown" : known->meaning;
}

std::map<std::string, KindSizes> kinds_of(const PackIndex& before, const PackIndex& after) {
  std::map<std::string, KindSizes> kinds;
  const PackIndex* const both[] = {&before, &after};
  for (int i = 0; i < 2; ++i)
    for (const SectionInfo& section : both[i]->sections) {
      KindSizes& kind = kinds[kind_text(section.kind)];
      ++kind.sections[i];
      kind.bytes[i] += section.stored_bytes;
    }
  return kinds;
}

const char* text_of(SurfaceState state) {
  switch (state) {
    case SurfaceState::kOnlyInFirst:
      return "gone";
    case SurfaceState::kOnlyInSecond:
      return "added";
    default:
      return "";
  }
}

bool within(const PackDiff& diff, std::optional<double> tolerance) {
  if (!tolerance) return true;
  for (const SurfaceChange& s : diff.surfaces)
    if (s.state != SurfaceState::kBoth) return false;
  return diff.largest() <= tolerance;
}

std::string shortened(const std::string& text) {
  return text.empty() ? "-" : text.size() <= kLongest ? text : text.substr(0, kLongest) + "…";
}

void print_texels(const TexelDiff& t) {
  fmt::print(
      "\n## Texels\n\nThe atlas is the same: {} texels, relative to the first pack's light (its mean: {:.4g} lux).\n\n",
      t.texels, t.mean_lux);
  fmt::print("| | % |\n|---|---|\n");
  const auto row = [](const char* what, double share) { fmt::print("| {} | {:.3g} |\n", what, 100 * share); };
  row("difference (relRMSE)", t.difference);
  row("noise of the first", t.noise);
  row("error that the second states", t.stated);
  row("net of the first's noise", t.net);
  row("net, without the worst hundredth", t.net_without_worst);
  row("net, relative to the brighter of both", t.net_of_brighter);
  row("bias of the mean", t.bias);
}

// Both tell of texels; nothing where the atlases differ.
struct OfTexels {
  std::optional<TexelDiff> all;
  std::optional<ErrorBands> bands;
  const std::vector<MeshPart>& parts;
};

void print_bands(const ErrorBands& bands, const std::vector<MeshPart>& parts) {
  constexpr std::size_t kListed = 12;
  fmt::print(
      "\n## Where the difference lies\n\nBy size on the surface, in texels, % of the light around; visible: contrast "
      "over what the nearest eye just notices.\n\n| surface | texels |");
  for (std::size_t k = 0; k < kErrorBands; ++k) fmt::print(" {}–{} |", 1u << k, 2u << k);
  fmt::print(" wider | visible |\n|---|---|");
  for (std::size_t k = 0; k < kErrorBands + 2; ++k) fmt::print("---|");
  const auto row = [](const std::string& name, const BandErrors& e) {
    fmt::print("\n| {} | {} |", name, e.texels);
    for (const double band : e.band) fmt::print(" {:.2g} |", 100 * band);
    fmt::print(" {:.2g} | {:.2g} |", 100 * e.wider, e.visible);
  };
  row("all", bands.all);
  for (std::size_t i = 0; i < std::min(kListed, bands.parts.size()); ++i)
    row(parts[bands.parts[i].part].name, bands.parts[i].errors);
  fmt::print("\n");
}

Json bands_json(const BandErrors& e) {
  return {{"texels", e.texels}, {"bands", e.band}, {"wider", e.wider}, {"visible", e.visible}};
}

// Files that were baked and options, apart: the provenance has both.
bool is_input(const OptionChange& o) {
  return o.name.starts_with("inputs");
}

// Numbers as people wrote them: those of options are floats told to the last digit.
std::string as_written(const std::string& value) {
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  return error == std::errc() && end == value.data() + value.size() ? fmt::format("{:.6g}", number) : shortened(value);
}

// First of all: whether what was baked differs, or how.
std::string what_differs(const PackDiff& diff) {
  std::string settings;
  std::size_t inputs = 0, versions = 0;
  for (const OptionChange& o : diff.options) {
    if (is_input(o)) {
      ++inputs;
    } else if (o.name.starts_with("options.")) {
      settings += fmt::format("{}{} ({} → {})", settings.empty() ? "" : ", ", o.name.substr(8), as_written(o.before),
                              as_written(o.after));
    } else {
      ++versions;
    }
  }
  return fmt::format("Scene: {}. Settings: {}. {}\n", inputs > 0 ? "other files" : "the same files",
                     settings.empty() ? "the same" : settings,
                     versions > 0 ? "Tool: another version." : "Tool: the same version.");
}

bool in_blocks(const PackDiff& diff) {
  return std::any_of(diff.surfaces.begin(), diff.surfaces.end(), [](const SurfaceChange& s) { return s.block_m > 0; });
}

void print_markdown(const PackDiff& diff, const OfTexels& texels, const std::map<std::string, KindSizes>& kinds,
                    const DiffOptions& options) {
  fmt::print("{}\n", what_differs(diff));
  if (in_blocks(diff))
    fmt::print(
        "Texels are of other sizes: light is compared over blocks of four of the larger ones, not within them.\n\n");
  fmt::print("## Light\n\nMean of the first pack: {:.4g} lux. Largest change of a surface: {:.2f} %.\n\n",
             diff.mean_lux, 100 * diff.largest());
  fmt::print("| surface | material | m² | before, lux | after, lux | change, lux | % | standard error, lux | |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  const auto changed = static_cast<std::size_t>(std::ranges::count_if(
      diff.surfaces, [](const SurfaceChange& s) { return s.change_lux() > 0 || s.state != SurfaceState::kBoth; }));
  const std::size_t listed = std::min(options.surfaces, changed);
  for (std::size_t i = 0; i < listed; ++i) {
    const SurfaceChange& s = diff.surfaces[i];
    fmt::print("| {} | {} | {:.3g} | {:.4g} | {:.4g} | {:.3g} | {:.1f} | {:.2g} → {:.2g} | {} |\n", s.name, s.material,
               s.area_m2, s.before_lux, s.after_lux, s.change_lux(), 100 * diff.share(s), s.before_error_lux,
               s.after_error_lux, s.same_shape ? text_of(s.state) : "another shape");
  }
  if (changed > listed) fmt::print("\n{} more changed less.\n", changed - listed);
  if (diff.surfaces.size() > changed)
    fmt::print("\n{} surfaces did not change by more than their noise.\n", diff.surfaces.size() - changed);
  if (texels.all) print_texels(*texels.all);
  if (texels.bands) print_bands(*texels.bands, texels.parts);
  fmt::print("\n## Sections\n\n| kind | before | after | bytes before | bytes after |\n|---|---|---|---|---|\n");
  for (const auto& [name, kind] : kinds)
    fmt::print("| {} | {} | {} | {} | {} |\n", name, kind.sections[0], kind.sections[1], kind.bytes[0], kind.bytes[1]);
  if (diff.options.empty()) return;
  fmt::print("\n## Provenance\n\n| | before | after |\n|---|---|---|\n");
  for (const OptionChange& o : diff.options)
    fmt::print("| {} | {} | {} |\n", o.name, shortened(o.before), shortened(o.after));
}

void print_json(const PackDiff& diff, const OfTexels& texels, const std::map<std::string, KindSizes>& kinds,
                bool good) {
  Json out;
  out["schema"] = kJsonSchema;
  out["within_tolerance"] = good;
  const auto any = [&](bool input) {
    return std::any_of(diff.options.begin(), diff.options.end(), [&](const OptionChange& o) {
      return is_input(o) == input && (input || o.name.starts_with("options."));
    });
  };
  out["scene_differs"] = any(true);
  out["settings_differ"] = any(false);
  out["mean_lux"] = diff.mean_lux;
  out["largest_change"] = diff.largest();
  out["surfaces"] = Json::array();
  for (const SurfaceChange& s : diff.surfaces)
    out["surfaces"].push_back({{"name", s.name},
                               {"material", s.material},
                               {"state", s.state == SurfaceState::kBoth ? "both" : text_of(s.state)},
                               {"same_shape", s.same_shape},
                               {"area_m2", s.area_m2},
                               {"before_lux", s.before_lux},
                               {"after_lux", s.after_lux},
                               {"rms_lux", s.rms_lux},
                               {"noise_lux", s.noise_lux},
                               {"block_m", s.block_m},
                               {"change_lux", s.change_lux()},
                               {"change", diff.share(s)},
                               {"before_error_lux", s.before_error_lux},
                               {"after_error_lux", s.after_error_lux}});
  if (const auto& t = texels.all)
    out["texels"] = {{"count", t->texels},
                     {"mean_lux", t->mean_lux},
                     {"difference", t->difference},
                     {"noise", t->noise},
                     {"stated", t->stated},
                     {"net", t->net},
                     {"net_without_worst_hundredth", t->net_without_worst},
                     {"net_of_brighter", t->net_of_brighter},
                     {"bias", t->bias}};
  if (texels.bands) {
    out["bands"] = {{"all", bands_json(texels.bands->all)}, {"surfaces", Json::array()}};
    for (const PartBands& p : texels.bands->parts) {
      auto json = bands_json(p.errors);
      json["name"] = texels.parts[p.part].name;
      out["bands"]["surfaces"].push_back(std::move(json));
    }
  }
  for (const auto& [name, kind] : kinds)
    out["sections"][name] = {{"before", {{"sections", kind.sections[0]}, {"bytes", kind.bytes[0]}}},
                             {"after", {{"sections", kind.sections[1]}, {"bytes", kind.bytes[1]}}}};
  out["provenance"] = Json::array();
  for (const OptionChange& o : diff.options)
    out["provenance"].push_back({{"name", o.name}, {"before", o.before}, {"after", o.after}});
  fmt::print("{}\n", out.dump(2));
}

}  // namespace

int diff(const std::filesystem::path& before, const std::filesystem::path& after, const DiffOptions& options) {
  const auto a = open(before);
  if (!a) return report(a.error());
  const auto b = open(after);
  if (!b) return report(b.error());
  const PackDiff diff = diff_packs(a->pack, b->pack);
  const OfTexels texels{diff_texels(a->pack, b->pack), error_bands(a->pack, b->pack), a->pack.mesh.parts};
  const bool good = within(diff, options.tolerance);
  const auto kinds = kinds_of(a->index, b->index);
  if (options.json)
    print_json(diff, texels, kinds, good);
  else
    print_markdown(diff, texels, kinds, options);
  return good ? 0 : static_cast<int>(ErrorCode::kDifferent);
}

}  // namespace oriel::inspect
