#include "player/scene/check.h"

#include <algorithm>
#include <bit>

#include "player/maps/map_choice.h"

namespace oriel {
namespace {

// what: "mesh", or whose.
Status check_mesh(const Pack& pack, const Mesh& mesh, const std::string& what) {
  const std::size_t count = mesh.positions.size();
  if (mesh.normals.size() != count || mesh.uvs.size() != count || mesh.lightmap_uvs.size() != count ||
      (!mesh.colors.empty() && mesh.colors.size() != count)) {
    return invalid(what, "found {} normals, {} uvs, {} lightmap uvs and {} colours, expected {} of each",
                   mesh.normals.size(), mesh.uvs.size(), mesh.lightmap_uvs.size(), mesh.colors.size(), count);
  }
  if (mesh.normal_uvs.size() != mesh.tangents.size() || (!mesh.tangents.empty() && mesh.tangents.size() != count)) {
    return invalid(what, "found {} uvs and {} tangents of normal maps, expected none or {}", mesh.normal_uvs.size(),
                   mesh.tangents.size(), count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_finite(mesh.positions[i]))
      return invalid(fmt::format("{}: vertex {}", what, i), "found a position that is not finite");
  }
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    if (mesh.indices[i] >= count) {
      return invalid(fmt::format("{}: index {}", what, i), "found vertex {}, expected less than {}", mesh.indices[i],
                     count);
    }
  }
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const MeshPart& part = mesh.parts[i];
    const std::string where = fmt::format("{}: part {} '{}'", what, i, part.name);
    if (std::uint64_t{part.first_index} + part.index_count > mesh.indices.size() || part.index_count % 3 != 0) {
      return invalid(where, "found indices {} + {}, expected triangles within {}", part.first_index, part.index_count,
                     mesh.indices.size());
    }
    if (part.material >= pack.materials.size()) {
      return invalid(where, "found material {}, expected less than {}", part.material, pack.materials.size());
    }
    if (part.lightmap_page >= static_cast<std::int64_t>(pack.lightmaps.size())) {
      return invalid(where, "found lightmap page {}, expected less than {}", part.lightmap_page, pack.lightmaps.size());
    }
  }
  return {};
}

Status check_size(const std::string& where, std::uint64_t width, std::uint64_t height, std::uint64_t found,
                  std::uint64_t per_texel, const gpu::Device& device) {
  const auto limit = static_cast<std::uint64_t>(device.texture_size);
  if (width == 0 || height == 0) return invalid(where, "found {}x{} texels, expected at least 1x1", width, height);
  if (width > limit || height > limit) {
    return fail(ErrorCode::kRuntime, where, "found {}x{} texels, expected at most {}x{} ({})", width, height, limit,
                limit, device.renderer);
  }
  if (found != width * height * per_texel) {
    return invalid(where, "found {} values, expected {} for {}x{} texels", found, width * height * per_texel, width,
                   height);
  }
  return {};
}

Status check_rectangle(const std::string& where, const Vec2& lower, const Vec2& upper) {
  const bool finite = is_finite(Vec3(lower, 0)) && is_finite(Vec3(upper, 0));
  if (finite && lower.x < upper.x && lower.y < upper.y) return {};
  return invalid(where, "found a rectangle from {}, {} to {}, {}, expected finite numbers that rise", lower.x, lower.y,
                 upper.x, upper.y);
}

Status check_images(const Pack& pack, const gpu::Device& device, ImagePixels pixels) {
  // Deferred ones have sizes only.
  const auto check = [&](const std::string& where, const auto& image, std::uint64_t found,
                         std::uint32_t per_texel) -> Status {
    const std::uint64_t all = std::uint64_t{image.width} * image.height * per_texel;
    return check_size(where, image.width, image.height, pixels == ImagePixels::kHere ? found : all, per_texel, device);
  };
  for (std::size_t i = 0; i < pack.textures.size(); ++i)
    ORIEL_TRY_VOID(check(fmt::format("texture {}", i), pack.textures[i], pack.textures[i].texels.size(), 4));
  for (std::size_t i = 0; i < pack.normal_textures.size(); ++i)
    ORIEL_TRY_VOID(
        check(fmt::format("normal texture {}", i), pack.normal_textures[i], pack.normal_textures[i].texels.size(), 4));
  for (std::size_t i = 0; i < pack.lightmaps.size(); ++i) {
    const LightmapPage& p = pack.lightmaps[i];
    const std::string where = fmt::format("lightmap {}", i);
    ORIEL_TRY_VOID(check(where, p, p.irradiance.size(), 1));
    if (!p.direction.empty()) ORIEL_TRY_VOID(check(where, p, p.direction.size(), 1));
  }
  for (std::size_t i = 0; i < pack.radiance_maps.size(); ++i) {
    const RadianceMap& m = pack.radiance_maps[i];
    const std::string where = fmt::format("radiance map {}", i);
    ORIEL_TRY_VOID(check(where, m, m.radiance.size(), 1));
    if (m.disparity.size() != m.radiance.size() || m.valid.size() != m.radiance.size()) {
      return invalid(where, "found {} disparities and {} states, expected {}", m.disparity.size(), m.valid.size(),
                     m.radiance.size());
    }
    if (!(m.eye.z < 0) || !is_finite(m.eye)) {
      return invalid(where, "found its eye at z = {}, expected behind the reflector's plane", m.eye.z);
    }
    ORIEL_TRY_VOID(check_rectangle(where, m.lower, m.upper));
  }
  return {};
}

Status check_materials(const Pack& pack) {
  const auto in_range = [](std::int64_t index, std::size_t count) { return index < static_cast<std::int64_t>(count); };
  for (std::size_t i = 0; i < pack.materials.size(); ++i) {
    const Material& m = pack.materials[i];
    if (!in_range(m.base_color_texture, pack.textures.size()) || !in_range(m.kernel, pack.kernels.size()) ||
        !in_range(m.fresnel_map, pack.fresnel_maps.size()) ||
        !in_range(m.normal_texture, pack.normal_textures.size())) {
      return invalid(
          fmt::format("material {} '{}'", i, m.name),
          "found texture {}, kernel {}, Fresnel map {}, normal texture {}, expected less than {}, {}, {}, {}",
          m.base_color_texture, m.kernel, m.fresnel_map, m.normal_texture, pack.textures.size(), pack.kernels.size(),
          pack.fresnel_maps.size(), pack.normal_textures.size());
    }
  }
  return {};
}

// Shaders divide by its determinant, and turn it by up to a right angle.
Status check_fit(const std::string& where, const LobeFit& f) {
  constexpr float kMost = 1e12f;
  for (const float v : {f.m11, f.m13, f.m22, f.m31})
    if (!(std::fabs(v) <= kMost)) return invalid(where, "found a fit's matrix entry {}, expected up to {}", v, kMost);
  if (f.m22 > 0 && f.m11 - f.m13 * f.m31 > 0) return {};
  return invalid(where, "found a fit of m11 {}, m13 {}, m22 {}, m31 {}, expected a positive determinant", f.m11, f.m13,
                 f.m22, f.m31);
}

// Weights of a kernel are read here; what becomes of them has a row of taps per slice.
Status check_kernels(const Pack& pack, const gpu::Device& device) {
  for (std::size_t i = 0; i < pack.kernels.size(); ++i) {
    const BrdfKernel& k = pack.kernels[i];
    const std::string where = fmt::format("kernel {}", i);
    ORIEL_TRY_VOID(check_size(where, k.size, k.size, k.weights.size(), 1, device));
    for (std::size_t s = 0; s < k.slices.size(); ++s) {
      const KernelSlice& slice = k.slices[s];
      const std::string at = fmt::format("{}: slice {}", where, s);
      ORIEL_TRY_VOID(check_size(at, k.slice_size, k.slice_size, slice.weights.size(), 1, device));
      if (!(slice.cos_theta >= 0 && slice.cos_theta <= 1) || (s > 0 && !(slice.cos_theta > k.slices[s - 1].cos_theta)))
        return invalid(at, "found cosine {}, expected 0 to 1 and rising", slice.cos_theta);
    }
    if (k.slices.size() > static_cast<std::size_t>(device.texture_size))
      return fail(ErrorCode::kRuntime, where, "found {} slices, expected at most {} ({})", k.slices.size(),
                  device.texture_size, device.renderer);
    if (!k.fits.empty() && k.fits.size() != k.slices.size())
      return invalid(where, "found {} fits, expected {}", k.fits.size(), k.slices.size());
    for (const LobeFit& f : k.fits) ORIEL_TRY_VOID(check_fit(where, f));
  }
  return {};
}

// All tables lie in one texture, a row each.
Status check_fresnel_maps(const Pack& pack, const gpu::Device& device) {
  const auto limit = static_cast<std::size_t>(device.texture_size);
  if (pack.fresnel_maps.size() > limit)
    return fail(ErrorCode::kRuntime, "Fresnel maps", "found {}, expected at most {} ({})", pack.fresnel_maps.size(),
                limit, device.renderer);
  for (std::size_t i = 0; i < pack.fresnel_maps.size(); ++i) {
    const FresnelMap& f = pack.fresnel_maps[i];
    const std::string where = fmt::format("Fresnel map {}", i);
    ORIEL_TRY_VOID(check_size(where, f.table.size(), 1, f.table.size(), 1, device));
    if (f.sphere_size > 0 || !f.sphere.empty())
      ORIEL_TRY_VOID(check_size(where, f.sphere_size, f.sphere_size, f.sphere.size(), 1, device));
  }
  return {};
}

Status check_triangles(const std::string& where, const Pack& pack, const std::vector<std::uint32_t>& indices) {
  if (indices.size() % 3 != 0) return invalid(where, "found {} indices, expected triangles", indices.size());
  for (const std::uint32_t index : indices) {
    if (index >= pack.mesh.positions.size()) {
      return invalid(where, "found vertex {}, expected less than {}", index, pack.mesh.positions.size());
    }
  }
  return {};
}

Status check_reflector_emitters(const Pack& pack, const Reflector& r, const std::string& where,
                                const gpu::Device& device) {
  if (r.emitters.empty()) return {};
  if (r.emitters.size() > kMaxReflectorEmitters || r.visibility_x < 2 || r.visibility_y < 2) {
    return invalid(where, "found {} emitters seen from {}x{} nodes, expected at most {} and at least 2x2 nodes",
                   r.emitters.size(), r.visibility_x, r.visibility_y, kMaxReflectorEmitters);
  }
  ORIEL_TRY_VOID(check_size(where, r.visibility_x, r.visibility_y * static_cast<std::uint32_t>(r.emitters.size()),
                            r.visibility.size(), 1, device));
  for (const std::uint32_t emitter : r.emitters) {
    if (emitter >= pack.emitters.size()) {
      return invalid(where, "found emitter {}, expected less than {}", emitter, pack.emitters.size());
    }
  }
  return {};
}

Status check_emitters(const Pack& pack) {
  for (std::size_t i = 0; i < pack.emitters.size(); ++i) {
    const Emitter& e = pack.emitters[i];
    const std::string where = fmt::format("emitter {}", i);
    const std::size_t corners = e.corners.size();
    if (corners < 3 || corners > 4) return invalid(where, "found an emitter of {} corners, expected 3 or 4", corners);
    if (!std::all_of(e.corners.begin(), e.corners.end(), [](const Vec3& c) { return is_finite(c); }))
      return invalid(where, "found a corner that is not finite");
    if (!is_finite(e.radiance) || !(glm::all(glm::greaterThanEqual(e.radiance, Vec3(0)))))
      return invalid(where, "found radiance {}, {}, {}, expected finite numbers from 0 up", e.radiance.x, e.radiance.y,
                     e.radiance.z);
  }
  return {};
}

Status check_curved_reflectors(const Pack& pack, const gpu::Device& device, ImagePixels pixels) {
  for (std::size_t i = 0; i < pack.curved_reflectors.size(); ++i) {
    const CurvedReflector& r = pack.curved_reflectors[i];
    const std::string where = fmt::format("curved reflector {} '{}'", i, r.name);
    if (r.material >= pack.materials.size() || r.map >= pack.surround_maps.size()) {
      return invalid(where, "found material {} and map {}, expected less than {} and {}", r.material, r.map,
                     pack.materials.size(), pack.surround_maps.size());
    }
    ORIEL_TRY_VOID(check_triangles(where, pack, r.indices));
  }
  for (std::size_t i = 0; i < pack.surround_maps.size(); ++i) {
    const SurroundMap& map = pack.surround_maps[i];
    const std::string where = fmt::format("surround map {}", i);
    // Its levels lie side by side with their borders.
    const std::uint64_t side = map.size + map.size / 2 + 4;
    if (!std::has_single_bit(map.size) || side > static_cast<std::uint64_t>(device.texture_size)) {
      return fail(ErrorCode::kRuntime, where, "found {} texels a side, expected a power of two up to {} ({})", map.size,
                  device.texture_size / 2, device.renderer);
    }
    if (pixels == ImagePixels::kDeferred) continue;
    for (const std::size_t found : {map.radiance.size(), map.inverse_distance.size(), map.valid.size()})
      ORIEL_TRY_VOID(check_size(where, map.size, map.size, found, 1, device));
  }
  return {};
}

Status check_reflectors(const Pack& pack, const gpu::Device& device) {
  for (std::size_t i = 0; i < pack.reflectors.size(); ++i) {
    const Reflector& r = pack.reflectors[i];
    const std::string where = fmt::format("reflector {} '{}'", i, r.name);
    if (r.material >= pack.materials.size()) {
      return invalid(where, "found material {}, expected less than {}", r.material, pack.materials.size());
    }
    ORIEL_TRY_VOID(check_rectangle(where, r.lower, r.upper));
    if (std::uint64_t{r.first_map} + r.map_count > pack.radiance_maps.size()) {
      return invalid(where, "found maps {} + {}, expected within {}", r.first_map, r.map_count,
                     pack.radiance_maps.size());
    }
    for (const ReflectorElement& element : group_by_element(r, pack.radiance_maps)) {
      if (element.maps.size() > static_cast<std::size_t>(device.array_layers)) {
        return fail(ErrorCode::kRuntime, where, "found {} maps of one element, expected at most {} ({})",
                    element.maps.size(), device.array_layers, device.renderer);
      }
    }
    ORIEL_TRY_VOID(check_reflector_emitters(pack, r, where, device));
    ORIEL_TRY_VOID(check_triangles(where, pack, r.indices));
  }
  return {};
}

// Whatever light_at() would read.
Status check_field(const LightField& field) {
  if (field.bands == 0) return {};
  const auto coefficients = static_cast<std::size_t>(3 * field.bands * field.bands);
  const std::size_t texels = std::size_t{field.depth_side} * field.depth_side;
  const std::size_t grid = std::size_t{field.size[0]} * field.size[1] * field.size[2];
  if (grid == 0 || field.cells.size() < grid || texels == 0 || field.lights.size() > kMaxBrightLights)
    return invalid("light field", "found {} cells of a grid of {}, {} depths, {} lights", field.cells.size(), grid,
                   texels, field.lights.size());
  for (std::size_t i = 0; i < field.cells.size(); ++i) {
    const FieldCell& cell = field.cells[i];
    const bool probes =
        std::all_of(cell.probes.begin(), cell.probes.end(), [&](std::uint32_t p) { return p < field.probes.size(); });
    // Parts follow their cell, so that none holds itself.
    if (!probes ||
        (cell.children != 0 && (cell.children <= i || std::uint64_t{cell.children} + 8 > field.cells.size())))
      return invalid(fmt::format("light field: cell {}", i), "found parts from {}, expected later cells and {} probes",
                     cell.children, field.probes.size());
  }
  for (std::size_t i = 0; i < field.probes.size(); ++i)
    if (field.probes[i].sh.size() != coefficients || field.probes[i].depth.size() != texels)
      return invalid(fmt::format("light field: probe {}", i), "found {} coefficients and {} depths, expected {} and {}",
                     field.probes[i].sh.size(), field.probes[i].depth.size(), coefficients, texels);
  return {};
}

Status check_movers(const Pack& pack, const gpu::Device& device) {
  for (std::size_t i = 0; i < pack.movers.size(); ++i) {
    const Mover& mover = pack.movers[i];
    const CompressedTransfer& t = mover.transfer;
    const std::string where = fmt::format("mover {} '{}'", i, mover.name);
    ORIEL_TRY_VOID(check_mesh(pack, mover.mesh, where));
    const std::size_t vertices = mover.mesh.positions.size();
    if (t.components < 0 || t.clusters < 1 || t.vertices() != vertices ||
        t.weight.size() != vertices * static_cast<std::size_t>(t.components))
      return invalid(where, "found transfer of {} vertices in {} clusters of {} components, expected {} vertices",
                     t.vertices(), t.clusters, t.components, vertices);
    // Four weights a texel, 2048 texels a row; a row of light a cluster.
    const auto limit = static_cast<std::size_t>(device.texture_size);
    if (vertices * static_cast<std::size_t>(t.components + 3) / 4 > 2048 * limit)
      return fail(ErrorCode::kRuntime, where, "found {} vertices, expected fewer ({})", vertices, device.renderer);
    if (t.basis.size() !=
            static_cast<std::size_t>(t.clusters) * static_cast<std::size_t>(t.components + 1) * t.stride() ||
        t.weight_scale.size() != static_cast<std::size_t>(t.clusters) * static_cast<std::size_t>(t.components))
      return invalid(where, "found a basis of {} numbers and {} scales for {} clusters of {} components",
                     t.basis.size(), t.weight_scale.size(), t.clusters, t.components);
    if (t.bands > pack.light_field.bands && pack.light_field.bands > 0)
      return invalid(where, "found transfer of {} bands, expected at most the light field's {}", t.bands,
                     pack.light_field.bands);
    for (const std::uint8_t cluster : t.cluster)
      if (cluster >= t.clusters) return invalid(where, "found cluster {}, expected less than {}", cluster, t.clusters);
  }
  return {};
}

}  // namespace

Status check_drawable(const Pack& pack, const gpu::Device& device, ImagePixels pixels) {
  ORIEL_TRY_VOID(check_mesh(pack, pack.mesh, "mesh"));
  ORIEL_TRY_VOID(check_materials(pack));
  ORIEL_TRY_VOID(check_kernels(pack, device));
  ORIEL_TRY_VOID(check_fresnel_maps(pack, device));
  ORIEL_TRY_VOID(check_images(pack, device, pixels));
  ORIEL_TRY_VOID(check_curved_reflectors(pack, device, pixels));
  ORIEL_TRY_VOID(check_emitters(pack));
  ORIEL_TRY_VOID(check_reflectors(pack, device));
  ORIEL_TRY_VOID(check_field(pack.light_field));
  return check_movers(pack, device);
}

}  // namespace oriel
