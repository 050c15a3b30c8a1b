#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/export/summary.h"
#include "formats/inspect/commands.h"
#include "formats/inspect/info_maps.h"
#include "formats/pack/index.h"
#include "formats/pack/reader.h"
#include "formats/pack/validate.h"
#include "formats/query/day_hours.h"

namespace oriel::inspect {
namespace {

std::size_t valid_probes(const LightField& field) {
  return static_cast<std::size_t>(
      std::count_if(field.probes.begin(), field.probes.end(), [](const LightProbe& probe) { return probe.valid; }));
}

Json sections_json(const PackIndex& index) {
  Json out = Json::array();
  for (const auto& section : index.sections) {
    const auto* known = find_section_kind(section.kind);
    out.push_back({{"kind", kind_text(section.kind)},
                   {"meaning", known ? known->meaning : "unknown"},
                   {"optional", section.optional},
                   {"codec", section.codec},
                   {"offset", section.offset},
                   {"stored_bytes", section.stored_bytes},
                   {"raw_bytes", section.raw_bytes},
                   {"count", section.count},
                   {"checksum", fmt::format("{:016x}", section.checksum)}});
  }
  return out;
}

Json mesh_json(const Mesh& mesh) {
  const MeshBounds bounds = bounds_of(mesh);
  Json parts = Json::array();
  for (const auto& part : mesh.parts)
    parts.push_back({{"name", part.name},
                     {"triangles", part.index_count / 3},
                     {"material", part.material},
                     {"lightmap_page", part.lightmap_page}});
  return {{"vertices", mesh.positions.size()},
          {"triangles", mesh.indices.size() / 3},
          {"has_colors", !mesh.colors.empty()},
          {"origin", {mesh.origin.x, mesh.origin.y, mesh.origin.z}},
          {"lower", triple(bounds.lower)},
          {"upper", triple(bounds.upper)},
          {"parts", parts}};
}

Json movers_json(const Pack& pack) {
  Json out = Json::array();
  for (const Mover& m : pack.movers)
    out.push_back({{"name", m.name},
                   {"vertices", m.mesh.positions.size()},
                   {"triangles", m.mesh.indices.size() / 3},
                   {"position", triple(m.rest.position)},
                   {"keys", m.keys.size()},
                   {"transfer",
                    {{"bands", m.transfer.bands},
                     {"channels", m.transfer.channels},
                     {"clusters", m.transfer.clusters},
                     {"components", m.transfer.components},
                     {"bytes_per_vertex", m.transfer.bytes_per_vertex()},
                     {"relative_error", m.transfer.error}}}});
  return out;
}

// Lightmap pages that have any of its light.
std::vector<std::uint32_t> pages_of_group(const Pack& pack, std::size_t group) {
  std::vector<std::uint32_t> pages;
  for (const PageGroups& page : pack.page_groups)
    if (std::ranges::find(page.others, group, &GroupTexels::group) != page.others.end() ||
        std::ranges::find(page.rest, group) != page.rest.end())
      pages.push_back(page.page);
  return pages;
}

Json light_field_json(const LightField& field) {
  if (field.bands == 0) return Json();
  Json lights = Json::array();
  for (const BrightLight& light : field.lights) lights.push_back(light.name);
  return {{"bands", field.bands},           {"cells", {field.size[0], field.size[1], field.size[2]}},
          {"cell_m", triple(field.cell_m)}, {"lower", triple(field.lower)},
          {"probes", field.probes.size()},  {"valid_probes", valid_probes(field)},
          {"depth_side", field.depth_side}, {"relative_standard_error", field.error},
          {"bright_lights", lights}};
}

Json light_groups_json(const Pack& pack) {
  Json out = Json::array();
  for (std::size_t g = 0; g < pack.light_groups.size(); ++g) {
    const LightGroup& group = pack.light_groups[g];
    out.push_back({{"name", group.name},
                   {"lamps", group.lamps},
                   {"value", group.value},
                   {"color", triple(group.color)},
                   {"own_color", triple(group.own_color)},
                   {"sky", group.sky},
                   {"keys", group.keys.size()},
                   {"pages", pages_of_group(pack, g)}});
  }
  return out;
}

Json day_json(const Day& day) {
  if (day.empty()) return nullptr;
  Json hours = Json::array();
  for (const DayHour& hour : day.hours)
    hours.push_back({{"hour", hour.hour},
                     {"group", hour.group == kNight ? Json() : Json(hour.group)},
                     {"to_sun", triple(hour.to_sun)},
                     {"sun_lux", hour.sun_lux},
                     {"sky_lux", hour.sky_lux},
                     {"sky", triple(hour.sky)}});
  return {{"date", day.date},
          {"latitude_deg", day.latitude_deg},
          {"longitude_deg", day.longitude_deg},
          {"north_deg", day.north_deg},
          {"clock", clock_name(day)},
          {"sky_type", day.sky_type},
          {"shown_hour", day.shown_hour},
          {"hours", hours}};
}

Json materials_json(const Pack& pack) {
  Json out = Json::array();
  for (const auto& m : pack.materials)
    out.push_back({{"name", m.name},
                   {"roughness", m.roughness},
                   {"metallic", m.metallic},
                   {"texture", m.base_color_texture},
                   {"normal_texture", m.normal_texture},
                   {"normal_scale", m.normal_scale},
                   {"kernel", m.kernel},
                   {"fresnel_map", m.fresnel_map}});
  return out;
}

Json small_maps_json(const Pack& pack, Json out) {
  out["textures"] = Json::array();
  for (const auto& t : pack.textures)
    out["textures"].push_back({{"name", t.name}, {"width", t.width}, {"height", t.height}});
  out["kernels"] = Json::array();
  for (const auto& k : pack.kernels)
    out["kernels"].push_back({{"size", k.size},
                              {"alpha", k.alpha},
                              {"cos_theta", k.cos_theta},
                              {"half_extent", k.half_extent},
                              {"energy_kept", k.energy_kept},
                              {"incidences", k.slices.size()},
                              {"cosine_lobes", k.fits.size()}});
  out["fresnel_maps"] = Json::array();
  for (const auto& f : pack.fresnel_maps)
    out["fresnel_maps"].push_back({{"alpha", f.alpha}, {"table_entries", f.table.size()}});
  out["cameras"] = Json::array();
  for (const auto& c : pack.cameras) out["cameras"].push_back(c.name);
  out["paths"] = Json::array();
  for (const auto& p : pack.paths) {
    Json eyes = Json::array();
    for (const CameraKey& key : p.keys) eyes.push_back(triple(key.eye));
    out["paths"].push_back({{"name", p.name}, {"keys", p.keys.size()}, {"eyes", eyes}});
  }
  return out;
}

struct SetsSummary {
  std::size_t cells = 0;
  double seen = 0;  // share of the groups, mean over the cells
};

SetsSummary summarise(const VisibleSets& sets) {
  SetsSummary s{sets.seen.size() / sets.set_bytes(), 0};
  for (const std::uint8_t byte : sets.seen) s.seen += std::popcount(byte);
  s.seen /= std::max(1.0, static_cast<double>(s.cells) * sets.groups);
  return s;
}

Json visible_sets_json(const Pack& pack) {
  const VisibleSets& sets = pack.visible_sets;
  if (sets.empty()) return Json();
  const SetsSummary s = summarise(sets);
  return {{"groups", sets.groups},   {"runs", sets.runs.size()},
          {"eye_cells", s.cells},    {"side", sets.side},
          {"below_m", sets.below_m}, {"above_m", sets.above_m},
          {"seen_share", s.seen},    {"made_for_this", made_for(sets, pack.mesh, pack.materials, pack.walk_grids)}};
}

void print_visible_sets(const Pack& pack) {
  const VisibleSets& sets = pack.visible_sets;
  if (sets.empty()) return;
  const SetsSummary s = summarise(sets);
  if (s.cells == 0) {
    fmt::print("visible sets: {} groups of triangles in {} runs alone, for what mirrors show\n", sets.groups,
               sets.runs.size());
    return;
  }
  fmt::print(
      "visible sets: {} groups of triangles in {} runs, {} eye cells of {} x {} walk cells, {:.3g} % seen on the "
      "mean{}\n",
      sets.groups, sets.runs.size(), s.cells, sets.side, sets.side, 100 * s.seen,
      made_for(sets, pack.mesh, pack.materials, pack.walk_grids) ? "" : ", for another mesh: ignored");
}

Json describe(const std::filesystem::path& path, const PackIndex& index, const Pack& pack) {
  Json out;
  out["schema"] = kJsonSchema;
  out["file"] = path.string();
  out["version"] = index.version;
  out["bytes"] = index.file_bytes;
  // validate() has seen that these are JSON objects, or empty.
  out["provenance"] = pack.provenance.empty() ? Json() : Json::parse(pack.provenance).value();
  out["plan"] = pack.plan.empty() ? Json() : Json::parse(pack.plan).value();
  out["sections"] = sections_json(index);
  out["mesh"] = mesh_json(pack.mesh);
  out["sky"] = triple(pack.sky);
  out["materials"] = materials_json(pack);
  add_lightmaps(index, pack, out);
  add_reflections(index, pack, out);
  out["visible_sets"] = visible_sets_json(pack);
  out["movers"] = movers_json(pack);
  out["light_field"] = light_field_json(pack.light_field);
  out["light_groups"] = light_groups_json(pack);
  out["day"] = day_json(pack.day);
  return small_maps_json(pack, std::move(out));
}

void print_sections(const PackIndex& index) {
  // Kinds with a section an element share a line.
  fmt::print("\nsections           number     stored bytes        raw bytes\n");
  for (std::size_t i = 0; i < index.sections.size();) {
    const auto kind = index.sections[i].kind;
    const auto* known = find_section_kind(kind);
    std::uint64_t number = 0, stored = 0, raw = 0;
    for (; i < index.sections.size() && index.sections[i].kind == kind; ++i) {
      number += index.sections[i].count;
      stored += index.sections[i].stored_bytes;
      raw += index.sections[i].raw_bytes;
    }
    fmt::print("{} {:<14}{:>6} {:>16} {:>16}\n", kind_text(kind), known ? known->meaning : "unknown", number, stored,
               raw);
  }
}

// A line a kind, and one a kernel: there may be many.
void print_material_maps(const Pack& pack) {
  for (std::size_t i = 0; i < pack.kernels.size(); ++i) {
    const BrdfKernel& k = pack.kernels[i];
    fmt::print("kernel {}: alpha {:.4g}, {} x {}, keeps {:.4g} of the lobe", i, k.alpha, k.size, k.size, k.energy_kept);
    if (!k.slices.empty()) {
      const auto& widest = std::max_element(k.slices.begin(), k.slices.end(), [](const auto& a, const auto& b) {
        return std::abs(a.tilt_rad) < std::abs(b.tilt_rad);
      });
      fmt::print("; {} incidences of {} x {}, up to {:.3g} degrees off the mirror direction", k.slices.size(),
                 k.slice_size, k.slice_size, widest->tilt_rad * 180 / kPi);
    }
    fmt::print("\n");
  }
  if (pack.fresnel_maps.empty()) return;
  std::size_t least = pack.fresnel_maps[0].table.size(), most = 0;
  float low = 1, high = 0;
  for (const FresnelMap& map : pack.fresnel_maps) {
    least = std::min(least, map.table.size());
    most = std::max(most, map.table.size());
    low = std::min(low, map.alpha);
    high = std::max(high, map.alpha);
  }
  fmt::print("{} Fresnel maps: alpha {:.4g} to {:.4g}, tables of {} to {} entries\n", pack.fresnel_maps.size(), low,
             high, least, most);
}

void print_maps(const PackIndex& index, const Pack& pack) {
  print_lightmaps(index, pack);
  print_reflections(index, pack);
  print_material_maps(pack);
}

void print_day(const Day& day) {
  if (day.empty()) return;
  fmt::print("day {} at {:g}, {:g} ({}), sky of type {}; texels hold the mean of {} hours, the pack opens at {}\n",
             day.date, day.latitude_deg, day.longitude_deg, clock_name(day), day.sky_type, day.lit(),
             clock_text(day.shown_hour));
  for (const DayHour& hour : day.hours)
    if (hour.group == kNight)
      fmt::print("hour {}: night\n", clock_text(hour.hour));
    else
      fmt::print("hour {}: sun {:.1f}° high, {:.0f} lux facing it, sky {:.0f} lux on level ground\n",
                 clock_text(hour.hour), std::asin(std::clamp(hour.to_sun.y, -1.0f, 1.0f)) * 180 / kPi, hour.sun_lux,
                 hour.sky_lux);
}

void print_movers(const Pack& pack) {
  for (const Mover& m : pack.movers)
    fmt::print(
        "mover '{}': {} triangles, {} keys, transfer of {} bands in {} clusters, {} bytes a vertex, error {:.2g} %\n",
        m.name, m.mesh.indices.size() / 3, m.keys.size(), m.transfer.bands, m.transfer.clusters,
        m.transfer.bytes_per_vertex(), 100 * m.transfer.error);
  for (std::size_t g = 0; g < pack.light_groups.size(); ++g) {
    const LightGroup& group = pack.light_groups[g];
    fmt::print("light group '{}': {} lamps ({}{}), light on {} lightmap pages{}\n", group.name, group.lamps.size(),
               group.lamps.empty() ? "" : group.lamps.front(), group.lamps.size() > 1 ? ", …" : "",
               pages_of_group(pack, g).size(),
               group.keys.empty() ? "" : fmt::format(", {} keys of an animation", group.keys.size()));
  }
  const LightField& field = pack.light_field;
  if (field.bands > 0)
    fmt::print("light field: {} x {} x {} cells, {} of {} probes valid, {} bands, {} bright lights, noise {:.2g} %\n",
               field.size[0], field.size[1], field.size[2], valid_probes(field), field.probes.size(), field.bands,
               field.lights.size(), 100 * field.error);
}

void print_text(const std::filesystem::path& path, const PackIndex& index, const Pack& pack) {
  const MeshBounds bounds = bounds_of(pack.mesh);
  const Vec3 size = bounds.upper - bounds.lower;
  fmt::print("{}: {} bytes, format version {}\n", path.string(), index.file_bytes, index.version);
  fmt::print("mesh: {} triangles, {} vertices, {} parts, {:.4g} x {:.4g} x {:.4g} m around ({:.6g}, {:.6g}, {:.6g})\n",
             pack.mesh.indices.size() / 3, pack.mesh.positions.size(), pack.mesh.parts.size(), size.x, size.y, size.z,
             pack.mesh.origin.x, pack.mesh.origin.y, pack.mesh.origin.z);
  fmt::print("{} materials, {} textures, {} normal textures, sky ({:.4g}, {:.4g}, {:.4g}) cd/m2\n",
             pack.materials.size(), pack.textures.size(), pack.normal_textures.size(), pack.sky.r, pack.sky.g,
             pack.sky.b);
  print_sections(index);
  fmt::print("\n");
  print_maps(index, pack);
  print_visible_sets(pack);
  print_day(pack.day);
  print_movers(pack);
  for (const auto& camera : pack.cameras) fmt::print("camera '{}'\n", camera.name);
  for (const auto& p : pack.paths) fmt::print("path '{}': {} keys\n", p.name, p.keys.size());
  for (const auto& [name, text] : {std::pair("provenance", &pack.provenance), std::pair("plan", &pack.plan)})
    if (!text->empty()) fmt::print("\n{}: {}\n", name, Json::parse(*text).value().dump(2));
}

}  // namespace

int info(const std::filesystem::path& path, bool json) {
  const auto file = read_file(path);
  if (!file) return report(file.error());
  const auto at_path = [&](Error error) {
    error.where = error.where.empty() ? path.string() : path.string() + ": " + error.where;
    return report(error);
  };
  const auto index = read_index(*file);
  if (!index) return at_path(index.error());
  const auto pack = decode_pack(*file);
  if (!pack) return at_path(pack.error());
  for (const auto& issue : oriel::validate(*pack))
    if (issue.severity == Severity::kError)
      return at_path({ErrorCode::kInvalid, fmt::format("issue {}: {}", issue.number, issue.message), issue.section});
  if (json)
    fmt::print("{}\n", describe(path, *index, *pack).dump(2));
  else
    print_text(path, *index, *pack);
  return 0;
}

}  // namespace oriel::inspect
