#include "bake/scene/texture.h"

#include <algorithm>

#include "bake/jobs/parallel.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr float kMostPlaces = 4;       // along the longer radius: beyond, an ellipse is read as a wider one
constexpr float kGrazing = 1.0f / 64;  // cosine below which footprints grow no longer

std::uint32_t wrapped(double i, std::uint32_t size, Wrap wrap) {
  const double n = size;
  if (wrap == Wrap::kClamp) return static_cast<std::uint32_t>(std::clamp(i, 0.0, n - 1));
  const double period = wrap == Wrap::kMirror ? 2 * n : n;
  double r = i - std::floor(i / period) * period;
  if (r >= period) r = 0;  // rounding of a tiny negative i
  if (r < 0) r = 0;
  const auto at = static_cast<std::uint32_t>(r);
  return at < size ? at : 2 * size - 1 - at;
}

Vec4 texel(const Image& image, double x, double y, const TextureSlot& slot, bool srgb) {
  const std::uint8_t* p = image.texels.data() + 4 * (std::size_t{wrapped(y, image.height, slot.wrap_t)} * image.width +
                                                     wrapped(x, image.width, slot.wrap_s));
  const float alpha = static_cast<float>(p[3]) / 255.0f;
  if (srgb) return {linear_from_srgb8(p[0]), linear_from_srgb8(p[1]), linear_from_srgb8(p[2]), alpha};
  return {static_cast<float>(p[0]) / 255.0f, static_cast<float>(p[1]) / 255.0f, static_cast<float>(p[2]) / 255.0f,
          alpha};
}

// at: 1 is the image's side.
Vec4 sample_image(const Image& image, const DVec2& at, const TextureSlot& slot, bool srgb) {
  const double x = at.x * image.width, y = at.y * image.height;
  if (slot.nearest) return texel(image, std::floor(x), std::floor(y), slot, srgb);
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const auto fx = static_cast<float>(x - 0.5 - left), fy = static_cast<float>(y - 0.5 - top);
  const Vec4 upper = glm::mix(texel(image, left, top, slot, srgb), texel(image, left + 1, top, slot, srgb), fx);
  const Vec4 lower = glm::mix(texel(image, left, top + 1, slot, srgb), texel(image, left + 1, top + 1, slot, srgb), fx);
  return glm::mix(upper, lower, fy);
}

DVec2 image_from(const TextureSlot& slot, const Vec2& uv, double w) {
  // In double: a float of a large coordinate has no texels left, and its floor no integer.
  return DVec2(DMat3(slot.image_from_uv) * DVec3(uv, w));
}

// What materials read an image as.
struct ImageUse {
  bool colour = false;   // sRGB
  bool cut_out = false;  // alpha says what is there: the colour of nothing does not count
};

// Half the size; each texel the mean of the two or three times as many below it.
Image halved(const Image& image, const ImageUse& use) {
  Image half{image.name, std::max(1u, image.width / 2), std::max(1u, image.height / 2), {}, {}};
  half.texels.resize(std::size_t{4} * half.width * half.height);
  const auto first = [](std::uint32_t i, std::uint32_t whole, std::uint32_t part) {
    return static_cast<std::uint32_t>(std::uint64_t{i} * whole / part);
  };
  for (std::uint32_t y = 0; y < half.height; ++y)
    for (std::uint32_t x = 0; x < half.width; ++x) {
      const std::uint32_t left = first(x, image.width, half.width), right = first(x + 1, image.width, half.width);
      const std::uint32_t top = first(y, image.height, half.height), bottom = first(y + 1, image.height, half.height);
      Vec4 sum(0), seen(0);
      for (std::uint32_t v = top; v < bottom; ++v)
        for (std::uint32_t u = left; u < right; ++u) {
          const Vec4 t = texel(image, u, v, {}, use.colour);
          sum += t, seen += Vec4(t.a * Vec3(t), t.a);
        }
      sum /= static_cast<float>((right - left) * (bottom - top));
      if (use.cut_out && seen.a > 0) sum = Vec4(Vec3(seen) / seen.a, sum.a);
      if (use.colour) sum = Vec4(srgb_from_linear(Vec3(sum)), sum.a);
      std::uint8_t* to = half.texels.data() + 4 * (std::size_t{y} * half.width + x);
      for (int c = 0; c < 4; ++c) to[c] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(sum[c], 0.0f, 1.0f)));
    }
  return half;
}

}  // namespace

Footprint cone_footprint(const Scene& scene, std::uint32_t triangle, const Vec3& direction, float width_m) {
  const UVec3& t = scene.triangles[triangle];
  const Vec3 u = scene.positions[t.y] - scene.positions[t.x], v = scene.positions[t.z] - scene.positions[t.x];
  const double uu = glm::dot(DVec3(u), DVec3(u)), uv = glm::dot(DVec3(u), DVec3(v)), vv = glm::dot(DVec3(v), DVec3(v));
  const double area2 = uu * vv - uv * uv;
  if (!(width_m > 0) || !(area2 > 0)) return {};
  const auto steps = [&](const Vec3& way) {  // of a way in the plane
    const double a = glm::dot(DVec3(way), DVec3(u)), b = glm::dot(DVec3(way), DVec3(v));
    const Vec2 step(DVec2(vv * a - uv * b, uu * b - uv * a) / area2);
    return std::isfinite(step.x) && std::isfinite(step.y) ? step : Vec2(0);
  };
  const Vec3 normal = geometric_normal(scene, triangle);
  const float cosine = std::abs(glm::dot(normal, direction));
  const Vec3 along = direction - glm::dot(normal, direction) * normal;
  const Vec3 longer = length2(along) > 1e-12f ? glm::normalize(along) : frame_from_normal(normal)[0];
  const float radius = 0.5f * width_m;
  return {steps(radius * glm::cross(normal, longer)), steps(radius / std::max(cosine, kGrazing) * longer)};
}

Vec4 sample_texture(const Scene& scene, const TextureSlot& slot, const Vec2& uv, bool srgb, const Footprint& over) {
  const Image& image = scene.images[static_cast<std::size_t>(slot.image)];
  const DVec2 at = image_from(slot, uv, 1), size(image.width, image.height);
  if (over.is_point()) return sample_image(image, at, slot, srgb);
  DVec2 narrow = image_from(slot, over.shorter, 0), wide = image_from(slot, over.longer, 0);
  if (glm::length(size * narrow) > glm::length(size * wide)) std::swap(narrow, wide);
  const double long_texels = glm::length(size * wide);  // radii
  const double texels = 2 * std::max(glm::length(size * narrow), long_texels / kMostPlaces);
  const double level = std::clamp(std::log2(std::max(texels, 1.0)), 0.0, static_cast<double>(image.mips.size()));
  if (slot.nearest || image.mips.empty() || !(2 * long_texels > 1)) return sample_image(image, at, slot, srgb);
  const auto lower = static_cast<std::size_t>(level);
  const auto between = static_cast<float>(level - static_cast<double>(lower));
  const auto of_level = [&](std::size_t l) -> const Image& { return l == 0 ? image : image.mips[l - 1]; };
  const int places = static_cast<int>(std::ceil(2 * long_texels / std::max(texels, 1.0)));
  Vec4 sum(0);
  for (int k = 0; k < places; ++k) {
    const DVec2 place = at + ((2.0 * k + 1) / places - 1) * wide;
    const Vec4 fine = sample_image(of_level(lower), place, slot, srgb);
    sum += between > 0 ? glm::mix(fine, sample_image(of_level(lower + 1), place, slot, srgb), between) : fine;
  }
  return sum / static_cast<float>(places);
}

Status make_mips(Scene& scene, Context& context) {
  std::vector<ImageUse> uses(scene.images.size());
  for (const SceneMaterial& m : scene.materials) {
    for (const TextureSlot* slot : {&m.base_color_texture, &m.emission_texture, &m.specular_color_texture})
      if (slot->image >= 0) uses[static_cast<std::size_t>(slot->image)].colour = true;
    if (m.alpha_mode != AlphaMode::kOpaque && m.base_color_texture.image >= 0)
      uses[static_cast<std::size_t>(m.base_color_texture.image)].cut_out = true;
  }
  return parallel_for(context, "mips", scene.images.size(), [&](std::size_t i) {
    Image& image = scene.images[i];
    image.mips.clear();
    if (image.texels.empty()) return;
    while (std::max(image.width >> image.mips.size(), image.height >> image.mips.size()) > 1)
      image.mips.push_back(halved(image.mips.empty() ? image : image.mips.back(), uses[i]));
  });
}

}  // namespace oriel
