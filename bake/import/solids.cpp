#include "bake/import/solids.h"

#include <algorithm>
#include <array>
#include <map>

#include "bake/import/warning_group.h"

namespace oriel {
namespace {

using Corner = std::array<float, 3>;

// How many edges have another number of triangles on one side than on the other, and the volume enclosed, m³.
struct Shell {
  std::size_t open_edges = 0;
  double volume = 0;
  bool is_solid() const { return open_edges == 0 && volume > 0; }
  std::string fault() const {
    return open_edges > 0 ? fmt::format("found {} open edges, expected a closed surface", open_edges)
                          : "found its front inwards, expected it outwards";
  }
};

Shell shell_of(const Scene& scene, const std::vector<std::uint32_t>& surfaces) {
  std::map<Corner, std::uint32_t> corners;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;  // low to high corner: how often, less the other way
  Shell shell;
  for (const std::uint32_t s : surfaces) {
    const Surface& surface = scene.surfaces[s];
    for (std::uint32_t t = 0; t < surface.triangle_count; ++t) {
      const UVec3& triangle = scene.triangles[surface.first_triangle + t];
      std::array<std::uint32_t, 3> id{};
      DVec3 p[3];
      for (int k = 0; k < 3; ++k) {
        const Vec3 at = scene.positions[triangle[k]] + 0.0f;  // -0 is 0
        p[k] = DVec3(at);
        const auto number = static_cast<std::uint32_t>(corners.size());
        id[static_cast<std::size_t>(k)] = corners.try_emplace(Corner{at.x, at.y, at.z}, number).first->second;
      }
      shell.volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = id[k], to = id[(k + 1) % 3];
        edges[std::minmax(from, to)] += from < to ? 1 : -1;
      }
    }
  }
  shell.open_edges =
      static_cast<std::size_t>(std::ranges::count_if(edges, [](const auto& e) { return e.second != 0; }));
  return shell;
}

bool may_be_solid(const SceneMaterial& m) {
  return m.alpha_mode == AlphaMode::kOpaque && m.metal == Metal::kNone && !m.unlit;
}

// The surfaces that are no solids by themselves or together, and why.
std::map<std::uint32_t, std::string> find_thin(const Scene& scene) {
  std::map<std::pair<std::uint32_t, std::int32_t>, std::vector<std::uint32_t>> open;  // by material and mover
  std::map<std::uint32_t, std::string> thin;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    const SceneMaterial& m = scene.materials[surface.material];
    if (!m.solid) continue;
    if (!may_be_solid(m)) {
      thin.emplace(s, "found an alpha mode, a metal or an unlit material, expected opaque glass");
    } else if (const Shell shell = shell_of(scene, {s}); !shell.is_solid()) {
      thin.emplace(s, shell.fault());
      open[{surface.material, surface.mover}].push_back(s);
    }
  }
  for (const auto& [of, surfaces] : open)
    if (surfaces.size() > 1 && shell_of(scene, surfaces).is_solid())
      for (const std::uint32_t s : surfaces) thin.erase(s);
  return thin;
}

}  // namespace

void find_solids(Scene& scene, Context& context) {
  // Light that enters a body of panes leaves it by their backs.
  for (SceneMaterial& m : scene.materials) m.double_sided = m.double_sided || (m.transmission > 0 && !m.solid);
  if (std::ranges::none_of(scene.materials, [](const SceneMaterial& m) { return m.solid; })) return;
  const auto thin = find_thin(scene);
  std::map<std::uint32_t, std::uint32_t> copies;  // by material: the pane
  WarningGroup panes(context, "surfaces of solid glass that are taken for thin panes");
  for (const auto& [s, fault] : thin) {
    Surface& surface = scene.surfaces[s];
    const auto [copy, is_new] = copies.try_emplace(surface.material, scene.materials.size());
    if (is_new) {
      SceneMaterial pane = scene.materials[surface.material];
      pane.name += " (thin)";
      pane.solid = false, pane.double_sided = true;
      scene.materials.push_back(std::move(pane));
    }
    panes.add(fmt::format("surface \"{}\" of solid glass: {}: taken for a thin pane", surface.name, fault));
    surface.material = copy->second;
  }
  panes.finish();
  for (SceneMaterial& m : scene.materials) m.double_sided = m.double_sided && !m.solid;
}

}  // namespace oriel
