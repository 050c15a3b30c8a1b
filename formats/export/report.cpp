#include "formats/export/report.h"

#include <map>

#include "formats/core/text.h"
#include "formats/export/html.h"
#include "formats/export/sections.h"
#include "formats/export/summary.h"

namespace oriel::report {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,"><title>{0}</title>
<style>
body {{ font: 15px/1.5 system-ui, sans-serif; color: #1a1a1a; max-width: 1180px; margin: 2rem auto; padding: 0 1rem }}
h1 {{ font-size: 1.6rem; margin: 0 0 .3rem; overflow-wrap: anywhere }} h2 {{ font-size: 1.15rem; margin: 2.2rem 0 .6rem }}
p, li {{ max-width: 75ch; margin: .3rem 0; overflow-wrap: anywhere }} .quiet, figcaption {{ color: #555; font-size: .88rem }}
.wide {{ overflow-x: auto }} table {{ border-collapse: collapse; font-size: .85rem }}
th, td {{ padding: .25rem .7rem; text-align: right; border-bottom: 1px solid #eee }} th {{ vertical-align: bottom }}
td {{ font-variant-numeric: tabular-nums; overflow-wrap: anywhere }} td:first-child, th:first-child {{ text-align: left }}
.bars {{ display: grid; grid-template-columns: max-content 1fr max-content; gap: .15rem .7rem; font-size: .85rem;
align-items: center }} .bars i {{ background: #3f7cac; height: .8em; min-width: 1px; border-radius: 2px }}
.figures {{ display: flex; flex-wrap: wrap; gap: 1rem; align-items: flex-start }} figure {{ margin: 0; max-width: 100% }}
.pages figure {{ flex: 1 1 30%; max-width: 32% }}
img {{ max-width: 100%; height: auto; image-rendering: pixelated; border: 1px solid #e3e3e3 }}
svg text {{ font: 11px system-ui, sans-serif; fill: #444 }} svg .frame {{ fill: none; stroke: #ccc }} svg {{ max-width: 100% }}
.zoom {{ display: block; overflow: auto; max-height: 80vh; cursor: zoom-in }} .zoom input {{ display: none }}
.zoom input:checked + span img {{ cursor: zoom-out }} .zoom img {{ width: 100%; box-sizing: border-box }}
.pages figure:has(input:checked) {{ flex-basis: 100%; max-width: 100% }}
.finding {{ border-left: 4px solid #c0392b; padding: .1rem .8rem; margin: .8rem 0 }} .finding img {{ image-rendering: auto }}
details {{ margin: .6rem 0 }} summary {{ cursor: pointer }}
</style></head><body>
)";

std::string facts_html(const Pack& pack, const PackIndex& index) {
  const MeshBounds bounds = bounds_of(pack.mesh);
  const Vec3 size = bounds.upper - bounds.lower;
  return fmt::format(
      "<p>{} triangles in {} parts, {:.4g} × {:.4g} × {:.4g} m; {} materials, {} textures; {} lightmap pages; {} "
      "planar "
      "reflectors with {} radiance maps, {} curved ones with {} surround maps; {} movers; {} cameras, {} paths.</p>\n"
      "<p class=\"quiet\">{} bytes, format version {}. Constant sky of {:.4g}, {:.4g}, {:.4g} cd/m².</p>\n",
      pack.mesh.indices.size() / 3, pack.mesh.parts.size(), size.x, size.y, size.z, pack.materials.size(),
      pack.textures.size(), pack.lightmaps.size(), pack.reflectors.size(), pack.radiance_maps.size(),
      pack.curved_reflectors.size(), pack.surround_maps.size(), pack.movers.size(), pack.cameras.size(),
      pack.paths.size(), index.file_bytes, index.version, pack.sky.r, pack.sky.g, pack.sky.b);
}

std::string sizes_html(const PackIndex& index) {
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> kinds;  // sections, bytes
  for (const SectionInfo& section : index.sections) {
    const SectionKind* known = find_section_kind(section.kind);
    auto& [sections, bytes] = kinds[known == nullptr ? "unknown" : known->meaning];
    ++sections, bytes += section.stored_bytes;
  }
  std::vector<Bar> bars;
  for (const auto& [name, kind] : kinds)
    bars.push_back({fmt::format("{} ({})", name, kind.first), static_cast<double>(kind.second),
                    fmt::format("{:.1f} kB, {:.1f} %", static_cast<double>(kind.second) / 1000,
                                100 * static_cast<double>(kind.second) / static_cast<double>(index.file_bytes))});
  std::stable_sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) { return a.value > b.value; });
  return bars.empty() ? "" : "<h2>Sizes</h2>\n" + bars_html(bars);
}

}  // namespace

std::string page_html(const Pack& pack, const PackIndex& index, const std::string& name, const Limits& limits) {
  std::string html = fmt::format(fmt::runtime(kHead), shown_text(name));
  html += "<h1>" + shown_text(name) + "</h1>\n" + facts_html(pack, index);
  html += findings_html(pack, limits) + errors_html(pack, limits) + lightmaps_html(pack, limits) +
          surfaces_html(pack, limits);
  html += reflections_html(pack, limits) + materials_html(pack, limits);
  return html + sizes_html(index) + records_html(pack, limits) + "</body></html>\n";
}

}  // namespace oriel::report
