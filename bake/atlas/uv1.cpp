#include "bake/atlas/uv1.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bake/atlas/polygon.h"

namespace oriel {
namespace {

constexpr float kSlack = 1e-6f;
constexpr double kThinTexels = 1e-3;  // what rounding of float coordinates may do between neighbours
constexpr double kOverlapTexels2 = 1e-4;
constexpr double kNegligibleShare = 1e-6;  // of a surface's area may lie in triangles without area on the page
constexpr double kLineRatio = 1e-9;        // twice the area over the longest side squared: a line

std::string name_of(const Surface& surface) {
  if (surface.mesh_name.empty()) return fmt::format("'{}'", surface.name);
  return fmt::format("'{}' (mesh '{}')", surface.name, surface.mesh_name);
}

Status check_range(const Scene& scene, const Surface& surface) {
  for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vec2& uv = scene.uv1[scene.triangles[t][k]];
      const bool inside = uv.x >= -kSlack && uv.x <= 1 + kSlack && uv.y >= -kSlack && uv.y <= 1 + kSlack;
      if (!inside)
        return invalid(name_of(surface),
                       "TEXCOORD_1 ({}, {}) found at triangle {}; expected lightmap coordinates in [0, 1]", uv.x, uv.y,
                       t - surface.first_triangle);
    }
  }
  return {};
}

bool has_area(const Triangle2& t) {
  const double longest = std::max(
      {glm::dot(t[1] - t[0], t[1] - t[0]), glm::dot(t[2] - t[1], t[2] - t[1]), glm::dot(t[0] - t[2], t[0] - t[2])});
  return 2 * std::abs(signed_area(t)) > kLineRatio * longest;
}

Triangle2 in_texels(const Atlas& atlas, std::uint32_t triangle) {
  const DVec2 size(atlas.pages[0].width, atlas.pages[0].height);
  const auto& uv = atlas.uv[triangle];
  return {DVec2(uv[0]) * size, DVec2(uv[1]) * size, DVec2(uv[2]) * size};
}

Status check_area(const Scene& scene, const Surface& surface, const Atlas& atlas, Context& context) {
  double total = 0, lost = 0;
  std::uint32_t count = 0;
  for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t) {
    const double world = triangle_area(scene, t);
    total += world;
    if (has_area(in_texels(atlas, t))) continue;
    lost += world;
    ++count;
  }
  if (count == 0) return {};
  if (lost > kNegligibleShare * total)
    return invalid(name_of(surface),
                   "{} of {} triangles ({:.3g} m²) have no area in TEXCOORD_1; expected a place of its own for each",
                   count, surface.triangle_count, lost);
  context.warning("missing-texcoords",
                  fmt::format("{}: {} slivers ({:.3g} m²) have no area in TEXCOORD_1; they show the nearest texel",
                              name_of(surface), count, lost));
  return {};
}

Status check_overlap(const Scene& scene, const std::vector<std::uint32_t>& surfaces, const Atlas& atlas) {
  std::vector<Triangle2> points;
  std::vector<std::uint32_t> owner;
  for (const std::uint32_t s : surfaces) {
    const Surface& surface = scene.surfaces[s];
    for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t) {
      points.push_back(in_texels(atlas, t));
      owner.push_back(s);
    }
  }
  const double side = std::max(atlas.pages[0].width, atlas.pages[0].height);
  // Coordinates near 1 are rounded to 2^-24.
  const auto found = find_overlap(points, {kOverlapTexels2, std::max(kThinTexels, side * 0x1p-22)});
  if (!found) return {};
  const Surface &a = scene.surfaces[owner[found->a]], &b = scene.surfaces[owner[found->b]];
  const DVec2 uv = found->where / DVec2(atlas.pages[0].width, atlas.pages[0].height);
  const std::string place =
      fmt::format("at uv ({:.5f}, {:.5f}), {:.3g} texels² of one pair of triangles", uv.x, uv.y, found->area);
  constexpr const char* kExpected = "expected every triangle to own its texels";
  if (&a == &b) return invalid(name_of(a), "TEXCOORD_1 overlaps itself {}; {}", place, kExpected);
  std::string hint;
  if (!a.mesh_name.empty() && a.mesh_name == b.mesh_name)
    hint = "; a mesh placed twice needs a copy with coordinates of its own for each place";
  return invalid(name_of(a), "TEXCOORD_1 overlaps that of {} {}; {}{}", name_of(b), place, kExpected, hint);
}

// Gives each part of the surface that hangs together in position and coordinates a chart id.
void number_charts(const Scene& scene, const Surface& surface, Atlas& atlas) {
  std::vector<std::uint32_t> order(surface.vertex_count), parent(surface.vertex_count);
  std::iota(order.begin(), order.end(), 0u);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto key = [&](std::uint32_t v) {
    const Vec3& p = scene.positions[surface.first_vertex + v];
    const Vec2& uv = scene.uv1[surface.first_vertex + v];
    return std::array<float, 5>{p.x, p.y, p.z, uv.x, uv.y};
  };
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    parent[std::max(a, b)] = std::min(a, b);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1])) join(order[i], order[i - 1]);
  for (std::uint32_t t = 0; t < surface.triangle_count; ++t) {
    const UVec3 v = scene.triangles[surface.first_triangle + t] - UVec3(surface.first_vertex);
    join(v.x, v.y), join(v.x, v.z);
  }
  std::vector<std::uint32_t> id(surface.vertex_count, ~0u);
  for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t) {
    std::uint32_t& chart = id[root(scene.triangles[t].x - surface.first_vertex)];
    if (chart == ~0u) chart = atlas.chart_count++;
    atlas.chart[t] = chart;
  }
}

}  // namespace

Status place_uv1(const Scene& scene, const std::vector<std::uint32_t>& surfaces, Context& context, Atlas& atlas) {
  for (const std::uint32_t s : surfaces) {
    const Surface& surface = scene.surfaces[s];
    ORIEL_TRY_VOID(check_range(scene, surface));
    for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t) {
      atlas.page[t] = 0;
      for (int k = 0; k < 3; ++k)
        atlas.uv[t][static_cast<std::size_t>(k)] = glm::clamp(scene.uv1[scene.triangles[t][k]], Vec2(0), Vec2(1));
    }
    ORIEL_TRY_VOID(check_area(scene, surface, atlas, context));
    number_charts(scene, surface, atlas);
    if (context.stopped()) return fail(ErrorCode::kStopped, "atlas", "stopped");
  }
  return check_overlap(scene, surfaces, atlas);
}

}  // namespace oriel
