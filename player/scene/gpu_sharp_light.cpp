#include "player/scene/gpu_sharp_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace oriel {
namespace {

template <class Texel>
gpu::Texture2d rows_of(const gpu::TextureFormat& format, std::vector<Texel> texels) {
  const std::size_t rows = std::max<std::size_t>((texels.size() + kSharpColumns - 1) / kSharpColumns, 1);
  texels.resize(rows * kSharpColumns);
  return {format, static_cast<int>(kSharpColumns), static_cast<int>(rows), texels.data()};
}

}  // namespace

GpuSharpLight GpuSharpLight::upload(const SharpLight& light) {
  GpuSharpLight out;
  if (light.empty()) return out;
  std::vector<Vec4> corners;
  corners.reserve(4 * light.triangles.size());
  for (const std::array<Vec3, 3>& triangle : light.triangles) {
    for (const Vec3& corner : triangle) corners.emplace_back(corner, 0);
    corners.emplace_back(0);
  }
  out.words = rows_of(gpu::kR32ui, light.words);
  out.triangles = rows_of(gpu::kRgba32f, std::move(corners));
  out.suns = std::ranges::any_of(light.lamps, &SharpLamp::sun);
  out.shine(light, {});
  return out;
}

void GpuSharpLight::shine(const SharpLight& light, std::span<const Vec3> factors) {
  std::vector<Vec4> rows;
  for (const SharpLamp& lamp : light.lamps) {
    const Vec3 power = (lamp.light_group < factors.size() ? factors[lamp.light_group] : Vec3(1)) * lamp.intensity;
    rows.emplace_back(lamp.sun ? -lamp.direction : lamp.position, lamp.sun ? 1 : 0);
    rows.emplace_back(lamp.direction, lamp.cos_outer);
    rows.emplace_back(power, lamp.sun ? std::tan(lamp.angular_radius_rad) : lamp.inverse_falloff);
  }
  if (lamps)
    lamps.upload(0, rows.data());
  else if (!rows.empty())
    lamps = gpu::Texture2d(gpu::kRgba32f, 3, static_cast<int>(light.lamps.size()), rows.data());
}

}  // namespace oriel
