#include "bake/material/lobe.h"

namespace oriel {
namespace {

// D(h) from tan² and cos of the half vector's angle: no difference of nearly equal numbers at tiny alpha.
double facet_density(KernelModel model, double alpha, double tan2, double cos_h) {
  const double a2 = alpha * alpha, c4 = cos_h * cos_h * cos_h * cos_h;
  if (model == KernelModel::kBeckmannDg) return std::exp(-tan2 / a2) / (kPiD * a2 * c4);
  const double q = 1 + tan2 / a2;
  return 1 / (kPiD * a2 * c4 * q * q);
}

double v_cavity_masking(const DVec3& wo, const DVec3& wi, double cos_h, double cos_d) {
  return std::min(1.0, 2 * cos_h * std::min(wo.z, wi.z) / cos_d);
}

}  // namespace

double smith_lambda(KernelModel model, double alpha, double cos_v) {
  const double tan2 = std::max(0.0, 1 - cos_v * cos_v) / (cos_v * cos_v);
  if (tan2 <= 0) return 0;
  if (model == KernelModel::kGgxDg) return 0.5 * (std::sqrt(1 + alpha * alpha * tan2) - 1);
  // Beckmann, exact: (erf(a) - 1) / 2 + exp(-a²) / (2 a √π), a = 1 / (α tanθ).
  const double a = 1 / (alpha * std::sqrt(tan2));
  return std::max(0.0, std::exp(-a * a) / (2 * a * std::sqrt(kPiD)) - 0.5 * std::erfc(a));
}

LobeFunction microfacet_lobe(KernelModel model, LobeForm form, double alpha) {
  return [=](const DVec3& wo, const DVec3& wi, const DVec3& h) {
    if (wi.z <= 0 || wo.z <= 0) return 0.0;
    const double tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z);
    double g = 1;
    if (form == LobeForm::kDg) g = v_cavity_masking(wo, wi, h.z, glm::dot(wo, h));
    if (form == LobeForm::kLobe) g = 1 / (1 + smith_lambda(model, alpha, wo.z) + smith_lambda(model, alpha, wi.z));
    return facet_density(model, alpha, tan2, h.z) * g / (4 * wo.z);
  };
}

}  // namespace oriel
