#include "bake/radiosity/lit_sides.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>

#include "bake/jobs/units.h"
#include "bake/trace/view_samples.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr double kLit = 0.01;  // of the other side's mean: above it a side is lit
// Points of a part, one path from each of their sides: enough to find light that one path in a hundred meets. Fewer
// where there are so many parts that all of them together would exceed kAllPoints; never less than kFewPoints.
constexpr std::size_t kRaysAPoint = 10;  // on both sides, about
constexpr std::size_t kPoints = 256, kFewPoints = 8, kFirstPoints = 2, kAllPoints = std::size_t{1} << 17;
constexpr std::size_t kMostPatches = 4096;
constexpr double kFinestCells = 256;  // cells of patches, across the scene
constexpr int kMostBounces = 6;       // light with more bounces is dim compared with the other side's

// The double-sided triangles, part by part.
struct Parts {
  std::vector<std::uint32_t> triangles;
  std::vector<std::size_t> first{0};  // of each part, and the end

  std::size_t count() const { return first.size() - 1; }
  std::span<const std::uint32_t> of(std::size_t part) const {
    return std::span(triangles).subspan(first[part], first[part + 1] - first[part]);
  }
};

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

void add_parts(const Scene& scene, const Surface& surface, Parts& parts) {
  std::vector<std::uint32_t> parent(surface.vertex_count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto corner = [&](std::uint32_t t, int k) { return scene.triangles[t][k] - surface.first_vertex; };
  std::vector<std::uint32_t> own(surface.triangle_count);
  std::iota(own.begin(), own.end(), surface.first_triangle);
  for (const std::uint32_t t : own)
    for (int k = 1; k < 3; ++k) parent[root_of(parent, corner(t, k))] = root_of(parent, corner(t, 0));
  const auto part_of = [&](std::uint32_t t) { return root_of(parent, corner(t, 0)); };
  std::stable_sort(own.begin(), own.end(), [&](std::uint32_t a, std::uint32_t b) { return part_of(a) < part_of(b); });
  for (std::size_t i = 0; i < own.size(); ++i) {
    parts.triangles.push_back(own[i]);
    if (i + 1 == own.size() || part_of(own[i]) != part_of(own[i + 1])) parts.first.push_back(parts.triangles.size());
  }
}

Parts find_parts(const Scene& scene) {
  Parts parts;
  for (const Surface& surface : scene.surfaces) {
    const SceneMaterial& material = scene.materials[surface.material];
    if (material.double_sided && !material.unlit) add_parts(scene, surface, parts);
  }
  return parts;
}

struct PartShape {
  double area = 0;
  DVec3 centre{0}, normal{0};  // sums over the area
};

PartShape shape_of(const Scene& scene, std::span<const std::uint32_t> part) {
  PartShape shape;
  for (const std::uint32_t t : part) {
    const UVec3& corner = scene.triangles[t];
    const double area = triangle_area(scene, t);
    shape.area += area;
    shape.centre +=
        area / 3 * DVec3(scene.positions[corner[0]] + scene.positions[corner[1]] + scene.positions[corner[2]]);
    shape.normal += area * DVec3(geometric_normal(scene, t));
  }
  return shape;
}

// One of six: the axis that it faces along most.
std::uint32_t facing(const DVec3& n) {
  const DVec3 a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return static_cast<std::uint32_t>(2 * axis + (n[axis] < 0 ? 1 : 0));
}

// Leaves, fibres and triangles that share no vertices are parts by the hundred thousand. Beyond kMostPatches parts the
// largest are looked at by themselves, and the others in patches: those of one surface that face alike within one cell
// of a grid, which is as fine as their number allows. What is lit on both sides somewhere in a patch has texels on both
// sides everywhere in it, which costs texels and no light.
Parts in_patches(const Scene& scene, Parts parts) {
  if (parts.count() <= kMostPatches) return parts;
  std::vector<PartShape> shapes(parts.count());
  for (std::size_t i = 0; i < shapes.size(); ++i) shapes[i] = shape_of(scene, parts.of(i));
  std::vector<std::uint32_t> order(parts.count());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return shapes[a].area > shapes[b].area; });
  constexpr std::size_t kAlone = kMostPatches / 2;
  using Key = std::array<std::int64_t, 5>;
  std::map<Key, std::vector<std::uint32_t>> patches;
  const double extent = std::max(1e-6, double{glm::length(scene.upper - scene.lower)});
  for (double cell = extent / kFinestCells; patches.empty() || patches.size() > kMostPatches - kAlone; cell *= 1.5) {
    patches.clear();
    for (std::size_t k = kAlone; k < order.size(); ++k) {
      const PartShape& shape = shapes[order[k]];
      const DVec3 at = glm::floor(shape.centre / std::max(shape.area, 1e-30) / cell);
      const std::uint32_t surface = scene.triangle_surface[parts.of(order[k]).front()];
      const auto key = [&](double v) { return static_cast<std::int64_t>(std::clamp(v, -1e9, 1e9)); };
      patches[{surface, facing(shape.normal), key(at.x), key(at.y), key(at.z)}].push_back(order[k]);
    }
    if (cell > extent) break;  // one patch for each surface and facing
  }
  Parts out;
  const auto add = [&](std::uint32_t part) {
    const auto triangles = parts.of(part);
    out.triangles.insert(out.triangles.end(), triangles.begin(), triangles.end());
  };
  for (std::size_t k = 0; k < kAlone; ++k) {
    add(order[k]);
    out.first.push_back(out.triangles.size());
  }
  for (const auto& [key, members] : patches) {
    for (const std::uint32_t part : members) add(part);
    out.first.push_back(out.triangles.size());
  }
  return out;
}

// The light on one side of a part, and its visibility to views.
struct SideLight {
  double sum = 0, max = 0;
  bool seen = false;

  void add(double light) {
    sum += light;
    max = std::max(max, light);
  }
  bool is_lit_against(const SideLight& other, std::size_t points) const {
    return max > kLit * other.sum / static_cast<double>(points);
  }
};

// Parameters of lit_sides().
struct SideProbe {
  const Transport& transport;
  const ViewSamples& views;
  std::size_t points = 0;  // of each part
  std::uint64_t seed = 0;
};

LitSides lit_sides(const SideProbe& probe, std::span<const std::uint32_t> part, std::uint64_t& rays) {
  const auto& [t, views, points, seed] = probe;
  const Scene& scene = t.accel.scene();
  std::vector<double> area_until;
  double total = 0;
  for (const std::uint32_t triangle : part) area_until.push_back(total += triangle_area(scene, triangle));
  SideLight front, back;
  for (std::size_t k = 0; k < points; ++k) {
    Sampler sampler(mix64(seed), part.front(), static_cast<std::uint32_t>(k));
    const double area = sampler.next1() * total;
    const auto at = std::lower_bound(area_until.begin(), area_until.end(), area) - area_until.begin();
    const std::uint32_t triangle = part[std::min<std::size_t>(at, part.size() - 1)];
    const Vec2 barycentric = square_to_triangle(sampler.next2());
    for (SideLight* side : {&front, &back}) {
      const SurfacePoint point = point_on_side(t.accel, triangle, barycentric, side == &front);
      Sampler own = sampler;
      const IrradianceSample e = sample_irradiance(t, point, own, rays);
      side->add(luminance(e.direct + e.indirect));
      if (side->seen || !views.any()) continue;
      ViewSamples::Nearest nearest;
      const Vec3& normal = point.geometric_normal;
      side->seen = views.in_sight(spawn_origin(point, normal), normal, nearest, rays);
    }
    // Stops early: a side that is lit by the points so far stays lit.
    if (k + 1 >= kFirstPoints && std::has_single_bit(k + 1) && front.is_lit_against(back, k + 1) &&
        back.is_lit_against(front, k + 1))
      return LitSides::kBoth;
  }
  if (!back.seen && !back.is_lit_against(front, points)) return LitSides::kFront;
  return front.seen || front.is_lit_against(back, points) ? LitSides::kBoth : LitSides::kBack;
}

}  // namespace

Result<FoundSides> find_lit_sides(const Transport& transport, std::span<const Vec3> eyes, Context& context) {
  const ViewSamples views(transport, eyes);
  const Hash128 where = context.units ? hash_of(std::vector<Vec3>(eyes.begin(), eyes.end())) : Hash128();
  const Parts parts = in_patches(transport.accel.scene(), find_parts(transport.accel.scene()));
  const std::size_t points = std::clamp(kAllPoints / std::max<std::size_t>(1, parts.count()), kFewPoints, kPoints);
  Transport short_paths = transport;
  short_paths.options.max_bounces = std::min(transport.options.max_bounces, kMostBounces);
  std::vector<LitSides> of_part(parts.count(), LitSides::kBoth);
  std::atomic<std::uint64_t> rays{0};
  UnitLoop loop{.stage = "sides", .count = parts.count(), .rays = static_cast<double>(points * kRaysAPoint)};
  loop.inputs = [&](std::size_t i, Archive& key) { key(i, where); };
  loop.compute = [&](std::size_t i) {
    std::uint64_t traced = 0;
    of_part[i] = lit_sides({short_paths, views, points, context.seed}, parts.of(i), traced);
    return traced;
  };
  loop.results = [&](std::size_t i, Archive& archive) { archive(of_part[i]); };
  if (const Status evaluated = parallel_units({context, &rays}, loop); !evaluated && context.stop)
    return tl::unexpected(evaluated.error());
  FoundSides found;
  found.sides.assign(transport.accel.scene().triangles.size(), LitSides::kFront);
  for (std::size_t i = 0; i < parts.count(); ++i) {
    found.report.turned += of_part[i] == LitSides::kBack;
    found.report.doubled += of_part[i] == LitSides::kBoth;
    for (const std::uint32_t t : parts.of(i)) found.sides[t] = of_part[i];
  }
  found.report.rays = rays;
  return found;
}

}  // namespace oriel
