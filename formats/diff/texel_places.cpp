#include "formats/diff/texel_places.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oriel {
namespace {

struct Corner {
  Vec3 position;
  Vec2 texel;  // on the page, in texels
};

float cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}

// Gives the texels whose centres lie in the triangle their place.
void add_triangle(const std::array<Corner, 3>& corner, std::uint32_t part, const LightmapPage& page,
                  std::vector<TexelPlace>& places) {
  const Vec2 u = corner[1].texel - corner[0].texel, v = corner[2].texel - corner[0].texel;
  const Vec3 normal = glm::cross(corner[1].position - corner[0].position, corner[2].position - corner[0].position);
  const float twice_texels = cross(u, v), twice_m2 = glm::length(normal);
  if (twice_texels == 0 || !(twice_m2 > 0)) return;
  const auto range = [&](int axis, std::uint32_t size) {
    const auto [least, most] = std::minmax({corner[0].texel[axis], corner[1].texel[axis], corner[2].texel[axis]});
    const auto last = static_cast<float>(size - 1);
    return std::array<std::uint32_t, 2>{static_cast<std::uint32_t>(std::clamp(std::floor(least), 0.0f, last)),
                                        static_cast<std::uint32_t>(std::clamp(std::ceil(most), 0.0f, last))};
  };
  const auto across = range(0, page.width), down = range(1, page.height);
  for (std::uint32_t y = down[0]; y <= down[1]; ++y)
    for (std::uint32_t x = across[0]; x <= across[1]; ++x) {
      const Vec2 at = Vec2(x, y) + 0.5f - corner[0].texel;
      const float b = cross(at, v) / twice_texels, c = cross(u, at) / twice_texels;
      if (b < 0 || c < 0 || b + c > 1) continue;
      places[std::size_t{y} * page.width + x] = {
          part, std::sqrt(twice_m2 / std::abs(twice_texels)),
          (1 - b - c) * corner[0].position + b * corner[1].position + c * corner[2].position, normal / twice_m2};
    }
}

}  // namespace

std::vector<std::vector<TexelPlace>> texel_places(const Pack& pack) {
  std::vector<std::vector<TexelPlace>> places;
  for (const LightmapPage& page : pack.lightmaps) places.emplace_back(page.irradiance.size());
  const Mesh& mesh = pack.mesh;
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
    const MeshPart& part = mesh.parts[p];
    if (part.lightmap_page < 0) continue;
    const auto number = static_cast<std::size_t>(part.lightmap_page);
    const LightmapPage& page = pack.lightmaps[number];
    const Vec2 size(page.width, page.height);
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
      std::array<Corner, 3> corner;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t vertex = mesh.indices[i + c];
        corner[c] = {mesh.positions[vertex], mesh.lightmap_uvs[vertex] * size};
      }
      add_triangle(corner, p, page, places[number]);
    }
  }
  return places;
}

}  // namespace oriel
