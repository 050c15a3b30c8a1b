#include "formats/diff/part_light.h"

#include "formats/core/color.h"

namespace oriel {
namespace {

// Bilinear; texels that were not baked have light but no error.
TexelLight light_at(const Pack& pack, const MeshPart& part, const Vec2& uv) {
  const LightmapPage& page = pack.lightmaps[static_cast<std::size_t>(part.lightmap_page)];
  const auto clamped = [](float at, std::uint32_t size) {
    return std::clamp(at * static_cast<float>(size) - 0.5f, 0.0f, static_cast<float>(size - 1));
  };
  const float x = clamped(uv.x, page.width), y = clamped(uv.y, page.height);
  const auto x0 = static_cast<std::size_t>(x), y0 = static_cast<std::size_t>(y);
  const std::size_t x1 = std::min<std::size_t>(x0 + 1, page.width - 1),
                    y1 = std::min<std::size_t>(y0 + 1, page.height - 1);
  const double tx = x - static_cast<float>(x0), ty = y - static_cast<float>(y0);
  TexelLight light;
  const auto add = [&](std::size_t column, std::size_t row, double weight) {
    const std::size_t at = row * page.width + column;
    light.lux += weight * luminance(page.irradiance[at]);
    const double error = luminance(page.standard_error[at]);
    light.variance += weight * error * error;  // texels beside each other share their noise: no gain from blending
  };
  add(x0, y0, (1 - tx) * (1 - ty));
  add(x1, y0, tx * (1 - ty));
  add(x0, y1, (1 - tx) * ty);
  add(x1, y1, tx * ty);
  return light;
}

}  // namespace

TexelLight PartSampler::at(std::size_t t, const Vec3& barycentric) const {
  Vec2 uv(0);
  for (std::size_t c = 0; c < 3; ++c) uv += barycentric[static_cast<int>(c)] * pack_.mesh.lightmap_uvs[vertex(t, c)];
  return light_at(pack_, part_, uv);
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
    const TexelLight light = part.at(t, at);
    sums.mean += weight * light.lux;
    sums.variance += weight * light.variance;
    sums.lowest = first ? light.lux : std::min(sums.lowest, light.lux);
    sums.highest = std::max(sums.highest, light.lux);
    first = false;
  });
  return sums;
}

}  // namespace oriel
