#include "bake/radiosity/texels/frame_error.h"

#include <cmath>
#include <limits>

namespace oriel {

FrameError::FrameError(std::span<const FramePixel> pixels, std::span<const TexelMapPage> map,
                       const std::vector<bool>& has_light)
    : importance_(has_light.size()) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::vector<std::uint32_t>> number;  // by page and y * width + x
  std::uint32_t next = 0;
  for (const TexelMapPage& page : map) {
    number.emplace_back(std::size_t{page.width} * page.height, kNone);
    for (const std::uint32_t t : page.texel) number.back()[t] = next++;
  }
  for (FramePixel pixel : pixels) {
    float sum = 0;
    for (std::size_t k = 0; k < pixel.texel.size(); ++k) {
      const std::uint32_t texel = number[pixel.page][pixel.texel[k]];
      const bool has = texel != kNone && has_light[texel];
      pixel.texel[k] = has ? texel : 0;
      sum += pixel.share[k] *= has ? 1.0f : 0.0f;
    }
    if (!(sum > 0)) continue;
    for (float& share : pixel.share) share /= sum;
    pixels_.push_back(pixel);
  }
  for (const FramePixel& pixel : pixels_)
    for (std::size_t k = 0; k < pixel.texel.size(); ++k)
      importance_[pixel.texel[k]] += pixel.share[k] / static_cast<float>(pixels_.size());
}

std::vector<float> FrameError::squares(std::span<const Vec3> light, std::span<const Vec3> variance) const {
  const auto mixed = [](const FramePixel& pixel, std::span<const Vec3> of) {
    DVec3 sum(0);
    for (std::size_t k = 0; k < pixel.texel.size(); ++k) sum += double{pixel.share[k]} * DVec3(of[pixel.texel[k]]);
    return sum;
  };
  std::vector<float> squares(importance_.size());
  const std::vector<DVec3> floors2 =
      frame_floors2(pixels_, [&](std::size_t i) { return DVec3(pixels_[i].transfer) * mixed(pixels_[i], light); });
  for (const FramePixel& pixel : pixels_) {
    const DVec3 transfer(pixel.transfer), radiance = transfer * mixed(pixel, light) + DVec3(pixel.emitted);
    const DVec3 light2 = radiance * radiance + transfer * transfer * mixed(pixel, variance);
    for (std::size_t k = 0; k < pixel.texel.size(); ++k) {
      const DVec3 error2 = transfer * transfer * DVec3(variance[pixel.texel[k]]);
      squares[pixel.texel[k]] += static_cast<float>(
          pixel.share[k] * relative_square(error2, light2, floors2[pixel.view]) / static_cast<double>(pixels_.size()));
    }
  }
  return squares;
}

double stated_error(std::span<const TexelMapPage> map, std::span<const FramePixel> pixels,
                    std::span<const LightmapPage> pages) {
  std::vector<Vec3> light, variance;
  std::vector<bool> has_light;
  for (std::size_t p = 0; p < map.size(); ++p)
    for (const std::uint32_t t : map[p].texel) {
      const Vec3& error = pages[p].standard_error[t];
      light.push_back(pages[p].irradiance[t]);
      variance.push_back(error * error);
      has_light.push_back(pages[p].state[t] == TexelState::kValid);
    }
  double sum = 0;
  for (const float square : FrameError(pixels, map, has_light).squares(light, variance)) sum += square;
  return std::sqrt(sum);
}

}  // namespace oriel
