#include "scenes/sky.h"

#include "formats/core/daylight.h"

namespace oriel::sample {
namespace {

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

Result<FloatImage> make_sky(const SkyOptions& o) {
  if (const Status checked = check(o); !checked) return tl::unexpected<Error>(checked.error());
  constexpr double kRadians = kPiD / 180;
  const CieSky sky{o.type, sky_direction(o.elevation_deg * kRadians, o.azimuth_deg * kRadians)};
  const double relative = sky.illuminance();
  const double zenith = o.zenith_cd_m2 > 0 ? o.zenith_cd_m2 : o.horizontal_lux / relative;
  const double ground = o.ground / kPiD * zenith * relative;
  FloatImage image{2 * o.height, o.height, 3, {}};
  image.pixels.reserve(std::size_t{6} * o.height * o.height);
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const double theta = kPiD * (y + 0.5) / image.height, phi = 2 * kPiD * ((x + 0.5) / image.width - 0.5);
      const DVec3 direction(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      const double value = direction.y > 0 ? zenith * sky.luminance(direction) : ground;
      image.pixels.insert(image.pixels.end(), 3, static_cast<float>(value));
    }
  return image;
}

}  // namespace oriel::sample
