#include "bake/run/report.h"

#include "bake/jobs/unit_cache.h"
#include "bake/radiosity/texels/frame_error.h"
#include "bake/run/option_table.h"
#include "bake/run/version.h"
#include "formats/core/half.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

Json rgb(const Vec3& v) {
  return {v.r, v.g, v.b};
}
Json rgb(const DVec3& v) {
  return {v.r, v.g, v.b};
}

// Names come from files and may hold any bytes.
std::string text_of(const Json& json) {
  return json.dump(2);
}

Json detail_json(const DetailReport& r) {
  return {{"cells", r.cells},
          {"points", r.points},
          {"relative_error", r.relative_error},
          {"unresolved", r.unresolved},
          {"left_out", r.left_out}};
}

Json seams_json(const SeamReport& r) {
  return {{"stitched", r.pairs},
          {"mean_step_before", r.mean_step_before},
          {"max_step_before", r.max_step_before},
          {"mean_step", r.mean_step},
          {"max_step", r.max_step},
          {"energy_change", r.energy_change},
          {"moved", r.moved}};
}

Json atlas_json(const Atlas& atlas) {
  const AtlasReport& r = atlas.report;
  return {{"pages", atlas.pages.size()},
          {"charts", atlas.chart_count},
          {"texel_m", atlas.texel_m},
          {"covered_share", atlas.covered_share},
          {"overlapping_texels", r.overlapping_texels},
          {"l2_stretch", r.l2_stretch},
          {"linf_stretch", r.linf_stretch},
          {"angle_distortion", r.angle_distortion},
          {"area_distortion", r.area_distortion},
          {"time_limit_struck", r.time_limit_struck}};
}

// Planar ones with what their maps show to eyes that they were not planned for.
Json reflectors_json(const BakeFacts& f) {
  Json out = Json::array();
  for (std::size_t i = 0; i < f.pack.reflectors.size(); ++i) {
    const Reflector& r = f.pack.reflectors[i];
    std::uint64_t pixels = 0;
    for (std::uint32_t m = 0; m < r.map_count; ++m) {
      const RadianceMap& map = f.pack.radiance_maps[r.first_map + m];
      pixels += std::uint64_t{map.width} * map.height;
    }
    out.push_back({{"name", r.name},
                   {"kind", "planar"},
                   {"why", fmt::format("within {:.2g} m of a plane", r.flatness_m)},
                   {"way", r.map_count > 0 ? "maps" : "geometry"},
                   {"why_that_way", f.reflections.ways[i]},
                   {"area_m2", r.area_m2},
                   {"elements", r.elements_x * r.elements_y},
                   {"maps", r.map_count},
                   {"pixels", pixels}});
    if (r.map_count == 0) continue;
    out.back().update({{"seen", f.reflections.quality[i].seen},
                       {"seen_by_worst_camera", f.reflections.quality[i].worst},
                       {"sharp", f.reflections.quality[i].sharp},
                       {"relative_error", f.reflections.errors[i].relative_error},
                       {"relative_error_of_seen", f.reflections.errors[i].seen_error}});
  }
  for (const CurvedReflector& r : f.pack.curved_reflectors)
    out.push_back({{"name", r.name},
                   {"kind", "curved"},
                   {"why", "curved, or flat in pieces too small for planar reflectors"},
                   {"triangles", r.indices.size() / 3},
                   {"map_size", f.pack.surround_maps[r.map].size}});
  return out;
}

// Root mean square of what a page's halves change, over baked texels, relative to their light and a tenth of the mean,
// as errors in frames are (frame_error.h).
double storage_error(const Pack& pack) {
  double squares = 0, count = 0, sum = 0;
  const auto each = [&](const auto& body) {
    for (const LightmapPage& page : pack.lightmaps) {
      float largest = 0;
      for (const Vec3& e : page.irradiance) largest = std::max(largest, max_component(e));
      // docs/notes/format.md: the brightest lies in [2^14, 2^15).
      const float scale = largest > 0 ? std::ldexp(1.0f, std::ilogb(largest) - 14) : 1.0f;
      for (std::size_t i = 0; i < page.irradiance.size(); ++i)
        for (int c = 0; c < 3 && page.state[i] == TexelState::kValid; ++c) body(page.irradiance[i][c], scale);
    }
  };
  each([&](float e, float) { sum += e, ++count; });
  if (!(sum > 0)) return 0;
  const double floor = kFrameFloor * sum / count;
  each([&](float e, float scale) {
    const double off = double{float_from_half(half_from_float(e / scale))} * scale - e;
    squares += off * off / (double{e} * e + floor * floor);
  });
  return std::sqrt(squares / count);
}

double largest_compression_error(const BakeFacts& f) {
  double most = 0;
  for (const MoverReport& m : f.movers) most = std::max<double>(most, m.compression_error);
  return most;
}

Json worst_json(const BakeFacts& f) {
  Json out = Json::array();
  for (const WorstPixel& w : f.radiosity.held_out_error.worst) {
    const DVec3 p = f.scene.origin + DVec3(w.position);
    out.push_back({{"surface", f.scene.surfaces[f.scene.triangle_surface[w.triangle]].name},
                   {"at", {p.x, p.y, p.z}},
                   {"baked_cd_m2", w.baked},
                   {"measured_cd_m2", w.paths},
                   {"share", w.share}});
  }
  return out;
}

Json certificate_json(const BakeFacts& f) {
  const HeldOutError& c = f.radiosity.held_out_error;
  return {{"pixels", c.pixels},
          {"paths", c.paths},
          {"bias", c.bias},
          {"bias_95_interval", c.bias_interval},
          {"relative_error", c.relative_error},
          {"relative_error_95_low", c.error_low},
          {"relative_error_95_high", c.error_high},
          {"rays", c.rays},
          {"worst", worst_json(f)}};
}

// What is off by how much, part by part: asked for, stated by the estimate itself, measured on what it did not know.
Json errors_json(const BakeFacts& f) {
  const HeldOutError& c = f.radiosity.held_out_error;
  Json diffuse = {{"component", "D"}};
  if (f.asked > 0) diffuse["asked"] = f.asked;
  diffuse["stated"] = f.radiosity.stated();
  if (c.pixels > 0) {
    diffuse["measured"] = c.relative_error;
    diffuse["measured_95_interval"] = {c.error_low, c.error_high};
    diffuse["pixels"] = c.pixels;
  }
  double weight = 0, squares = 0, seen_squares = 0, unseen = 0;
  for (std::size_t i = 0; i < f.reflections.errors.size(); ++i) {
    const ReflectedError& e = f.reflections.errors[i];
    const double w = f.pack.reflectors[i].area_m2;
    weight += w, squares += w * e.relative_error * e.relative_error, seen_squares += w * e.seen_error * e.seen_error;
    unseen += w * (1 - e.seen);
  }
  Json out = {diffuse};
  if (weight > 0)
    out.push_back({{"component", "S"},
                   {"measured", std::sqrt(squares / weight)},
                   {"of_seen", std::sqrt(seen_squares / weight)},
                   {"holes", unseen / weight}});
  out.push_back({{"component", "storage of D"}, {"measured", storage_error(f.pack)}});
  if (!f.movers.empty())
    out.push_back({{"component", "compression of transfer"}, {"measured", largest_compression_error(f)}});
  return out;
}

double walkable_m2(const Pack& pack) {
  double area = 0;
  for (const WalkGrid& grid : pack.walk_grids) area += grid.walkable_m2();
  return area;
}

Json movers_json(std::span<const MoverReport> movers) {
  Json out = Json::array();
  for (const MoverReport& m : movers)
    out.push_back({{"name", m.name},
                   {"vertices", m.vertices},
                   {"transfer_standard_error", m.transfer_error},
                   {"compression_error", m.compression_error},
                   {"bytes_per_vertex", m.bytes_per_vertex},
                   {"coarse_share", m.coarse_share}});
  return out;
}

// Where light comes from beside emitting surfaces: what oriel-inspect why asks for. World metres.
Json punctual_json(const Scene& scene) {
  Json out = Json::array();
  for (const Light& light : scene.lights) {
    const DVec3 at = scene.origin + DVec3(light.position);
    Json json = {{"name", light.name}};
    if (light.type == LightType::kDirectional) {
      json["towards"] = rgb(light.direction);
    } else {
      json["at"] = rgb(at);
      if (light.type == LightType::kSpot) {
        json["towards"] = rgb(light.direction);
        json["outer_cone_rad"] = light.outer_cone_rad;
      }
    }
    out.push_back(std::move(json));
  }
  return out;
}

Json lumens_json(const Lumens& lumens) {
  return {{"lm", lumens.value}, {"standard_error", lumens.error}};
}

Json ledger_json(const Ledger& l) {
  if (l.particles == 0) return Json();
  return {{"particles", l.particles},
          {"rays", l.rays},
          {"emitted_lm", l.emitted_lm()},
          {"by_lamps_lm", l.lamps_lm},
          {"by_sky_and_sun", lumens_json(l.from_afar)},
          {"absorbed", lumens_json(l.absorbed)},
          {"escaped", lumens_json(l.escaped)},
          {"lost_behind_surfaces", lumens_json(l.lost_behind)},
          {"lost_on_long_paths", lumens_json(l.lost_guard)},
          {"closure", l.closure()},
          {"closure_standard_error", l.closure_error()},
          {"kept_by_texels",
           {{"by_particles", lumens_json(l.on_texels)},
            {"by_lightmap_lm", l.lightmap_lm},
            {"apart", l.disagreement()},
            {"standard_error", l.disagreement_error()}}}};
}

Json light_field_json(const LightField& field) {
  if (field.bands == 0) return Json();
  return {{"probes", field.probes.size()},
          {"cell_m", rgb(field.cell_m)},
          {"bright_lights", field.lights.size()},
          {"standard_error", field.error}};
}

Json visibility_json(const BakeFacts& f) {
  if (f.pack.visible_sets.empty()) return Json();
  return {{"eye_cells", f.visibility.cells},
          {"groups", f.visibility.groups},
          {"seen_share", f.visibility.seen},
          {"lines", f.visibility.lines}};
}

const char* text_of(Start start) {
  return start == Start::kOfScene ? "of the scene" : start == Start::kInside ? "chosen, inside" : "chosen, outside";
}

}  // namespace

BakeResult::BakeResult() = default;
BakeResult::~BakeResult() = default;
BakeResult::BakeResult(const BakeResult&) = default;
BakeResult::BakeResult(BakeResult&&) noexcept = default;
BakeResult& BakeResult::operator=(const BakeResult&) = default;
BakeResult& BakeResult::operator=(BakeResult&&) noexcept = default;

std::string plan_json(const BakeFacts& f) {
  const Json json = {
      {"scene",
       {{"triangles", f.scene.triangles.size()},
        {"surfaces", f.scene.surfaces.size()},
        {"materials", f.scene.materials.size()},
        {"punctual_lights", f.scene.lights.size()},
        {"emitted_lm", rgb(f.emitted_lm)}}},
      {"lights", punctual_json(f.scene)},
      {"sides", {{"turned_parts", f.sides.turned}, {"doubled_parts", f.sides.doubled}, {"rays", f.sides.rays}}},
      {"atlas", atlas_json(f.atlas)},
      {"radiosity",
       {{"estimator", f.cached ? "cached" : "reference"},
        {"directional", !f.pack.lightmaps.empty() && !f.pack.lightmaps[0].direction.empty()},
        {"texels", f.radiosity.texels},
        {"buried_texels", f.radiosity.buried},
        {"rays", f.radiosity.rays},
        {"sweeps", f.radiosity.sweeps},
        {"sweep_tail", f.radiosity.sweep_tail},
        {"sweep_growth", f.radiosity.sweep_growth},
        {"bounded_patches", f.radiosity.bounded_patches},
        {"filter_drift", f.radiosity.filter_drift},
        {"ended_early", f.radiosity.ended_early},
        {"out_of_rays", f.radiosity.out_of_rays},
        {"certificate", certificate_json(f)},
        {"seams", seams_json(f.radiosity.seams)},
        {"detail", detail_json(f.radiosity.detail)},
        {"mean_lux", rgb(f.radiosity.mean)},
        {"max_lux", rgb(f.radiosity.max)},
        {"relative_standard_error", f.radiosity.relative_error},
        {"incident_lm", rgb(f.radiosity.incident_lm)}}},
      {"ledger", ledger_json(f.ledger)},
      {"radiance",
       {{"reflectors", reflectors_json(f)},
        {"maps", f.pack.radiance_maps.size()},
        {"surround_maps", f.pack.surround_maps.size()},
        {"walkable_m2", walkable_m2(f.pack)},
        {"rays", f.reflections.rays}}},
      {"errors", errors_json(f)},
      {"material", {{"kernels", f.pack.kernels.size()}, {"fresnel_maps", f.pack.fresnel_maps.size()}}},
      {"visible_sets", visibility_json(f)},
      {"movers", movers_json(f.movers)},
      {"light_field", light_field_json(f.pack.light_field)},
      {"start", text_of(f.start)},
      {"omitted", texts_of(f.omissions)},
      {"findings", texts_of(f.findings)},
      {"warnings", texts_of(f.warnings)},
  };
  return text_of(json);
}

std::string provenance_json(const BakeOptions& options, std::uint64_t seed,
                            const std::vector<std::pair<std::string, std::string>>& inputs) {
  Json files = Json::array();
  for (const auto& [name, hash] : inputs) files.push_back({{"name", name}, {"xxh3_128", hash}});
  const Json json = {{"tool", "oriel-bake"},
                     {"version", kVersion},
                     {"build", build_id()},
                     {"given", options.words},
                     {"options", Json::parse(options_json(options, seed)).value()},
                     {"inputs", files}};
  return text_of(json);
}

std::string report_json(const BakeResult& result) {
  Json times = Json::array();
  for (const StageTime& t : result.times)
    times.push_back({{"stage", t.stage},
                     {"seconds", t.seconds},
                     {"rays", t.rays},
                     {"rays_per_s", t.seconds > 0 ? static_cast<double>(t.rays) / t.seconds : 0}});
  const Json json = {{"provenance", Json::parse(result.pack.provenance).value()},
                     {"plan", Json::parse(result.pack.plan).value()},
                     {"stages", times},
                     {"units",
                      {{"reused", result.units.reused},
                       {"computed", result.units.computed},
                       {"reused_s", result.units.reused_s},
                       {"computed_s", result.units.computed_s}}}};
  return text_of(json) + "\n";
}

}  // namespace oriel
