#include "bake/brdf/microfacet.h"

#include <limits>

namespace oriel {
namespace {

const double kRootPi = std::sqrt(kPiD);

DVec3 ggx_visible_normal(const DVec3& stretched, const DVec2& u) {
  const double phi = 2 * kPiD * u.x, z = (1 - u.y) * (1 + stretched.z) - stretched.z;
  const double r = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
  return DVec3(r * std::cos(phi), r * std::sin(phi), z) + stretched;
}

// The slope x towards the viewer for which a share u of what is seen of a Gaussian surface of unit width is below:
// density (cosθ - x sinθ) exp(-x²) over x < cotθ. Newton's steps, halved where they leave the bracket.
double gaussian_slope(double cos_theta, double sin_theta, double u) {
  const auto seen = [&](double x) {
    return 0.5 * cos_theta * (1 + std::erf(x)) + sin_theta * std::exp(-x * x) / (2 * kRootPi);
  };
  double low = -6, high = sin_theta > 0 ? std::min(6.0, cos_theta / sin_theta) : 6.0;
  const double wanted = u * seen(high);
  double x = std::min(0.0, high);
  for (int i = 0; i < 64 && high - low > 1e-12; ++i) {
    const double error = seen(x) - wanted;
    (error > 0 ? high : low) = x;
    const double slope = (cos_theta - x * sin_theta) * std::exp(-x * x) / kRootPi;
    const double next = slope > 0 ? x - error / slope : low;
    if (std::abs(next - x) < 1e-14) break;
    x = next > low && next < high ? next : 0.5 * (low + high);
  }
  return x;
}

DVec3 beckmann_visible_normal(const DVec3& stretched, const DVec2& u) {
  const double sin_theta = std::hypot(stretched.x, stretched.y);
  const DVec2 towards = sin_theta > 0 ? DVec2(stretched.x, stretched.y) / sin_theta : DVec2(1, 0);
  const double along = gaussian_slope(stretched.z, sin_theta, u.x), across = gaussian_slope(1, 0, u.y);
  // The normal of a surface that rises by (sx, sy) is (-sx, -sy, 1).
  return {-(along * towards.x - across * towards.y), -(along * towards.y + across * towards.x), 1};
}

}  // namespace

double Microfacet::d(const DVec3& h) const {
  if (h.z < 0 || (h.z == 0 && model == FacetModel::kBeckmann)) return 0;
  const double x = h.x / alpha_x, y = h.y / alpha_y, z2 = h.z * h.z;
  const double area = kPiD * alpha_x * alpha_y;
  if (model == FacetModel::kBeckmann) return std::exp(-(x * x + y * y) / z2) / (area * z2 * z2);
  const double q = x * x + y * y + z2;
  return 1 / (area * q * q);
}

double Microfacet::lambda(const DVec3& v) const {
  const double x = alpha_x * v.x, y = alpha_y * v.y, z2 = v.z * v.z;
  if (!(z2 > 0)) return std::numeric_limits<double>::infinity();
  const double tan2 = (x * x + y * y) / z2;  // of the stretched direction
  if (model == FacetModel::kGgx) return 0.5 * tan2 / (1 + std::sqrt(1 + tan2));
  if (tan2 <= 0) return 0;
  const double a = 1 / std::sqrt(tan2);
  return std::max(0.0, std::exp(-a * a) / (2 * a * kRootPi) - 0.5 * std::erfc(a));
}

double Microfacet::f_cos(const DVec3& wo, const DVec3& wi, const DVec3& h) const {
  return wi.z > 0 ? d(h) * g2(wo, wi) / (4 * wo.z) : 0;
}

DVec3 Microfacet::sample_visible_normal(const DVec3& wo, const DVec2& u) const {
  const DVec3 stretched = glm::normalize(DVec3(alpha_x * wo.x, alpha_y * wo.y, wo.z));
  const DVec3 n = model == FacetModel::kGgx ? ggx_visible_normal(stretched, u) : beckmann_visible_normal(stretched, u);
  return glm::normalize(DVec3(alpha_x * n.x, alpha_y * n.y, std::max(1e-12, n.z)));
}

}  // namespace oriel
