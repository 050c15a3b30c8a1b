#include "player/movers/shade_scene.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>

#include "formats/core/color.h"
#include "formats/core/parallel.h"

namespace oriel {
namespace {

constexpr float kOnLamp = 1e-3f;    // over the lamp's size: a surface that is so near to it is the lamp's
constexpr float kHidden = 1.01f;    // times as far as what hides it
constexpr float kSheet = 1e-4f;     // of the distance: thinner things are one surface
constexpr float kRoom = 2;          // times a mover's radius: it moves on
constexpr float kMostBrighter = 4;  // than it was, of a light whose lamps are changed
constexpr std::uint32_t kMostCells = 512;
constexpr float kCellsOfScene = 48;  // smallest cells are so much smaller than the scene
constexpr float kSmallestCell_m = 0.25f;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool lies_on(const Vec3& p, const BrightLight& light) {
  for (std::size_t i = 0; i + 2 < light.corners.size(); i += 3) {
    const Vec3 &a = light.corners[i], &b = light.corners[i + 1], &c = light.corners[i + 2];
    const Vec3 n = glm::cross(b - a, c - a);
    const float area2 = glm::length(n);
    if (!(area2 > 0) || std::abs(glm::dot(p - a, n)) > kOnLamp * area2 * std::sqrt(area2)) continue;
    const float slack = -kOnLamp * area2 * area2;
    if (glm::dot(glm::cross(b - a, p - a), n) >= slack && glm::dot(glm::cross(c - b, p - b), n) >= slack &&
        glm::dot(glm::cross(a - c, p - c), n) >= slack)
      return true;
  }
  return false;
}

// By part: what shines as one of the bright lights has shadows of its own.
std::vector<std::uint8_t> bright_parts(const Pack& pack, std::span<const Vec3> emission) {
  const Mesh& mesh = pack.mesh;
  std::vector<std::uint8_t> out(mesh.parts.size(), 0);
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    const MeshPart& part = mesh.parts[p];
    if (luminance(emission[part.material]) <= 0 || part.index_count < 3) continue;
    const std::uint32_t* corner = &mesh.indices[part.first_index];
    const Vec3 middle = (mesh.positions[corner[0]] + mesh.positions[corner[1]] + mesh.positions[corner[2]]) / 3.0f;
    out[p] = std::ranges::any_of(pack.light_field.lights, [&](const BrightLight& l) { return lies_on(middle, l); });
  }
  return out;
}

std::vector<ShadeTriangle> lit_triangles(const Pack& pack, Bounds& bounds) {
  const Mesh& mesh = pack.mesh;
  std::vector<ShadeTriangle> out;
  for (const MeshPart& part : mesh.parts) {
    const Material& material = pack.materials[part.material];
    if (part.lightmap_page < 0 || material.alpha_mode == AlphaMode::kBlend || material.transmission > 0) continue;
    for (std::uint32_t i = part.first_index; i + 2 < part.first_index + part.index_count; i += 3) {
      ShadeTriangle& triangle = out.emplace_back();
      triangle.two_sided = material.double_sided;
      for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t vertex = mesh.indices[i + c];
        triangle.corners[c] = mesh.positions[vertex], triangle.normals[c] = mesh.normals[vertex];
        bounds.extend(mesh.positions[vertex]);
      }
    }
  }
  return out;
}

// Half way between the first thing along a ray and the second: so far from both, a map's texels may be wide (Woo 1992,
// "The Shadow Depth Map Revisited"). Infinite where there are not two.
float middle_of_first(const LampScene& scene, const Vec3& from, const Vec3& ray) {
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  const auto first = scene.first_surface(from, ray);
  if (!first) return kEndless;
  const float beyond = first->distance * (1 + kSheet) + scene.offset_m() / glm::length(ray);
  const auto second = scene.first_surface(from + beyond * ray, ray);
  return second ? 0.5f * (first->distance + beyond + second->distance) : kEndless;
}

void look_from(ShadeScene& scene, std::uint32_t light) {
  const HemisphereMap& map = scene.maps[light];
  const Vec3 from = map.from + scene.around->offset_m() * scene.lights[light].light.normal;
  for (int t = 0; t < kStillSide * kStillSide; ++t) {
    const Vec2 at(static_cast<float>(t % kStillSide) + 0.5f, static_cast<float>(t / kStillSide) + 0.5f);
    const Vec3 ray = hemisphere_ray(map, at * (2.0f / kStillSide) - 1.0f);
    scene.still[(std::size_t{light} * kStillSide * kStillSide) + static_cast<std::size_t>(t)] =
        hemisphere_depth(map, middle_of_first(*scene.around, from, ray));
  }
}

}  // namespace

bool ShadeScene::hides(std::uint32_t light, const Bounds& box) const {
  const auto part = part_of_box(maps[light], box);
  if (!part || box.empty()) return false;
  const float depth = hemisphere_depth(maps[light], part->height / kHidden);
  const auto texel = [](float at, float beside) {
    return std::clamp(static_cast<int>(std::floor((0.5f + 0.5f * at) * kStillSide + beside)), 0, kStillSide - 1);
  };
  const float* map = &still[std::size_t{light} * kStillSide * kStillSide];
  for (int y = texel(part->lower.y, -2); y <= texel(part->upper.y, 2); ++y)
    for (int x = texel(part->lower.x, -2); x <= texel(part->upper.x, 2); ++x)
      if (!(map[y * kStillSide + x] < depth)) return false;
  return true;
}

std::vector<ShadeLight> ShadeScene::shade_lights() const {
  std::vector<ShadeLight> out;
  for (const ScatteredLight& l : lights) out.push_back({l.light.position, l.light.normal});
  return out;
}

Result<std::vector<Vec3>> ShadeScene::shine(const ImageSource& images, std::span<const Material> materials,
                                            const Vec3& sky) const {
  const bool as_baked = images.lights() == 0;
  std::map<std::uint32_t, LightmapPage> pages;
  std::vector<Vec3> out;
  float all = 0;
  for (const ScatteredLight& l : lights) {
    Vec3 before = l.before, now = l.before;
    if (l.source == ScatterSource::kSky) {
      before = sky_then, now = sky;
    } else if (l.source == ScatterSource::kEmission) {
      before = emission_then[l.index], now = materials[l.index].emission;
    } else if (!as_baked) {
      std::uint64_t of = 0;
      if (!pages.contains(l.index)) {
        ORIEL_TRY(pages[l.index], images.lit_page(l.index, of));
      }
      now = pages[l.index].irradiance[l.texel];
    }
    Vec3 factor(1);
    for (int c = 0; c < 3; ++c)
      if (before[c] != now[c]) factor[c] = before[c] > 0 ? now[c] / before[c] : 0.0f;
    out.push_back(factor * l.light.intensity);
    all += luminance(l.light.intensity);
  }
  // Each was one of many alike. What was dark and is lit now would be most of the light.
  for (std::size_t l = 0; l < out.size() && !as_baked; ++l) {
    const float most =
        kMostBrighter * std::max(luminance(lights[l].light.intensity), all / static_cast<float>(out.size()));
    if (const float own = luminance(out[l]); own > most) out[l] *= most / own;
  }
  return out;
}

std::vector<CellLights> lights_in_view(const ShadeScene& scene, const BlockedLights& blocked, const Frustum& frustum) {
  std::vector<CellLights> out;
  for (std::uint32_t c = 0; c < scene.cells.size(); ++c) {
    const ShadeCell& cell = scene.cells[c];
    if (cell.child != 0 || cell.content.empty() || !may_be_visible(frustum, cell.content)) continue;
    if (std::vector<std::uint32_t> lights = blocked.lights_of(c); !lights.empty())
      out.push_back({c, std::move(lights)});
  }
  return out;
}

bool holds(std::span<const Vec4> places, std::span<const Vec4> spheres) {
  if (places.size() != spheres.size()) return false;
  for (std::size_t m = 0; m < places.size(); ++m)
    if (glm::length(Vec3(spheres[m] - places[m])) + spheres[m].w > places[m].w) return false;
  return true;
}

Result<ShadeMaker> ShadeMaker::begin(const Pack& pack, const ImageSource& images, const BakedLamps& baked) {
  const auto start = std::chrono::steady_clock::now();
  ShadeMaker maker;
  ShadeScene& scene = maker.scene_;
  scene.around = std::make_shared<LampScene>(LiveSurfaces{pack.mesh, pack.materials, pack.textures, pack.fresnel_maps},
                                             LiveLamp{});
  std::vector<LightmapPage> pages;
  std::vector<std::vector<PagePoint>> points;
  for (std::uint32_t p = 0; p < pack.lightmaps.size(); ++p) {
    ORIEL_TRY(LightmapPage page, images.whole_page(p));
    points.push_back(page_points(pack.mesh, {}, p, page));
    page.standard_error = {}, page.direction = {};
    pages.push_back(std::move(page));
  }
  scene.emission_then.assign(baked.emission().begin(), baked.emission().end());
  scene.sky_then = baked.sky();
  const std::vector<std::uint8_t> left_out = bright_parts(pack, scene.emission_then);
  scene.sources =
      std::make_shared<ScatterSources>(ScatteredScene{*scene.around, pages, points, scene.emission_then, left_out});
  maker.triangles_ = lit_triangles(pack, scene.bounds);
  scene.seconds = seconds_since(start);
  return maker;
}

ShadeMaker ShadeMaker::again(const ShadeScene& scene) {
  ShadeMaker maker;
  maker.scene_ = scene;
  maker.scene_.seconds = 0;
  return maker;
}

ShadeScene ShadeMaker::finish(std::span<const Vec4> movers, std::uint32_t lights, const std::atomic<bool>* stop) {
  const auto start = std::chrono::steady_clock::now();
  ShadeScene& scene = scene_;
  Bounds around;
  scene.places.clear();
  for (const Vec4& m : movers) {
    scene.places.emplace_back(Vec3(m), kRoom * m.w);
    around.extend(Vec3(m) - kRoom * m.w), around.extend(Vec3(m) + kRoom * m.w);
  }
  scene.lights = scene.sources->draw(*scene.around, scene.sky_then, scene.places, lights);
  scene.maps.clear();
  for (const ScatteredLight& l : scene.lights)
    scene.maps.push_back(hemisphere_of(l.light, l.source == ScatterSource::kSky ? around : scene.bounds));
  scene.still.assign(scene.lights.size() * kStillSide * kStillSide, 1.0f);
  for_each_parallel(scene.lights.size(), core_count(), [&](std::size_t l) {
    if (stop == nullptr || !*stop) look_from(scene, static_cast<std::uint32_t>(l));
  });
  if (scene.cells.empty())
    scene.cells = make_shade_cells(triangles_,
                                   {std::max(2 * scene.bounds.radius() / kCellsOfScene, kSmallestCell_m), kMostCells});
  scene.seconds += seconds_since(start);
  return std::move(scene);
}

}  // namespace oriel
