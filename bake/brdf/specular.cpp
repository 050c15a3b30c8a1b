#include "bake/brdf/specular.h"

#include <map>
#include <mutex>
#include <tuple>

#include "bake/brdf/quadrature.h"

namespace oriel {
namespace {

constexpr int kWidths = 33;        // row j at roughness j / (n-1), alpha its square
constexpr int kCosines = 64;       // of mean weights, even in √cosθ
constexpr int kCurveNodes = 1025;  // of a Fresnel curve, even in √cosθ: right to 1e-4 for indices from 1.0001
constexpr int kGgxOrder = 12;
constexpr double kNarrowest = 1e-6;  // stands for the limit of alpha → 0

double row_alpha(int j) {
  const double roughness = static_cast<double>(j) / (kWidths - 1);
  return std::max(kNarrowest, roughness * roughness);
}

// Between rows of a roughness.
struct Rows {
  std::size_t j;
  double f;
};
Rows rows_at(double alpha) {
  const double y = std::sqrt(std::clamp(alpha, 0.0, 1.0)) * (kWidths - 1);
  const auto j = std::min(static_cast<std::size_t>(y), std::size_t{kWidths - 2});
  return {j, y - static_cast<double>(j)};
}

std::vector<DVec3> curve_table(const FresnelCurve& curve) {
  std::vector<DVec3> table;
  table.reserve(kCurveNodes);
  for (int i = 0; i < kCurveNodes; ++i) {
    const double root = static_cast<double>(i) / (kCurveNodes - 1);
    table.push_back(fresnel_weight(curve, root * root));
  }
  return table;
}

// Linear in √cosθ.
DVec3 in_root(const DVec3* table, int size, double cos_theta) {
  const double x = std::sqrt(std::clamp(cos_theta, 0.0, 1.0)) * (size - 1);
  const int i = std::min(static_cast<int>(x), size - 2);
  return glm::mix(table[i], table[i + 1], x - i);
}

struct GgxTable {
  std::vector<Compensation> rows;
  GgxTable() {
    for (int j = 0; j < kWidths; ++j) rows.emplace_back(Microfacet(FacetModel::kGgx, row_alpha(j)), kGgxOrder);
  }
};
const GgxTable& ggx_table() {
  static const GgxTable table;
  return table;
}

// Both neighbours at the same share of their own width: q and not cosθ is what rows have in common.
double in_rows(double alpha, double cos_theta, double (Compensation::*value)(double) const) {
  const auto [j, f] = rows_at(alpha);
  const double c = std::clamp(cos_theta, 0.0, 1.0);
  const double q = Compensation::coordinate(alpha, c) / (Compensation::kNodes - 1);
  const auto of_row = [&](std::size_t row) {
    const double a = row_alpha(static_cast<int>(row));
    return (ggx_table().rows[row].*value)(std::min(1.0, q * a / (1 + a - q)));
  };
  return of_row(j) + f * (of_row(j + 1) - of_row(j));
}

// Means over the GGX lobe of a curve's weight, by roughness and √cosθ.
struct MeanWeights {
  std::vector<DVec3> table;
  explicit MeanWeights(const FresnelCurve& curve) {
    const std::vector<DVec3> weights = curve_table(curve);
    table.reserve(kWidths * kCosines);
    for (int j = 0; j < kWidths; ++j)
      for (int i = 0; i < kCosines; ++i) {
        const double root = static_cast<double>(i) / (kCosines - 1), cos_theta = std::max(1e-6, root * root);
        const Microfacet facets(FacetModel::kGgx, row_alpha(j));
        const DVec3 wo = direction_at(cos_theta);
        DVec3 sum(0);
        double total = 0;
        for_each_reflection(cos_theta, facets.alpha_x, kGgxOrder, [&](const DVec3& wi, const DVec3& h, double angle) {
          const double weight = facets.f_cos(wo, wi, h) * angle;
          sum += weight * in_root(weights.data(), kCurveNodes, glm::dot(wo, h));
          total += weight;
        });
        table.push_back(sum / total);
      }
  }
  DVec3 at(double alpha, double cos_theta) const {
    const auto [j, f] = rows_at(alpha);
    const DVec3* row = &table[j * kCosines];
    return glm::mix(in_root(row, kCosines, cos_theta), in_root(row + kCosines, kCosines, cos_theta), f);
  }
};

// Tables of the curves in use, kept once made.
const MeanWeights& mean_weights(const FresnelCurve& curve) {
  thread_local FresnelCurve last_curve;
  thread_local const MeanWeights* last = nullptr;
  if (last && last_curve == curve) return *last;
  static std::mutex mutex;
  static std::map<std::tuple<float, float, Metal>, MeanWeights> made;
  const std::scoped_lock lock(mutex);
  last = &made.try_emplace({curve.ior, curve.schlick, curve.metal}, curve).first->second;
  last_curve = curve;
  return *last;
}

DVec3 mean_weight(const FresnelCurve& curve, double alpha, double cos_theta) {
  if (alpha < kMirrorAlpha) return fresnel_weight(curve, cos_theta);
  if (curve.metal != Metal::kNone) return mean_weights(curve).at(alpha, cos_theta);
  static const MeanWeights schlick{FresnelCurve{}};
  const DVec3 of_schlick = schlick.at(alpha, cos_theta);
  if (!(curve.ior > 0) || curve.schlick >= 1) return of_schlick;
  const DVec3 exact = mean_weights({.ior = curve.ior, .schlick = 0}).at(alpha, cos_theta);
  return glm::mix(exact, of_schlick, double{curve.schlick});
}

double single_albedo(double alpha, double cos_theta) {
  return alpha < kMirrorAlpha ? 1 : std::min(1.0, in_rows(alpha, cos_theta, &Compensation::albedo));
}

DVec3 fresnel_of(const SpecularLobe& lobe, const DVec3& weight) {
  return DVec3(lobe.f0) + (DVec3(lobe.f90) - DVec3(lobe.f0)) * weight;
}

}  // namespace

Vec3 specular_fresnel(const SpecularLobe& lobe, double cos_theta) {
  return Vec3(fresnel_of(lobe, fresnel_weight(lobe.curve, cos_theta)));
}

Albedo lobe_albedo(const CosineLobe& lobe, const Compensation& compensation, const LobeFresnel& fresnel,
                   double cos_theta, int order) {
  const DVec3 wo = direction_at(cos_theta);
  const double scale = compensation.scale(cos_theta);
  Albedo albedo;
  for_each_reflection(cos_theta, lobe.width, order, [&](const DVec3& wi, const DVec3& h, double angle) {
    const DVec3 value = lobe.f_cos(wo, wi, h) * angle * fresnel.at(glm::dot(wo, h));
    albedo.single += value;
    albedo.compensated += value * (1.0 + fresnel.f0 * (scale * compensation.scale(wi.z) - 1));
  });
  return albedo;
}

ExactReflectance::ExactReflectance(const SpecularLobe& lobe) : lobe_(lobe) {
  if (lobe_.alpha < kMirrorAlpha) return;
  compensation_.emplace(Microfacet(FacetModel::kGgx, lobe_.alpha), kGgxOrder);
  weights_ = curve_table(lobe_.curve);
}

Vec3 ExactReflectance::operator()(double cos_theta) const {
  if (!compensation_) return specular_fresnel(lobe_, cos_theta);
  const Microfacet facets(FacetModel::kGgx, lobe_.alpha);
  const Albedo albedo = lobe_albedo(
      {[&](const DVec3& wo, const DVec3& wi, const DVec3& h) { return facets.f_cos(wo, wi, h); }, lobe_.alpha},
      *compensation_,
      {[&](double cosine) { return fresnel_of(lobe_, in_root(weights_.data(), kCurveNodes, cosine)); },
       DVec3(lobe_.f0)},
      std::clamp(cos_theta, 1e-6, 1.0), kGgxOrder);
  return glm::min(Vec3(albedo.compensated), Vec3(1));
}

Vec3 specular_reflectance(const SpecularLobe& lobe, float cos_theta) {
  const DVec3 fresnel = fresnel_of(lobe, mean_weight(lobe.curve, lobe.alpha, cos_theta));
  const double single = single_albedo(lobe.alpha, cos_theta);
  return glm::clamp(Vec3(fresnel * (single + DVec3(lobe.f0) * (1 - single))), Vec3(0), Vec3(1));
}

double ggx_scale(double alpha, double cos_theta) {
  return in_rows(alpha, cos_theta, &Compensation::scale);
}

}  // namespace oriel
