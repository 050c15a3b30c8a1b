#include "bake/trace/planar_mirrors.h"

#include <algorithm>
#include <map>

#include "bake/trace/albedo.h"
#include "bake/trace/glass.h"
#include "formats/core/convex_hull.h"

namespace oriel {
namespace {

constexpr float kMirrorRoughness = 0.01f;  // squared: kMirrorAlpha
constexpr double kFlat = 1e-6;             // 1 - the cosine between normals that are taken for one
constexpr double kPlaneCells = 1e-5;       // of normals and, times the scene's size, offsets that are taken for one
constexpr double kSheetCells = 1e-7;       // likewise of frosted panes' offsets
constexpr double kEdge = 1e-6;             // of barycentric coordinates, outwards: no gap between two triangles
constexpr int kMostCells = 64;             // along a side

bool may_mirror(const SceneMaterial& m) {
  if (m.unlit || m.normal_texture.image >= 0) return false;
  const bool coat = m.coat > 0 && m.coat_roughness < kMirrorRoughness;
  const bool black = m.metal == Metal::kNone && m.metallic <= 0 && (m.specular <= 0 || m.ior == 1);
  return coat || (m.roughness < kMirrorRoughness && !black);
}

bool is_frosted_glass(const SceneMaterial& m) {
  return may_be_frosted(m) && m.normal_texture.image < 0 && m.metallic_roughness_texture.image < 0 &&
         m.gloss_texture.image < 0;
}

std::vector<char> materials_that(const Scene& scene, bool (*is)(const SceneMaterial&)) {
  std::vector<char> out(scene.materials.size());
  for (std::size_t m = 0; m < out.size(); ++m) out[m] = is(scene.materials[m]);
  return out;
}

bool is_flat(const Scene& scene, std::uint32_t triangle, const Vec3& normal) {
  for (int k = 0; k < 3; ++k)
    if (glm::dot(scene.normals[scene.triangles[triangle][k]], normal) < 1 - kFlat) return false;
  return true;
}

struct Axes {
  DVec3 u, v;
};
Axes axes_of(const DVec3& normal) {
  const DVec3 other = std::abs(normal.x) < 0.6 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
  const DVec3 u = glm::normalize(glm::cross(other, normal));
  return {u, glm::cross(normal, u)};
}

// Area, hull and shade of the triangles that are in it.
void complete(const Scene& scene, PlanarMirror& mirror) {
  const Axes axes = axes_of(mirror.normal);
  std::vector<DVec2> corners;
  double largest = 0;
  for (const std::uint32_t t : mirror.triangles) {
    const double area = triangle_area(scene, t);
    mirror.area_m2 += area;
    if (area > largest) mirror.shade = shade_point(scene, t, Vec2(1.0f / 3)), largest = area;
    for (int k = 0; k < 3; ++k) {
      const DVec3 p(scene.positions[scene.triangles[t][k]]);
      corners.push_back({glm::dot(p, axes.u), glm::dot(p, axes.v)});
    }
  }
  for (const DVec2& c : convex_hull(std::move(corners)))
    mirror.hull.push_back(c.x * axes.u + c.y * axes.v + mirror.offset * mirror.normal);
}

using PlaneKey = std::array<std::int64_t, 4>;

}  // namespace

Vec3 mirror_reflectance(const ShadePoint& point, float cos_theta) {
  const float coat = coat_reflectance(point, cos_theta);
  Vec3 f(0);
  if (point.alpha < kMirrorAlpha && (point.f90 > 0 || max_component(point.f0) > 0))
    f += (1 - coat) * specular_fresnel(specular_lobe(point), cos_theta);
  if (point.coat > 0 && point.coat_alpha < kMirrorAlpha)
    f += point.coat * specular_fresnel(specular_layers(point).coat_lobe(), cos_theta);
  return point.coverage * f;
}

double mirror_margin(const Scene& scene, std::uint32_t triangle, const Vec3& from, double cosine) {
  float magnitude = max_component(glm::abs(from));
  for (int k = 0; k < 3; ++k)
    magnitude = std::max(magnitude, max_component(glm::abs(scene.positions[scene.triangles[triangle][k]])));
  return double{magnitude} * 64 * 0x1p-24 / std::max(cosine, 1e-4);
}

PlanarMirrors::PlanarMirrors(const Scene& scene) {
  collect(scene, materials_that(scene, may_mirror), false);
}

PlanarMirrors PlanarMirrors::frosted_panes(const Scene& scene) {
  PlanarMirrors panes;
  panes.collect(scene, materials_that(scene, is_frosted_glass), true);
  return panes;
}

std::vector<char> PlanarMirrors::triangles_of(const Scene& scene) const {
  std::vector<char> out(empty() ? 0 : scene.triangles.size());
  for (const PlanarMirror& mirror : mirrors_)
    for (const std::uint32_t t : mirror.triangles) {
      out[t] = 1;
      if (!scene.twin.empty() && scene.twin[t] != ~0u) out[scene.twin[t]] = 1;
    }
  return out;
}

void PlanarMirrors::collect(const Scene& scene, const std::vector<char>& of_material, bool both_sides) {
  if (std::ranges::find(of_material, 1) == of_material.end()) return;
  const double size = std::max(1e-30, double{scene.radius()});
  std::map<PlaneKey, PlanarMirror> planes;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const Surface& surface = scene.surfaces[scene.triangle_surface[t]];
    if (!of_material[surface.material] || surface.mover >= 0) continue;
    if (both_sides && !scene.twin.empty() && scene.twin[t] < t) continue;  // the other has both
    const Vec3 front = geometric_normal(scene, t);
    if (!is_flat(scene, t, front)) continue;
    for (const double side : {1.0, -1.0}) {
      if (side < 0 && !both_sides && !scene.materials[surface.material].double_sided) continue;
      const DVec3 normal = side * DVec3(front);
      const double offset = glm::dot(normal, DVec3(scene.positions[scene.triangles[t].x]));
      PlaneKey key;
      for (int k = 0; k < 3; ++k) key[k] = std::llround(normal[k] / kPlaneCells);
      // The sheets of a frosted pane are two planes: one would stand in the way of the other.
      key[3] = std::llround(offset / ((both_sides ? kSheetCells : kPlaneCells) * size));
      PlanarMirror& plane = planes[key];
      if (plane.triangles.empty()) plane.normal = glm::normalize(normal), plane.offset = offset;
      plane.triangles.push_back(t);
    }
  }
  for (auto& [key, plane] : planes) {
    complete(scene, plane);
    mirrors_.push_back(std::move(plane));
  }
  // Of panes both sides of a surface stay together, so that no cut parts them.
  std::stable_sort(mirrors_.begin(), mirrors_.end(), [&](const PlanarMirror& a, const PlanarMirror& b) {
    if (a.area_m2 != b.area_m2) return a.area_m2 > b.area_m2;
    return both_sides && a.triangles.front() < b.triangles.front();
  });
  mirrors_.resize(std::min(mirrors_.size(), kMost));
  for (const PlanarMirror& mirror : mirrors_) grids_.push_back(grid_of(scene, mirror));
}

PlanarMirrors::Grid PlanarMirrors::grid_of(const Scene& scene, const PlanarMirror& mirror) {
  Grid grid;
  const Axes axes = axes_of(mirror.normal);
  grid.u = axes.u, grid.v = axes.v;
  const auto flat = [&](const DVec3& p) { return DVec2(glm::dot(p, axes.u), glm::dot(p, axes.v)); };
  DVec2 upper(-1e300);
  grid.lower = DVec2(1e300);
  for (const DVec3& p : mirror.hull) grid.lower = glm::min(grid.lower, flat(p)), upper = glm::max(upper, flat(p));
  const int cells = std::clamp(static_cast<int>(std::sqrt(double(mirror.triangles.size()))), 1, kMostCells);
  grid.columns = grid.rows = cells;
  grid.per_cell = double(cells) / glm::max(upper - grid.lower, DVec2(1e-30));
  std::vector<std::vector<std::uint32_t>> held(static_cast<std::size_t>(cells) * cells);
  for (const std::uint32_t t : mirror.triangles) {
    DVec2 low(1e300), high(-1e300);
    for (int k = 0; k < 3; ++k) {
      const DVec2 at = (flat(DVec3(scene.positions[scene.triangles[t][k]])) - grid.lower) * grid.per_cell;
      low = glm::min(low, at), high = glm::max(high, at);
    }
    const auto cell = [&](double x) { return std::clamp(static_cast<int>(std::floor(x)), 0, cells - 1); };
    for (int y = cell(low.y - kEdge); y <= cell(high.y + kEdge); ++y)
      for (int x = cell(low.x - kEdge); x <= cell(high.x + kEdge); ++x)
        held[static_cast<std::size_t>(y) * cells + x].push_back(t);
  }
  for (const auto& triangles : held) {
    grid.first.push_back(static_cast<std::uint32_t>(grid.triangle.size()));
    grid.triangle.insert(grid.triangle.end(), triangles.begin(), triangles.end());
  }
  grid.first.push_back(static_cast<std::uint32_t>(grid.triangle.size()));
  return grid;
}

std::optional<PlanarMirrors::On> PlanarMirrors::on(const Scene& scene, std::size_t mirror, const DVec3& p) const {
  const Grid& grid = grids_[mirror];
  const DVec2 at = (DVec2(glm::dot(p, grid.u), glm::dot(p, grid.v)) - grid.lower) * grid.per_cell;
  if (!(at.x > -kEdge && at.y > -kEdge && at.x < grid.columns + kEdge && at.y < grid.rows + kEdge)) return std::nullopt;
  const int x = std::clamp(static_cast<int>(at.x), 0, grid.columns - 1);
  const int y = std::clamp(static_cast<int>(at.y), 0, grid.rows - 1);
  const std::size_t cell = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.columns) + x;
  for (std::uint32_t i = grid.first[cell]; i < grid.first[cell + 1]; ++i) {
    const UVec3& t = scene.triangles[grid.triangle[i]];
    const DVec3 a(scene.positions[t.x]), ab = DVec3(scene.positions[t.y]) - a, ac = DVec3(scene.positions[t.z]) - a;
    const DVec3 n = glm::cross(ab, ac), ap = p - a;
    const double size = glm::dot(n, n);
    const double b = glm::dot(glm::cross(ap, ac), n) / size, c = glm::dot(glm::cross(ab, ap), n) / size;
    if (b >= -kEdge && c >= -kEdge && b + c <= 1 + kEdge)
      return On{grid.triangle[i], Vec2(glm::clamp(DVec2(b, c), 0.0, 1.0))};
  }
  return std::nullopt;
}

}  // namespace oriel
