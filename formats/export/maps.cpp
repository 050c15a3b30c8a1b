#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "formats/analysis/part_light.h"
#include "formats/core/color.h"
#include "formats/export/html.h"
#include "formats/export/picture.h"
#include "formats/export/sections.h"
#include "formats/export/summary.h"

namespace oriel::report {
namespace {

constexpr std::size_t kFewPages = 3;
constexpr double kSeenFloor = 0.1;  // of the mean light, that dark surfaces are judged by

std::string figure(const std::string& img, const std::string& caption) {
  return "<figure>" + img + "<figcaption>" + shown_text(caption) + "</figcaption></figure>\n";
}

Raster light_raster(const LightmapPage& page, std::uint32_t longest) {
  return reduced(
      page.width, page.height, longest, [&](std::size_t i) { return page.irradiance[i]; },
      [&](std::size_t i) { return page.state[i] != TexelState::kEmpty; });
}

// From the darkest hundredth of the baked texels to the brightest, out to 1, 2 or 5 of a decade.
HeatScale lux_scale(const Pack& pack, std::size_t pages) {
  std::vector<float> lux;
  for (std::size_t p = 0; p < pages; ++p) {
    const LightmapPage& page = pack.lightmaps[p];
    const std::size_t step = std::max<std::size_t>(1, page.state.size() / 65536);
    for (std::size_t i = 0; i < page.state.size(); i += step)
      if (page.state[i] == TexelState::kValid && luminance(page.irradiance[i]) > 0)
        lux.push_back(luminance(page.irradiance[i]));
  }
  if (lux.empty()) return kLuxScale;
  std::sort(lux.begin(), lux.end());
  const auto rounded = [](float value, bool up) {
    const double decade = std::pow(10, std::floor(std::log10(double{value})));
    const double share = value / decade;
    if (up) return static_cast<float>(decade * (share > 5 ? 10 : share > 2 ? 5 : share > 1 ? 2 : 1));
    return static_cast<float>(decade * (share >= 5 ? 5 : share >= 2 ? 2 : 1));
  };
  const float low = rounded(std::max(lux[lux.size() / 100], 1e-4f * lux.back()), false);
  return {low, std::max(rounded(lux[lux.size() - 1 - lux.size() / 200], true), 10 * low), "lux"};
}

// A picture that a click shows three times as large, and its scale below it.
std::string zoomed(const std::string& img, const std::string& caption, const std::string& legend = "") {
  return "<figure><label class=\"zoom\"><input type=\"checkbox\"><span>" + img + "</span></label>" + legend +
         "<figcaption>" + shown_text(caption) + "</figcaption></figure>\n";
}

// Standard error over illuminance, of the baked texels.
Raster error_raster(const LightmapPage& page, std::uint32_t longest) {
  return reduced(
      page.width, page.height, longest,
      [&](std::size_t i) {
        const float lux = luminance(page.irradiance[i]);
        return Vec3(lux > 0 ? luminance(page.standard_error[i]) / lux : 0);
      },
      [&](std::size_t i) { return page.state[i] == TexelState::kValid; });
}

// Of RadianceMaps or SurroundMaps. named: what they are called; shown_as: of a map, its name and picture.
template <class Map, class ShownAs>
std::string maps_html(const std::vector<Map>& maps, const Limits& limits, const std::array<std::string_view, 3>& named,
                      const ShownAs& shown_as) {
  const std::size_t shown = std::min(limits.maps, maps.size());
  if (shown == 0) return {};
  const auto& [heading, kind, explained] = named;
  std::vector<std::string> names;
  std::vector<Raster> rasters;
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& [name, width, height] = shown_as(maps[i]);
    names.push_back(fmt::format("{}: {}{} × {}", i, name, width, height));
    rasters.push_back(reduced(
        width, height, limits.map_side, [&](std::size_t k) { return maps[i].radiance[k]; },
        [&](std::size_t k) { return maps[i].valid[k] != 0; }));
    if constexpr (std::is_same_v<Map, RadianceMap>) rasters.back() = flipped(rasters.back());
  }
  const float white = white_of(rasters);
  std::string html = fmt::format(
      "<h3>{}</h3>\n<p class=\"quiet\">{} {:.4g} cd/m² is white, grey is not usable.</p>\n"
      "<div class=\"figures\">\n",
      heading, explained, white);
  for (std::size_t i = 0; i < shown; ++i)
    html += figure(toned_img(rasters[i], white, fmt::format("{} {}", kind, shown_text(names[i]))), names[i]);
  return html + "</div>\n" + left_out(maps.size(), shown, fmt::format("{}s", kind));
}

}  // namespace

std::string lightmaps_html(const Pack& pack, const Limits& limits) {
  const std::size_t shown = std::min(limits.pages, pack.lightmaps.size());
  if (shown == 0) return {};
  // Few pages may be seen finer.
  const std::uint32_t side = shown <= kFewPages ? 2 * limits.page_side : limits.page_side;
  std::vector<Raster> rasters;
  for (std::size_t i = 0; i < shown; ++i) rasters.push_back(light_raster(pack.lightmaps[i], side));
  const float white = white_of(rasters);
  const HeatScale scale = lux_scale(pack, shown);
  std::string html = fmt::format(
      "<h2>Lightmaps</h2>\n<p class=\"quiet\">Irradiance with {:.4g} lux as white, illuminance in false colour, and "
      "each "
      "texel's standard error over its illuminance. Grey: no surface; in the last picture also what was filled from "
      "neighbours. A click shows a picture three times as large, and back.</p>\n",
      white);
  for (std::size_t i = 0; i < shown; ++i) {
    const LightmapPage& page = pack.lightmaps[i];
    const LightmapSummary s = summarise(page);
    html += fmt::format(
        "<h3>Page {}</h3>\n<p class=\"quiet\">{} × {}, {} baked texels, {:.4g} to {:.4g} lux, mean {:.4g}, standard "
        "error {:.2g} %{}.</p>\n<div class=\"figures pages\">\n",
        i, page.width, page.height, s.states[3], s.min_lux, s.max_lux, s.mean_lux, 100 * s.error,
        page.direction.empty() ? "" : ", directional");
    html += zoomed(toned_img(rasters[i], white, "irradiance"), "irradiance");
    html += zoomed(heat_img(rasters[i], scale, "illuminance in false colour"), "illuminance", legend_svg(scale));
    html += zoomed(heat_img(error_raster(page, side), kErrorScale, "standard error in false colour"), "standard error",
                   legend_svg(kErrorScale)) +
            "</div>\n";
  }
  return html + left_out(pack.lightmaps.size(), shown, "pages");
}

std::string surfaces_html(const Pack& pack, const Limits& limits) {
  std::vector<std::pair<const MeshPart*, PartLight>> surfaces;
  for (const MeshPart& part : pack.mesh.parts)
    if (part.lightmap_page >= 0 && part.index_count > 0)
      surfaces.emplace_back(&part, light_of(PartSampler(pack, part), limits.surface_points));
  if (surfaces.empty()) return {};
  double light = 0, area = 0;
  for (const auto& [part, of] : surfaces) light += of.mean * of.area_m2, area += of.area_m2;
  const double floor = area > 0 ? kSeenFloor * light / area : 0;
  // As frames' errors are: of dark surfaces to a tenth of the mean.
  const auto error_of = [&](const PartLight& of) {
    const double beside = std::sqrt(of.mean * of.mean + floor * floor);
    return beside > 0 ? std::sqrt(of.variance) / beside : 0;
  };
  std::stable_sort(surfaces.begin(), surfaces.end(), [&](const auto& a, const auto& b) {
    return error_of(a.second) * std::sqrt(a.second.area_m2) > error_of(b.second) * std::sqrt(b.second.area_m2);
  });
  Table table({"surface", "material", "m²", "least lux", "mean lux", "greatest lux", "standard error, lux",
               "standard error as seen", "lm"});
  const std::size_t shown = std::min(limits.surfaces, surfaces.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& [part, of] = surfaces[i];
    table.row({part->name, pack.materials[part->material].name, number_text(of.area_m2), number_text(of.lowest),
               number_text(of.mean), number_text(of.highest), number_text(std::sqrt(of.variance)),
               fmt::format("{:.2g} %", 100 * error_of(of)), number_text(of.mean * of.area_m2)});
  }
  return "<h2>Surfaces</h2>\n<p class=\"quiet\">By node. Those first whose error shows most: relative to their light "
         "and "
         "a tenth of the mean, over more area.</p>\n" +
         table.html() + left_out(surfaces.size(), shown, "surfaces");
}

std::string reflections_html(const Pack& pack, const Limits& limits) {
  std::string html;
  Table table({"reflector", "material", "m²", "elements", "maps", "lamps in closed form"});
  const std::size_t shown = std::min(limits.lines, pack.reflectors.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const Reflector& r = pack.reflectors[i];
    table.row({r.name, pack.materials[r.material].name, number_text(r.area_m2),
               fmt::format("{} × {}", r.elements_x, r.elements_y),
               r.map_count > 0 ? fmt::format("{}", r.map_count) : "mirrored geometry",
               fmt::format("{}", r.emitters.size())});
  }
  if (!table.empty()) html += table.html() + left_out(pack.reflectors.size(), shown, "reflectors");
  html += maps_html(
      pack.radiance_maps, limits,
      {"Radiance maps", "radiance map", "As the viewpoint behind the reflector sees them, up as on the plane;"},
      [&](const RadianceMap& m) { return std::tuple(pack.reflectors[m.reflector].name + ", ", m.width, m.height); });
  html += maps_html(pack.surround_maps, limits,
                    {"Surround maps", "surround map", "All directions around a point, octahedral;"},
                    [](const SurroundMap& m) { return std::tuple("", m.size, m.size); });
  return html.empty() ? "" : "<h2>Reflections</h2>\n" + html;
}

std::string materials_html(const Pack& pack, const Limits& limits) {
  std::string html;
  const std::size_t kernels = std::min(limits.materials, pack.kernels.size()),
                    fresnels = std::min(limits.materials, pack.fresnel_maps.size());
  if (kernels > 0)
    html +=
        "<h3>Kernels</h3>\n<p class=\"quiet\">The lobe around the mirror ray; its greatest weight is "
        "white.</p>\n<div class=\"figures\">\n";
  for (std::size_t i = 0; i < kernels; ++i) {
    const BrdfKernel& k = pack.kernels[i];
    const auto most = std::max_element(k.weights.begin(), k.weights.end());
    const Raster raster = reduced(
        k.size, k.size, limits.map_side, [&](std::size_t w) { return Vec3(k.weights[w]); },
        [](std::size_t) { return true; });
    const float white = most != k.weights.end() && *most > 0 ? *most : 1;
    html += figure(toned_img(raster, white, fmt::format("kernel {}", i)),
                   fmt::format("{}: α {:.3g}, {} × {}, keeps {:.3g} %, {} incidences", i, k.alpha, k.size, k.size,
                               100 * k.energy_kept, k.slices.size()));
  }
  if (kernels > 0) html += "</div>\n" + left_out(pack.kernels.size(), kernels, "kernels");
  if (fresnels > 0)
    html +=
        "<h3>Reflectances</h3>\n<p class=\"quiet\">Red, green and blue by angle of incidence.</p>\n"
        "<div class=\"figures\">\n";
  for (std::size_t i = 0; i < fresnels; ++i) {
    constexpr int kSteps = 90;
    std::vector<Vec3> by_angle;
    for (int d = 0; d <= kSteps; ++d)
      by_angle.push_back(lookup_by_cosine(pack.fresnel_maps[i].table, std::cos(static_cast<float>(d) * kPi / 180)));
    html += curves_svg(fmt::format("{}: α {:.3g}", i, pack.fresnel_maps[i].alpha), by_angle);
  }
  if (fresnels > 0) html += "</div>\n" + left_out(pack.fresnel_maps.size(), fresnels, "Fresnel maps");
  return html.empty() ? "" : "<h2>Materials</h2>\n" + html;
}

}  // namespace oriel::report
