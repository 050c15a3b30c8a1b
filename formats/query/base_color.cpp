#include "formats/query/base_color.h"

#include <algorithm>
#include <cmath>

#include "formats/core/color.h"

namespace oriel {
namespace {

std::uint32_t texel_at(float coordinate, std::uint32_t size, Wrap wrap) {
  const float inside = wrap == Wrap::kClamp ? std::clamp(coordinate, 0.0f, 1.0f) : glm::fract(coordinate);
  const auto i = static_cast<std::uint32_t>(inside * static_cast<float>(size));
  const bool odd = wrap == Wrap::kMirror && std::fmod(std::fabs(std::floor(coordinate)), 2.0f) == 1.0f;
  return odd ? size - 1 - std::min(i, size - 1) : std::min(i, size - 1);
}

}  // namespace

Vec3 base_color_at(const Mesh& mesh, const Material& material, std::span<const Texture> textures,
                   const std::uint32_t* corners, const Vec2& uv) {
  Vec3 color = material.base_color;
  if (!mesh.colors.empty()) {
    const std::uint32_t rgba = mesh.colors[corners[0]];
    color *= Vec3(rgba & 255, rgba >> 8 & 255, rgba >> 16 & 255) / 255.0f;
  }
  if (material.base_color_texture < 0) return color;
  const Texture& texture = textures[static_cast<std::size_t>(material.base_color_texture)];
  if (texture.texels.empty()) return color;
  const Vec2 at = mesh.uvs[corners[0]] * (1 - uv.x - uv.y) + mesh.uvs[corners[1]] * uv.x + mesh.uvs[corners[2]] * uv.y;
  const std::size_t row = texel_at(at.y, texture.height, texture.wrap_t);
  const std::uint8_t* rgb = &texture.texels[4 * (row * texture.width + texel_at(at.x, texture.width, texture.wrap_s))];
  return color * Vec3(linear_from_srgb8(rgb[0]), linear_from_srgb8(rgb[1]), linear_from_srgb8(rgb[2]));
}

}  // namespace oriel
