#include "formats/inspect/info_maps.h"

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

// As stored, valid pixels or not; 0 where there are none.
double radiance_bytes_per_pixel(const PackIndex& index, const Pack& pack) {
  double bytes = 0, pixels = 0;
  for (const auto& section : index.sections)
    if (section.kind == kRadianceMapSection) bytes += static_cast<double>(section.stored_bytes);
  for (const auto& map : pack.radiance_maps) pixels += static_cast<double>(map.valid.size());
  return pixels > 0 ? bytes / pixels : 0;
}

Json reflectors_json(const Pack& pack) {
  Json out = Json::array();
  for (const auto& r : pack.reflectors)
    out.push_back({{"name", r.name},
                   {"material", r.material},
                   {"way", r.map_count > 0 ? "maps" : "geometry"},
                   {"area_m2", r.area_m2},
                   {"centre", triple(Vec3(r.pack_from_reflector * Vec4(0.5f * (r.lower + r.upper), 0, 1)))},
                   {"normal", triple(Vec3(r.pack_from_reflector[2]))},
                   {"flatness_m", r.flatness_m},
                   {"elements", {r.elements_x, r.elements_y}},
                   {"first_map", r.first_map},
                   {"map_count", r.map_count},
                   {"emitters", r.emitters},
                   {"visibility_nodes", {r.visibility_x, r.visibility_y}}});
  return out;
}

Json frosted_panes_json(const Pack& pack) {
  Json out = Json::array();
  for (const auto& pane : pack.frosted_panes)
    out.push_back({{"name", pane.name},
                   {"material", pane.material},
                   {"area_m2", pane.area_m2},
                   {"lit_from", triple(Vec3(pane.pack_from_reflector[2]))},
                   {"emitters", pane.emitters},
                   {"visibility_nodes", {pane.visibility_x, pane.visibility_y}}});
  return out;
}

Json radiance_maps_json(const Pack& pack) {
  Json out = Json::array();
  for (const auto& map : pack.radiance_maps) {
    const auto s = summarise(map);
    out.push_back({{"reflector", map.reflector},
                   {"width", map.width},
                   {"height", map.height},
                   {"eye", triple(map.eye)},
                   {"has_emission", map.has_emission},
                   {"pixels", {{"invalid", s.pixels[0]}, {"surface", s.pixels[1]}, {"sky", s.pixels[2]}}},
                   {"radiance", {{"mean", s.mean}, {"max", s.max}}}});
  }
  return out;
}

// Curved reflectors and what surrounds them.
Json curved_reflectors_json(const Pack& pack) {
  Json out = Json::array();
  for (const auto& r : pack.curved_reflectors)
    out.push_back(
        {{"name", r.name}, {"material", r.material}, {"surround_map", r.map}, {"triangles", r.indices.size() / 3}});
  return out;
}

Json surround_maps_json(const Pack& pack) {
  Json out = Json::array();
  for (const auto& map : pack.surround_maps) {
    const auto s = summarise(map);
    out.push_back({{"size", map.size},
                   {"centre", triple(map.centre)},
                   {"texels", {{"invalid", s.pixels[0]}, {"surface", s.pixels[1]}, {"sky", s.pixels[2]}}},
                   {"radiance", {{"mean", s.mean}, {"max", s.max}}}});
  }
  return out;
}

Json emitters_json(const Pack& pack) {
  Json out = Json::array();
  for (const auto& e : pack.emitters) {
    Json corners = Json::array();
    for (const Vec3& corner : e.corners) corners.push_back(triple(corner));
    out.push_back({{"corners", corners}, {"radiance", triple(e.radiance)}, {"two_sided", e.two_sided}});
  }
  return out;
}

Json walk_grids_json(const Pack& pack) {
  Json out = Json::array();
  for (const auto& g : pack.walk_grids)
    out.push_back({{"lower", {g.lower.x, g.lower.y}},
                   {"cell_m", g.cell_m},
                   {"width", g.width},
                   {"height", g.height},
                   {"walkable_m2", g.walkable_m2()},
                   {"eye_height_m", g.eye_height_m}});
  return out;
}

// Of a reflector without maps.
std::string shows_text(const Pack& pack, std::size_t reflector) {
  const VisibleSets& groups = pack.visible_sets;
  const std::vector<std::uint8_t>& sets = pack.reflected_sets.seen;
  if (sets.size() < (reflector + 1) * groups.set_bytes() || groups.empty()) return "the mirrored scene";
  const std::uint8_t* set = sets.data() + reflector * groups.set_bytes();
  std::uint64_t seen = 0;
  for (const TriangleRun& run : groups.runs)
    if (set[run.group / 8] >> (run.group % 8) & 1) seen += run.index_count / 3;
  return fmt::format("the mirrored scene: {} of {} triangles may be seen in it", seen, pack.mesh.indices.size() / 3);
}

void print_planar(const PackIndex& index, const Pack& pack) {
  for (std::size_t i = 0; i < pack.reflectors.size(); ++i) {
    const auto& r = pack.reflectors[i];
    const std::string way = r.map_count > 0 ? fmt::format("{} x {} elements, {} radiance maps from {}", r.elements_x,
                                                          r.elements_y, r.map_count, r.first_map)
                                            : shows_text(pack, i);
    fmt::print("reflector {}: '{}', {:.4g} m2, material {}, {}{}\n", i, r.name, r.area_m2, r.material, way,
               r.emitters.empty() ? "" : fmt::format(", {} emitters in closed form", r.emitters.size()));
  }
  for (std::size_t i = 0; i < pack.frosted_panes.size(); ++i) {
    const auto& pane = pack.frosted_panes[i];
    fmt::print("frosted pane {}: '{}', {:.4g} m2, material {}, {} emitters shine on it\n", i, pane.name, pane.area_m2,
               pane.material, pane.emitters.size());
  }
  for (std::size_t i = 0; i < pack.radiance_maps.size(); ++i) {
    const auto& map = pack.radiance_maps[i];
    const auto s = summarise(map);
    fmt::print("radiance map {}: {} x {} of reflector {}, {:.3g} % surface, mean {:.4g} cd/m2, max {:.4g}\n", i,
               map.width, map.height, map.reflector,
               100.0 * static_cast<double>(s.pixels[1]) / static_cast<double>(map.valid.size()), s.mean, s.max);
  }
  if (!pack.radiance_maps.empty())
    fmt::print("{} radiance maps: {:.3g} bytes a pixel as stored\n", pack.radiance_maps.size(),
               radiance_bytes_per_pixel(index, pack));
}

void print_curved(const Pack& pack) {
  for (std::size_t i = 0; i < pack.curved_reflectors.size(); ++i) {
    const auto& r = pack.curved_reflectors[i];
    fmt::print("curved reflector {}: '{}', {} triangles, material {}, surround map {}\n", i, r.name,
               r.indices.size() / 3, r.material, r.map);
  }
  for (std::size_t i = 0; i < pack.surround_maps.size(); ++i) {
    const auto& map = pack.surround_maps[i];
    const auto s = summarise(map);
    fmt::print(
        "surround map {}: {} x {} around ({:.4g}, {:.4g}, {:.4g}), {:.3g} % surface, mean {:.4g} cd/m2, max {:.4g}\n",
        i, map.size, map.size, map.centre.x, map.centre.y, map.centre.z,
        100.0 * static_cast<double>(s.pixels[1]) / static_cast<double>(map.valid.size()), s.mean, s.max);
  }
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

Json triple(const Vec3& v) {
  return {v.x, v.y, v.z};
}

void add_reflections(const PackIndex& index, const Pack& pack, Json& out) {
  out["reflectors"] = reflectors_json(pack);
  out["frosted_panes"] = frosted_panes_json(pack);
  out["radiance_maps"] = radiance_maps_json(pack);
  out["radiance_map_bytes_per_pixel"] = radiance_bytes_per_pixel(index, pack);
  out["emitters"] = emitters_json(pack);
  out["curved_reflectors"] = curved_reflectors_json(pack);
  out["surround_maps"] = surround_maps_json(pack);
  out["walk_grids"] = walk_grids_json(pack);
}

void print_reflections(const PackIndex& index, const Pack& pack) {
  print_planar(index, pack);
  print_curved(pack);
  for (std::size_t i = 0; i < pack.walk_grids.size(); ++i) {
    const auto& g = pack.walk_grids[i];
    fmt::print("walk grid {}: {} x {} cells of {:.3g} m, {:.4g} m2 walkable, eyes {:.3g} m over the floor\n", i,
               g.width, g.height, g.cell_m, g.walkable_m2(), g.eye_height_m);
  }
}

}  // namespace oriel::inspect
