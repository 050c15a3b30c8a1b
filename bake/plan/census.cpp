#include "bake/plan/census.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "bake/brdf/specular.h"
#include "bake/radiosity/radiosity.h"
#include "bake/radiosity/texels/sharp_charts.h"
#include "formats/assets/sharp_light.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

LightCensus count_lights(const Scene& scene, const LightSet& lights) {
  LightCensus c;
  for (const Light& light : scene.lights) {
    ++(light.type == LightType::kPoint ? c.points : light.type == LightType::kSpot ? c.spots : c.directionals);
    c.profiles += light.profile >= 0;
  }
  for (const Surface& surface : scene.surfaces)
    if (max_component(scene.materials[surface.material].emission) > 0 && !scene.materials[surface.material].unlit) {
      ++c.emitting_surfaces;
      c.emitting_triangles += surface.triangle_count;
    }
  c.sky = luminance(scene.sky) <= 0        ? LightCensus::Sky::kNone
          : scene.sky_image.texels.empty() ? LightCensus::Sky::kConstant
                                           : LightCensus::Sky::kImage;
  c.power_lm = luminance(lights.power());
  c.dark = lights.empty() && c.sky == LightCensus::Sky::kNone;
  return c;
}

LobeKind lobe_of(const SceneMaterial& m, const MaterialSummary& s, std::int32_t kernel) {
  if (m.unlit) return LobeKind::kUnlit;
  if (max_component(s.f0) <= 0 && s.f90 <= 0 && s.coat <= 0) return LobeKind::kMatte;
  if (s.alpha < kMirrorAlpha) return LobeKind::kMirror;
  return kernel >= 0 ? LobeKind::kGlossy : LobeKind::kBroad;
}

// By triangle: whether a planar or curved reflector has it.
std::vector<bool> reflecting(const Scene& scene, const FoundReflections& found) {
  std::vector<bool> reflects(scene.triangles.size());
  for (const FoundReflector& r : found.found.reflectors)
    for (const std::uint32_t t : r.triangles) reflects[t] = true;
  for (const FoundCurvedReflector& r : found.curved.reflectors)
    for (const std::uint32_t t : r.triangles) reflects[t] = true;
  return reflects;
}

std::vector<MaterialCensus> list_materials(const CensusInput& in) {
  const Scene& scene = in.prepared.scene();
  std::vector<MaterialCensus> all(scene.materials.size());
  for (std::size_t m = 0; m < all.size(); ++m) {
    const SceneMaterial& material = scene.materials[m];
    const MaterialSummary& summary = in.materials.summaries[m];
    MaterialCensus& c = all[m];
    c.name = material.name;
    c.lobe = lobe_of(material, summary, in.materials.kernel[m]);
    c.alpha = summary.alpha;
    c.reflectance =
        c.lobe == LobeKind::kUnlit || c.lobe == LobeKind::kMatte ? 0 : reflectance_at_60_deg(in.reflections.lobes[m]);
    c.transmission = summary.transmission;
    const auto slots = texture_slots(material);
    c.textured = std::any_of(slots.begin(), slots.end(), [](const TextureSlot* slot) { return slot->image >= 0; });
    c.normal_map = material.normal_texture.image >= 0;
    c.emits = max_component(material.emission) > 0;
    c.area_m2 = summary.area_m2;
    c.kernel = in.options.with_material ? in.materials.kernel[m] : -1;
  }
  const std::vector<bool> reflects = reflecting(scene, in.reflections);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    MaterialCensus& c = all[scene.surfaces[scene.triangle_surface[t]].material];
    c.seen += in.seen[t];
    if (!reflects[t] || !in.options.with_radiance) c.left_out += double{c.reflectance} * in.seen[t];
  }
  std::erase_if(all, [](const MaterialCensus& c) { return c.area_m2 <= 0; });
  return all;
}

std::vector<ReflectorCensus> list_reflectors(const FoundReflections& all) {
  std::vector<ReflectorCensus> out;
  for (const FoundReflector& r : all.found.reflectors)
    out.push_back({r.reflector.name, true, r.reflector.area_m2, r.reflectance, r.roughness * r.roughness});
  for (const FoundCurvedReflector& r : all.curved.reflectors) {
    const ReflectorMaterial& lobe = all.lobes[r.reflector.material];
    out.push_back({r.reflector.name, false, r.area_m2, reflectance_at_60_deg(lobe), lobe.roughness * lobe.roughness});
  }
  return out;
}

std::uint64_t covered_texels(const PreparedScene& prepared) {
  std::uint64_t count = 0;
  for (const TexelMapPage& page : prepared.texel_map) count += page.texel.size();
  return count;
}

StageCensus radiosity_stage(const CensusInput& in, const LightCensus& lights) {
  const std::uint64_t texels = covered_texels(in.prepared);
  return {"radiosity",
          !lights.dark && texels > 0,
          lights.dark   ? "the scene has no light: black is exact, nothing is traced for it"
          : texels == 0 ? "no surface takes part in light transport"
                        : fmt::format("irradiance on {} texels of {:.3g} m", texels, in.prepared.atlas.texel_m),
          {{"texels", texels}, {"pages", in.prepared.atlas.pages.size()}}};
}

StageCensus sharp_light_stage(const CensusInput& in) {
  const Scene& scene = in.prepared.scene();
  if (scene.lights.empty()) return {"sharp light", false, "no light by the pixel: no points, spots and suns", {}};
  if (!finds_sharp_light(in.options.radiosity))
    return {"sharp light", false, "no light by the pixel: these options keep all of it in texels", {}};
  std::map<std::string, std::vector<std::string>> in_texels;
  for (const Light& light : scene.lights)
    if (const char* why = why_in_texels(scene, light)) in_texels[why].push_back(light.name);
  const SharpCharts sharp = find_sharp_charts(scene, in.prepared.atlas);
  const std::ptrdiff_t flat = std::ranges::count_if(sharp.charts, &ChartGrid::flat);
  std::string why = fmt::format("light of {} of {} points, spots and suns by the pixel, on flat charts",
                                flat > 0 ? sharp.lights.size() : 0, scene.lights.size());
  if (sharp.lights.size() > kMostShines) why += fmt::format(", of each the {} brightest", kMostShines);
  for (const auto& [reason, names] : in_texels)
    why += fmt::format("; {}{} in texels: {}", names[0],
                       names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : "", reason);
  return {"sharp light",
          flat > 0,
          why,
          {{"charts", static_cast<std::uint64_t>(flat)}, {"of", in.prepared.atlas.chart_count}}};
}

StageCensus directional_stage(const CensusInput& in) {
  std::vector<Warning> why;
  const bool runs = choose_directional(in.prepared.scene(), in.options.directional, why);
  return {"directional",
          runs,
          runs ? (in.options.directional == Directional::kOn ? "asked for" : "materials have normal maps")
               : why.front().text,
          {}};
}

StageCensus radiance_stage(const CensusInput& in, bool dark) {
  const std::size_t count = in.options.with_radiance && !dark ? in.reflections.found.reflectors.size() : 0;
  std::string why;
  if (!in.options.with_radiance)
    why = "no radiance maps: left out by --only";
  else if (dark)
    why = "no radiance maps: the scene has no light";
  else if (count == 0)
    why = "no radiance maps: no planar surface that is shiny and large enough is seen from where people walk";
  else
    why = fmt::format("{} planar surface{} show{} an image to people who walk", count, count == 1 ? "" : "s",
                      count == 1 ? "s" : "");
  return {"radiance", count > 0, why, {{"reflectors", count}}};
}

StageCensus surround_stage(const CensusInput& in, bool dark) {
  const FoundCurvedReflectors& curved = in.reflections.curved;
  const std::size_t count = in.options.with_radiance && !dark ? curved.reflectors.size() : 0;
  std::uint64_t texels = 0;
  for (const SurroundMap& map : curved.maps) texels += std::uint64_t{map.size} * map.size;
  return {"surround",
          count > 0,
          count > 0 ? fmt::format("{} curved surface{} show{} what is around", count, count == 1 ? "" : "s",
                                  count == 1 ? "s" : "")
                    : "no surround maps: nothing that is not planar shows an image",
          {{"reflectors", count}, {"texels", count > 0 ? texels : 0}}};
}

StageCensus kernel_stage(const CensusInput& in, const std::vector<MaterialCensus>& materials) {
  std::set<std::int32_t> kernels;
  std::size_t served = 0;
  for (const MaterialCensus& m : materials)
    if (m.kernel >= 0) kernels.insert(m.kernel), ++served;
  std::string why;
  if (!in.options.with_material)
    why = "no kernels: left out by --only";
  else if (kernels.empty())
    why = "no kernels: no material reflects enough within a narrow lobe";
  else
    why = fmt::format("{} kernel{} serve{} {} material{}", kernels.size(), kernels.size() == 1 ? "" : "s",
                      kernels.size() == 1 ? "s" : "", served, served == 1 ? "" : "s");
  return {"kernels", !kernels.empty(), why, {{"kernels", kernels.size()}, {"materials", served}}};
}

StageCensus fresnel_stage(const CensusInput& in) {
  const std::size_t count = in.materials.fresnel_maps.size();
  return {"fresnel",
          count > 0,
          count > 0 ? "what specular lobes take from the diffuse light" : "no Fresnel maps: every material is matte",
          {{"maps", count}}};
}

StageCensus mover_stage(const CensusInput& in) {
  std::uint64_t vertices = 0;
  for (const TakenMover& mover : in.prepared.movers) vertices += mover.scene.positions.size();
  const std::size_t count = in.prepared.movers.size();
  return {"movers",
          count > 0,
          count > 0 ? "transfer by vertex, and the light that movers meet"
          : in.options.with_transfer
              ? "no transfer and no light field: no node is marked (--object NODE:mover) or animated"
              : "no transfer and no light field: left out by --only",
          {{"movers", count}, {"vertices", vertices}}};
}

StageCensus visibility_stage(const CensusInput& in) {
  const std::size_t triangles = in.prepared.scene().triangles.size();
  const std::string why_not = why_not_visible_sets(in.options, triangles, in.reflections.region.grids);
  return {
      "visibility",
      why_not.empty(),
      why_not.empty() ? "what is seen from where people walk, if it is not nearly all" : "no visible sets: " + why_not,
      {{"triangles", triangles}}};
}

}  // namespace

const char* name_of(LobeKind lobe) {
  static const std::array names{"unlit", "matte", "mirror", "glossy", "broad"};
  return names.at(static_cast<std::size_t>(lobe));
}

Census take_census(const CensusInput& in) {
  const Scene& scene = in.prepared.scene();
  Census c;
  c.triangles = scene.triangles.size();
  c.surfaces = scene.surfaces.size();
  c.size_m = scene.upper - scene.lower;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) c.area_m2 += triangle_area(scene, t);
  for (const WalkGrid& grid : in.reflections.region.grids) c.walkable_m2 += grid.walkable_m2();
  c.lights = count_lights(scene, in.lights);
  c.materials = list_materials(in);
  if (in.options.with_radiance) c.reflectors = list_reflectors(in.reflections);
  c.stages = {radiosity_stage(in, c.lights),
              sharp_light_stage(in),
              directional_stage(in),
              radiance_stage(in, c.lights.dark),
              surround_stage(in, c.lights.dark),
              kernel_stage(in, c.materials),
              fresnel_stage(in),
              mover_stage(in),
              visibility_stage(in)};
  c.omissions = in.prepared.omissions;
  if (in.options.with_radiance)
    c.omissions.insert(c.omissions.end(), in.reflections.omissions.begin(), in.reflections.omissions.end());
  return c;
}

}  // namespace oriel
