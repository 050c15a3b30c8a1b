#include "player/images/map_levels.h"

#include "formats/core/half.h"

namespace oriel {
namespace {

bool is_usable(const RadianceMap& map, std::size_t i) {
  return map.valid[i] != 0 && is_finite(map.radiance[i]) && map.disparity[i] >= 0 && map.disparity[i] <= 1;
}

// Light with its weight in a.
using WeightedLight = std::vector<Vec4>;

// The same, and beside what has light the mean of that.
WeightedLight filled_beside(const WeightedLight& level, int width, int height) {
  WeightedLight out = level;
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (level[at(x, y)].w > 0) continue;
      Vec4 sum(0);
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
          const Vec4& light = level[at(u, v)];
          sum += light.w * Vec4(Vec3(light), 1);
        }
      if (sum.w > 0) out[at(x, y)] = Vec4(Vec3(sum) / sum.w, 0);
    }
  return out;
}

WeightedLight halved_light(const WeightedLight& fine, int width, int height) {
  const int w = std::max(width / 2, 1), h = std::max(height / 2, 1);
  WeightedLight out;
  out.reserve(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      Vec4 sum(0);
      for (int k = 0; k < 4; ++k) {
        const int u = std::min(2 * x + (k & 1), width - 1), v = std::min(2 * y + (k >> 1), height - 1);
        const Vec4& light =
            fine[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
        sum += light.w * Vec4(Vec3(light), 1);
      }
      out.push_back(sum.w > 0 ? Vec4(Vec3(sum) / sum.w, 0.25f * sum.w) : Vec4(0));
    }
  return out;
}

}  // namespace

std::vector<std::uint16_t> disparity_codes(const RadianceMap& map) {
  constexpr float kUnseen = 2;
  std::vector<std::uint16_t> codes;
  codes.reserve(map.disparity.size());
  for (std::size_t i = 0; i < map.disparity.size(); ++i) {
    const float seen = !is_usable(map, i) ? kUnseen : map.valid[i] == 2 ? 0.0f : map.disparity[i];
    codes.push_back(static_cast<std::uint16_t>(seen * kDisparityCodes + 0.5f));
  }
  return codes;
}

LightLevels make_light_levels(const RadianceMap& map) {
  LightLevels out;
  float brightest = 0;
  WeightedLight level(map.radiance.size(), Vec4(0));
  for (std::size_t i = 0; i < level.size(); ++i) {
    if (!is_usable(map, i)) continue;
    level[i] = Vec4(map.radiance[i], 1);
    brightest = std::max(brightest, max_component(map.radiance[i]));
  }
  if (brightest > 0) out.scale = std::ldexp(1.0f, std::clamp(std::ilogb(brightest) - 14, -120, 120));
  int width = static_cast<int>(map.width), height = static_cast<int>(map.height);
  while (true) {
    std::vector<std::uint32_t> packed;
    packed.reserve(level.size());
    for (const Vec4& light : filled_beside(level, width, height))
      packed.push_back(rgb9e5_from_rgb(Vec3(light) / out.scale));
    out.rgb9e5.push_back(std::move(packed));
    if (width == 1 && height == 1) return out;
    level = halved_light(level, width, height);
    width = std::max(width / 2, 1);
    height = std::max(height / 2, 1);
  }
}

}  // namespace oriel
