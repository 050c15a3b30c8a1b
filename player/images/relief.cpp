#include "player/images/relief.h"

#include <limits>

#include "formats/core/half.h"

namespace oriel {
namespace {

bool is_usable(const RadianceMap& map, std::size_t i) {
  return map.valid[i] != 0 && is_finite(map.radiance[i]) && map.disparity[i] >= 0 && map.disparity[i] <= 1;
}

// (least, largest) of none.
const Vec2 kNothing(std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest());

struct RangeGrid {
  IVec2 size{0};
  std::vector<Vec2> cells;
  // Of cells [lower, upper), where they exist.
  Vec2 over(const IVec2& lower, const IVec2& upper) const {
    Vec2 range = kNothing;
    for (int y = std::max(lower.y, 0); y < std::min(upper.y, size.y); ++y)
      for (int x = std::max(lower.x, 0); x < std::min(upper.x, size.x); ++x) {
        const Vec2& cell =
            cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x)];
        range = {std::min(range.x, cell.x), std::max(range.y, cell.y)};
      }
    return range;
  }
};

// A grid of half the cells, each over those of `fine` from 2 i - around to 2 i + 2 + around.
RangeGrid halved(const RangeGrid& fine, const IVec2& size, int around) {
  RangeGrid out{size, {}};
  out.cells.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      out.cells.push_back(
          fine.over(IVec2(2 * x - around, 2 * y - around), IVec2(2 * x + 2 + around, 2 * y + 2 + around)));
  return out;
}

// Light with its weight in a.
using ReliefLight = std::vector<Vec4>;

// The same, and beside what has light the mean of that.
ReliefLight filled_beside(const ReliefLight& level, int width, int height) {
  ReliefLight out = level;
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

ReliefLight halved_light(const ReliefLight& fine, int width, int height) {
  const int w = std::max(width / 2, 1), h = std::max(height / 2, 1);
  ReliefLight out;
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

Relief make_relief(const RadianceMap& map) {
  Relief relief;
  relief.size = {static_cast<int>(map.width), static_cast<int>(map.height)};
  RangeGrid raw{relief.size, {}};
  relief.disparity.reserve(map.disparity.size());
  raw.cells.reserve(map.disparity.size());
  for (std::size_t i = 0; i < map.disparity.size(); ++i) {
    const float seen = !is_usable(map, i) ? kUnseenDisparity : map.valid[i] == 2 ? 0.0f : map.disparity[i];
    const float s = static_cast<float>(disparity_code(seen)) / kDisparityCodes;
    relief.disparity.push_back(s);
    raw.cells.emplace_back(s, s);
  }
  for (int level = 1; level <= kRangeLevels; ++level) {
    const IVec2 size = relief.range_size(level);
    relief.ranges[static_cast<std::size_t>(level - 1)] = halved(raw, size, 1).cells;
    raw = halved(raw, size, 0);
  }
  return relief;
}

LightLevels make_light_levels(const RadianceMap& map) {
  LightLevels out;
  float brightest = 0;
  ReliefLight level(map.radiance.size(), Vec4(0));
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
