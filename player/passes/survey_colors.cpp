#include "player/passes/survey_colors.h"

#include "formats/core/color.h"

namespace oriel {
namespace {

Vec3 color_of_texel(TexelState state, bool odd) {
  const float bright = odd ? 0.9f : 0.75f;
  if (state == TexelState::kValid) return Vec3(odd ? 0.75f : 0.55f);
  if (state == TexelState::kDilated) return {0.2f, 0.35f, bright};
  return state == TexelState::kBuried ? Vec3(bright, 0.2f, 0.15f) : Vec3(0);
}

Vec3 color_of(const LightmapPage& page, std::size_t texel, Show show) {
  if (show == Show::kTexels) {
    const bool odd = (texel % page.width + texel / page.width) % 2 == 1;
    return color_of_texel(page.state[texel], odd);
  }
  if (page.state[texel] == TexelState::kEmpty) return Vec3(0);
  const float lux = luminance(page.irradiance[texel]);
  const float value = show == Show::kLux ? lux : lux > 0 ? luminance(page.standard_error[texel]) / lux : 0;
  return heat(share_of(heat_scale(show), value));
}

}  // namespace

HeatScale heat_scale(Show show) {
  return show == Show::kError ? kErrorScale : kLuxScale;
}

std::vector<std::uint8_t> survey_colors(const LightmapPage& page, Show show) {
  std::vector<std::uint8_t> out;
  out.reserve(4 * page.state.size());
  for (std::size_t i = 0; i < page.state.size(); ++i) {
    const Vec3 color = color_of(page, i, show) * 255.0f + 0.5f;
    for (int c = 0; c < 3; ++c) out.push_back(static_cast<std::uint8_t>(color[c]));
    out.push_back(255);
  }
  return out;
}

}  // namespace oriel
