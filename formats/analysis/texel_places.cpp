#include "formats/analysis/texel_places.h"

#include <array>
#include <cmath>

#include "formats/image/texel_centres.h"

namespace oriel {
namespace {

// Gives the texels whose centres lie in the triangle their place.
void add_triangle(const std::array<Vec3, 3>& corner, const std::array<Vec2, 3>& uv, std::uint32_t part,
                  const LightmapPage& page, std::vector<TexelPlace>& places) {
  const Vec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const Vec2 u = uv[1] - uv[0], v = uv[2] - uv[0];
  const float twice_m2 = glm::length(normal);
  const float twice_texels = std::abs(u.x * v.y - u.y * v.x) * static_cast<float>(page.width * page.height);
  if (!(twice_m2 > 0) || !(twice_texels > 0)) return;
  for_texel_centres(uv, page.width, page.height, [&](std::uint32_t x, std::uint32_t y, const Vec3& b) {
    places[std::size_t{y} * page.width + x] = {part, std::sqrt(twice_m2 / twice_texels),
                                               b.x * corner[0] + b.y * corner[1] + b.z * corner[2], normal / twice_m2};
  });
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
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
      std::array<Vec3, 3> corner;
      std::array<Vec2, 3> uv;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t vertex = mesh.indices[i + c];
        corner[c] = mesh.positions[vertex], uv[c] = mesh.lightmap_uvs[vertex];
      }
      add_triangle(corner, uv, p, page, places[number]);
    }
  }
  return places;
}

}  // namespace oriel
