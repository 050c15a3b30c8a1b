#include "bake/material/lobe.h"

namespace oriel {

double gaussian_d(double cos_theta, double alpha) {
  if (cos_theta <= 0) return 0;
  const double angle = std::acos(std::min(cos_theta, 1.0)) / alpha;
  return std::exp(-angle * angle) / (kPiD * alpha * alpha);
}

LobeFunction microfacet_lobe(KernelModel model, LobeForm form, double alpha) {
  if (model == KernelModel::kGaussian)
    return [=](const DVec3& wo, const DVec3& wi, const DVec3& h) {
      if (wi.z <= 0) return 0.0;
      return gaussian_d(h.z, alpha) * (form == LobeForm::kD ? 1.0 : v_cavity_g(wo, wi, h)) / (4 * wo.z);
    };
  const Microfacet facets(model == KernelModel::kGgx ? FacetModel::kGgx : FacetModel::kBeckmann, alpha);
  if (form == LobeForm::kLobe)
    return [=](const DVec3& wo, const DVec3& wi, const DVec3& h) { return facets.f_cos(wo, wi, h); };
  return [=](const DVec3& wo, const DVec3& wi, const DVec3& h) {
    if (wi.z <= 0) return 0.0;
    return facets.d(h) * (form == LobeForm::kDg ? v_cavity_g(wo, wi, h) : 1.0) / (4 * wo.z);
  };
}

std::vector<LobeNode> lobe_nodes(const LobeFunction& lobe, double alpha, const MirrorFrame& frame, int polar,
                                 int azimuth) {
  std::vector<LobeNode> nodes;
  nodes.reserve(static_cast<std::size_t>(polar) * static_cast<std::size_t>(azimuth));
  for (int i = 0; i < polar; ++i)
    for (int j = 0; j < azimuth; ++j) {
      const double t = (i + glm::fract((j + 0.5) * 0.6180339887498949)) / polar, slope = alpha * t / (1 - t);
      const double phi = kPiD * (j + 0.5) / azimuth, cos_h = 1 / std::sqrt(1 + slope * slope);
      const DVec3 h = cos_h * DVec3(slope * std::cos(phi), slope * std::sin(phi), 1);
      const double cos_d = glm::dot(frame.wo, h);
      const DVec3 wi = 2 * cos_d * h - frame.wo;
      if (cos_d <= 0 || wi.z <= 0) continue;
      const double d_slope = alpha / ((1 - t) * (1 - t)) / polar;
      const double d_half = cos_h * cos_h * cos_h * slope * d_slope * 2 * kPiD / azimuth;  // both sides
      nodes.push_back({wi, lobe(frame.wo, wi, h) * 4 * cos_d * d_half});
    }
  return nodes;
}

}  // namespace oriel
