#include "bake/material/lobe.h"

namespace oriel {

LobeFunction microfacet_lobe(FacetModel model, double alpha) {
  return [facets = Microfacet(model, alpha)](const DVec3& wo, const DVec3& wi, const DVec3& h) {
    return facets.f_cos(wo, wi, h);
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
