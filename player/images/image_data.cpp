#include "player/images/image_data.h"

#include <cmath>

#include "formats/core/color.h"
#include "formats/core/parallel.h"
#include "formats/query/group_light.h"
#include "player/images/cutout_mips.h"
#include "player/images/mean_mips.h"

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

TextureData mipmapped(const Texture& texture, const gpu::TextureFormat& format,
                      std::vector<std::vector<std::uint8_t>> levels, int coarser) {
  const auto left_out = static_cast<std::size_t>(std::min(coarser, static_cast<int>(levels.size()) - 1));
  TextureData out;
  out.format = format;
  out.width = std::max(1, static_cast<int>(texture.width) >> left_out);
  out.height = std::max(1, static_cast<int>(texture.height) >> left_out);
  out.options.levels = static_cast<int>(levels.size() - left_out);
  out.options.min_filter = GL_LINEAR_MIPMAP_LINEAR;
  out.options.mag_filter = texture.nearest ? GL_NEAREST : GL_LINEAR;
  out.options.wrap_s = gl_wrap(texture.wrap_s);
  out.options.wrap_t = gl_wrap(texture.wrap_t);
  for (std::size_t i = left_out; i < levels.size(); ++i) {
    const int level = static_cast<int>(i - left_out);
    out.add({level, 0, 0, std::max(1, out.width >> level), std::max(1, out.height >> level)}, std::move(levels[i]));
  }
  return out;
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

Vec3 floats_of(const Half4& h) {
  return {float_from_half(h[0]), float_from_half(h[1]), float_from_half(h[2])};
}

// Texels of half a page: means of those of the four that have light, and of the directions of the same ones.
void halve(HalfPage& page) {
  const std::uint32_t width = std::max(page.width / 2, 1u), height = std::max(page.height / 2, 1u);
  std::vector<Half4> light, direction;
  light.reserve(std::size_t{width} * height);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      Vec3 sum(0), towards(0);
      float count = 0;
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t row = std::min(y * page.height / height + (k >> 1), page.height - 1);
        const std::uint32_t column = std::min(x * page.width / width + (k & 1), page.width - 1);
        const std::size_t at = std::size_t{row} * page.width + column;
        const Vec3 texel = floats_of(page.light[at]);
        if (!(max_component(texel) > 0)) continue;
        sum += texel;
        if (!page.direction.empty()) towards += floats_of(page.direction[at]);
        count += 1;
      }
      const float share = count > 0 ? 1 / count : 0;
      light.push_back(halves_of(sum, share));
      if (!page.direction.empty()) direction.push_back(halves_of(towards, share));
    }
  page.width = width;
  page.height = height;
  page.cell.clear(), page.detail.clear();  // of cells that are no more
  page.light = std::move(light);
  page.direction = std::move(direction);
}

TextureData unsigned_ints(std::uint32_t width, std::uint32_t height, std::vector<std::uint32_t> texels) {
  TextureData out;
  out.format = gpu::kR32ui;
  out.width = static_cast<int>(width), out.height = static_cast<int>(height);
  out.add({0, 0, 0, out.width, out.height}, std::move(texels));
  return out;
}

TextureData half_floats(std::uint32_t width, std::uint32_t height, std::vector<Half4> texels) {
  TextureData out;
  out.format = gpu::kRgba16f;
  out.width = static_cast<int>(width);
  out.height = static_cast<int>(height);
  out.options.min_filter = out.options.mag_filter = GL_LINEAR;
  out.add({0, 0, 0, out.width, out.height}, std::move(texels));
  return out;
}

}  // namespace

TextureData normal_texture_data(const Texture& texture, int coarser) {
  return mipmapped(texture, gpu::kRgba8, mean_mips(texture, Encoding::kLinear), coarser);
}

TextureData color_texture_data(const Texture& texture, std::span<const Material> used_by, int coarser) {
  const std::optional<float> cutoff = cutoff_in_texture(used_by);
  bool opaque = true;
  for (std::size_t i = 3; i < texture.texels.size(); i += 4) opaque = opaque && texture.texels[i] == 255;
  return mipmapped(texture, gpu::kSrgbAlpha8,
                   !cutoff || opaque ? mean_mips(texture, Encoding::kSrgb) : cutout_mips(texture, *cutoff), coarser);
}

HalfPage half_page(const LightmapPage& page) {
  HalfPage out{page.width, page.height, 0, {}, halves_of(page.direction)};
  const std::vector<Vec3> smooth = without_sharp(page);
  float brightest = 0;
  for (const std::span<const Vec3> light : {std::span<const Vec3>(smooth), std::span<const Vec3>(page.detail)})
    for (const Vec3& e : light)
      if (is_finite(e)) brightest = std::max(brightest, max_component(e));
  if (brightest > 0) out.scale = std::ldexp(1.0f, std::max(std::ilogb(brightest) - 14, -120));
  const float inverse = out.scale > 0 ? 1 / out.scale : 0.0f;
  out.light.reserve(smooth.size());
  for (const Vec3& e : smooth) out.light.push_back(halves_of(e, inverse));
  out.cell = page.cell, out.detail_width = page.detail_width, out.detail_height = page.detail_height;
  for (const Vec3& e : page.detail) out.detail.push_back(halves_of(e, inverse));
  out.sharp_at = page.sharp_at;
  return out;
}

HalfPage relit(const HalfPage& baked, const PageGroups& groups, std::span<const Vec3> factors) {
  HalfPage out = baked;
  float most = 1;
  for (const Vec3& factor : factors) most = std::max(most, max_component(factor));
  out.scale = baked.scale * std::exp2(std::ceil(std::log2(most)));
  const float inverse = out.scale > 0 ? 1 / out.scale : 0.0f;
  for (const bool details : {false, true}) {
    std::vector<Half4>& light = details ? out.detail : out.light;
    for_each_run(light.size(), core_count(), [&](std::size_t first, std::size_t end) {
      std::vector<Vec3> whole(end - first);
      for (std::size_t i = 0; i < whole.size(); ++i) whole[i] = floats_of(light[first + i]) * baked.scale;
      relight(groups, details, factors, first, whole);
      for (std::size_t i = 0; i < whole.size(); ++i) light[first + i] = halves_of(whole[i], inverse);
    });
  }
  return out;
}

HalfPage changed(HalfPage page, const PageChange& change) {
  if (change.empty()) return page;
  const auto each = [&](std::vector<Half4>& light, const std::vector<Vec3>& added, const auto& visit) {
    for (std::size_t i = 0; i < std::min(light.size(), added.size()); ++i)
      if (added[i] != Vec3(0)) visit(light[i], glm::max(floats_of(light[i]) * page.scale + added[i], Vec3(0)));
  };
  float brightest = 0;
  const auto look = [&](const Half4&, const Vec3& light) { brightest = std::max(brightest, max_component(light)); };
  each(page.light, change.light, look), each(page.detail, change.detail, look);
  // A power of two more, if need be: no bits of what stays are lost but those of the faintest light.
  const float needed = brightest > 0 ? std::ldexp(1.0f, std::max(std::ilogb(brightest) - 14, -120)) : 0.0f;
  const float scale = std::max(page.scale, needed);
  if (!(scale > 0)) return page;
  const auto scaled = [&](std::vector<Half4>& light) {
    if (scale != page.scale)
      for (Half4& texel : light) texel = halves_of(floats_of(texel), page.scale / scale);
  };
  HalfPage out = page;
  scaled(out.light), scaled(out.detail);
  const auto put = [&](std::vector<Half4>& to, const std::vector<Half4>& from) {
    return [&](const Half4& texel, const Vec3& light) {
      to[static_cast<std::size_t>(&texel - from.data())] = halves_of(light, 1 / scale);
    };
  };
  each(page.light, change.light, put(out.light, page.light));
  each(page.detail, change.detail, put(out.detail, page.detail));
  out.scale = scale;
  return out;
}

PageChange light_of(const HalfPage& page) {
  PageChange out;
  for (const Half4& texel : page.light) out.light.push_back(floats_of(texel) * page.scale);
  for (const Half4& point : page.detail) out.detail.push_back(floats_of(point) * page.scale);
  return out;
}

LightData light_data(HalfPage page, int coarser) {
  LightData out;
  if (!page.sharp_at.empty()) out.sharp_at = unsigned_ints(page.width, page.height, std::move(page.sharp_at));
  for (; coarser > 0 && (page.width > 1 || page.height > 1); --coarser) halve(page);
  out.scale = page.scale;
  double sum = 0, count = 0;
  constexpr std::size_t kSome = 4096;  // a mean of some is as good
  for (std::size_t i = 0; i < page.light.size(); i += std::max<std::size_t>(page.light.size() / kSome, 1)) {
    const float lux = luminance(floats_of(page.light[i])) * page.scale;
    if (lux > 0) sum += static_cast<double>(lux), count += 1;
  }
  if (count > 0) out.mean_lux = static_cast<float>(sum / count);
  if (!page.direction.empty()) out.direction = half_floats(page.width, page.height, std::move(page.direction));
  if (!page.detail.empty()) {
    out.detail = half_floats(page.detail_width, page.detail_height, std::move(page.detail));
    out.cells = unsigned_ints(page.width, page.height, std::move(page.cell));
  }
  out.light = half_floats(page.width, page.height, std::move(page.light));
  return out;
}

std::size_t mipmapped_bytes(const IVec2& size, int coarser) {
  TextureData shape;
  shape.width = std::max(1, size.x >> coarser);
  shape.height = std::max(1, size.y >> coarser);
  shape.options.levels = gpu::mip_levels(shape.width, shape.height);
  return shape.bytes();
}

std::size_t light_page_bytes(const IVec2& size, const IVec2& detail, bool directional, bool sharp, int coarser) {
  TextureData shape;
  shape.format = gpu::kRgba16f;
  shape.width = std::max(1, size.x >> coarser);
  shape.height = std::max(1, size.y >> coarser);
  const std::size_t records =
      sharp ? std::size_t{4} * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) : 0;
  const std::size_t plain = shape.bytes() * (directional ? 2 : 1) + records;
  if (coarser > 0 || detail.x == 0) return plain;
  return plain + shape.bytes() / 2 +
         std::size_t{8} * static_cast<std::size_t>(detail.x) * static_cast<std::size_t>(detail.y);
}

}  // namespace oriel
