#include "bake/scene/sky.h"

namespace oriel {

Vec2 sky_uv(const SkyImage& image, const Vec3& d) {
  const float u = 0.5f + (std::atan2(d.z, d.x) + image.rotation_rad) / (2 * kPi);
  return {u - std::floor(u), std::atan2(std::hypot(d.x, d.z), d.y) / kPi};
}

Vec3 sky_radiance(const Scene& scene, const Vec3& direction) {
  const SkyImage& image = scene.sky_image;
  if (image.texels.empty()) return scene.sky;
  const Vec2 uv = sky_uv(image, direction);
  const float x = uv.x * static_cast<float>(image.width) - 0.5f;
  const float y =
      std::clamp(uv.y * static_cast<float>(image.height) - 0.5f, 0.0f, static_cast<float>(image.height - 1));
  const float left = std::floor(x);
  const auto x0 = left < 0 ? image.width - 1 : std::min(static_cast<std::uint32_t>(left), image.width - 1);
  const auto y0 = static_cast<std::uint32_t>(y);
  const std::uint32_t x1 = x0 + 1 < image.width ? x0 + 1 : 0, y1 = std::min(y0 + 1, image.height - 1);
  const auto texel = [&](std::uint32_t i, std::uint32_t j) { return image.texels[std::size_t{j} * image.width + i]; };
  const float fx = x - left, fy = y - static_cast<float>(y0);
  return glm::mix(glm::mix(texel(x0, y0), texel(x1, y0), fx), glm::mix(texel(x0, y1), texel(x1, y1), fx), fy);
}

SkyRow sky_row(const SkyImage& image, std::uint32_t k) {
  const double h = image.height;
  const auto cosine = [&](double row) { return std::cos(kPiD * std::clamp(row / h, 0.0, 1.0)); };
  return {k > 0 ? k - 1 : 0, std::min(k, image.height - 1), cosine(k - 0.5), cosine(k + 0.5)};
}

Vec3 sky_mean(const SkyImage& image) {
  DVec3 sum(0);
  for (std::uint32_t k = 0; k <= image.height; ++k) {
    const SkyRow row = sky_row(image, k);
    DVec3 corners(0);
    for (std::uint32_t x = 0; x < image.width; ++x)
      corners += DVec3(image.texels[std::size_t{row.upper} * image.width + x]) +
                 DVec3(image.texels[std::size_t{row.lower} * image.width + x]);
    sum += corners * (0.5 * (row.cos_upper - row.cos_lower));
  }
  return Vec3(sum / (2.0 * image.width));
}

}  // namespace oriel
