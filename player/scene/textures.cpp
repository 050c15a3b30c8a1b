#include "player/scene/textures.h"

#include <algorithm>

#include "formats/query/lobe_light.h"

namespace oriel {
gpu::Texture2d upload_reflectance_tables(const std::vector<FresnelMap>& maps) {
  std::size_t width = 1;
  for (const FresnelMap& map : maps) width = std::max(width, map.table.size());
  const std::size_t height = std::max<std::size_t>(maps.size(), 1);
  std::vector<Vec4> texels(width * height, Vec4(0));
  for (std::size_t row = 0; row < maps.size(); ++row) {
    for (std::size_t i = 0; i < maps[row].table.size(); ++i) texels[row * width + i] = Vec4(maps[row].table[i], 1);
  }
  return {gpu::kRgba32f, static_cast<int>(width), static_cast<int>(height), texels.data()};
}

gpu::Texture2d upload_kernel_taps(const KernelTaps& taps) {
  std::vector<Vec4> texels;
  for (const KernelTap& tap : taps.taps) texels.emplace_back(tap.at, tap.width, tap.weight);
  return {gpu::kRgba32f, taps.count, taps.rows, texels.data()};
}

gpu::Texture2d upload_lobe_fits(const BrdfKernel& kernel, const FresnelMap& fresnel,
                                std::span<const float> mean_factors) {
  constexpr int kRows = 33;
  std::vector<Vec4> texels;
  for (int i = 0; i < kRows; ++i) {
    const double root = i / (kRows - 1.0);
    const SlicePosition at = find_slice(kernel, root * root);
    const LobeFit &a = kernel.fits[at.below], &b = kernel.fits[at.above];
    texels.push_back(mix_lobes(in_mirror_frame(a, kernel.slices[at.below].cos_theta),
                               in_mirror_frame(b, kernel.slices[at.above].cos_theta), static_cast<float>(at.share)));
  }
  for (int i = 0; i < kRows; ++i) {
    const double root = i / (kRows - 1.0);
    const RowPosition at = kernel_row(static_cast<float>(root * root), static_cast<int>(mean_factors.size()));
    const auto low = static_cast<std::size_t>(at.row), high = std::min(low + 1, mean_factors.size() - 1);
    texels.emplace_back(fresnel_factor(fresnel, root * root), std::lerp(mean_factors[low], mean_factors[high], at.next),
                        0, 0);
  }
  return {gpu::kRgba32f, kRows, 2, texels.data()};
}

}  // namespace oriel
