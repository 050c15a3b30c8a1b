#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "formats/analysis/error_bands.h"
#include "formats/analysis/pack_diff.h"
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
  return state == SurfaceState::kOnlyInFirst ? "gone" : state == SurfaceState::kOnlyInSecond ? "added" : "";
}

std::string shortened(const std::string& text) {
  return text.empty() ? "-" : text.size() <= kLongest ? text : text.substr(0, kLongest) + "…";
}

// Nothing where the atlases differ.
struct OfTexels {
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

std::string changes_text(const PackDiff& diff, const SurfaceChange& s) {
  const DVec3 bias = glm::abs(s.bias_lux);
  const int most = bias.r >= bias.g && bias.r >= bias.b ? 0 : bias.g >= bias.b ? 1 : 2;
  const double by = s.change_lux() > 0 ? 100 * diff.share(s) / s.change_lux() : 0;
  return fmt::format("{:.4g} | {:.4g} | {:.3g} | {:.1f} | {:.1f} | {:.1f}", s.before_lux, s.after_lux, s.bias_lux[most],
                     by * s.mean_change_lux, by * s.rms_change_lux, by * s.p99_change_lux);
}

void print_light(const PackDiff& diff, std::size_t most) {
  fmt::print(
      "## Light\n\nMean of the first pack: {:.4g} lux. Largest change: {:.2f} %; of the mean of all: {:.2f} %.\n\n",
      diff.mean_lux, 100 * diff.largest(), diff.mean_lux > 0 ? 100 * diff.bias_lux / diff.mean_lux : 0);
  fmt::print(
      "In % of the surface's light, beyond noise, of the channel that changed most.\n\n"
      "| surface | material | m² | before, lux | after, lux | bias, lux | mean, % | RMS, % | p99, % | standard error, "
      "lux | |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  const auto changed = static_cast<std::size_t>(std::ranges::count_if(
      diff.surfaces, [](const SurfaceChange& s) { return s.change_lux() > 0 || s.state != SurfaceState::kBoth; }));
  const std::size_t listed = std::min(most, changed);
  for (std::size_t i = 0; i < listed; ++i) {
    const SurfaceChange& s = diff.surfaces[i];
    fmt::print("| {} | {} | {:.3g} | {} | {:.2g} → {:.2g} | {} |\n", s.name, s.material, s.area_m2,
               changes_text(diff, s), s.before_error_lux, s.after_error_lux,
               s.same_shape ? text_of(s.state) : "another shape");
  }
  if (changed > listed) fmt::print("\n{} more changed less.\n", changed - listed);
  if (diff.surfaces.size() > changed)
    fmt::print("\n{} surfaces did not change by more than their noise.\n", diff.surfaces.size() - changed);
}

void print_cameras(const PackDiff& diff) {
  fmt::print(
      "\n## Light that cameras see\n\n| camera | before, lux | after, lux | bias, lux | mean, % | RMS, % | p99, % "
      "|\n|---|---|---|---|---|---|---|\n");
  for (const SurfaceChange& s : diff.cameras) fmt::print("| {} | {} |\n", s.name, changes_text(diff, s));
}

void print_assets(const PackDiff& diff) {
  fmt::print("\n## Materials, lamps, shapes, cameras\n\n| | | before | after | % |\n|---|---|---|---|---|\n");
  for (const AssetChange& c : diff.assets)
    fmt::print("| {} | {} | {} | {} | {:.3g} |\n", c.asset, c.member, shortened(c.before), shortened(c.after),
               100 * c.change);
}

void print_markdown(const PackDiff& diff, const OfTexels& texels, const std::map<std::string, KindSizes>& kinds,
                    const DiffOptions& options) {
  fmt::print("{}\n", what_differs(diff));
  if (in_blocks(diff))
    fmt::print(
        "Texels are of other sizes: light is compared over blocks of four of the larger ones, not within them.\n\n");
  print_light(diff, options.surfaces);
  if (!diff.cameras.empty()) print_cameras(diff);
  if (!diff.assets.empty()) print_assets(diff);
  if (texels.bands) print_bands(*texels.bands, texels.parts);
  fmt::print("\n## Sections\n\n| kind | before | after | bytes before | bytes after |\n|---|---|---|---|---|\n");
  for (const auto& [name, kind] : kinds)
    fmt::print("| {} | {} | {} | {} | {} |\n", name, kind.sections[0], kind.sections[1], kind.bytes[0], kind.bytes[1]);
  if (diff.options.empty()) return;
  fmt::print("\n## Provenance\n\n| | before | after |\n|---|---|---|\n");
  for (const OptionChange& o : diff.options)
    fmt::print("| {} | {} | {} |\n", o.name, shortened(o.before), shortened(o.after));
}

Json surface_json(const PackDiff& diff, const SurfaceChange& s) {
  return {{"name", s.name},
          {"material", s.material},
          {"state", s.state == SurfaceState::kBoth ? "both" : text_of(s.state)},
          {"same_shape", s.same_shape},
          {"area_m2", s.area_m2},
          {"before_lux", s.before_lux},
          {"after_lux", s.after_lux},
          {"bias_lux", {s.bias_lux.r, s.bias_lux.g, s.bias_lux.b}},
          {"rms_lux", s.rms_lux},
          {"noise_lux", s.noise_lux},
          {"block_m", s.block_m},
          {"mean_change_lux", s.mean_change_lux},
          {"rms_change_lux", s.rms_change_lux},
          {"p99_change_lux", s.p99_change_lux},
          {"change_lux", s.change_lux()},
          {"change", diff.share(s)},
          {"before_error_lux", s.before_error_lux},
          {"after_error_lux", s.after_error_lux}};
}

void print_json(const PackDiff& diff, const OfTexels& texels, const std::map<std::string, KindSizes>& kinds,
                bool good) {
  Json out;
  out["schema"] = kJsonSchema;
  for (const char* list : {"surfaces", "cameras", "assets"}) out[list] = Json::array();
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
  out["bias_lux"] = diff.bias_lux;
  for (const SurfaceChange& s : diff.surfaces) out["surfaces"].push_back(surface_json(diff, s));
  for (const SurfaceChange& s : diff.cameras) out["cameras"].push_back(surface_json(diff, s));
  for (const AssetChange& c : diff.assets)
    out["assets"].push_back(
        {{"asset", c.asset}, {"member", c.member}, {"before", c.before}, {"after", c.after}, {"change", c.change}});
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
  const OfTexels texels{error_bands(a->pack, b->pack), a->pack.mesh.parts};
  const bool good = diff.within(options.tolerance);
  const auto kinds = kinds_of(a->index, b->index);
  if (options.json)
    print_json(diff, texels, kinds, good);
  else
    print_markdown(diff, texels, kinds, options);
  return good ? 0 : static_cast<int>(ErrorCode::kDifferent);
}

}  // namespace oriel::inspect
