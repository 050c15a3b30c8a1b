#include "bake/brdf/compensation.h"

#include "bake/brdf/quadrature.h"

namespace oriel {
namespace {

constexpr int kNodes = Compensation::kNodes;
constexpr int kMaxSteps = 200;
constexpr double kBalanced = 1e-7;

struct Interval {
  std::size_t i;
  double f;  // towards i + 1
};

Interval interval(double width, double cos_theta) {
  const double at = Compensation::coordinate(width, cos_theta);
  const double x = at > 0 ? std::min(at, double{kNodes - 1}) : 0;  // NaN: 0
  const auto i = std::min(static_cast<std::size_t>(x), std::size_t{kNodes - 2});
  return {i, x - static_cast<double>(i)};
}

using Row = std::array<double, kNodes>;

// Row i of the operator (K s)(θo) = ∫ f s(θi) cosθi dωi for a table s.
Row row(const LobeFunction& f_cos, double width, double cos_theta, int order) {
  Row k{};
  const DVec3 wo = direction_at(cos_theta);
  for_each_reflection(cos_theta, width, order, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
    const double weight = f_cos(wo, wi, h) * solid_angle;
    const auto [i, f] = interval(width, wi.z);
    k[i] += weight * (1 - f);
    k[i + 1] += weight * f;
  });
  return k;
}

}  // namespace

Compensation::Compensation(const CosineLobe& lobe, int order) : width_(lobe.width) {
  std::array<Row, kNodes> k;
  for (int i = 0; i < kNodes; ++i) {
    const double q = std::max(1e-6, static_cast<double>(i) / (kNodes - 1));
    const double cos_theta = std::min(1.0, q * width_ / (1 + width_ - q));
    k[static_cast<std::size_t>(i)] = row(lobe.f_cos, width_, cos_theta, order);
  }
  scale_.fill(1);
  for (int step = 0; step < kMaxSteps; ++step) {
    double imbalance = 0;  // of a lobe without absorption, from 1
    Row reflected{};
    for (std::size_t i = 0; i < kNodes; ++i) {
      for (std::size_t j = 0; j < kNodes; ++j) reflected[i] += k[i][j] * scale_[j];
      if (step == 0) albedo_[i] = reflected[i];
      imbalance = std::max(imbalance, std::abs(scale_[i] * reflected[i] - 1));
    }
    if (imbalance < kBalanced) break;
    for (std::size_t i = 0; i < kNodes; ++i) scale_[i] = std::sqrt(scale_[i] / reflected[i]);
  }
}

Compensation::Compensation(const Microfacet& isotropic, int order)
    : Compensation({[&](const DVec3& wo, const DVec3& wi, const DVec3& h) { return isotropic.f_cos(wo, wi, h); },
                    isotropic.alpha_x},
                   order) {}

double Compensation::at(const Row& table, double cos_theta) const {
  const auto [i, f] = interval(width_, cos_theta);
  return table[i] + f * (table[i + 1] - table[i]);
}

}  // namespace oriel
