#include "bake/material/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>

#include "bake/jobs/units.h"
#include "bake/material/share.h"
#include "bake/scene/shade.h"
#include "bake/trace/albedo.h"
#include "formats/assets/fields.h"

namespace oriel {
namespace {

constexpr double kRaysAMap = 1 << 16;     // that would take as long as a map or a kernel, about
constexpr std::uint32_t kSamples = 1024;  // per textured material

bool is_textured(const Scene& scene, const SceneMaterial& m) {
  const auto slots = texture_slots(m);
  return !scene.colors.empty() ||
         std::any_of(slots.begin(), slots.end(), [](const TextureSlot* slot) { return slot->image >= 0; });
}

// The lobe that shows an image is the one that reflects more at normal incidence.
void choose_image_lobe(MaterialSummary& s, float base_roughness) {
  s.base_alpha = base_roughness * base_roughness;
  const bool coat = s.coat > 0 && s.coat * 0.04f >= 0.999f * max_component(s.f0);
  s.roughness = coat ? std::sqrt(s.coat_alpha) : base_roughness;
  s.alpha = s.roughness * s.roughness;
}

}  // namespace

Vec3 dielectric_f0(const SceneMaterial& m) {
  return glm::min(static_cast<float>(dielectric_f0(double{m.ior})) * m.specular_color, Vec3(1)) * m.specular;
}

namespace {

// The factors alone (docs/notes/conventions.md, "Materials").
MaterialSummary from_factors(const SceneMaterial& m) {
  MaterialSummary s;
  s.base_color = m.base_color;
  s.metallic = m.metallic;
  s.transmission = m.transmission;
  s.diffuse = (1 - m.metallic) * (1 - m.transmission) * m.base_color;
  s.f0 = glm::mix(dielectric_f0(m), m.base_color, m.metallic);
  s.f90 = glm::mix(m.specular, 1.0f, m.metallic);
  s.curve = {.ior = m.ior, .schlick = m.metallic};
  s.coat = m.coat;
  s.coat_alpha = m.coat_roughness * m.coat_roughness;
  if (m.metal != Metal::kNone) {
    s.metallic = 1;
    s.f0 = s.base_color = Vec3(metal_f0(m.metal));
    s.f90 = 1;
    s.curve = {.metal = m.metal};
    s.diffuse = Vec3(0);
    s.transmission = 0;
  }
  choose_image_lobe(s, std::sqrt(mean_alpha(m.roughness * m.roughness, m.anisotropy)));
  s.coverage = m.alpha_mode == AlphaMode::kBlend ? m.alpha : 1;
  s.emission = m.emission;
  return s;
}

float metallic_at(const Scene& scene, const SceneMaterial& m, std::uint32_t triangle, const Vec2& b) {
  const TextureSlot& slot = m.metallic_roughness_texture;
  if (m.metal != Metal::kNone) return 1;
  if (slot.image < 0) return m.metallic;
  const auto& uvs = slot.texcoord == 1 ? scene.uv1 : scene.uv0;
  const UVec3 t = scene.triangles[triangle];
  const Vec2 uv = uvs[t.x] + b.x * (uvs[t.y] - uvs[t.x]) + b.y * (uvs[t.z] - uvs[t.x]);
  return std::clamp(m.metallic * sample_texture(scene, slot, uv, false).b, 0.0f, 1.0f);
}

// Sums of what is averaged, in double and in a fixed order.
struct Sums {
  DVec3 base_color{0}, diffuse{0}, f0{0}, emission{0};
  double metallic = 0, roughness = 0, roughness_squares = 0, f90 = 0, coverage = 0, coat = 0, coat_roughness = 0;
};

MaterialSummary average(const Scene& scene, const SceneMaterial& m, const std::vector<std::uint32_t>& triangles,
                        const std::vector<double>& area_until) {
  Sums sums;
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    // Points evenly along the list of areas; inside a triangle the R2 sequence (Roberts 2018) folded at the diagonal.
    const double area = (i + 0.5) / kSamples * area_until.back();
    while (at + 1 < triangles.size() && area_until[at] < area) ++at;
    Vec2 b(glm::fract(DVec2(0.5) + (i + 1.0) * DVec2(0.7548776662466927, 0.5698402909980532)));
    if (b.x + b.y > 1) b = Vec2(1) - b;
    const ShadePoint p = shade_point(scene, triangles[at], b);
    sums.base_color += DVec3(p.base_color);
    sums.diffuse += DVec3(p.diffuse);
    sums.f0 += DVec3(p.f0);
    sums.emission += DVec3(p.emission);
    sums.f90 += p.f90;
    sums.coverage += p.coverage;
    const double roughness = std::sqrt(mean_alpha(p.alpha, p.anisotropy));
    sums.roughness += roughness, sums.roughness_squares += roughness * roughness;
    sums.coat += p.coat;
    sums.coat_roughness += std::sqrt(p.coat_alpha);
    sums.metallic += metallic_at(scene, m, triangles[at], b);
  }
  MaterialSummary s = from_factors(m);
  s.base_color = Vec3(sums.base_color / double{kSamples});
  s.diffuse = Vec3(sums.diffuse / double{kSamples});
  s.f0 = Vec3(sums.f0 / double{kSamples});
  s.emission = Vec3(sums.emission / double{kSamples});
  s.f90 = static_cast<float>(sums.f90 / kSamples);
  s.coverage = static_cast<float>(sums.coverage / kSamples);
  s.metallic = static_cast<float>(sums.metallic / kSamples);
  s.coat = static_cast<float>(sums.coat / kSamples);
  s.coat_alpha = static_cast<float>(std::pow(sums.coat_roughness / kSamples, 2));
  if (s.curve.metal == Metal::kNone) s.curve.schlick = s.metallic;
  const double roughness = sums.roughness / kSamples;
  s.roughness_deviation =
      static_cast<float>(std::sqrt(std::max(sums.roughness_squares / kSamples - roughness * roughness, 0.0)));
  choose_image_lobe(s, static_cast<float>(roughness));
  return s;
}

MaterialSummary summarize(const Scene& scene, std::uint32_t material, const std::vector<std::uint32_t>& triangles) {
  const SceneMaterial& m = scene.materials[material];
  std::vector<double> area_until;
  area_until.reserve(triangles.size());
  double total = 0;
  for (const std::uint32_t t : triangles) area_until.push_back(total += triangle_area(scene, t));
  MaterialSummary s = total > 0 && is_textured(scene, m) ? average(scene, m, triangles, area_until) : from_factors(m);
  s.area_m2 = total;
  return s;
}

// What a Fresnel map is computed of, to the last bit: near an index of 1 the least difference changes all of R at
// grazing angles. Maps that come out alike are merged by their tables.
using FresnelKey = std::array<std::uint32_t, 10>;

FresnelKey fresnel_key(const MaterialSummary& s) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return {bits(s.f0.r),          bits(s.f0.g),
          bits(s.f0.b),          bits(s.f90),
          bits(s.base_alpha),    bits(s.coat),
          bits(s.coat_alpha),    s.curve.schlick < 1 ? bits(s.curve.ior) : 0,
          bits(s.curve.schlick), static_cast<std::uint32_t>(s.curve.metal)};
}

// The widths of lobes that show an image, and who needs a Fresnel map of its own; maps.kernel and maps.fresnel_map are
// indices into these.
struct Needs {
  std::vector<float> alphas;
  std::vector<std::size_t> fresnel_owner;  // the first material of each need
};

Needs find_needs(const Scene& scene, MaterialMaps& maps, const MaterialOptions& options) {
  Needs needs;
  maps.kernel.assign(scene.materials.size(), -1);
  maps.fresnel_map.assign(scene.materials.size(), -1);
  std::map<FresnelKey, std::int32_t> fresnel_of;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const MaterialSummary& s = maps.summaries[m];
    if (scene.materials[m].unlit || (max_component(s.f0) <= 0 && s.f90 <= 0 && s.coat <= 0)) continue;
    const auto [fresnel, is_new] = fresnel_of.try_emplace(fresnel_key(s), needs.fresnel_owner.size());
    if (is_new) needs.fresnel_owner.push_back(m);
    maps.fresnel_map[m] = fresnel->second;
    const bool highlights = shows_highlights(reflectance_at_60_deg(s.f0, s.f90, s.curve), s.alpha);
    if (!scene.materials[m].reflections || (s.roughness > options.max_roughness && !highlights)) continue;
    maps.kernel[m] = static_cast<std::int32_t>(needs.alphas.size());
    needs.alphas.push_back(s.alpha);
  }
  return needs;
}

// The first map of each group into maps.fresnel_maps; indices follow.
void keep_shared(std::vector<FresnelMap> all, double error, MaterialMaps& maps) {
  const Groups groups = group_reflectances(all, error);
  std::vector<std::int32_t> kept(all.size(), -1);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (groups.of[i] == i) {
      kept[i] = static_cast<std::int32_t>(maps.fresnel_maps.size());
      maps.fresnel_maps.push_back(std::move(all[i]));
    }
  for (std::int32_t& map : maps.fresnel_map)
    if (map >= 0) map = kept[groups.of[static_cast<std::size_t>(map)]];
}

}  // namespace

SpecularLayers layers_of(const MaterialSummary& s) {
  return {{s.f0, s.f90, s.base_alpha, s.curve}, s.coat, s.coat_alpha};
}

std::vector<MaterialSummary> summarize_materials(const Scene& scene) {
  std::vector<std::vector<std::uint32_t>> triangles(scene.materials.size());
  for (const Surface& surface : scene.surfaces)
    for (std::uint32_t i = 0; i < surface.triangle_count; ++i)
      triangles[surface.material].push_back(surface.first_triangle + i);
  std::vector<MaterialSummary> summaries;
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m) summaries.push_back(summarize(scene, m, triangles[m]));
  return summaries;
}

std::vector<std::string> averaged_roughness(const Scene& scene, const MaterialMaps& maps) {
  constexpr float kSeen = 0.05f;  // of polished beside satin tiles: 0.2 and 0.3
  std::vector<std::string> names;
  for (std::size_t m = 0; m < maps.summaries.size(); ++m)
    if (maps.kernel[m] >= 0 && maps.summaries[m].roughness_deviation > kSeen)
      names.push_back(fmt::format("'{}'", scene.materials[m].name));
  return names;
}

Result<MaterialMaps> bake_materials(const Scene& scene, const MaterialOptions& options, Context& context) {
  MaterialMaps maps;
  maps.summaries = summarize_materials(scene);
  const Needs needs = find_needs(scene, maps, options);
  const Groups widths = group_widths(needs.alphas, options.error);
  maps.kernels.resize(widths.values.size());
  std::vector<FresnelMap> fresnel_maps(needs.fresnel_owner.size());
  UnitLoop kernels{.stage = "kernels", .count = maps.kernels.size(), .rays = kRaysAMap};
  kernels.inputs = [&](std::size_t i, Archive& key) { key(widths.values[i], options.kernel, options.slices); };
  kernels.compute = [&](std::size_t i) {
    maps.kernels[i] = make_kernel(widths.values[i], 1, options.kernel);
    add_slices(maps.kernels[i], options.slices);
    return 0;
  };
  kernels.results = [&](std::size_t i, Archive& archive) { archive(maps.kernels[i]); };
  ORIEL_TRY_VOID(parallel_units(context, kernels));
  UnitLoop fresnel{.stage = "fresnel", .count = fresnel_maps.size(), .rays = kRaysAMap};
  fresnel.inputs = [&](std::size_t i, Archive& key) {
    key(fresnel_key(maps.summaries[needs.fresnel_owner[i]]), options.fresnel);
  };
  fresnel.compute = [&](std::size_t i) {
    const MaterialSummary& s = maps.summaries[needs.fresnel_owner[i]];
    fresnel_maps[i] = make_fresnel_map(layers_of(s), options.fresnel);
    return 0;
  };
  fresnel.results = [&](std::size_t i, Archive& archive) { archive(fresnel_maps[i]); };
  ORIEL_TRY_VOID(parallel_units(context, fresnel));
  for (std::int32_t& kernel : maps.kernel)
    if (kernel >= 0) kernel = static_cast<std::int32_t>(widths.of[static_cast<std::size_t>(kernel)]);
  keep_shared(std::move(fresnel_maps), options.error, maps);
  return maps;
}

}  // namespace oriel
