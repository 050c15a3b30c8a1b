#include <algorithm>
#include <cmath>
#include <numeric>

#include "formats/core/color.h"
#include "formats/diff/part_light.h"
#include "formats/report/html.h"
#include "formats/report/picture.h"
#include "formats/report/sections.h"
#include "formats/report/summary.h"

namespace oriel::report {
namespace {

std::string figure(const std::string& img, const std::string& caption) {
  return "<figure>" + img + "<figcaption>" + shown_text(caption) + "</figcaption></figure>\n";
}

Raster light_raster(const LightmapPage& page, std::uint32_t longest) {
  return reduced(
      page.width, page.height, longest, [&](std::size_t i) { return page.irradiance[i]; },
      [&](std::size_t i) { return page.state[i] != TexelState::kEmpty; });
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

// RadianceMap or SurroundMap.
template <class Map>
Raster radiance_raster(const Map& map, std::uint32_t width, std::uint32_t height, std::uint32_t longest) {
  return reduced(
      width, height, longest, [&](std::size_t i) { return map.radiance[i]; },
      [&](std::size_t i) { return map.valid[i] != 0; });
}

std::string radiance_maps_html(const Pack& pack, const Limits& limits) {
  const std::size_t shown = std::min(limits.maps, pack.radiance_maps.size());
  if (shown == 0) return {};
  std::vector<Raster> rasters;
  for (std::size_t i = 0; i < shown; ++i) {
    const RadianceMap& m = pack.radiance_maps[i];
    rasters.push_back(flipped(radiance_raster(m, m.width, m.height, limits.map_side)));
  }
  const float white = white_of(rasters);
  std::string html = fmt::format(
      "<h3>Radiance maps</h3>\n<p class=\"quiet\">As the viewpoint behind the reflector sees them, up as on the plane; "
      "{:.4g} cd/m² is white, grey is not usable.</p>\n<div class=\"figures\">\n",
      white);
  for (std::size_t i = 0; i < shown; ++i) {
    const RadianceMap& m = pack.radiance_maps[i];
    const std::string name = fmt::format("{}: {}, {} × {}{}", i, pack.reflectors[m.reflector].name, m.width, m.height,
                                         m.residual ? ", residual" : "");
    html += figure(toned_img(rasters[i], white, "radiance map " + shown_text(name)), name);
  }
  return html + "</div>\n" + left_out(pack.radiance_maps.size(), shown, "radiance maps");
}

std::string surround_maps_html(const Pack& pack, const Limits& limits) {
  const std::size_t shown = std::min(limits.maps, pack.surround_maps.size());
  if (shown == 0) return {};
  std::vector<Raster> rasters;
  for (std::size_t i = 0; i < shown; ++i) {
    const SurroundMap& m = pack.surround_maps[i];
    rasters.push_back(radiance_raster(m, m.size, m.size, limits.map_side));
  }
  const float white = white_of(rasters);
  std::string html = fmt::format(
      "<h3>Surround maps</h3>\n<p class=\"quiet\">All directions around a point, octahedral; {:.4g} cd/m² is "
      "white.</p>\n<div class=\"figures\">\n",
      white);
  for (std::size_t i = 0; i < shown; ++i) {
    const std::string name = fmt::format("{}: {} × {}", i, pack.surround_maps[i].size, pack.surround_maps[i].size);
    html += figure(toned_img(rasters[i], white, "surround map " + name), name);
  }
  return html + "</div>\n" + left_out(pack.surround_maps.size(), shown, "surround maps");
}

}  // namespace

std::string lightmaps_html(const Pack& pack, const Limits& limits) {
  const std::size_t shown = std::min(limits.pages, pack.lightmaps.size());
  if (shown == 0) return {};
  std::vector<Raster> rasters;
  for (std::size_t i = 0; i < shown; ++i) rasters.push_back(light_raster(pack.lightmaps[i], limits.page_side));
  const float white = white_of(rasters);
  std::string html = fmt::format(
      "<h2>Lightmaps</h2>\n<p class=\"quiet\">Irradiance with {:.4g} lux as white, illuminance in false colour, and "
      "standard error over illuminance. Grey: no surface; in the last picture also what was filled from "
      "neighbours.</p>\n{}{}",
      white, legend_svg(kLuxScale), legend_svg(kErrorScale));
  for (std::size_t i = 0; i < shown; ++i) {
    const LightmapPage& page = pack.lightmaps[i];
    const LightmapSummary s = summarise(page);
    html += fmt::format(
        "<h3>Page {}</h3>\n<p class=\"quiet\">{} × {}, {} baked texels, {:.4g} to {:.4g} lux, mean {:.4g}, standard "
        "error {:.2g} %{}.</p>\n<div class=\"figures pages\">\n",
        i, page.width, page.height, s.states[3], s.min_lux, s.max_lux, s.mean_lux, 100 * s.error,
        page.direction.empty() ? "" : ", directional");
    html += figure(toned_img(rasters[i], white, "irradiance"), "irradiance");
    html += figure(heat_img(rasters[i], kLuxScale, "illuminance in false colour"), "illuminance");
    html += figure(heat_img(error_raster(page, limits.page_side), kErrorScale, "standard error in false colour"),
                   "standard error") +
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
  std::stable_sort(surfaces.begin(), surfaces.end(), [](const auto& a, const auto& b) {
    return a.second.mean * a.second.area_m2 > b.second.mean * b.second.area_m2;
  });
  Table table({"surface", "material", "m²", "least lux", "mean lux", "greatest lux", "standard error, lux", "lm"});
  const std::size_t shown = std::min(limits.surfaces, surfaces.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& [part, light] = surfaces[i];
    table.row({part->name, pack.materials[part->material].name, number_text(light.area_m2), number_text(light.lowest),
               number_text(light.mean), number_text(light.highest), number_text(std::sqrt(light.variance)),
               number_text(light.mean * light.area_m2)});
  }
  return "<h2>Surfaces</h2>\n<p class=\"quiet\">Those first that receive most light.</p>\n" + table.html() +
         left_out(surfaces.size(), shown, "surfaces");
}

std::string reflections_html(const Pack& pack, const Limits& limits) {
  std::string html;
  Table table({"reflector", "material", "m²", "elements", "maps", "lamps in closed form"});
  const std::size_t shown = std::min(limits.lines, pack.reflectors.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const Reflector& r = pack.reflectors[i];
    table.row({r.name, pack.materials[r.material].name, number_text(r.area_m2),
               fmt::format("{} × {}", r.elements_x, r.elements_y), fmt::format("{}", r.map_count),
               fmt::format("{}", r.emitters.size())});
  }
  if (!table.empty()) html += table.html() + left_out(pack.reflectors.size(), shown, "reflectors");
  html += radiance_maps_html(pack, limits) + surround_maps_html(pack, limits);
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
