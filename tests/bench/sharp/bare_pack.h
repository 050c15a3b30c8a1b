// What a pack shows of its sharp light, and its mesh for rays.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "bake/trace/accel.h"
#include "formats/core/disjoint_sets.h"
#include "formats/pack/pack.h"

namespace oriel {

// The pack's opaque parts alone, white, without light of texels.
struct BarePack {
  const Pack& full;
  Pack pack;
  std::vector<std::int32_t> page;    // by triangle of the mesh
  std::vector<std::uint32_t> plane;  // likewise: numbers of planes that have a chart in common
  Scene scene;

  explicit BarePack(const Pack& of) : full(of) {
    pack.mesh = full.mesh, pack.sharp_light = full.sharp_light, pack.lightmaps = full.lightmaps;
    pack.materials.resize(1);
    pack.materials[0].f0 = Vec3(0);
    pack.mesh.indices.clear(), pack.mesh.parts.clear(), pack.mesh.colors.clear();
    pack.mesh.normal_uvs.clear(), pack.mesh.tangents.clear();
    for (LightmapPage& p : pack.lightmaps) {
      std::ranges::fill(p.irradiance, Vec3(0)), std::ranges::fill(p.sharp, Vec3(0));
      p.direction.clear(), p.cell.clear(), p.detail.clear(), p.detail_width = p.detail_height = 0;
    }
    for (const MeshPart& part : full.mesh.parts) {
      const Material& m = full.materials[part.material];
      if (m.alpha_mode != AlphaMode::kOpaque || m.transmission > 0 || m.unlit || part.lightmap_page < 0) continue;
      MeshPart bare = part;
      bare.material = 0, bare.first_index = static_cast<std::uint32_t>(pack.mesh.indices.size());
      const auto first = full.mesh.indices.begin() + part.first_index;
      pack.mesh.indices.insert(pack.mesh.indices.end(), first, first + part.index_count);
      pack.mesh.parts.push_back(bare);
      page.insert(page.end(), part.index_count / 3, part.lightmap_page);
    }
    scene.positions = pack.mesh.positions, scene.normals = pack.mesh.normals, scene.origin = pack.mesh.origin;
    for (std::size_t i = 0; i < pack.mesh.indices.size(); i += 3)
      scene.triangles.emplace_back(pack.mesh.indices[i], pack.mesh.indices[i + 1], pack.mesh.indices[i + 2]);
    scene.triangle_surface.assign(scene.triangles.size(), 0);
    scene.materials.resize(1), scene.surfaces.resize(1);
    scene.surfaces[0].triangle_count = static_cast<std::uint32_t>(scene.triangles.size());
    scene.lower = scene.upper = scene.positions.at(0);
    for (const Vec3& p : scene.positions)
      scene.lower = glm::min(scene.lower, p), scene.upper = glm::max(scene.upper, p);
    // What lies in one plane may be flat or part of something curved, whose lamps are in texels.
    DisjointSets charts(page.size());
    std::map<std::array<float, 3>, std::uint32_t> corners;
    for (std::uint32_t t = 0; t < page.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const Vec2& at = pack.mesh.lightmap_uvs[scene.triangles[t][k]];
        charts.join(t, corners.try_emplace({static_cast<float>(page[t]), at.x, at.y}, t).first->second);
      }
    std::map<std::array<int, 5>, std::uint32_t> planes;
    for (std::uint32_t t = 0; t < page.size(); ++t) {
      const Vec3 n = geometric_normal(scene, t);
      const float off = glm::dot(n, scene.positions[scene.triangles[t].x]);
      const auto rounded = [](float v, float by) { return static_cast<int>(std::lround(v / by)); };
      plane.push_back(planes
                          .try_emplace({static_cast<int>(charts.root(t)), rounded(n.x, 0.01f), rounded(n.y, 0.01f),
                                        rounded(n.z, 0.01f), rounded(off, 0.002f)},
                                       static_cast<std::uint32_t>(planes.size()))
                          .first->second);
    }
  }

  Vec2 uv(std::uint32_t t, const Vec2& in) const {
    const UVec3& v = scene.triangles[t];
    const auto& uvs = pack.mesh.lightmap_uvs;
    return uvs[v.x] + in.x * (uvs[v.y] - uvs[v.x]) + in.y * (uvs[v.z] - uvs[v.x]);
  }

  // Whether a place of the full pack has at least half of that illuminance although no lamp is listed there.
  bool has_in_texels(std::uint32_t t, const Vec2& at, float lux) const {
    const LightmapPage& p = full.lightmaps[static_cast<std::size_t>(page[t])];
    const UVec2 texel =
        glm::min(UVec2(glm::clamp(at, Vec2(0), Vec2(1)) * Vec2(p.width, p.height)), UVec2(p.width, p.height) - 1u);
    const std::size_t i = std::size_t{texel.y} * p.width + texel.x;
    return (p.sharp_at.empty() || p.sharp_at[i] == 0) && max_component(p.irradiance[i]) > 0.5f * lux;
  }

  bool lists(std::uint32_t record, std::uint32_t lamp) const {
    const auto& words = pack.sharp_light.words;
    if (words[record] == kSharpSplit) {
      for (std::uint32_t k = 1; k <= 4; ++k)
        if (lists(words[record + k], lamp)) return true;
      return false;
    }
    std::uint32_t next = record + 1;
    for (std::uint32_t k = 0; k < words[record]; ++k) {
      const SharpShine shine = SharpShine::of(words[next]);
      if (shine.lamp == lamp) return true;
      next += 1 + (shine.tinted ? 1 : 0) + shine.count;
    }
    return false;
  }

  // Planes on which a lamp is computed by pixel: somewhere it is listed.
  std::set<std::uint32_t> planes_of(std::uint32_t lamp) const {
    std::set<std::uint32_t> out;
    for (std::uint32_t t = 0; t < page.size(); ++t) {
      const LightmapPage& p = pack.lightmaps[static_cast<std::size_t>(page[t])];
      if (p.sharp_at.empty() || out.contains(plane[t])) continue;
      const Vec2 size(p.width, p.height), a = uv(t, {0, 0}) * size, b = uv(t, {1, 0}) * size, c = uv(t, {0, 1}) * size;
      const int steps = 1 + static_cast<int>(std::max(glm::distance(a, b), glm::distance(a, c)));
      for (int y = 0; y <= steps; ++y)
        for (int x = 0; x <= steps - y; ++x) {
          const Vec2 at = a + (b - a) * (static_cast<float>(x) / static_cast<float>(steps)) +
                          (c - a) * (static_cast<float>(y) / static_cast<float>(steps));
          const UVec2 texel = glm::min(UVec2(glm::max(at, Vec2(0))), UVec2(p.width, p.height) - 1u);
          if (lists(p.sharp_at[std::size_t{texel.y} * p.width + texel.x], lamp)) out.insert(plane[t]);
        }
    }
    return out;
  }
};

}  // namespace oriel
