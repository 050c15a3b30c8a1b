#include "formats/export/probes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/core/half.h"
#include "formats/core/octahedral.h"
#include "formats/image/encode.h"

namespace oriel {
namespace {

constexpr std::uint32_t kPlaces = 2;  // along each side of a texel

// Bilinear over the texels that saw something; those that saw none have been filled.
Vec3 radiance_towards(const std::vector<Vec3>& radiance, std::uint32_t size, const Vec3& direction) {
  const Vec2 at = (octahedral_from_direction(direction) + 1.0f) * 0.5f * static_cast<float>(size) - 0.5f;
  const Vec2 low = glm::floor(at), f = at - low;
  Vec3 sum(0);
  for (int i = 0; i < 4; ++i) {
    const IVec2 texel = wrap_octahedral(IVec2(low) + IVec2(i & 1, i >> 1), static_cast<int>(size));
    const float weight = (i & 1 ? f.x : 1 - f.x) * (i >> 1 ? f.y : 1 - f.y);
    sum += weight * radiance[static_cast<std::size_t>(texel.y) * size + static_cast<std::size_t>(texel.x)];
  }
  return sum;
}

// Backs of surfaces take the mean of what is around them, ring by ring.
std::vector<Vec3> filled(const SurroundMap& map) {
  std::vector<Vec3> light = map.radiance;
  std::vector<std::uint8_t> known;
  for (const std::uint8_t v : map.valid) known.push_back(v != 0);
  const auto side = static_cast<int>(map.size);
  for (bool any = std::find(known.begin(), known.end(), 1) != known.end(); any;) {
    any = false;
    const std::vector<std::uint8_t> before = known;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * map.size + static_cast<std::size_t>(x);
        if (before[at] != 0) continue;
        Vec3 sum(0);
        float count = 0;
        for (const IVec2& step : {IVec2(1, 0), IVec2(-1, 0), IVec2(0, 1), IVec2(0, -1)}) {
          const IVec2 t = wrap_octahedral(IVec2(x, y) + step, side);
          const std::size_t from = static_cast<std::size_t>(t.y) * map.size + static_cast<std::size_t>(t.x);
          if (before[from] != 0) sum += light[from], ++count;
        }
        if (count > 0) light[at] = sum / count, known[at] = 1, any = true;
      }
  }
  return light;
}

}  // namespace

Vec3 cube_direction(std::uint32_t face, const Vec2& at) {
  const float s = 2 * at.x - 1, t = 2 * at.y - 1;
  const std::array<Vec3, 6> directions = {Vec3(1, -t, -s), Vec3(-1, -t, s), Vec3(s, 1, t),
                                          Vec3(s, -1, -t), Vec3(s, -t, 1),  Vec3(-s, -t, -1)};
  return directions[face];
}

ProbeCube probe_cube(const SurroundMap& map, TexelCoding coding) {
  const std::uint32_t side = std::max(map.size / 2, 1u);
  const std::vector<Vec3> light = filled(map);
  ProbeCube out;
  float most = 0;
  for (const Vec3& v : light) most = std::max(most, max_component(v));
  while (most > kRgb9e5Max * out.scale) out.scale *= 2;
  ByteWriter level;
  double squares = 0, count = 0;
  for (std::uint32_t face = 0; face < 6; ++face) {
    std::vector<Vec3> texels;
    for (std::uint32_t i = 0; i < side * side; ++i) {
      Vec3 sum(0);
      for (std::uint32_t k = 0; k < kPlaces * kPlaces; ++k) {
        const Vec2 place = (Vec2(k % kPlaces, k / kPlaces) + 0.5f) / float{kPlaces};
        const Vec2 at = (Vec2(i % side, i / side) + place) / static_cast<float>(side);
        sum += radiance_towards(light, map.size, cube_direction(face, at));
      }
      texels.push_back(sum / (float{kPlaces * kPlaces} * out.scale));
    }
    std::vector<Vec3> shown;
    if (coding == TexelCoding::kBc6h) {
      const Bytes blocks = bc6h_blocks(texels, side, side);
      level.put_array(std::span(blocks));
      shown = rgb_from_bc6h(blocks, side, side);
    } else {
      for (const Vec3& texel : texels) {
        level.put(rgb9e5_from_rgb(texel));
        shown.push_back(rgb_from_rgb9e5(rgb9e5_from_rgb(texel)));
      }
    }
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const float largest = max_component(texels[i]);
      if (!(largest > 0)) continue;
      const DVec3 off = DVec3(shown[i] - texels[i]) / double{largest};
      squares += glm::dot(off, off), count += 3;
    }
  }
  out.texture = {coding, side, side, 6, level.take()};
  out.rounding = count > 0 ? std::sqrt(squares / count) : 0;
  return out;
}

}  // namespace oriel
