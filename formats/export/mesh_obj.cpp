#include "formats/export/mesh_obj.h"

#include <fmt/format.h>

#include <iterator>

namespace oriel {
namespace {

// Line ends and spaces would break the line.
std::string group_name(const std::string& name) {
  std::string text;
  for (const char c : name) text += static_cast<unsigned char>(c) > 32 ? c : '_';
  return text.empty() ? "unnamed" : text;
}

}  // namespace

std::string obj_text(const Mesh& mesh) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# add ({}, {}, {}) for world coordinates\n", mesh.origin.x, mesh.origin.y, mesh.origin.z);
  for (const Vec3& p : mesh.positions) fmt::format_to(out, "v {} {} {}\n", p.x, p.y, p.z);
  for (const Vec2& uv : mesh.lightmap_uvs) fmt::format_to(out, "vt {} {}\n", uv.x, 1 - uv.y);
  for (const Vec3& n : mesh.normals) fmt::format_to(out, "vn {} {} {}\n", n.x, n.y, n.z);
  for (const auto& part : mesh.parts) {
    fmt::format_to(out, "g {}\nusemtl material_{}_lightmap_{}\n", group_name(part.name), part.material,
                   part.lightmap_page);
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
      text += 'f';
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh.indices[i + k] + 1;
        fmt::format_to(out, " {}/{}/{}", v, v, v);
      }
      text += '\n';
    }
  }
  return text;
}

}  // namespace oriel
