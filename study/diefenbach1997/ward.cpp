#include "study/diefenbach1997/ward.h"

#include "formats/core/file.h"
#include "study/rooms.h"

namespace oriel::study {
namespace {

constexpr int kAngles = 20000;  // of the fit

double tan2_of(double cos_h) {
  return std::max(0.0, (1 - cos_h) * (1 + cos_h)) / (cos_h * cos_h);
}

double sin2_of(const DVec3& h) {
  return h.x * h.x + h.y * h.y;
}

// Pearson's χ² of two lobes of peak about 1, where the first is more than 1e-6.
double chi_square(const Ward& ward, const Phong& phong) {
  const double peak = ward.lobe(1);
  double sum = 0;
  for (int i = 0; i < kAngles; ++i) {
    const double cos_h = std::cos((i + 0.5) / kAngles * kPiD / 2);
    const double expected = ward.lobe(cos_h) / peak, difference = phong.lobe(cos_h) / peak - expected;
    if (expected > 1e-6) sum += difference * difference / expected;
  }
  return sum / kAngles;
}

}  // namespace

double Ward::lobe(double cos_h) const {
  return cos_h > 0 ? std::exp(-tan2_of(cos_h) / (alpha * alpha)) / (4 * kPiD * alpha * alpha) : 0;
}

double Ward::f_cos(const DVec3& wo, const DVec3& wi, const DVec3& h) const {
  if (wi.z <= 0 || wo.z <= 0 || h.z <= 0) return 0;
  const double value = std::exp(-sin2_of(h) / (h.z * h.z * alpha * alpha)) / (4 * kPiD * alpha * alpha);
  if (norm == WardNorm::kOriginal) return value * std::sqrt(wi.z / wo.z);
  if (norm == WardNorm::kDuer) return value / wo.z;
  const double cos_d = glm::dot(wo, h);  // (H·H) / (H·n)⁴ of H = wo + wi is 1 / (4 cos²d cos⁴δ)
  return value * wi.z / (cos_d * cos_d * std::pow(h.z, 4));
}

double Phong::lobe(double cos_h) const {
  return cos_h > 0 ? gain * std::pow(cos_h, exponent) : 0;
}

double Phong::f_cos(const DVec3&, const DVec3& wi, const DVec3& h) const {
  return wi.z > 0 ? lobe(h.z) * wi.z : 0;
}

Phong cited_phong(double alpha) {
  const double exponent = 1.999 / (alpha * alpha);
  return {exponent, 0.0398 * exponent};
}

PhongFit fit_phong(double alpha) {
  const Ward ward{WardNorm::kOriginal, alpha};
  const double peak = ward.lobe(1);
  // exp(n log cos) g against Ward's lobe over its peak, in n and g; the lobe ends where it is below 1e-16.
  const double end = std::min(kPiD / 2, std::atan(alpha * std::sqrt(36.0)));
  double n = 2 / (alpha * alpha), g = 1;
  for (int step = 0; step < 50; ++step) {
    double nn = 0, ng = 0, gg = 0, rn = 0, rg = 0;
    for (int i = 0; i < kAngles; ++i) {
      const double cos_h = std::cos((i + 0.5) / kAngles * end), log_cos = std::log(cos_h);
      const double power = std::exp(n * log_cos), rest = ward.lobe(cos_h) / peak - g * power;
      const double by_n = g * power * log_cos;
      nn += by_n * by_n, ng += by_n * power, gg += power * power;
      rn += by_n * rest, rg += power * rest;
    }
    const double determinant = nn * gg - ng * ng;
    const double step_n = (rn * gg - rg * ng) / determinant, step_g = (rg * nn - rn * ng) / determinant;
    n += step_n, g += step_g;
    if (std::abs(step_n) < 1e-12 * n && std::abs(step_g) < 1e-12) break;
  }
  const Phong phong{n, g * peak};
  return {phong, chi_square(ward, phong), chi_square(ward, cited_phong(alpha))};
}

ToolCommand phong_fit_command() {
  return {.name = "phong-fit",
          .help = "Phong's lobe fitted to Ward's, beside 1.999/alpha^2 and 0.0398 exponent of Diefenbach & Badler 1997",
          .footer = {},
          .options = {},
          .run = [] {
            std::string text = fmt::format("{:>8} {:>18} {:>14} {:>12} {:>16}\n", "alpha", "exponent*alpha^2",
                                           "gain/exponent", "chi2", "chi2 cited");
            for (const double alpha : {0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5}) {
              const auto [phong, chi2, cited] = fit_phong(alpha);
              text += fmt::format("{:8g} {:18.5f} {:14.6f} {:12.3g} {:16.3g}\n", alpha, phong.exponent * alpha * alpha,
                                  phong.gain / phong.exponent, chi2, cited);
            }
            return oriel::print(text);
          }};
}

}  // namespace oriel::study
