#include "bake/scene/sky.h"

#include <array>

namespace oriel {

Vec2 sky_uv(const SkyImage& image, const Vec3& d) {
  const float u = 0.5f + (std::atan2(d.z, d.x) + image.rotation_rad) / (2 * kPi);
  return {u - std::floor(u), std::atan2(std::hypot(d.x, d.z), d.y) / kPi};
}

namespace {

// The four texels around a direction, rows one after the other, and where between them it is.
struct Between {
  std::array<std::size_t, 4> texel;
  float fx, fy;
};

Between texels_around(const SkyImage& image, const Vec3& direction) {
  const Vec2 uv = sky_uv(image, direction);
  const float x = uv.x * static_cast<float>(image.width) - 0.5f;
  const float y =
      std::clamp(uv.y * static_cast<float>(image.height) - 0.5f, 0.0f, static_cast<float>(image.height - 1));
  const float left = std::floor(x);
  const auto x0 = left < 0 ? image.width - 1 : std::min(static_cast<std::uint32_t>(left), image.width - 1);
  const auto y0 = static_cast<std::uint32_t>(y);
  const std::uint32_t x1 = x0 + 1 < image.width ? x0 + 1 : 0, y1 = std::min(y0 + 1, image.height - 1);
  const auto texel = [&](std::uint32_t i, std::uint32_t j) { return std::size_t{j} * image.width + i; };
  return {{texel(x0, y0), texel(x1, y0), texel(x0, y1), texel(x1, y1)}, x - left, y - static_cast<float>(y0)};
}

}  // namespace

Vec3 sky_radiance(const Scene& scene, const Vec3& direction) {
  const SkyImage& image = scene.sky_image;
  if (image.texels.empty()) return scene.sky;
  const auto [at, fx, fy] = texels_around(image, direction);
  const std::vector<Vec3>& texels = image.texels;
  return glm::mix(glm::mix(texels[at[0]], texels[at[1]], fx), glm::mix(texels[at[2]], texels[at[3]], fx), fy);
}

SkyMap make_sky_map(const Scene& scene) {
  const SkyImage& image = scene.sky_image;
  SkyMap map;
  if (image.texels.empty() || scene.day.lit() > 1) return map;
  map.width = std::min(image.width, SkyMap::kMostWidth), map.height = std::min(image.height, SkyMap::kMostHeight);
  map.texels.reserve(std::size_t{map.width} * map.height);
  // Within a texel, each way: of 16384 texels every second one.
  const std::uint32_t steps = std::clamp(std::max(image.width / map.width, image.height / map.height), 1u, 4u);
  for (std::uint32_t y = 0; y < map.height; ++y)
    for (std::uint32_t x = 0; x < map.width; ++x) {
      Vec3 sum(0);
      for (std::uint32_t i = 0; i < steps * steps; ++i) {
        const auto at = [&](std::uint32_t whole, std::uint32_t part) {
          return static_cast<float>(whole * steps + part) + 0.5f;
        };
        const float turn = 2 * kPi * at(x, i % steps) / static_cast<float>(map.width * steps) - kPi,
                    polar = kPi * at(y, i / steps) / static_cast<float>(map.height * steps);
        sum +=
            sky_radiance(scene, {std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn)});
      }
      Vec3& texel = map.texels.emplace_back(0);
      for (int c = 0; c < 3; ++c)
        if (scene.sky[c] > 0) texel[c] = sum[c] / (scene.sky[c] * static_cast<float>(steps * steps));
    }
  return map;
}

void shares_of_sky(const Scene& scene, const Vec3& direction, std::vector<float>& shares) {
  const auto [at, fx, fy] = texels_around(scene.sky_image, direction);
  const std::size_t parts = scene.sky_parts.groups.size();
  shares.resize(parts);
  const std::vector<float>& luminance = scene.sky_parts.luminance;
  float sum = 0;
  for (std::size_t k = 0; k < parts; ++k) {
    const auto of = [&](std::size_t corner) { return luminance[at[corner] * parts + k]; };
    sum += shares[k] = glm::mix(glm::mix(of(0), of(1), fx), glm::mix(of(2), of(3), fx), fy);
  }
  for (float& share : shares) share = sum > 0 ? share / sum : 1 / static_cast<float>(parts);
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
