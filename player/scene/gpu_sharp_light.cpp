#include "player/scene/gpu_sharp_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "formats/query/sharp_light.h"

namespace oriel {
namespace {

template <class Texel>
gpu::Texture2d rows_of(const gpu::TextureFormat& format, std::vector<Texel> texels) {
  const std::size_t rows = std::max<std::size_t>((texels.size() + kSharpColumns - 1) / kSharpColumns, 1);
  texels.resize(rows * kSharpColumns);
  return {format, static_cast<int>(kSharpColumns), static_cast<int>(rows), texels.data()};
}

// What half_disk() looks up, in order: by 64 directions about the square |x| + |y| = 1, and by 64 offsets.
std::vector<std::uint32_t> half_disks() {
  std::vector<std::uint32_t> words;
  for (int k = 0; k < 64; ++k) {
    const float at = (static_cast<float>(k) + 0.5f) / 16, x = at < 2 ? 1 - at : at - 3;
    const Vec2 normal = glm::normalize(Vec2(x, (at < 2 ? 1 : -1) * (1 - std::abs(x))));
    for (int off = 0; off < 64; ++off) {
      std::uint64_t bits = 0;
      for (std::size_t i = 0; i < 64; ++i)
        if (glm::dot(normal, kSunPlaces[i]) + (static_cast<float>(off) + 0.5f) / 32 - 1 >= 0)
          bits |= std::uint64_t{1} << i;
      words.push_back(static_cast<std::uint32_t>(bits)), words.push_back(static_cast<std::uint32_t>(bits >> 32u));
    }
  }
  return words;
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
  std::vector<std::uint32_t> words = half_disks();
  words.insert(words.end(), light.words.begin(), light.words.end());
  out.words = rows_of(gpu::kR32ui, std::move(words));
  for (const LampProfile& profile : light.profiles) {
    corners.resize((corners.size() + kSharpColumns - 1) / kSharpColumns * kSharpColumns);
    out.profile_rows.push_back(corners.size() / kSharpColumns);
    for (std::uint32_t i = 0; i < profile.rows * profile.columns; ++i) {
      const std::uint32_t row = i / profile.columns, next = row * profile.columns + (i + 1) % profile.columns,
                          down = row + 1 < profile.rows ? profile.columns : 0;
      corners.emplace_back(profile.candela[i], profile.candela[i + down], profile.candela[next],
                           profile.candela[next + down]);
    }
  }
  out.triangles = rows_of(gpu::kRgba32f, std::move(corners));
  out.suns = std::ranges::any_of(light.lamps, &SharpLamp::sun);
  out.shine(light, {});
  return out;
}

void GpuSharpLight::shine(const SharpLight& light, std::span<const Vec3> factors) {
  std::vector<Vec4> rows;
  for (const SharpLamp& lamp : light.lamps) {
    const Vec3 power = (lamp.light_group < factors.size() ? factors[lamp.light_group] : Vec3(1)) * lamp.intensity;
    if (lamp.profile >= 0) {
      const auto number = static_cast<std::size_t>(lamp.profile);
      const LampProfile& profile = light.profiles[number];
      const float last = static_cast<float>(profile.rows - 1), degree = kPi / 180;
      rows.emplace_back(lamp.position, -static_cast<float>(profile.columns));
      rows.emplace_back(lamp.direction, profile.first_deg * degree);
      rows.emplace_back(power, last / ((profile.last_deg - profile.first_deg) * degree));
      rows.emplace_back(lamp.right, last);
      rows.emplace_back(lamp.over, profile_rows[number]);
      continue;
    }
    rows.emplace_back(lamp.sun ? -lamp.direction : lamp.position, lamp.sun ? 1 : 0);
    rows.emplace_back(lamp.direction, lamp.cos_outer);
    rows.emplace_back(power, lamp.sun ? std::tan(lamp.angular_radius_rad) : lamp.inverse_falloff);
    rows.resize(rows.size() + 2);
  }
  if (lamps)
    lamps.upload(0, rows.data());
  else if (!rows.empty())
    lamps = gpu::Texture2d(gpu::kRgba32f, 5, static_cast<int>(light.lamps.size()), rows.data());
}

}  // namespace oriel
