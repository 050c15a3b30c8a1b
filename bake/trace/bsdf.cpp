#include "bake/trace/bsdf.h"

#include "bake/trace/glass.h"
#include "bake/trace/warp.h"

namespace oriel {
namespace {

// A microfacet lobe of a point: its base or its coat.
class FacetLobe {
 public:
  FacetLobe(const SpecularLobe& specular, float alpha_x, float alpha_y)
      : specular_(specular), facets_(FacetModel::kGgx, alpha_x, alpha_y) {}

  bool is_mirror() const { return facets_.alpha_y < kMirrorAlpha; }
  Vec3 mirror_weight(float cos_o) const { return specular_fresnel(specular_, cos_o); }

  // f cosθi with compensation; 0 for a mirror.
  Vec3 eval(const Vec3& wo, const Vec3& wi) const {
    if (is_mirror()) return Vec3(0);
    const DVec3 o(wo), i(wi), h = glm::normalize(o + i);
    const double scale = ggx_scale(specular_.alpha, o.z) * ggx_scale(specular_.alpha, i.z);
    return specular_fresnel(specular_, glm::dot(o, h)) * compensated(specular_.f0, static_cast<float>(scale)) *
           static_cast<float>(facets_.f_cos(o, i, h));
  }
  float pdf(const Vec3& wo, const Vec3& wi) const {
    if (is_mirror()) return 0;
    return static_cast<float>(facets_.reflected_pdf(DVec3(wo), glm::normalize(DVec3(wo) + DVec3(wi))));
  }
  Vec3 sample(const Vec3& wo, const Vec2& v) const {
    return Vec3(reflect_at(DVec3(wo), facets_.sample_visible_normal(glm::normalize(DVec3(wo)), DVec2(v))));
  }

 private:
  SpecularLobe specular_;
  Microfacet facets_;
};

FacetLobe base_lobe(const ShadePoint& point) {
  return {specular_lobe(point), wide_alpha(point), point.alpha};
}
FacetLobe coat_lobe(const ShadePoint& point) {
  return {specular_layers(point).coat_lobe(), point.coat_alpha, point.coat_alpha};
}

BsdfSample delta_sample(Lobe lobe, const Vec3& wi, const Vec3& weight) {
  BsdfSample s;
  s.wi = wi;
  s.weight = weight;
  s.delta = true;
  s.lobe = lobe;
  return s;
}

}  // namespace

Bsdf::Bsdf(const ShadePoint& point, const Vec3& wo) : point_(point), wo_(wo) {
  if (wo.z > 0) lobes_ = choose_lobes(point, wo.z);
}

Bsdf::LobeChoice Bsdf::choose_lobes(const ShadePoint& point, float cos_o) {
  LobeChoice c;
  c.coat = coat_reflectance(point, cos_o);
  c.under_coat = 1 - c.coat;
  c.diffuse_scale = 1 - max_component(reflectance(point, cos_o));
  c.specular = std::max(0.0f, c.under_coat - c.diffuse_scale);
  c.diffuse = max_component(point.diffuse) * c.diffuse_scale;
  c.transmission = max_component(point.transmission) * c.diffuse_scale;
  const float sum = c.diffuse + c.specular + c.coat + c.transmission;
  if (!(sum > 0)) return {};
  c.diffuse /= sum, c.specular /= sum, c.coat /= sum, c.transmission /= sum;
  return c;
}

DVec3 Bsdf::facet(const Vec2& v) const {
  if (point_.alpha < kMirrorAlpha) return {0, 0, 1};
  const Microfacet facets(FacetModel::kGgx, wide_alpha(point_), point_.alpha);
  return facets.sample_visible_normal(glm::normalize(DVec3(wo_)), DVec2(v));
}

// What a facet turns the wrong way is mirrored to the right side, so that all of it comes through.
std::optional<BsdfSample> Bsdf::refract_at(const DVec3& h, const Vec3& weight) const {
  const auto wi = refract_about(DVec3(wo_), h, point_.eta);
  if (!wi || !(wi->z != 0)) return std::nullopt;
  const float radiance_scale = 1 / (point_.eta * point_.eta);
  BsdfSample s = delta_sample(Lobe::kRefraction, Vec3(wi->x, wi->y, -std::abs(wi->z)), weight * radiance_scale);
  s.radiance_scale = radiance_scale;
  return s;
}

std::optional<BsdfSample> Bsdf::refracted(const Vec2& v) const {
  if (wo_.z <= 0 || point_.inside || !(point_.eta > 0)) return std::nullopt;
  return refract_at(facet(v), point_.transmission * lobes_.diffuse_scale);
}

Vec3 Bsdf::spread(const Vec2& v) const {
  const DVec3 mirrored = reflect_at(DVec3(wo_), facet(v));
  return Vec3(mirrored.x, mirrored.y, -std::abs(mirrored.z));
}

// By a facet that mirrors it beyond the pane, and by one that turns it to the wrong side.
float Bsdf::spread_pdf(const Vec3& wi) const {
  if (wo_.z <= 0 || wi.z >= 0 || point_.alpha < kMirrorAlpha) return 0;
  const Microfacet facets(FacetModel::kGgx, wide_alpha(point_), point_.alpha);
  const DVec3 o = glm::normalize(DVec3(wo_));
  double sum = 0;
  for (const double z : {-double{wi.z}, double{wi.z}}) {
    const DVec3 h = o + DVec3(wi.x, wi.y, z);
    if (h.z > 0) sum += facets.reflected_pdf(o, glm::normalize(h));
  }
  return static_cast<float>(sum);
}

// From within: one facet reflects or refracts all of its light, what its tint takes excepted. No lobe is left to light
// sampling, since no shadow ray is bent.
std::optional<BsdfSample> Bsdf::sample_inside(float u, const Vec2& v) const {
  const DVec3 h = facet(v);
  const auto cosine = static_cast<float>(glm::dot(DVec3(wo_), h));
  const auto outside = refracted_cosine(point_.eta, cosine);
  const Vec3 mirrored = outside ? specular_fresnel(specular_lobe(point_), *outside) : Vec3(1);
  const float all = max_component(mirrored);
  if (u >= all) return refract_at(h, point_.transmission);
  const Vec3 wi(reflect_at(DVec3(wo_), h));
  if (wi.z == 0) return std::nullopt;
  return delta_sample(Lobe::kSpecular, Vec3(wi.x, wi.y, std::abs(wi.z)), mirrored / all);
}

Vec3 Bsdf::eval(const Vec3& wi) const {
  if (wo_.z <= 0 || wi.z <= 0 || point_.inside) return Vec3(0);
  Vec3 f = point_.diffuse * (lobes_.diffuse_scale / kPi * wi.z);
  if (lobes_.specular > 0) f += lobes_.under_coat * base_lobe(point_).eval(wo_, wi);
  if (lobes_.coat > 0) f += point_.coat * coat_lobe(point_).eval(wo_, wi);
  return f;
}

float Bsdf::pdf(const Vec3& wi) const {
  if (wo_.z <= 0 || wi.z <= 0 || point_.inside) return 0;
  float pdf = lobes_.diffuse * cosine_hemisphere_pdf(wi.z);
  if (lobes_.specular > 0) pdf += lobes_.specular * base_lobe(point_).pdf(wo_, wi);
  if (lobes_.coat > 0) pdf += lobes_.coat * coat_lobe(point_).pdf(wo_, wi);
  return pdf;
}

std::optional<BsdfSample> Bsdf::sample(float u, const Vec2& v) const {
  if (wo_.z <= 0) return std::nullopt;
  if (point_.inside) return sample_inside(u, v);
  BsdfSample s;
  if (u < lobes_.diffuse) {
    s.wi = square_to_cosine_hemisphere(v);
  } else if (u < lobes_.diffuse + lobes_.specular + lobes_.coat) {
    const bool base = u < lobes_.diffuse + lobes_.specular;
    const FacetLobe lobe = base ? base_lobe(point_) : coat_lobe(point_);
    const float chance = base ? lobes_.specular : lobes_.coat, share = base ? lobes_.under_coat : point_.coat;
    if (lobe.is_mirror())
      return delta_sample(Lobe::kSpecular, Vec3(-wo_.x, -wo_.y, wo_.z), lobe.mirror_weight(wo_.z) * (share / chance));
    s.lobe = Lobe::kSpecular;
    s.wi = lobe.sample(wo_, v);
  } else if (lobes_.transmission > 0 && point_.eta > 0) {
    return refract_at(facet(v), point_.transmission * (lobes_.diffuse_scale / lobes_.transmission));
  } else if (lobes_.transmission > 0) {
    return delta_sample(Lobe::kTransmission, -wo_, point_.transmission * (lobes_.diffuse_scale / lobes_.transmission));
  } else {
    return std::nullopt;
  }
  if (s.wi.z <= 0) return std::nullopt;
  s.pdf = pdf(s.wi);
  if (!(s.pdf > 0)) return std::nullopt;
  s.weight = eval(s.wi) / s.pdf;
  return s;
}

}  // namespace oriel
