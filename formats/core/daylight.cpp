#include "formats/core/daylight.h"

#include <array>

namespace oriel {
namespace {

struct SkyType {
  double a, b, c, d, e;
};

// ISO 15469:2004, table 1.
constexpr std::array<SkyType, 15> kTypes = {{{4, -0.7, 0, -1, 0},
                                             {4, -0.7, 2, -1.5, 0.15},
                                             {1.1, -0.8, 0, -1, 0},
                                             {1.1, -0.8, 2, -1.5, 0.15},
                                             {0, -1, 0, -1, 0},
                                             {0, -1, 2, -1.5, 0.15},
                                             {0, -1, 5, -2.5, 0.3},
                                             {0, -1, 10, -3, 0.45},
                                             {-1, -0.55, 2, -1.5, 0.15},
                                             {-1, -0.55, 5, -2.5, 0.3},
                                             {-1, -0.55, 10, -3, 0.45},
                                             {-1, -0.32, 10, -3, 0.45},
                                             {-1, -0.32, 16, -3, 0.3},
                                             {-1, -0.15, 16, -3, 0.3},
                                             {-1, -0.15, 24, -2.8, 0.15}}};

double gradation(const SkyType& t, double cos_zenith) {
  return 1 + t.a * std::exp(t.b / std::max(cos_zenith, 1e-6));
}

double indicatrix(const SkyType& t, double chi) {
  return 1 + t.c * (std::exp(t.d * chi) - std::exp(t.d * kPiD / 2)) + t.e * std::cos(chi) * std::cos(chi);
}

// Extinction of the sun's light, negative: it is not seen; and the sky's light on level ground, a + b sin^c of the
// sun's elevation, klx.
struct Availability {
  double extinction, a, b, c;
};

const Availability& availability(int sky_type) {
  static constexpr Availability kOvercast{-1, 0.3, 21, 1}, kPartlyCloudy{0.8, 0.3, 45, 1}, kClear{0.21, 0.8, 15.5, 0.5};
  return sky_type <= 5 || sky_type == kTraditionalOvercast ? kOvercast : sky_type <= 10 ? kPartlyCloudy : kClear;
}

}  // namespace

double relative_sky_luminance(int type, double zenith_angle, double sun_zenith_angle, double sun_distance) {
  if (type == kTraditionalOvercast) return (1 + 2 * std::cos(zenith_angle)) / 3;
  const SkyType& t = kTypes[static_cast<std::size_t>(type - 1)];
  return indicatrix(t, sun_distance) * gradation(t, std::cos(zenith_angle)) /
         (indicatrix(t, sun_zenith_angle) * gradation(t, 1));
}

DVec3 sky_direction(double elevation_rad, double azimuth_rad) {
  const double level = std::cos(elevation_rad);
  return {level * std::sin(azimuth_rad), std::sin(elevation_rad), -level * std::cos(azimuth_rad)};
}

double CieSky::luminance(const DVec3& direction) const {
  return relative_sky_luminance(type, std::acos(std::clamp(direction.y, -1.0, 1.0)),
                                std::acos(std::clamp(to_sun.y, -1.0, 1.0)),
                                std::acos(std::clamp(glm::dot(direction, to_sun), -1.0, 1.0)));
}

// The midpoint rule in sin²(elevation) and azimuth.
double CieSky::illuminance() const {
  constexpr int kRings = 256, kSpokes = 512;
  double sum = 0;
  for (int i = 0; i < kRings; ++i)
    for (int k = 0; k < kSpokes; ++k)
      sum += luminance(sky_direction(std::asin(std::sqrt((i + 0.5) / kRings)), 2 * kPiD * (k + 0.5) / kSpokes));
  return kPiD * sum / (double{kRings} * kSpokes);
}

MeanDaylight mean_daylight(int sky_type, int day, double elevation_deg) {
  constexpr double kSolarConstant_lux = 127500;
  const double sine = std::sin(elevation_deg * kPiD / 180);
  if (!(sine > 0)) return {};
  const Availability& of = availability(sky_type);
  MeanDaylight light;
  if (of.extinction >= 0)
    light.sun_lux =
        kSolarConstant_lux * (1 + 0.034 * std::cos(2 * kPiD * (day - 2) / 365)) * std::exp(-of.extinction / sine);
  light.sky_lux = 1000 * (of.a + of.b * std::pow(sine, of.c));
  return light;
}

}  // namespace oriel
