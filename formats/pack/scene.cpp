// Geometry, materials, reflectors, cameras, walk grids.
#include <cmath>
#include <limits>

#include "formats/pack/sections.h"

namespace oriel {
namespace {

constexpr std::uint32_t kHasColors = 1, kHasNormalMaps = 2;

// Each index as its difference from the one before: vertices come mostly in the order of their triangles.
void describe_indices(Serial& s, std::vector<std::uint32_t>& indices, std::uint32_t n) {
  std::uint32_t before = 0;
  s.coded<std::uint32_t>(
      indices, n, [&](std::uint32_t index) { return index - std::exchange(before, index); },
      [&](std::uint32_t step, std::size_t) { return before += step; });
}

// Directions, then on which side of them the bitangent lies: 0 for none.
void describe_tangents(Serial& s, std::vector<Vec4>& tangents, std::uint32_t n) {
  std::vector<std::int8_t> sides;
  for (const Vec4& t : tangents) sides.push_back(static_cast<std::int8_t>(t.w));
  s.coded<std::uint32_t>(
      tangents, n, [](const Vec4& t) { return t.w == 0 ? 0 : octahedral_from_normal(Vec3(t)); },
      [](std::uint32_t code, std::size_t) { return Vec4(normal_from_octahedral(code), 0); });
  s.planes(sides, n);
  if (!s.reading()) return;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] < -1 || sides[i] > 1)
      s.refuse("found side {} of vertex {}'s tangent, expected -1, 0 or 1", static_cast<int>(sides[i]), i);
    tangents[i] = sides[i] == 0 ? Vec4(0) : Vec4(Vec3(tangents[i]), sides[i]);
  }
}

}  // namespace

void describe(Serial& s, Mesh& mesh) {
  s(mesh.origin);
  const std::uint32_t vertices = s.count(mesh.positions), indices = s.count(mesh.indices), parts = s.count(mesh.parts);
  std::uint32_t flags = (mesh.colors.empty() ? 0 : kHasColors) | (mesh.normal_uvs.empty() ? 0 : kHasNormalMaps);
  s(flags);
  if (flags > (kHasColors | kHasNormalMaps)) s.refuse("found mesh flags {:#x}, expected 0 to 3", flags);
  s.planes(mesh.positions, vertices);
  s.coded<std::uint32_t>(mesh.normals, vertices, octahedral_from_normal,
                         [](std::uint32_t code, std::size_t) { return normal_from_octahedral(code); });
  s.planes(mesh.uvs, vertices);
  s.planes(mesh.lightmap_uvs, vertices);
  if (flags & kHasColors) s.planes(mesh.colors, vertices);
  if (flags & kHasNormalMaps) {
    s.planes(mesh.normal_uvs, vertices);
    describe_tangents(s, mesh.tangents, vertices);
  }
  describe_indices(s, mesh.indices, indices);
  s.list(mesh.parts, parts,
         [&](MeshPart& part) { s(part.name, part.first_index, part.index_count, part.material, part.lightmap_page); });
}

void describe(Serial& s, Material& m) {
  s(m.name, m.base_color, m.alpha, m.base_color_texture);
  s.choice("alpha mode", 2, m.alpha_mode);
  s.choice("double-sided flag", 1, m.double_sided);
  s.choice("unlit flag", 1, m.unlit);
  s.reserved(1);
  s(m.alpha_cutoff, m.metallic, m.roughness, m.ior, m.f0, m.transmission, m.emission, m.kernel, m.fresnel_map,
    m.normal_texture, m.normal_scale);
}

void describe(Serial& s, SolidGlass& solid) {
  s(solid.material, solid.tint, solid.absorption);
}

void describe(Serial& s, EmissionTexture& emission) {
  s(emission.material, emission.texture, emission.mean);
}

void describe(Serial& s, Metalness& metalness) {
  s(metalness.material, metalness.texture, metalness.dielectric);
}

void describe(Serial& s, Reflector& r) {
  s(r.name, r.material, r.pack_from_reflector, r.lower, r.upper, r.area_m2, r.flatness_m, r.elements_x, r.elements_y,
    r.first_map, r.map_count);
  s.array(r.indices, s.count(r.indices));
  const std::uint32_t emitters = s.count(r.emitters);
  if (emitters > kMaxReflectorEmitters)
    s.refuse("found {} emitters, expected at most {}", emitters, kMaxReflectorEmitters);
  s(r.visibility_x, r.visibility_y);
  if (r.visibility_x > kMaxSide || r.visibility_y > kMaxSide)
    s.refuse("found visibility from {} x {} nodes, expected at most {} a side", r.visibility_x, r.visibility_y,
             kMaxSide);
  s.array(r.emitters, emitters);
  s.planes(r.visibility, std::uint64_t{r.visibility_x} * r.visibility_y * emitters);
}

void describe(Serial& s, CurvedReflector& r) {
  s(r.name, r.material, r.map);
  s.array(r.indices, s.count(r.indices));
}

void describe(Serial& s, Emitter& emitter) {
  auto corners = static_cast<std::uint8_t>(emitter.corners.size());
  s(corners);
  if (corners != 3 && corners != 4) s.refuse("found {} corners, expected 3 or 4", corners);
  s.choice("two-sided flag", 1, emitter.two_sided);
  s(emitter.radiance);
  s.list(emitter.corners, corners, [&](Vec3& corner) { s(corner); });
}

void describe(Serial& s, Camera& camera) {
  s(camera.name, camera.eye, camera.forward, camera.up, camera.vertical_fov_rad, camera.half_height);
}

void describe(Serial& s, CameraPath& path) {
  s(path.name, path.vertical_fov_rad);
  s.list(path.keys, s.count(path.keys), [&](CameraKey& key) { s(key.time_s, key.eye, key.forward); });
}

void describe(Serial& s, WalkGrid& grid) {
  s(grid.lower, grid.cell_m, grid.eye_height_m);
  s.size(grid.width, grid.height);
  const std::uint64_t cells = std::uint64_t{grid.width} * grid.height;
  std::vector<std::uint8_t> walkable;
  for (std::size_t i = 0; i < grid.floor_y.size(); ++i) walkable.push_back(grid.walkable(i));
  s.planes(walkable, cells);
  s.coded<float>(
      grid.floor_y, cells, [](float y) { return std::isnan(y) ? 0 : y; },
      [&](float y, std::size_t i) {
        if (walkable[i] > 1 || !std::isfinite(y))
          s.refuse("found floor {} with walkable flag {} in cell {}, expected a finite one with 0 or 1", y, walkable[i],
                   i);
        return walkable[i] == 0 ? std::numeric_limits<float>::quiet_NaN() : y;
      });
}

}  // namespace oriel
