// A room in the form of a cube, with a page of light for each wall.
#pragma once

#include "formats/query/live_lights.h"
#include "formats/query/page_points.h"

namespace oriel {

inline constexpr std::uint32_t kLitSide = 8;  // texels of a wall
inline constexpr float kLitAlbedo = 0.5f;

// A cube of 2 m about the origin whose walls face inwards, dark at first.
struct LitCube {
  Mesh mesh;
  std::vector<Material> materials{1};
  std::vector<LightmapPage> pages;
  std::vector<std::vector<PagePoint>> points;

  LitCube() {
    materials[0].base_color = Vec3(kLitAlbedo);
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-1.0f, 1.0f}) {
        Vec3 u(0), v(0), o(-1);
        u[(axis + 1) % 3] = 2, v[(axis + 2) % 3] = 2;
        o[axis] = side;
        side < 0 ? wall(o, u, v) : wall(o, v, u);
      }
    find_points();
  }
  void wall(const Vec3& o, const Vec3& u, const Vec3& v) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto page = static_cast<std::int32_t>(pages.size());
    for (const Vec2& at : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
      mesh.positions.push_back(o + at.x * u + at.y * v);
      mesh.normals.push_back(glm::normalize(glm::cross(u, v)));
      mesh.uvs.emplace_back(0), mesh.lightmap_uvs.push_back(at);
    }
    mesh.parts.push_back({"wall", static_cast<std::uint32_t>(mesh.indices.size()), 6, 0, page});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
    LightmapPage& added = pages.emplace_back();
    added.width = added.height = kLitSide;
    added.irradiance.assign(kLitSide * kLitSide, Vec3(0));
    added.state.assign(kLitSide * kLitSide, TexelState::kValid);
  }
  // Its page stays, with nothing on it.
  void remove_wall(std::size_t number) {
    mesh.parts.erase(mesh.parts.begin() + static_cast<std::ptrdiff_t>(number));
    find_points();
  }
  void find_points() {
    points.clear();
    for (std::uint32_t p = 0; p < pages.size(); ++p) points.push_back(page_points(mesh, {}, p, pages[p]));
  }
  LampScene scene() const { return {{mesh, materials, {}, {}}, {}}; }
};

}  // namespace oriel
