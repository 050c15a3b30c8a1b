#include "bake/run/stages/baked_light.h"

#include <algorithm>

#include "bake/trace/albedo.h"

namespace oriel {

namespace {

// One of a page's arrays at a point, bilinear.
Vec3 sample_page(const LightmapPage& page, const std::vector<Vec3>& texels, const Atlas& atlas, std::uint32_t triangle,
                 const Vec2& barycentric) {
  const auto& corners = atlas.uv[triangle];
  const Vec2 uv = corners[0] + barycentric.x * (corners[1] - corners[0]) + barycentric.y * (corners[2] - corners[0]);
  const float x = std::clamp(uv.x * static_cast<float>(page.width) - 0.5f, 0.0f, static_cast<float>(page.width - 1));
  const float y = std::clamp(uv.y * static_cast<float>(page.height) - 0.5f, 0.0f, static_cast<float>(page.height - 1));
  const auto x0 = static_cast<std::uint32_t>(x), y0 = static_cast<std::uint32_t>(y);
  const std::uint32_t x1 = std::min(x0 + 1, page.width - 1), y1 = std::min(y0 + 1, page.height - 1);
  const auto texel = [&](std::uint32_t i, std::uint32_t j) { return texels[std::size_t{j} * page.width + i]; };
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  return glm::mix(glm::mix(texel(x0, y0), texel(x1, y0), fx), glm::mix(texel(x0, y1), texel(x1, y1), fx), fy);
}

}  // namespace

Vec3 baked_irradiance(const Atlas& atlas, std::span<const LightmapPage> pages, std::uint32_t triangle,
                      const Vec2& barycentric, const Vec3& tilted, const Vec3& normal) {
  const std::int32_t index = atlas.page[triangle];
  if (index < 0) return Vec3(0);
  const LightmapPage& page = pages[static_cast<std::size_t>(index)];
  const Vec3 e = sample_page(page, page.irradiance, atlas, triangle, barycentric);
  if (page.direction.empty() || tilted == normal) return e;
  return e * directional_ratio(sample_page(page, page.direction, atlas, triangle, barycentric), tilted, normal);
}

Vec3 baked_radiance(const Scene& scene, const Atlas& atlas, std::span<const LightmapPage> pages,
                    const SeenSurface& seen) {
  const Hit& hit = seen.hit;
  const Vec3& towards_eye = seen.towards_eye;
  const SurfacePoint surface = surface_at(scene, hit, -towards_eye);
  const SceneMaterial& material = scene.materials[scene.surfaces[scene.triangle_surface[hit.triangle]].material];
  if (material.unlit) return surface.shade.base_color;
  Vec3 light = surface.emits && seen.emission ? surface.shade.emission : Vec3(0);
  if (!hit.front) return light;  // lit backs have triangles of their own
  const Vec3 r = reflectance(surface.shade, glm::dot(surface.normal, towards_eye));
  const Vec3 share = surface.shade.diffuse * (1 - max_component(r)) + (seen.mirror ? Vec3(0) : r);
  const Vec3 normal = geometry_at(scene, hit, -towards_eye).normal;
  const Vec3 e = baked_irradiance(atlas, pages, hit.triangle, hit.barycentric, surface.normal, normal);
  return light + share / kPi * e;
}

}  // namespace oriel
