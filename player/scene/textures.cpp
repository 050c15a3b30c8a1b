#include "player/scene/textures.h"

#include <algorithm>
#include <array>
#include <optional>

#include "formats/core/half.h"
#include "formats/lobes/lobe_light.h"
#include "player/textures/cutout_mips.h"

namespace oriel {
namespace {

GLenum gl_wrap(Wrap wrap) {
  switch (wrap) {
    case Wrap::kRepeat:
      return GL_REPEAT;
    case Wrap::kClamp:
      return GL_CLAMP_TO_EDGE;
    case Wrap::kMirror:
      return GL_MIRRORED_REPEAT;
  }
  return GL_REPEAT;
}

// Of a texture with all its mip levels; the caller says who fills them.
gpu::TextureOptions mipmapped(const Texture& texture) {
  gpu::TextureOptions options;
  options.levels = gpu::mip_levels(static_cast<int>(texture.width), static_cast<int>(texture.height));
  options.min_filter = GL_LINEAR_MIPMAP_LINEAR;
  options.mag_filter = texture.nearest ? GL_NEAREST : GL_LINEAR;
  options.wrap_s = gl_wrap(texture.wrap_s);
  options.wrap_t = gl_wrap(texture.wrap_t);
  return options;
}

gpu::Texture upload_all_of_it(const Texture& texture, const gpu::TextureFormat& format) {
  gpu::TextureOptions options = mipmapped(texture);
  options.make_mipmaps = true;
  return {format, static_cast<int>(texture.width), static_cast<int>(texture.height), texture.texels.data(), options};
}

// The texture's alpha that a material's cutoff asks for; 0: it is blended; nothing: all of the texture is shown. The
// first of several with cutoffs counts.
std::optional<float> cutoff_in_texture(std::span<const Material> used_by) {
  std::optional<float> out;
  for (const Material& m : used_by) {
    if (m.alpha_mode == AlphaMode::kOpaque) return std::nullopt;
    if (m.alpha_mode == AlphaMode::kBlend) {
      out = out.value_or(0.0f);
    } else if (!out || *out <= 0) {
      if (!(m.alpha_cutoff > 0)) return std::nullopt;  // all of it passes
      out = m.alpha > 0 ? m.alpha_cutoff / m.alpha : 2.0f;
    }
  }
  return out;
}

}  // namespace

gpu::Texture upload_normal_texture(const Texture& texture) {
  return upload_all_of_it(texture, gpu::kRgba8);
}

gpu::Texture upload_color_texture(const Texture& texture, std::span<const Material> used_by) {
  const std::optional<float> cutoff = cutoff_in_texture(used_by);
  bool opaque = true;
  for (std::size_t i = 3; i < texture.texels.size(); i += 4) opaque = opaque && texture.texels[i] == 255;
  if (!cutoff || opaque) return upload_all_of_it(texture, gpu::kSrgbAlpha8);
  const int width = static_cast<int>(texture.width), height = static_cast<int>(texture.height);
  gpu::Texture out(gpu::kSrgbAlpha8, width, height, nullptr, mipmapped(texture));
  const auto levels = cutout_mips(texture, *cutoff);
  for (std::size_t i = 0; i < levels.size(); ++i) out.upload(static_cast<int>(i), levels[i].data());
  return out;
}

LightmapTexture upload_lightmap(const LightmapPage& page) {
  float brightest = 0;
  for (const Vec3& e : page.irradiance) {
    if (is_finite(e)) brightest = std::max(brightest, max_component(e));
  }
  LightmapTexture out;
  if (brightest > 0) out.scale = std::ldexp(1.0f, std::max(std::ilogb(brightest) - 14, -120));
  const float inverse = out.scale > 0 ? 1 / out.scale : 0.0f;
  std::vector<std::array<std::uint16_t, 4>> texels(page.irradiance.size());
  const std::uint16_t one = half_from_float(1.0f);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const Vec3 e = is_finite(page.irradiance[i]) ? page.irradiance[i] * inverse : Vec3(0);
    texels[i] = {half_from_float(e.x), half_from_float(e.y), half_from_float(e.z), one};
  }
  gpu::TextureOptions options;
  options.min_filter = options.mag_filter = GL_LINEAR;
  const int width = static_cast<int>(page.width), height = static_cast<int>(page.height);
  out.texture = {gpu::kRgba16f, width, height, texels.data(), options};
  if (page.direction.empty()) return out;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const Vec3 d = is_finite(page.direction[i]) ? page.direction[i] : Vec3(0);
    texels[i] = {half_from_float(d.x), half_from_float(d.y), half_from_float(d.z), one};
  }
  out.direction = {gpu::kRgba16f, width, height, texels.data(), options};
  return out;
}

gpu::Texture upload_radiance_map(const RadianceMap& map) {
  std::vector<Vec4> texels(map.radiance.size());
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const bool usable =
        map.valid[i] != 0 && is_finite(map.radiance[i]) && map.disparity[i] >= 0 && map.disparity[i] <= 1;
    texels[i] = usable ? Vec4(map.radiance[i], map.valid[i] == 2 ? 0.0f : map.disparity[i]) : Vec4(0, 0, 0, -1);
  }
  return {gpu::kRgba32f, static_cast<int>(map.width), static_cast<int>(map.height), texels.data()};
}

gpu::Texture upload_reflectance_tables(const std::vector<FresnelMap>& maps) {
  std::size_t width = 1;
  for (const FresnelMap& map : maps) width = std::max(width, map.table.size());
  const std::size_t height = std::max<std::size_t>(maps.size(), 1);
  std::vector<Vec4> texels(width * height, Vec4(0));
  for (std::size_t row = 0; row < maps.size(); ++row) {
    for (std::size_t i = 0; i < maps[row].table.size(); ++i) texels[row * width + i] = Vec4(maps[row].table[i], 1);
  }
  return {gpu::kRgba32f, static_cast<int>(width), static_cast<int>(height), texels.data()};
}

gpu::Texture upload_kernel_taps(const KernelTaps& taps) {
  std::vector<Vec4> texels;
  for (const KernelTap& tap : taps.taps) texels.emplace_back(tap.at, tap.width, tap.weight);
  return {gpu::kRgba32f, taps.count, taps.rows, texels.data()};
}

gpu::Texture upload_lobe_fits(const BrdfKernel& kernel, const FresnelMap& fresnel,
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

gpu::Texture upload_sphere_map(const FresnelMap& map) {
  std::vector<Vec4> texels;
  for (const Vec3& r : map.sphere) texels.emplace_back(r, 1);
  gpu::TextureOptions options;
  options.min_filter = options.mag_filter = GL_LINEAR;
  const int size = static_cast<int>(map.sphere_size);
  return {gpu::kRgba32f, size, size, texels.data(), options};
}

}  // namespace oriel
