#include "scenes/sky.h"

#include <array>

#include "formats/core/vec.h"

namespace oriel::sample {
namespace {

constexpr int kTraditionalOvercast = 16;

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

DVec3 direction_of(double elevation_rad, double azimuth_rad) {
  const double level = std::cos(elevation_rad);
  return {level * std::sin(azimuth_rad), std::sin(elevation_rad), -level * std::cos(azimuth_rad)};
}

// Relative luminance towards a unit direction of the upper half.
double luminance_towards(const SkyOptions& o, const DVec3& sun, const DVec3& direction) {
  return relative_sky_luminance(o.type, std::acos(std::clamp(direction.y, -1.0, 1.0)), std::acos(sun.y),
                                std::acos(std::clamp(glm::dot(direction, sun), -1.0, 1.0)));
}

// What a sky of zenith luminance 1 sheds on level ground: the midpoint rule in sin²(elevation) and azimuth.
double relative_illuminance(const SkyOptions& o, const DVec3& sun) {
  constexpr int kRings = 256, kSpokes = 512;
  double sum = 0;
  for (int i = 0; i < kRings; ++i)
    for (int k = 0; k < kSpokes; ++k)
      sum += luminance_towards(o, sun,
                               direction_of(std::asin(std::sqrt((i + 0.5) / kRings)), 2 * kPiD * (k + 0.5) / kSpokes));
  return kPiD * sum / (double{kRings} * kSpokes);
}

Status check(const SkyOptions& o) {
  const auto outside = [](double v, double lowest, double highest) { return !(v >= lowest && v <= highest); };
  if (o.type < 1 || o.type > kTraditionalOvercast)
    return fail(ErrorCode::kUsage, "sky", "found type {}, expected 1 to {}", o.type, kTraditionalOvercast);
  if (outside(o.elevation_deg, 0, 90))
    return fail(ErrorCode::kUsage, "sky", "found elevation {}, expected 0 to 90 degrees", o.elevation_deg);
  if (outside(o.azimuth_deg, -360, 360))
    return fail(ErrorCode::kUsage, "sky", "found azimuth {}, expected -360 to 360 degrees", o.azimuth_deg);
  if (outside(o.horizontal_lux, 0, 1e9) || outside(o.zenith_cd_m2, 0, 1e9))
    return fail(ErrorCode::kUsage, "sky", "found {} lux and {} cd/m², expected 0 to 1e9", o.horizontal_lux,
                o.zenith_cd_m2);
  if (outside(o.ground, 0, 1))
    return fail(ErrorCode::kUsage, "sky", "found ground reflectance {}, expected 0 to 1", o.ground);
  if (o.height < 2 || o.height > 16384)
    return fail(ErrorCode::kUsage, "sky", "found {} rows, expected 2 to 16384", o.height);
  return {};
}

}  // namespace

double relative_sky_luminance(int type, double zenith_angle, double sun_zenith_angle, double sun_distance) {
  if (type == kTraditionalOvercast) return (1 + 2 * std::cos(zenith_angle)) / 3;
  const SkyType& t = kTypes[static_cast<std::size_t>(type - 1)];
  return indicatrix(t, sun_distance) * gradation(t, std::cos(zenith_angle)) /
         (indicatrix(t, sun_zenith_angle) * gradation(t, 1));
}

Result<FloatImage> make_sky(const SkyOptions& o) {
  if (const Status checked = check(o); !checked) return tl::unexpected<Error>(checked.error());
  constexpr double kRadians = kPiD / 180;
  const DVec3 sun = direction_of(o.elevation_deg * kRadians, o.azimuth_deg * kRadians);
  const double relative = relative_illuminance(o, sun);
  const double zenith = o.zenith_cd_m2 > 0 ? o.zenith_cd_m2 : o.horizontal_lux / relative;
  const double ground = o.ground / kPiD * zenith * relative;
  FloatImage image{2 * o.height, o.height, 3, {}};
  image.pixels.reserve(std::size_t{6} * o.height * o.height);
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const double theta = kPiD * (y + 0.5) / image.height, phi = 2 * kPiD * ((x + 0.5) / image.width - 0.5);
      const DVec3 direction(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      const double value = direction.y > 0 ? zenith * luminance_towards(o, sun, direction) : ground;
      image.pixels.insert(image.pixels.end(), 3, static_cast<float>(value));
    }
  return image;
}

}  // namespace oriel::sample
