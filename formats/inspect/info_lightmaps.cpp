#include "formats/inspect/info_lightmaps.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/export/summary.h"

namespace oriel::inspect {
namespace {

Json lightmaps_json(const Pack& pack) {
  Json out = Json::array();
  for (const auto& page : pack.lightmaps) {
    const auto s = summarise(page);
    out.push_back(
        {{"width", page.width},
         {"height", page.height},
         {"texels",
          {{"empty", s.states[0]}, {"dilated", s.states[1]}, {"buried", s.states[2]}, {"valid", s.states[3]}}},
         {"lux", {{"min", s.min_lux}, {"mean", s.mean_lux}, {"max", s.max_lux}}},
         {"relative_standard_error", s.error},
         {"directional", !page.direction.empty()},
         {"mean_direction_length", s.mean_direction}});
  }
  return out;
}

struct SharpSummary {
  std::size_t texels = 0;
  std::uint64_t bytes = 0;  // of its section
};

SharpSummary summarise_sharp(const PackIndex& index, const Pack& pack) {
  SharpSummary s;
  for (const LightmapPage& page : pack.lightmaps)
    s.texels += page.sharp_at.size() - static_cast<std::size_t>(std::ranges::count(page.sharp_at, 0u));
  for (const auto& section : index.sections)
    if (section.kind == kSharpLightSection) s.bytes = section.stored_bytes;
  return s;
}

Json sharp_light_json(const PackIndex& index, const Pack& pack) {
  if (pack.sharp_light.empty()) return Json();
  const SharpSummary s = summarise_sharp(index, pack);
  return {{"lamps", pack.sharp_light.lamps.size()},
          {"texels", s.texels},
          {"words", pack.sharp_light.words.size()},
          {"triangles", pack.sharp_light.triangles.size()},
          {"stored_bytes", s.bytes}};
}

}  // namespace

void add_lightmaps(const PackIndex& index, const Pack& pack, Json& out) {
  out["lightmaps"] = lightmaps_json(pack);
  out["sharp_light"] = sharp_light_json(index, pack);
}

void print_lightmaps(const PackIndex& index, const Pack& pack) {
  for (std::size_t i = 0; i < pack.lightmaps.size(); ++i) {
    const auto& page = pack.lightmaps[i];
    const auto s = summarise(page);
    fmt::print(
        "lightmap {}: {} x {}, {} valid texels, {:.4g} to {:.4g} lux, mean {:.4g}, noise of texels, seen or not, "
        "{:.2g} %{}\n",
        i, page.width, page.height, s.states[3], s.min_lux, s.max_lux, s.mean_lux, 100 * s.error,
        page.direction.empty() ? "" : fmt::format(", directional (mean |d| {:.3g})", s.mean_direction));
  }
  if (pack.sharp_light.empty()) return;
  const SharpSummary s = summarise_sharp(index, pack);
  fmt::print("sharp light: {} lamps by the pixel on {} texels, {} triangles may be in their way, {} bytes\n",
             pack.sharp_light.lamps.size(), s.texels, pack.sharp_light.triangles.size(), s.bytes);
}

}  // namespace oriel::inspect
