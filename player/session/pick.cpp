#include "player/session/pick.h"

#include <algorithm>

#include "formats/core/color.h"
#include "formats/query/base_color.h"

namespace oriel {
namespace {

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
  out.albedo = base_color_at(mesh, material, pack.textures, corners, {hit->u, hit->v});
  out.page = part->lightmap_page;
  const LightmapPage* page = out.page >= 0 ? page_of(static_cast<std::uint32_t>(out.page)) : nullptr;
  if (page != nullptr) read_texel(*page, between(mesh.lightmap_uvs), out);
  return out;
}

}  // namespace oriel
