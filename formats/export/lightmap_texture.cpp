#include "formats/export/lightmap_texture.h"

#include <algorithm>
#include <cmath>

#include "formats/core/half.h"
#include "formats/image/encode.h"

namespace oriel {
namespace {

constexpr double kUnseen = 0.25;  // of the standard error: what rounding may add

double rounding(const LightmapPage& page, std::span<const Vec3> shown, float scale) {
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const float most = max_component(page.irradiance[i]);
    if (!(most > 0) || (!page.state.empty() && page.state[i] == TexelState::kEmpty)) continue;
    const DVec3 off = DVec3(shown[i] * scale - page.irradiance[i]) / double{most};
    squares += glm::dot(off, off), count += 3;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

// Root mean square over baked texels, of the texel's light; none is off by more than all of it. 0 where nothing is
// known.
double standard_error(const LightmapPage& page) {
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < page.standard_error.size(); ++i) {
    const double light = max_component(page.irradiance[i]), error = max_component(page.standard_error[i]);
    if (!(light > 0) || page.state[i] != TexelState::kValid) continue;
    squares += std::pow(std::min(error / light, 1.0), 2), ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

LightmapTexture as_rgb9e5(const LightmapPage& page) {
  const float scale = texture_scale(page);
  ByteWriter texels;
  std::vector<Vec3> shown;
  for (const Vec3& e : page.irradiance) {
    const std::uint32_t packed = rgb9e5_from_rgb(e / scale);
    texels.put(packed);
    shown.push_back(rgb_from_rgb9e5(packed));
  }
  return {{TexelCoding::kRgb9e5, page.width, page.height, 1, texels.take()}, rounding(page, shown, scale)};
}

LightmapTexture as_bc6h(const LightmapPage& page) {
  const float scale = texture_scale(page);
  std::vector<Vec3> light;
  std::vector<std::uint8_t> counts;
  for (const Vec3& e : page.irradiance) light.push_back(e / scale);
  for (const TexelState state : page.state) counts.push_back(state != TexelState::kEmpty);
  Bytes blocks = bc6h_blocks(light, page.width, page.height, counts);
  const double off = rounding(page, rgb_from_bc6h(blocks, page.width, page.height), scale);
  return {{TexelCoding::kBc6h, page.width, page.height, 1, std::move(blocks)}, off};
}

}  // namespace

float texture_scale(const LightmapPage& page) {
  float most = 0, scale = 1;
  for (const Vec3& e : page.irradiance) most = std::max(most, max_component(e));
  while (most > kRgb9e5Max * scale) scale *= 2;
  return scale;
}

LightmapTexture lightmap_texture(const LightmapPage& page, std::optional<TexelCoding> coding) {
  if (coding) return *coding == TexelCoding::kBc6h ? as_bc6h(page) : as_rgb9e5(page);
  LightmapTexture small = as_bc6h(page);
  return small.rounding <= kUnseen * standard_error(page) ? small : as_rgb9e5(page);
}

}  // namespace oriel
