#include "bake/radiosity/gather/surroundings.h"

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

Surroundings::Surroundings(const Transport& transport, const Texels& texels, bool closed_form, std::uint64_t seed)
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

void Surroundings::answer(std::span<const Ray> rays, std::span<const GatherRay> about, Answers& answers) const {
  answers.hits.resize(rays.size());
  answers.light.assign(rays.size(), Vec3(0));
  answers.unreflected.assign(rays.size(), Vec3(0));
  answers.places.assign(rays.size(), {});
  answers.texel.assign(rays.size(), kNoTexel);
  answers.share.assign(rays.size(), 1.0f);
  answers.grouped.assign(rays.size() * groups(), Vec3(0));
  answers.links.clear();
  answers.rays = 0;
  t_.accel.intersect(rays, answers.hits);
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    const Hit& hit = answers.hits[i];
    if (about[i].misses(hit)) continue;
    if (!hit) {
      answers.unreflected[i] = sky_radiance(scene(), rays[i].direction) * sky_weight(rays[i].direction, about[i]);
      answers.light[i] = answers.unreflected[i];
      if (groups() > 0)
        each_owner(scene(), sky_owner(scene()), rays[i].direction, answers.light[i],
                   [&](std::uint32_t group, const Vec3& light) { answers.grouped[i * groups() + group] = light; });
      continue;
    }
    const Kind kind = kinds_[hit.triangle];
    if (kind == Kind::kMatt && !hit.front) continue;  // texels hold the light of fronts
    if (hit.front) answers.places[i] = texels_.place(hit.triangle, hit.barycentric);
    const std::uint32_t texel = answers.places[i].texel;
    if (kind == Kind::kOther || answers.places[i].is_unevaluated() || is_near(about[i], hit.distance, texel) ||
        (kind == Kind::kLayered && texel == kNoTexel)) {
      follow(rays[i], about[i], hit, i, answers);
      continue;
    }
    answers.texel[i] = texel;
    if (kind == Kind::kLayered) look_through_layers(rays[i], about[i], hit, i, answers);
  }
}

// What layers leave to the texel's diffuse reflection. They themselves reflect little mostly: a path goes on from them
// as often as they are bright, and only then are textures read.
void Surroundings::look_through_layers(const Ray& ray, const GatherRay& about, const Hit& hit, std::uint32_t number,
                                       Answers& answers) const {
  const float cosine = -glm::dot(geometry_at(scene(), hit, ray.direction).normal, ray.direction);
  const float share = texels_.diffuse_share[answers.texel[number]].at(cosine);
  const float chance = std::min(1.0f, (1 - share) * survival_of(hit.triangle));
  answers.share[number] = share;
  Sampler sampler(seed_, about.stream, about.sample);
  if (!(chance > 0) || sampler.next1() >= chance) return;
  const std::size_t before = answers.links.size();
  const auto on_diffuse = [&](const DiffuseVertex& v) { return link_to(about, v, number, answers); };
  // Of surfaces too near for particles, too.
  const std::uint32_t texel = answers.texel[number];
  const bool lamps = lamps_ || (max_component(texels_.albedo[texel]) > 0 && goes_on(hit.distance, texel));
  LightBook book_of_path;
  Transport t = t_;
  if (groups() > 0) {
    book_of_path.begin(groups(), {0, 0, 1 / chance, lamps ? 1 / chance : 0});
    t.book = &book_of_path;
  }
  const PathLight light =
      specular_light(t, {surface_at(scene(), hit, ray.direction), -ray.direction}, sampler, answers.rays, on_diffuse);
  book(number, book_of_path.light(), answers);
  answers.light[number] = (light.scattered + (lamps ? light.lamps : Vec3(0))) / chance;
  for (std::size_t i = before; i < answers.links.size(); ++i) answers.links[i].weight /= chance;
}

std::optional<float> Surroundings::link_to(const GatherRay& about, const DiffuseVertex& v, std::uint32_t number,
                                           Answers& answers) const {
  const Texels::Place place = v.front ? texels_.place(v.triangle, v.barycentric) : Texels::Place();
  const std::uint32_t texel = place.texel;
  if (place.is_unevaluated() || is_near(about, v.distance, texel)) return std::nullopt;
  if (texel != kNoTexel) answers.links.push_back({number, texel, v.weight});
  return survival_of(v.triangle);
}

void Surroundings::follow(const Ray& ray, const GatherRay& about, const Hit& hit, std::uint32_t number,
                          Answers& answers) const {
  Sampler sampler(seed_, about.stream, about.sample);
  const auto on_diffuse = [&](const DiffuseVertex& v) { return link_to(about, v, number, answers); };
  const float pdf = closed_form_ ? 0 : about.incidence / kPi;
  LightBook book_of_path;
  Transport t = t_;
  if (groups() > 0) {
    book_of_path.begin(groups(), {closed_form_ ? 0.0f : 1.0f, closed_form_ ? sky_weight(ray.direction, about) : 1.0f,
                                  1.0f, lamps_ ? 1.0f : 0.0f});
    t.book = &book_of_path;
  }
  const PathLight light = trace_to_diffuse(t, {ray, hit, pdf}, sampler, answers.rays, on_diffuse);
  book(number, book_of_path.light(), answers);
  answers.unreflected[number] = closed_form_ ? light.sky * sky_weight(ray.direction, about) : light.sky + light.emitted;
  answers.light[number] = light.scattered + (lamps_ ? light.lamps : Vec3(0)) + answers.unreflected[number];
}

float Surroundings::sky_weight(const Vec3& direction, const GatherRay& about) const {
  if (!t_.lights.samples_sky()) return 1;
  const float pdf = about.incidence / kPi;
  return pdf / (pdf + (closed_form_ ? t_.lights.sky_pdf(direction) : t_.lights.pdf(direction)));
}

}  // namespace oriel
