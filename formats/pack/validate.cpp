#include "formats/pack/validate.h"

#include "formats/core/json.h"
#include "formats/pack/issues.h"

namespace oriel {

static std::string text_of(const CameraKey& key) {
  return fmt::format("time {}, eye {}, forward {}", key.time_s, text_of(key.eye), text_of(key.forward));
}

namespace {

// Inside the half-open range of a table, or -1.
bool optional_index(std::int32_t index, std::size_t size) {
  return index == -1 || (index >= 0 && static_cast<std::size_t>(index) < size);
}

void validate_parts(const Pack& pack, const Mesh& mesh, IssueList& list) {
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const MeshPart& part = mesh.parts[i];
    if (part.first_index % 3 != 0 || part.index_count % 3 != 0)
      list.error(107, "part {} ('{}'): found first index {} and {} indices, expected multiples of 3", i, part.name,
                 part.first_index, part.index_count);
    if (std::uint64_t{part.first_index} + part.index_count > mesh.indices.size())
      list.error(108, "part {} ('{}'): found indices {} to {}, expected at most {}", i, part.name, part.first_index,
                 std::uint64_t{part.first_index} + part.index_count, mesh.indices.size());
    if (part.material >= pack.materials.size())
      list.error(109, "part {} ('{}'): found material {}, expected less than {}", i, part.name, part.material,
                 pack.materials.size());
    if (!optional_index(part.lightmap_page, pack.lightmaps.size()))
      list.error(110, "part {} ('{}'): found lightmap page {}, expected -1 or less than {}", i, part.name,
                 part.lightmap_page, pack.lightmaps.size());
  }
}

void validate_camera(std::size_t i, const Camera& camera, IssueList& list) {
  if (!is_finite(camera.eye) || !is_finite(camera.forward) || !is_finite(camera.up))
    list.error(701, "camera {} ('{}'): found eye {}, forward {}, up {}, expected finite numbers", i, camera.name,
               text_of(camera.eye), text_of(camera.forward), text_of(camera.up));
  const DVec3 forward(camera.forward), up(camera.up);
  if (!(glm::length(glm::cross(forward, up)) > 1e-6 * glm::length(forward) * glm::length(up)))
    list.error(702, "camera {} ('{}'): forward {} and up {} span no plane", i, camera.name, text_of(camera.forward),
               text_of(camera.up));
  const bool perspective = camera.vertical_fov_rad > 0 && camera.vertical_fov_rad < kPi;
  const bool orthographic = camera.vertical_fov_rad == 0 && camera.half_height > 0 && std::isfinite(camera.half_height);
  if (!perspective && !orthographic)
    list.error(703,
               "camera {} ('{}'): found a field of view of {} rad and half height {} m, expected 0 < fov < pi, or 0 "
               "and a height above 0",
               i, camera.name, camera.vertical_fov_rad, camera.half_height);
}

void validate_path(std::size_t i, const CameraPath& path, IssueList& list) {
  if (!(path.vertical_fov_rad > 0 && path.vertical_fov_rad < kPi))
    list.error(711, "path {} ('{}'): found a field of view of {} rad, expected 0 < fov < pi", i, path.name,
               path.vertical_fov_rad);
  list.each(
      712, "path keys", path.keys,
      [](const CameraKey& key) {
        return std::isfinite(key.time_s) && is_finite(key.eye) && is_finite(key.forward) && length2(key.forward) > 0;
      },
      "finite numbers and a direction");
  for (std::size_t k = 1; k < path.keys.size(); ++k)
    if (!(path.keys[k].time_s >= path.keys[k - 1].time_s)) {
      list.error(713, "path {} ('{}'): found time {} s of key {} after {} s, expected rising times", i, path.name,
                 path.keys[k].time_s, k, path.keys[k - 1].time_s);
      break;
    }
}

void validate_json(int number, std::uint32_t kind, const std::string& text, IssueList& list) {
  list.in_section(kind);
  if (text.empty()) return;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || text[first] != '{' || !Json::parse(text))
    list.error(number, "is not a JSON object");
}

}  // namespace

void validate_mesh(const Pack& pack, IssueList& list) {
  list.in_section(kMeshSection);
  validate_mesh(pack, pack.mesh, list);
}

void validate_mesh(const Pack& pack, const Mesh& mesh, IssueList& list) {
  const std::size_t n = mesh.positions.size();
  const bool mapped = !mesh.normal_uvs.empty() || !mesh.tangents.empty();
  if (mesh.normals.size() != n || mesh.uvs.size() != n || mesh.lightmap_uvs.size() != n ||
      (!mesh.colors.empty() && mesh.colors.size() != n) ||
      (mapped && (mesh.normal_uvs.size() != n || mesh.tangents.size() != n)))
    list.error(101,
               "found {} positions, {} normals, {} texture and {} lightmap coordinates, {} colours, {} coordinates "
               "and {} tangents of normal maps, expected as many of each (or no colours, or nothing for normal maps)",
               n, mesh.normals.size(), mesh.uvs.size(), mesh.lightmap_uvs.size(), mesh.colors.size(),
               mesh.normal_uvs.size(), mesh.tangents.size());
  if (n > 0xffffffffu || mesh.indices.size() > 0xffffffffu)
    list.error(102, "found {} vertices and {} indices, expected less than 2^32", n, mesh.indices.size());
  if (!std::isfinite(mesh.origin.x) || !std::isfinite(mesh.origin.y) || !std::isfinite(mesh.origin.z))
    list.error(103, "found origin ({}, {}, {}), expected finite numbers", mesh.origin.x, mesh.origin.y, mesh.origin.z);
  list.each(
      103, "positions", mesh.positions, [](const Vec3& v) { return is_finite(v); }, "finite numbers");
  list.each(
      104, "normals", mesh.normals, [](const Vec3& v) { return std::abs(glm::length(DVec3(v)) - 1) <= 1e-3; },
      "length 1");
  list.each(
      105, "texture coordinates", mesh.uvs, [](const Vec2& v) { return is_finite(v); }, "finite numbers");
  list.each(
      105, "coordinates of normal maps", mesh.normal_uvs, [](const Vec2& v) { return is_finite(v); }, "finite numbers");
  list.each(
      105, "lightmap coordinates", mesh.lightmap_uvs,
      [](const Vec2& v) { return within(v.x, 0, 1) && within(v.y, 0, 1); }, "0 to 1");
  list.each(
      112, "tangents", mesh.tangents,
      [](const Vec4& t) { return t.w == 0 || (std::abs(t.w) == 1 && std::abs(glm::length(DVec3(t)) - 1) <= 1e-3); },
      "length 1 and a side of -1, 0 or 1");
  list.each(
      106, "indices", mesh.indices, [n](std::uint32_t i) { return i < n; }, fmt::format("less than {}", n).c_str());
  validate_parts(pack, mesh, list);
  if (mesh.indices.empty()) list.warning(111, "has no triangles");
}

void validate_materials(const Pack& pack, IssueList& list) {
  list.in_section(kMaterialSection);
  for (std::size_t i = 0; i < pack.materials.size(); ++i) {
    const Material& m = pack.materials[i];
    const auto in_unit = [&](const char* what, float value) {
      if (!within(value, 0, 1))
        list.error(201, "material {} ('{}'): found {} {}, expected 0 to 1", i, m.name, what, value);
    };
    for (int c = 0; c < 3; ++c) {
      in_unit("base colour", m.base_color[c]);
      in_unit("f0", m.f0[c]);
    }
    in_unit("alpha", m.alpha);
    in_unit("metallic", m.metallic);
    in_unit("roughness", m.roughness);
    in_unit("transmission", m.transmission);
    if (!not_negative(m.alpha_cutoff) || !not_negative(m.ior) || !not_negative(m.emission))
      list.error(202,
                 "material {} ('{}'): found alpha cutoff {}, index of refraction {}, emission {}, expected finite "
                 "numbers from 0 up",
                 i, m.name, m.alpha_cutoff, m.ior, text_of(m.emission));
    if (!optional_index(m.base_color_texture, pack.textures.size()))
      list.error(203, "material {} ('{}'): found texture {}, expected -1 or less than {}", i, m.name,
                 m.base_color_texture, pack.textures.size());
    if (!optional_index(m.kernel, pack.kernels.size()))
      list.error(204, "material {} ('{}'): found kernel {}, expected -1 or less than {}", i, m.name, m.kernel,
                 pack.kernels.size());
    if (!optional_index(m.fresnel_map, pack.fresnel_maps.size()))
      list.error(205, "material {} ('{}'): found Fresnel map {}, expected -1 or less than {}", i, m.name, m.fresnel_map,
                 pack.fresnel_maps.size());
    if (!optional_index(m.normal_texture, pack.normal_textures.size()) || !within(m.normal_scale, -1e6f, 1e6f))
      list.error(206,
                 "material {} ('{}'): found normal texture {} of scale {}, expected -1 or less than {}, and a "
                 "scale within 1e6",
                 i, m.name, m.normal_texture, m.normal_scale, pack.normal_textures.size());
    if (m.normal_texture >= 0 && pack.mesh.normal_uvs.empty() && !pack.mesh.positions.empty())
      list.error(207, "material {} ('{}') has a normal texture, but the mesh no coordinates for it", i, m.name);
  }
}

void validate_solids(const Pack& pack, IssueList& list) {
  list.in_section(kSolidSection);
  for (std::size_t i = 0; i < pack.solids.size(); ++i) {
    const SolidGlass& solid = pack.solids[i];
    if (solid.material >= pack.materials.size())
      list.error(208, "solid {}: found material {}, expected less than {}", i, solid.material, pack.materials.size());
    if (i > 0 && solid.material <= pack.solids[i - 1].material)
      list.error(208, "solid {}: found material {} after {}, expected rising ones", i, solid.material,
                 pack.solids[i - 1].material);
    if (!not_negative(solid.tint) || max_component(solid.tint) > 1 || !not_negative(solid.absorption))
      list.error(209, "solid {}: found tint {}, expected 0 to 1, absorption {}, expected finite numbers from 0 up", i,
                 text_of(solid.tint), text_of(solid.absorption));
  }
}

void validate_emission_textures(const Pack& pack, IssueList& list) {
  list.in_section(kEmissionTextureSection);
  for (std::size_t i = 0; i < pack.emission_textures.size(); ++i) {
    const EmissionTexture& e = pack.emission_textures[i];
    if (e.material >= pack.materials.size() || e.texture >= pack.textures.size())
      list.error(212, "emission texture {}: found material {} and texture {}, expected less than {} and {}", i,
                 e.material, e.texture, pack.materials.size(), pack.textures.size());
    if (i > 0 && e.material <= pack.emission_textures[i - 1].material)
      list.error(212, "emission texture {}: found material {} after {}, expected rising ones", i, e.material,
                 pack.emission_textures[i - 1].material);
    if (!not_negative(e.mean) || max_component(e.mean) > 1)
      list.error(213, "emission texture {}: found mean {}, expected 0 to 1", i, text_of(e.mean));
  }
}

void validate_metalness(const Pack& pack, IssueList& list) {
  list.in_section(kMetalnessSection);
  for (std::size_t i = 0; i < pack.metalness.size(); ++i) {
    const Metalness& m = pack.metalness[i];
    if (m.material >= pack.materials.size() || m.texture < -1 ||
        (m.texture >= 0 && static_cast<std::size_t>(m.texture) >= pack.textures.size()))
      list.error(214, "metalness {}: found material {} and texture {}, expected less than {} and {}, or texture -1", i,
                 m.material, m.texture, pack.materials.size(), pack.textures.size());
    if (i > 0 && m.material <= pack.metalness[i - 1].material)
      list.error(214, "metalness {}: found material {} after {}, expected rising ones", i, m.material,
                 pack.metalness[i - 1].material);
    if (!not_negative(m.dielectric) || max_component(m.dielectric) > 1)
      list.error(215, "metalness {}: found reflectance {}, expected 0 to 1", i, text_of(m.dielectric));
  }
}

void validate_cameras(const Pack& pack, IssueList& list) {
  list.in_section(kCameraSection);
  for (std::size_t i = 0; i < pack.cameras.size(); ++i) validate_camera(i, pack.cameras[i], list);
  list.in_section(kPathSection);
  for (std::size_t i = 0; i < pack.paths.size(); ++i) validate_path(i, pack.paths[i], list);
}

void validate_texts(const Pack& pack, IssueList& list) {
  validate_json(801, kProvenanceSection, pack.provenance, list);
  if (pack.provenance.empty()) list.warning(802, "is missing: nothing says what made this pack");
  validate_json(803, kPlanSection, pack.plan, list);
  list.in_section(kSceneSection);
  if (!not_negative(pack.sky))
    list.error(804, "found sky radiance {}, expected finite numbers from 0 up", text_of(pack.sky));
  list.in_section(kSkyMapSection);
  const SkyMap& sky = pack.sky_map;
  if (sky.width > SkyMap::kMostWidth || sky.height > SkyMap::kMostHeight ||
      sky.texels.size() != std::size_t{sky.width} * sky.height)
    list.error(805, "found {} x {} and {} texels, expected as many, and at most {} x {}", sky.width, sky.height,
               sky.texels.size(), SkyMap::kMostWidth, SkyMap::kMostHeight);
  list.each(
      806, "texels", sky.texels, [](const Vec3& texel) { return not_negative(texel); }, "finite numbers from 0 up");
}

void validate_unknown(const Pack& pack, IssueList& list) {
  for (const auto& unknown : pack.unknown) {
    list.in_section(unknown.kind);
    if (find_section_kind(unknown.kind)) list.error(901, "is of a known kind, expected an unknown one");
    const bool plain = unknown.codec == static_cast<std::uint32_t>(Codec::kNone);
    if ((plain && unknown.raw_bytes != unknown.stored.size()) ||
        unknown.raw_bytes / kMaxExpansion > unknown.stored.size())
      list.error(902, "found {} raw bytes for {} stored with codec {}", unknown.raw_bytes, unknown.stored.size(),
                 unknown.codec);
  }
}

std::vector<Issue> validate(const Pack& pack, ImagePixels pixels) {
  IssueList list;
  validate_texts(pack, list);
  validate_mesh(pack, list);
  validate_materials(pack, list);
  validate_solids(pack, list);
  validate_emission_textures(pack, list);
  validate_metalness(pack, list);
  validate_textures(pack, pixels, list);
  validate_lightmaps(pack, pixels, list);
  validate_sharp_light(pack, list);
  validate_reflectors(pack, list);
  validate_radiance_maps(pack, pixels, list);
  validate_elements(pack, list);
  validate_map_meshes(pack, list);
  validate_emitters(pack, list);
  validate_curved_reflectors(pack, list);
  validate_surround_maps(pack, pixels, list);
  validate_kernels(pack, list);
  validate_kernel_fits(pack, list);
  validate_fresnel_maps(pack, list);
  validate_cameras(pack, list);
  validate_walk_grids(pack, list);
  validate_visible_sets(pack, list);
  validate_reflected_sets(pack, list);
  validate_movers(pack, list);
  validate_light_field(pack, list);
  validate_light_groups(pack, list);
  validate_unknown(pack, list);
  return std::move(list.issues);
}

}  // namespace oriel
