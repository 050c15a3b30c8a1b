#include "formats/analysis/part_light.h"

#include "formats/assets/bilinear.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

// Bilinear; texels that were not baked have light but no error.
SampledLight light_at(const LightmapPage& page, const Vec2& uv) {
  const TexelsAround around = texels_around(uv, page.width, page.height);
  SampledLight light;
  light.light = DVec3(irradiance_at(page, uv));
  for (std::size_t i = 0; i < 4; ++i) {
    const DVec3 error(page.standard_error[around.texel[i]]);
    // Texels beside each other share their noise: no gain from blending.
    light.variance += double{around.weight[i]} * error * error;
  }
  return light;
}

}  // namespace

SampledLight PartSampler::at(std::size_t t, const Vec3& barycentric) const {
  Vec2 uv(0);
  for (std::size_t c = 0; c < 3; ++c) uv += barycentric[static_cast<int>(c)] * pack_.mesh.lightmap_uvs[vertex(t, c)];
  return light_at(pack_.lightmaps[static_cast<std::size_t>(part_.lightmap_page)], uv);
}

Vec3 point_of(std::size_t i) {
  const double g = 1.32471795724474602596, n = static_cast<double>(i) + 1;
  double u = std::fmod(0.5 + n / g, 1.0), v = std::fmod(0.5 + n / (g * g), 1.0);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return {static_cast<float>(1 - u - v), static_cast<float>(u), static_cast<float>(v)};
}

PartLight light_of(const PartSampler& part, std::size_t points) {
  PartLight sums;
  sums.area_m2 = part.area();
  bool first = true;
  for_points(part, points, [&](std::size_t t, const Vec3& at, double weight) {
    const SampledLight light = part.at(t, at);
    const double lux = luminance(light.light), error = luminance(glm::sqrt(light.variance));
    sums.mean += weight * lux;
    sums.variance += weight * error * error;
    sums.lowest = first ? lux : std::min(sums.lowest, lux);
    sums.highest = std::max(sums.highest, lux);
    first = false;
  });
  return sums;
}

}  // namespace oriel
