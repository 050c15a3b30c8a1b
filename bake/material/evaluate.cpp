#include "bake/material/evaluate.h"

#include "bake/brdf/quadrature.h"
#include "bake/brdf/specular.h"
#include "bake/brdf/ward.h"

namespace oriel {
namespace {

constexpr double kGrazing = 1e-6;  // cosθ that stands for 90°, where albedos have their limit
constexpr int kOrder = 32;

// What the models have in common.
struct Lobe {
  CosineLobe lobe;
  std::function<double(const DVec3&)> d;
};

Lobe lobe_of(BrdfModel model, double alpha) {
  if (model == BrdfModel::kGgx || model == BrdfModel::kBeckmann) {
    const Microfacet facets(model == BrdfModel::kGgx ? FacetModel::kGgx : FacetModel::kBeckmann, alpha);
    return {{[=](const DVec3& wo, const DVec3& wi, const DVec3& h) { return facets.f_cos(wo, wi, h); }, alpha},
            [=](const DVec3& h) { return facets.d(h); }};
  }
  if (model == BrdfModel::kPhong) {
    const Phong phong = cited_phong(alpha);
    return {{[=](const DVec3& wo, const DVec3& wi, const DVec3& h) { return phong.f_cos(wo, wi, h); }, alpha},
            [=](const DVec3& h) { return phong.lobe(h.z); }};
  }
  const Ward ward{model == BrdfModel::kWardOriginal ? WardNorm::kOriginal
                  : model == BrdfModel::kWardDuer   ? WardNorm::kDuer
                                                    : WardNorm::kBounded,
                  alpha};
  return {{[=](const DVec3& wo, const DVec3& wi, const DVec3& h) { return ward.f_cos(wo, wi, h); }, alpha},
          [=](const DVec3& h) { return ward.lobe(h.z); }};
}

DVec3 exact_fresnel(const EvaluateOptions& options, double cos_theta) {
  if (!options.index) return DVec3(1);
  DVec3 f;
  for (int c = 0; c < 3; ++c) f[c] = fresnel_conductor((*options.index)[static_cast<std::size_t>(c)], cos_theta);
  return f;
}

DVec3 schlick_fresnel(const DVec3& f0, double cos_theta) {
  return f0 + (1.0 - f0) * schlick_weight(cos_theta);
}

}  // namespace

std::vector<Evaluation> evaluate(const EvaluateOptions& options) {
  const auto [lobe, d] = lobe_of(options.model, options.alpha);
  const Compensation compensation(lobe, kOrder);
  const DVec3 f0 = exact_fresnel(options, 1);
  const auto fresnel = [&](double cosine) {
    return options.schlick ? schlick_fresnel(f0, cosine) : exact_fresnel(options, cosine);
  };
  const bool compensable = options.model != BrdfModel::kWardOriginal && options.model != BrdfModel::kWardDuer;
  std::vector<Evaluation> rows;
  for (const double angle_deg : options.angles_deg) {
    // cos 90° of a rounded π/2 is not 0.
    const double cos_theta = angle_deg >= 90 ? 0 : std::cos(angle_deg * kPiD / 180);
    Evaluation row;
    row.angle_deg = angle_deg;
    row.f = fresnel(cos_theta);
    row.f_error = schlick_fresnel(f0, cos_theta) - exact_fresnel(options, cos_theta);
    const DVec3 w = direction_at(cos_theta);
    row.d = d(w);
    if (options.model == BrdfModel::kGgx || options.model == BrdfModel::kBeckmann) {
      const Microfacet facets(options.model == BrdfModel::kGgx ? FacetModel::kGgx : FacetModel::kBeckmann,
                              options.alpha);
      row.g1 = facets.g1(w);
      row.g2 = facets.g2(w, w);
    }
    const Albedo albedo = lobe_albedo(lobe, compensation, {fresnel, f0}, std::max(cos_theta, kGrazing), kOrder);
    row.albedo = albedo.single;
    if (compensable) row.compensated = albedo.compensated;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace oriel
