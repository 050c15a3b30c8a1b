#include "bake/trace/bsdf.h"

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

// The lobes as wo sees them: probabilities in proportion to their albedo, sum 1 or all 0; and what each one leaves to
// those below it.
struct LobeChoice {
  float diffuse = 0, specular = 0, coat = 0, transmission = 0;
  float under_coat = 1;     // 1 - coat R_c
  float diffuse_scale = 1;  // (1 - coat R_c) (1 - max R)
};

LobeChoice choose_lobes(const ShadePoint& point, float cos_o) {
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

float pdf_of(const ShadePoint& point, const LobeChoice& lobes, const Vec3& wo, const Vec3& wi) {
  float pdf = lobes.diffuse * cosine_hemisphere_pdf(wi.z);
  if (lobes.specular > 0) pdf += lobes.specular * base_lobe(point).pdf(wo, wi);
  if (lobes.coat > 0) pdf += lobes.coat * coat_lobe(point).pdf(wo, wi);
  return pdf;
}

Vec3 eval_with(const ShadePoint& point, const LobeChoice& lobes, const Vec3& wo, const Vec3& wi) {
  Vec3 f = point.diffuse * (lobes.diffuse_scale / kPi * wi.z);
  if (lobes.specular > 0) f += lobes.under_coat * base_lobe(point).eval(wo, wi);
  if (lobes.coat > 0) f += point.coat * coat_lobe(point).eval(wo, wi);
  return f;
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

Vec3 bsdf_eval(const ShadePoint& point, const Vec3& wo, const Vec3& wi) {
  if (wo.z <= 0 || wi.z <= 0) return Vec3(0);
  return eval_with(point, choose_lobes(point, wo.z), wo, wi);
}

float bsdf_pdf(const ShadePoint& point, const Vec3& wo, const Vec3& wi) {
  if (wo.z <= 0 || wi.z <= 0) return 0;
  return pdf_of(point, choose_lobes(point, wo.z), wo, wi);
}

std::optional<BsdfSample> bsdf_sample(const ShadePoint& point, const Vec3& wo, float u, const Vec2& v) {
  if (wo.z <= 0) return std::nullopt;
  const LobeChoice lobes = choose_lobes(point, wo.z);
  BsdfSample s;
  if (u < lobes.diffuse) {
    s.wi = square_to_cosine_hemisphere(v);
  } else if (u < lobes.diffuse + lobes.specular + lobes.coat) {
    const bool base = u < lobes.diffuse + lobes.specular;
    const FacetLobe lobe = base ? base_lobe(point) : coat_lobe(point);
    const float chance = base ? lobes.specular : lobes.coat, share = base ? lobes.under_coat : point.coat;
    if (lobe.is_mirror())
      return delta_sample(Lobe::kSpecular, Vec3(-wo.x, -wo.y, wo.z), lobe.mirror_weight(wo.z) * (share / chance));
    s.lobe = Lobe::kSpecular;
    s.wi = lobe.sample(wo, v);
  } else if (lobes.transmission > 0) {
    return delta_sample(Lobe::kTransmission, -wo, point.transmission * (lobes.diffuse_scale / lobes.transmission));
  } else {
    return std::nullopt;
  }
  if (s.wi.z <= 0) return std::nullopt;
  s.pdf = pdf_of(point, lobes, wo, s.wi);
  if (!(s.pdf > 0)) return std::nullopt;
  s.weight = eval_with(point, lobes, wo, s.wi) / s.pdf;
  return s;
}

}  // namespace oriel
