// Radiosity textures: irradiance per texel, with its error.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

enum class TexelState : std::uint8_t {
  kEmpty = 0,     // no surface, and too far from any to matter
  kDilated = 85,  // filled from neighbours so that bilinear filtering near a chart's border reads light, not black
  kBuried = 170,  // a surface is here, but inside other geometry: filled from neighbours
  kValid = 255,   // baked
};

// As people are told of it.
inline const char* name_of(TexelState state) {
  switch (state) {
    case TexelState::kValid:
      return "baked";
    case TexelState::kBuried:
      return "inside other geometry";
    case TexelState::kDilated:
      return "filled from neighbours";
    case TexelState::kEmpty:
      break;
  }
  return "empty";
}

// Texel (x, y) is at y * width + x; its centre at uv ((x + ½) / width, (y + ½) / height). Row 0 is v = 0.
struct LightmapPage {
  std::uint32_t width = 0, height = 0;
  std::vector<Vec3> irradiance;  // lux, linear Rec. 709, finite and >= 0
  std::vector<Vec3>
      standard_error;  // lux per channel: one standard deviation of the estimate's own noise; 0 where not baked
  std::vector<TexelState> state;
  // Of a directional lightmap, else empty: the L1 band of the incident luminance over its L0 band, d = v / m with
  // m = ∫ L dω / 4π and v = ∫ L ω dω / 4π above the texel; pack space, |d| <= 1.
  std::vector<Vec3> direction{};
  // Finer light where interpolation between texels misses too much. A cell is the square between four texel centres,
  // (x, y) the texel at its lower corner, its entry at y * width + x: 0, or a DetailBlock in `detail`. Empty: no cell
  // is finer.
  std::vector<std::uint32_t> cell{};
  std::uint32_t detail_width = 0, detail_height = 0;
  std::vector<Vec3> detail{};  // lux, as irradiance but without sharp light
  // Where lamps' direct light is computed by pixel (sharp_light.h), else empty. sharp: what of `irradiance` that is,
  // lux. sharp_at: by texel, its record in SharpLight::words.
  std::vector<Vec3> sharp{};
  std::vector<std::uint32_t> sharp_at{};
};

// Where an image of details holds a cell: (side + 1)² points, the first in each row and the last above texel centres.
// Cells that meet have the same light along their common side.
struct DetailBlock {
  std::uint32_t x = 0, y = 0;   // of its first point, less than 2^14
  std::uint32_t log2_side = 0;  // of the steps along a side: 1 to 5

  std::uint32_t side() const { return 1u << log2_side; }
  std::uint32_t code() const { return log2_side << 28u | y << 14u | x; }
  static DetailBlock of(std::uint32_t code) { return {code & 0x3fffu, code >> 14u & 0x3fffu, code >> 28u}; }
};
inline constexpr std::uint32_t kMostDetail = 32;        // steps along a cell's side
inline constexpr std::uint32_t kMaxDetailSide = 16384;  // points of an image of details

// By texel.
inline std::vector<Vec3> without_sharp(const LightmapPage& page) {
  std::vector<Vec3> light = page.irradiance;
  for (std::size_t i = 0; i < page.sharp.size(); ++i) light[i] = glm::max(light[i] - page.sharp[i], Vec3(0));
  return light;
}

namespace lightmap_detail {

// A place between texels' centres, or between points of details. The last cell's end is its own: beyond it there is
// none.
struct CellPlace {
  std::size_t texel = 0;  // at the cell's lower corner
  Vec2 within{0};
  std::uint32_t right = 1, down = 1;  // to the next texels

  // Of an image of that width: bilinear.
  Vec3 of(const std::vector<Vec3>& light, std::uint32_t width) const {
    const std::size_t below = texel + std::size_t{down} * width;
    return glm::mix(glm::mix(light[texel], light[texel + right], within.x),
                    glm::mix(light[below], light[below + right], within.x), within.y);
  }
};

inline CellPlace cell_place(const LightmapPage& page, const Vec2& uv) {
  const float x = std::clamp(uv.x * static_cast<float>(page.width) - 0.5f, 0.0f, static_cast<float>(page.width - 1));
  const float y = std::clamp(uv.y * static_cast<float>(page.height) - 0.5f, 0.0f, static_cast<float>(page.height - 1));
  const auto cx = std::min(static_cast<std::uint32_t>(x), std::max(page.width, 2u) - 2);
  const auto cy = std::min(static_cast<std::uint32_t>(y), std::max(page.height, 2u) - 2);
  return {std::size_t{cy} * page.width + cx, Vec2(x - static_cast<float>(cx), y - static_cast<float>(cy)),
          cx + 1 < page.width ? 1u : 0u, cy + 1 < page.height ? 1u : 0u};
}

inline Vec3 smooth_at(const LightmapPage& page, const CellPlace& at) {
  if (page.cell.empty() || page.cell[at.texel] == 0) {
    const Vec3 light = at.of(page.irradiance, page.width);
    return page.sharp.empty() ? light : glm::max(light - at.of(page.sharp, page.width), Vec3(0));
  }
  const DetailBlock block = DetailBlock::of(page.cell[at.texel]);
  const Vec2 in = at.within * static_cast<float>(block.side());
  const auto px = std::min(static_cast<std::uint32_t>(in.x), block.side() - 1);
  const auto py = std::min(static_cast<std::uint32_t>(in.y), block.side() - 1);
  const CellPlace point{std::size_t{block.y + py} * page.detail_width + block.x + px, in - Vec2(px, py)};
  return point.of(page.detail, page.detail_width);
}

}  // namespace lightmap_detail

// Irradiance at a place of a page without sharp light, uv in [0,1]: bilinear, from a cell's own points where it has
// some. Texels beyond the page's border are those at it. irradiance_at() has the sharp light of texels in it.
inline Vec3 smooth_irradiance_at(const LightmapPage& page, const Vec2& uv) {
  return lightmap_detail::smooth_at(page, lightmap_detail::cell_place(page, uv));
}
inline Vec3 irradiance_at(const LightmapPage& page, const Vec2& uv) {
  const lightmap_detail::CellPlace at = lightmap_detail::cell_place(page, uv);
  const Vec3 light = lightmap_detail::smooth_at(page, at);
  return page.sharp.empty() ? light : light + at.of(page.sharp, page.width);
}

// E(n) / E(g): how the irradiance at a texel changes when its normal g is tilted to n (both unit). d is read as an even
// hemisphere of light together with one distant lamp: the share of the lamp and its direction follow from d, and the
// irradiance of both is closed (docs/notes/conventions.md, "Directional lightmaps"). Finite and not negative; 1 for n =
// g.
inline float directional_ratio(const Vec3& d, const Vec3& n, const Vec3& g) {
  const Vec3 off = d - 0.5f * g;  // d = (1 - lamp) g / 2 + lamp ω, |ω| = 1
  const float h = 0.5f - glm::dot(d, g);
  const float lamp = std::clamp((std::sqrt(h * h + 3 * length2(off)) - h) / 1.5f, 0.0f, 1.0f);
  const Vec3 towards = off + 0.5f * lamp * g;  // lamp ω
  const auto light_on = [&](const Vec3& normal) {
    const Vec3 mirrored =
        normal - 2 * glm::dot(normal, g) * g;  // what of the lobe is below the surface counts above it
    return 1 - lamp + 2 * (std::max(glm::dot(towards, normal), 0.0f) + std::max(glm::dot(towards, mirrored), 0.0f));
  };
  const float untilted = light_on(g);
  return std::max(1 + (light_on(n) - untilted) / std::max(untilted, 0.1f), 0.0f);
}

}  // namespace oriel
