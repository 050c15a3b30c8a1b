#include "bake/run/baked_light.h"

#include <algorithm>

#include "bake/brdf/specular.h"
#include "bake/trace/albedo.h"
#include "formats/assets/bilinear.h"
#include "formats/query/sharp_light.h"

namespace oriel {
namespace {

constexpr std::uint32_t kFewerForMirrors = 8;  // whose rays only scatter where they arrive
constexpr float kLeastShare = 0.01f;           // of the light: a lobe that adds less is as good as wide
constexpr int kMostLobes = 8;                  // one after the other: in a closed pipe of metal paths never end

Vec2 uv_at(const Atlas& atlas, std::uint32_t triangle, const Vec2& barycentric) {
  const auto& corners = atlas.uv[triangle];
  return corners[0] + barycentric.x * (corners[1] - corners[0]) + barycentric.y * (corners[2] - corners[0]);
}

// The direction there, bilinear.
Vec3 direction_at(const LightmapPage& page, const Vec2& uv) {
  const TexelsAround around = texels_around(uv, page.width, page.height);
  Vec3 d(0);
  for (std::size_t k = 0; k < around.texel.size(); ++k) d += around.weight[k] * page.direction[around.texel[k]];
  return d;
}

Vec3 tilted_light(const LightmapPage& page, const Vec2& uv, const Vec3& e, const Vec3& tilted, const Vec3& normal) {
  if (page.direction.empty() || tilted == normal) return e;
  return e * directional_ratio(direction_at(page, uv), tilted, normal);
}

// Emission and diffuse reflection, and where wide_lobe the specular one too, as if its lobe were that wide.
Vec3 shown_light(const BakedScene& baked, const SeenSurface& seen, const SurfacePoint& surface, bool wide_lobe) {
  const Scene& scene = baked.accel.scene();
  if (scene.material_of(seen.hit.triangle).unlit) return baked.unlit_white * surface.shade.base_color;
  const Vec3 light = surface.emits && seen.emission ? surface.shade.emission : Vec3(0);
  if (!seen.hit.front) return light;  // lit backs have triangles of their own
  const Vec3 r = reflectance(surface.shade, glm::dot(surface.normal, seen.towards_eye));
  const Vec3 share = surface.shade.diffuse * (1 - max_component(r)) + (wide_lobe ? r : Vec3(0));
  const Vec3 normal = geometry_at(scene, seen.hit, -seen.towards_eye).normal;
  const Vec3 e = baked.irradiance({surface.triangle, surface.barycentric}, surface.normal, normal);
  return light + share / kPi * e;
}

// What the specular lobes send towards the eye.
Vec3 lobe_light(const BakedScene& baked, const ReflectingPoint& seen, std::uint32_t paths, std::uint64_t seed,
                std::uint64_t& rays) {
  const SurfacePoint& surface = seen.surface;
  const Transport transport{baked.accel, baked.lights, {.max_bounces = kMostLobes}};
  const UVec2 place = glm::floatBitsToUint(surface.barycentric);
  const std::uint64_t stream = mix64(mix64(surface.triangle) ^ (std::uint64_t{place.x} << 32u | place.y));
  Vec3 sum(0);
  const OnDiffuse add = [&](const DiffuseVertex& v) {
    if (!v.front) return 1.0f;
    const Vec3 normal = geometric_normal(baked.accel.scene(), v.triangle);
    sum += v.weight / kPi * baked.irradiance({v.triangle, v.barycentric}, normal, normal);
    return 1.0f;
  };
  for (std::uint32_t i = 0; i < paths; ++i) {
    Sampler sampler(seed, stream, i);
    const PathLight light = specular_light(transport, seen, sampler, rays, add);
    sum += light.scattered + light.lamps;
  }
  return sum / static_cast<float>(paths);
}

// Whether the lobe is to be traced: of glossy reflectors, and of all that are no planar ones but reflect more than
// their diffuse share. Dark frames beside a window, bulbs and rough metals shine where the lamp is ahead, ten times as
// bright as even light would have them.
bool shows_lobe(const BakedScene& baked, const SeenSurface& seen, const SurfacePoint& surface) {
  if (seen.mirror || seen.planar || seen.glossy) return seen.glossy;
  const Scene& scene = baked.accel.scene();
  const SceneMaterial& material = scene.material_of(seen.hit.triangle);
  const float r = max_component(reflectance(surface.shade, glm::dot(surface.normal, seen.towards_eye)));
  return seen.hit.front && !material.unlit && r > max_component(surface.shade.diffuse) * (1 - r);
}

}  // namespace

Vec3 baked_irradiance(const Atlas& atlas, std::span<const LightmapPage> pages, const TexelPoint& at, const Vec3& tilted,
                      const Vec3& normal) {
  const std::int32_t index = atlas.page[at.triangle];
  if (index < 0) return Vec3(0);
  const LightmapPage& page = pages[static_cast<std::size_t>(index)];
  const Vec2 uv = uv_at(atlas, at.triangle, at.barycentric);
  return tilted_light(page, uv, irradiance_at(page, uv), tilted, normal);
}

Vec3 BakedScene::irradiance(const TexelPoint& at, const Vec3& tilted, const Vec3& normal) const {
  const std::int32_t index = atlas.page[at.triangle];
  if (sharp == nullptr || index < 0 || pages[static_cast<std::size_t>(index)].sharp_at.empty())
    return baked_irradiance(atlas, pages, at, tilted, normal);
  const LightmapPage& page = pages[static_cast<std::size_t>(index)];
  const Vec2 uv = uv_at(atlas, at.triangle, at.barycentric);
  return tilted_light(page, uv, smooth_irradiance_at(page, uv), tilted, normal) + sharp_irradiance_at(at, tilted);
}

Vec3 BakedScene::sharp_irradiance_at(const TexelPoint& at, const Vec3& tilted, std::span<const Vec3> factors) const {
  const std::int32_t index = atlas.page[at.triangle];
  if (sharp == nullptr || index < 0 || pages[static_cast<std::size_t>(index)].sharp_at.empty()) return Vec3(0);
  const SharpPlace place{uv_at(atlas, at.triangle, at.barycentric),
                         point_on(accel.scene(), at.triangle, at.barycentric), tilted};
  return sharp_irradiance(*sharp, pages[static_cast<std::size_t>(index)], place, factors);
}

Vec3 baked_radiance(const BakedScene& baked, const SeenSurface& seen) {
  return shown_light(baked, seen, surface_at(baked.accel, seen.hit, -seen.towards_eye, seen.width_m), !seen.mirror);
}

Vec3 baked_radiance_with_lobes(const BakedScene& baked, const SeenSurface& seen, std::uint32_t paths,
                               std::uint64_t seed, std::uint64_t& rays) {
  const SurfacePoint surface = surface_at(baked.accel, seen.hit, -seen.towards_eye, seen.width_m);
  const float share =
      max_component(seen.throughput * reflectance(surface.shade, glm::dot(surface.normal, seen.towards_eye)));
  if (share < kLeastShare || !shows_lobe(baked, seen, surface)) return shown_light(baked, seen, surface, !seen.mirror);
  paths = std::max(1u, static_cast<std::uint32_t>(share * static_cast<float>(paths) / seen.averaged));
  if (surface.shade.alpha < kMirrorAlpha && surface.shade.coat == 0) paths = std::max(1u, paths / kFewerForMirrors);
  return shown_light(baked, seen, surface, false) + lobe_light(baked, {surface, seen.towards_eye}, paths, seed, rays);
}

OutgoingRadiance with_lobes_of(const std::vector<bool>& triangles, const BakedScene& baked, std::uint64_t seed) {
  return [&, seed](const SeenSurface& seen) {
    SeenSurface shown = seen;
    shown.glossy = seen.glossy || (!seen.mirror && triangles[seen.hit.triangle]);
    return baked_radiance_with_lobes(baked, shown, kLobePaths, seed, *seen.rays);
  };
}

}  // namespace oriel
