#include "formats/image/contrast_sensitivity.h"

#include <cmath>

namespace oriel {

double contrast_sensitivity(double cycles_per_degree) {
  constexpr double kLuminance = 100, kSide_deg = 60;
  const double u2 = cycles_per_degree * cycles_per_degree;
  const double optics = std::exp(-0.0016 * u2 * std::pow(1 + 100 / kLuminance, 0.08));
  const double size = 1 + 144 / (kSide_deg * kSide_deg) + 0.64 * u2;
  const double noise = 63 / std::pow(kLuminance, 0.83) - 1 / std::expm1(-0.02 * u2);
  return 5200 * optics / std::sqrt(size * noise);
}

}  // namespace oriel
