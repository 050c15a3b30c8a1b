#include "bake/radiosity/gather/surroundings.h"

#include <algorithm>
#include <cmath>

#include "bake/scene/light/sky.h"

namespace oriel {
namespace {

// Reflects diffusely and nothing else, lets no light through.
bool is_matt(const SceneMaterial& m) {
  return !m.unlit && m.alpha_mode == AlphaMode::kOpaque && m.transmission == 0 && m.metallic == 0 && m.specular == 0 &&
         m.coat == 0 && m.metal == Metal::kNone;
}

}  // namespace

Surroundings::Surroundings(const Transport& transport, const Texels& texels, bool closed_form, std::uint64_t seed)
    : t_(transport), texels_(texels), closed_form_(closed_form), seed_(seed) {
  side_.resize(texels.count());
  std::ranges::transform(texels.area_m2, side_.begin(), [](float area) { return std::sqrt(area); });
  const Scene& scene = transport.accel.scene();
  kinds_.resize(scene.triangles.size());
  for (std::uint32_t t = 0; t < kinds_.size(); ++t) {
    const SceneMaterial& material = scene.materials[scene.surfaces[scene.triangle_surface[t]].material];
    const bool emits = max_component(material.emission) > 0;
    kinds_[t] = is_matt(material) && (closed_form || !emits) ? Kind::kMatt : Kind::kOther;
  }
}

void Surroundings::answer(std::span<const Ray> rays, std::span<const GatherRay> about, Answers& answers) const {
  answers.hits.resize(rays.size());
  answers.light.assign(rays.size(), Vec3(0));
  answers.texel.assign(rays.size(), kNoTexel);
  answers.links.clear();
  answers.rays = 0;
  t_.accel.intersect(rays, answers.hits);
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    const Hit& hit = answers.hits[i];
    if (!hit) {
      answers.light[i] = sky_radiance(t_.accel.scene(), rays[i].direction) * sky_weight(rays[i].direction, about[i]);
      continue;
    }
    const bool matt = kinds_[hit.triangle] == Kind::kMatt;
    if (matt && !hit.front) continue;  // texels hold the light of fronts
    const std::uint32_t texel = matt ? texels_.find(hit.triangle, hit.barycentric) : kNoTexel;
    if (matt && !is_near(about[i], hit.distance, texel))
      answers.texel[i] = texel;
    else
      follow(rays[i], about[i], hit, i, answers);
  }
}

void Surroundings::follow(const Ray& ray, const GatherRay& about, const Hit& hit, std::uint32_t number,
                          Answers& answers) const {
  Sampler sampler(seed_, about.stream, about.sample);
  const auto on_diffuse = [&](const DiffuseVertex& v) {
    const std::uint32_t texel = v.front ? texels_.find(v.triangle, v.barycentric) : kNoTexel;
    if (is_near(about, v.distance, texel)) return false;
    if (texel != kNoTexel) answers.links.push_back({number, texel, v.weight});
    return true;
  };
  const float pdf = closed_form_ ? 0 : about.incidence / kPi;
  const PathLight light = trace_to_diffuse(t_, ray, hit, pdf, sampler, answers.rays, on_diffuse);
  answers.light[number] =
      light.scattered + (closed_form_ ? light.sky * sky_weight(ray.direction, about) : light.sky + light.emitted);
}

float Surroundings::sky_weight(const Vec3& direction, const GatherRay& about) const {
  if (!t_.lights.samples_sky()) return 1;
  const float pdf = about.incidence / kPi;
  return pdf / (pdf + (closed_form_ ? t_.lights.sky_pdf(direction) : t_.lights.pdf(direction)));
}

}  // namespace oriel
