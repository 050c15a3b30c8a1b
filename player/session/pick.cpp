#include "player/session/pick.h"

#include <algorithm>
#include <cmath>

#include "formats/core/color.h"

namespace oriel {
namespace {

Vec3 albedo_at(const Pack& pack, const Material& material, const Vec2& uv, const Vec3& vertex_color) {
  Vec3 albedo = material.base_color * vertex_color;
  if (material.base_color_texture >= 0) {
    const Texture& texture = pack.textures[static_cast<std::size_t>(material.base_color_texture)];
    if (texture.texels.empty()) return albedo;
    const auto texel = [](float coordinate, std::uint32_t size, Wrap wrap) {
      const float inside = wrap == Wrap::kClamp ? std::clamp(coordinate, 0.0f, 1.0f) : glm::fract(coordinate);
      const auto i = static_cast<std::uint32_t>(inside * static_cast<float>(size));
      const bool odd = wrap == Wrap::kMirror && std::fmod(std::fabs(std::floor(coordinate)), 2.0f) == 1.0f;
      return odd ? size - 1 - std::min(i, size - 1) : std::min(i, size - 1);
    };
    const std::uint8_t* rgb =
        &texture.texels[4 * (static_cast<std::size_t>(texel(uv.y, texture.height, texture.wrap_t)) * texture.width +
                             texel(uv.x, texture.width, texture.wrap_s))];
    albedo *= Vec3(linear_from_srgb8(rgb[0]), linear_from_srgb8(rgb[1]), linear_from_srgb8(rgb[2]));
  }
  return albedo;
}

void read_texel(const LightmapPage& page, const Vec2& uv, PickedSurface& out) {
  out.known = true;
  const IVec2 size(page.width, page.height);
  out.texel = glm::clamp(IVec2(glm::floor(uv * Vec2(size))), IVec2(0), size - 1);
  const auto i = static_cast<std::size_t>(out.texel.y) * page.width + static_cast<std::size_t>(out.texel.x);
  out.state = page.state[i];
  out.lux = luminance(page.irradiance[i]);
  out.lux_error = luminance(page.standard_error[i]);  // of the same rays: channels' errors add up
}

}  // namespace

std::optional<PickedSurface> pick_surface(const Pack& pack, const PickRay& ray, const PageOf& page_of) {
  const Mesh& mesh = pack.mesh;
  const std::optional<TriangleHit> hit = first_triangle(mesh, ray.from, ray.direction);
  if (!hit) return std::nullopt;
  const auto holds = [&](const MeshPart& p) {
    return hit->first_index >= p.first_index && hit->first_index < p.first_index + p.index_count;
  };
  const auto part = std::find_if(mesh.parts.begin(), mesh.parts.end(), holds);
  if (part == mesh.parts.end()) return std::nullopt;
  const std::uint32_t* corners = &mesh.indices[hit->first_index];
  const auto between = [&](const auto& values) {
    return values[corners[0]] * (1 - hit->u - hit->v) + values[corners[1]] * hit->u + values[corners[2]] * hit->v;
  };
  const Material& material = pack.materials[part->material];
  PickedSurface out;
  out.part = part->name;
  out.material = material.name;
  out.at = ray.from + hit->distance * ray.direction;
  out.distance_m = hit->distance;
  out.roughness = material.roughness;
  out.metallic = material.metallic;
  Vec3 vertex_color(1);
  if (!mesh.colors.empty()) {
    const std::uint32_t rgba = mesh.colors[corners[0]];
    vertex_color = Vec3(rgba & 255, rgba >> 8 & 255, rgba >> 16 & 255) / 255.0f;
  }
  out.albedo = albedo_at(pack, material, between(mesh.uvs), vertex_color);
  out.page = part->lightmap_page;
  const LightmapPage* page = out.page >= 0 ? page_of(static_cast<std::uint32_t>(out.page)) : nullptr;
  if (page != nullptr) read_texel(*page, between(mesh.lightmap_uvs), out);
  return out;
}

}  // namespace oriel
