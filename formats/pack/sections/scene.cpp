// Geometry, materials and their normal maps, reflectors, cameras.
#include "formats/pack/encoding/planes.h"
#include "formats/pack/encoding/quantise.h"
#include "formats/pack/fields.h"
#include "formats/pack/sections.h"

namespace oriel {

void encode(ByteWriter& out, const Mesh& mesh) {
  for (int i = 0; i < 3; ++i) out.put(mesh.origin[i]);
  out.put(static_cast<std::uint32_t>(mesh.positions.size()));
  out.put(static_cast<std::uint32_t>(mesh.indices.size()));
  out.put(static_cast<std::uint32_t>(mesh.parts.size()));
  out.put(static_cast<std::uint32_t>(mesh.colors.empty() ? 0 : 1));
  put_planes(out, std::span<const Vec3>(mesh.positions));
  std::vector<std::uint32_t> normals(mesh.normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = octahedral_from_normal(mesh.normals[i]);
  put_planes(out, std::span<const std::uint32_t>(normals));
  put_planes(out, std::span<const Vec2>(mesh.uvs));
  put_planes(out, std::span<const Vec2>(mesh.lightmap_uvs));
  if (!mesh.colors.empty()) put_planes(out, std::span<const std::uint32_t>(mesh.colors));
  // Each index as its difference from the one before: vertices come mostly in the order of their triangles.
  std::vector<std::uint32_t> steps(mesh.indices.size());
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i] = mesh.indices[i] - before;
    before = mesh.indices[i];
  }
  put_planes(out, std::span<const std::uint32_t>(steps));
  for (const auto& part : mesh.parts) {
    out.put_string(part.name);
    out.put(part.first_index);
    out.put(part.index_count);
    out.put(part.material);
    out.put(part.lightmap_page);
  }
}

Status decode(ByteReader& in, Mesh& mesh) {
  for (int i = 0; i < 3; ++i) mesh.origin[i] = in.get<double>();
  const auto vertices = in.get<std::uint32_t>();
  const auto indices = in.get<std::uint32_t>();
  const auto parts = in.get<std::uint32_t>();
  const auto has_colors = in.get<std::uint32_t>();
  if (has_colors > 1) return invalid("", "found mesh flags {:#x}, expected 0 or 1", has_colors);
  mesh.positions = get_planes<Vec3>(in, vertices);
  const auto normals = get_planes<std::uint32_t>(in, vertices);
  mesh.normals.resize(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) mesh.normals[i] = normal_from_octahedral(normals[i]);
  mesh.uvs = get_planes<Vec2>(in, vertices);
  mesh.lightmap_uvs = get_planes<Vec2>(in, vertices);
  if (has_colors) mesh.colors = get_planes<std::uint32_t>(in, vertices);
  mesh.indices = get_planes<std::uint32_t>(in, indices);
  std::uint32_t before = 0;
  for (auto& index : mesh.indices) {
    index += before;
    before = index;
  }
  for (std::uint32_t i = 0; i < parts && in.ok(); ++i) {
    MeshPart part;
    part.name = in.get_string();
    part.first_index = in.get<std::uint32_t>();
    part.index_count = in.get<std::uint32_t>();
    part.material = in.get<std::uint32_t>();
    part.lightmap_page = in.get<std::int32_t>();
    mesh.parts.push_back(std::move(part));
  }
  return {};
}

void encode(ByteWriter& out, const Material& material) {
  out.put_string(material.name);
  put(out, material.base_color);
  out.put(material.alpha);
  out.put(material.base_color_texture);
  out.put(static_cast<std::uint8_t>(material.alpha_mode));
  out.put(static_cast<std::uint8_t>(material.double_sided));
  out.put(static_cast<std::uint8_t>(material.unlit));
  out.put(std::uint8_t{0});
  out.put(material.alpha_cutoff);
  out.put(material.metallic);
  out.put(material.roughness);
  out.put(material.ior);
  put(out, material.f0);
  out.put(material.transmission);
  put(out, material.emission);
  out.put(material.kernel);
  out.put(material.fresnel_map);
}

Status decode(ByteReader& in, Material& material) {
  material.name = in.get_string();
  material.base_color = get_vec3(in);
  material.alpha = in.get<float>();
  material.base_color_texture = in.get<std::int32_t>();
  ORIEL_TRY_VOID(get_choice(in, "alpha mode", 2, material.alpha_mode));
  ORIEL_TRY_VOID(get_choice(in, "double-sided flag", 1, material.double_sided));
  ORIEL_TRY_VOID(get_choice(in, "unlit flag", 1, material.unlit));
  std::uint8_t reserved = 0;
  ORIEL_TRY_VOID(get_choice(in, "reserved byte", 0, reserved));
  material.alpha_cutoff = in.get<float>();
  material.metallic = in.get<float>();
  material.roughness = in.get<float>();
  material.ior = in.get<float>();
  material.f0 = get_vec3(in);
  material.transmission = in.get<float>();
  material.emission = get_vec3(in);
  material.kernel = in.get<std::int32_t>();
  material.fresnel_map = in.get<std::int32_t>();
  return {};
}

void encode(ByteWriter& out, const NormalMapping& mapping) {
  out.put(static_cast<std::uint32_t>(mapping.uses.size()));
  out.put(static_cast<std::uint32_t>(mapping.uvs.size()));
  for (const NormalMapping::Use& use : mapping.uses) {
    out.put(use.material);
    out.put(use.normal_texture);
    out.put(use.normal_scale);
  }
  put_planes(out, std::span<const Vec2>(mapping.uvs));
  std::vector<std::uint32_t> tangents(mapping.tangents.size());
  std::vector<std::int8_t> sides(mapping.tangents.size());
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    const Vec4& t = mapping.tangents[i];
    sides[i] = static_cast<std::int8_t>(t.w);
    tangents[i] = sides[i] == 0 ? 0 : octahedral_from_normal(Vec3(t));
  }
  put_planes(out, std::span<const std::uint32_t>(tangents));
  put_planes(out, std::span<const std::int8_t>(sides));
}

Status decode(ByteReader& in, NormalMapping& mapping) {
  const auto uses = in.get<std::uint32_t>();
  const auto vertices = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < uses && in.ok(); ++i) {
    NormalMapping::Use use;
    use.material = in.get<std::uint32_t>();
    use.normal_texture = in.get<std::int32_t>();
    use.normal_scale = in.get<float>();
    mapping.uses.push_back(use);
  }
  mapping.uvs = get_planes<Vec2>(in, vertices);
  const auto tangents = get_planes<std::uint32_t>(in, vertices);
  const auto sides = get_planes<std::int8_t>(in, vertices);
  mapping.tangents.resize(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] < -1 || sides[i] > 1)
      return invalid("", "found side {} of vertex {}'s tangent, expected -1, 0 or 1", static_cast<int>(sides[i]), i);
    mapping.tangents[i] = sides[i] == 0 ? Vec4(0) : Vec4(normal_from_octahedral(tangents[i]), sides[i]);
  }
  return {};
}

void encode(ByteWriter& out, const Reflector& reflector) {
  out.put_string(reflector.name);
  out.put(reflector.material);
  put(out, reflector.pack_from_reflector);
  put(out, reflector.lower);
  put(out, reflector.upper);
  out.put(reflector.area_m2);
  out.put(reflector.flatness_m);
  out.put(reflector.elements_x);
  out.put(reflector.elements_y);
  out.put(reflector.first_map);
  out.put(reflector.map_count);
  out.put(static_cast<std::uint32_t>(reflector.indices.size()));
  out.put_array(std::span<const std::uint32_t>(reflector.indices));
}

Status decode(ByteReader& in, Reflector& reflector) {
  reflector.name = in.get_string();
  reflector.material = in.get<std::uint32_t>();
  reflector.pack_from_reflector = get_mat4(in);
  reflector.lower = get_vec2(in);
  reflector.upper = get_vec2(in);
  reflector.area_m2 = in.get<float>();
  reflector.flatness_m = in.get<float>();
  reflector.elements_x = in.get<std::uint32_t>();
  reflector.elements_y = in.get<std::uint32_t>();
  reflector.first_map = in.get<std::uint32_t>();
  reflector.map_count = in.get<std::uint32_t>();
  const auto count = in.get<std::uint32_t>();
  reflector.indices = in.get_array<std::uint32_t>(count);
  return {};
}

void encode(ByteWriter& out, const Camera& camera) {
  out.put_string(camera.name);
  put(out, camera.eye);
  put(out, camera.forward);
  put(out, camera.up);
  out.put(camera.vertical_fov_rad);
  out.put(camera.half_height);
}

Status decode(ByteReader& in, Camera& camera) {
  camera.name = in.get_string();
  camera.eye = get_vec3(in);
  camera.forward = get_vec3(in);
  camera.up = get_vec3(in);
  camera.vertical_fov_rad = in.get<float>();
  camera.half_height = in.get<float>();
  return {};
}

void encode(ByteWriter& out, const CameraPath& path) {
  out.put_string(path.name);
  out.put(path.vertical_fov_rad);
  out.put(static_cast<std::uint32_t>(path.keys.size()));
  for (const auto& key : path.keys) {
    out.put(key.time_s);
    put(out, key.eye);
    put(out, key.forward);
  }
}

Status decode(ByteReader& in, CameraPath& path) {
  path.name = in.get_string();
  path.vertical_fov_rad = in.get<float>();
  const auto count = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    CameraKey key;
    key.time_s = in.get<float>();
    key.eye = get_vec3(in);
    key.forward = get_vec3(in);
    path.keys.push_back(key);
  }
  return {};
}

}  // namespace oriel
