#include "bake/radiosity/gather/cache_query.h"

#include <algorithm>
#include <cmath>

#include "bake/scene/sky.h"

namespace oriel {
namespace {

bool lets_nothing_through(const SceneMaterial& m) {
  return !m.unlit && m.alpha_mode == AlphaMode::kOpaque && m.transmission == 0;
}
bool has_specular_layers(const SceneMaterial& m) {
  return m.metallic > 0 || m.specular > 0 || m.coat > 0 || m.metal != Metal::kNone;
}

}  // namespace

CacheQuery::CacheQuery(const Transport& transport, const Texels& texels, bool closed_form, std::uint64_t seed)
    : t_(transport), texels_(texels), closed_form_(closed_form), seed_(seed) {
  side_.resize(texels.count());
  std::ranges::transform(texels.area_m2, side_.begin(), [](float area) { return std::sqrt(area); });
  const Scene& scene = transport.accel.scene();
  survival_.assign(scene.materials.size(), 1.0f);
  kinds_.resize(scene.triangles.size());
  for (std::uint32_t t = 0; t < kinds_.size(); ++t) {
    const SceneMaterial& material = scene.material_of(t);
    const bool emits = max_component(material.emission) > 0;
    if (lets_nothing_through(material) && (closed_form || !emits))
      kinds_[t] = has_specular_layers(material) ? Kind::kLayered : Kind::kMatt;
  }
}

void CacheQuery::evaluate(std::span<const Ray> rays, std::span<const GatherRay> info, QueryResults& results) const {
  results.hits.resize(rays.size());
  results.light.assign(rays.size(), Vec3(0));
  results.unreflected.assign(rays.size(), Vec3(0));
  results.places.assign(rays.size(), {});
  results.texel.assign(rays.size(), kNoTexel);
  results.share.assign(rays.size(), 1.0f);
  results.grouped.assign(rays.size() * groups(), Vec3(0));
  results.links.clear();
  results.rays = 0;
  t_.accel.intersect(rays, results.hits);
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    const Hit& hit = results.hits[i];
    if (info[i].misses(hit)) continue;
    if (!hit) {
      results.unreflected[i] = sky_radiance(scene(), rays[i].direction) * sky_weight(rays[i].direction, info[i]);
      results.light[i] = results.unreflected[i];
      if (groups() > 0)
        each_owner(scene(), sky_owner(scene()), rays[i].direction, results.light[i],
                   [&](std::uint32_t group, const Vec3& light) { results.grouped[i * groups() + group] = light; });
      continue;
    }
    const Kind kind = kinds_[hit.triangle];
    if (kind == Kind::kMatt && !hit.front) continue;  // texels hold the light of fronts
    if (hit.front) results.places[i] = texels_.place(hit.triangle, hit.barycentric);
    const std::uint32_t texel = results.places[i].texel;
    if (kind == Kind::kOther || results.places[i].is_unevaluated() || is_near(info[i], hit.distance, texel) ||
        (kind == Kind::kLayered && texel == kNoTexel)) {
      follow(rays[i], info[i], hit, i, results);
      continue;
    }
    results.texel[i] = texel;
    if (kind == Kind::kLayered) follow_layers(rays[i], info[i], hit, i, results);
  }
}

// Most specular layers reflect little: Russian roulette by their reflectance decides on a path, and only then are
// textures read.
void CacheQuery::follow_layers(const Ray& ray, const GatherRay& info, const Hit& hit, std::uint32_t number,
                               QueryResults& results) const {
  const float cosine = -glm::dot(geometry_at(scene(), hit, ray.direction).normal, ray.direction);
  const float share = texels_.diffuse_share[results.texel[number]].at(cosine);
  const float chance = std::min(1.0f, (1 - share) * survival_of(hit.triangle));
  results.share[number] = share;
  Sampler sampler(seed_, info.stream, info.sample);
  if (!(chance > 0) || sampler.next1() >= chance) return;
  const std::size_t before = results.links.size();
  const auto on_diffuse = [&](const DiffuseVertex& v) { return link_to(info, v, number, results); };
  // Surfaces too near for particles keep the light of lamps.
  const std::uint32_t texel = results.texel[number];
  const bool lamps = lamps_ || (max_component(texels_.albedo[texel]) > 0 && continues_path(hit.distance, texel));
  PathGroups path_groups;
  Transport t = t_;
  if (groups() > 0) {
    path_groups.begin(groups(), {0, 0, 1 / chance, lamps ? 1 / chance : 0});
    t.grouped = &path_groups;
  }
  const PathLight light =
      specular_light(t, {surface_at(t.accel, hit, ray.direction), -ray.direction}, sampler, results.rays, on_diffuse);
  add_to_groups(number, path_groups.light(), results);
  results.light[number] = (light.scattered + (lamps ? light.lamps : Vec3(0))) / chance;
  for (std::size_t i = before; i < results.links.size(); ++i) results.links[i].weight /= chance;
}

std::optional<float> CacheQuery::link_to(const GatherRay& info, const DiffuseVertex& v, std::uint32_t number,
                                         QueryResults& results) const {
  const Texels::Place place = v.front ? texels_.place(v.triangle, v.barycentric) : Texels::Place();
  const std::uint32_t texel = place.texel;
  if (place.is_unevaluated() || is_near(info, v.distance, texel)) return std::nullopt;
  if (texel != kNoTexel) results.links.push_back({number, texel, v.weight});
  return survival_of(v.triangle);
}

void CacheQuery::follow(const Ray& ray, const GatherRay& info, const Hit& hit, std::uint32_t number,
                        QueryResults& results) const {
  Sampler sampler(seed_, info.stream, info.sample);
  const auto on_diffuse = [&](const DiffuseVertex& v) { return link_to(info, v, number, results); };
  const float pdf = closed_form_ ? 0 : info.incidence / kPi;
  PathGroups path_groups;
  Transport t = t_;
  if (groups() > 0) {
    path_groups.begin(groups(), {closed_form_ ? 0.0f : 1.0f, closed_form_ ? sky_weight(ray.direction, info) : 1.0f,
                                 1.0f, lamps_ ? 1.0f : 0.0f});
    t.grouped = &path_groups;
  }
  const PathLight light = trace_to_diffuse(t, {ray, hit, pdf}, sampler, results.rays, on_diffuse);
  add_to_groups(number, path_groups.light(), results);
  results.unreflected[number] = closed_form_ ? light.sky * sky_weight(ray.direction, info) : light.sky + light.emitted;
  results.light[number] = light.scattered + (lamps_ ? light.lamps : Vec3(0)) + results.unreflected[number];
}

float CacheQuery::sky_weight(const Vec3& direction, const GatherRay& info) const {
  if (!t_.lights.samples_sky()) return 1;
  const float pdf = info.incidence / kPi;
  return pdf / (pdf + (closed_form_ ? t_.lights.sky_pdf(direction) : t_.lights.pdf(direction)));
}

}  // namespace oriel
