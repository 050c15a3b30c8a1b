#include "bake/radiosity/lit_sides.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "bake/jobs/parallel.h"
#include "bake/jobs/units.h"
#include "bake/scene/shade.h"
#include "bake/trace/shading.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr double kLit = 0.01;  // of the other side's mean: above it a side is lit
// Points of a part, one path from each of their sides: enough to find light that one path in a hundred meets. Fewer
// where all parts together would exceed kAllPoints; kMeanPoints, that tell its mean, where a side is lit or seen.
constexpr std::size_t kPoints = 256, kMeanPoints = 8, kAllPoints = std::size_t{1} << 16;
constexpr std::size_t kRaysAPoint = 10, kSightLines = 1024;  // on both sides, about; of an eye
constexpr std::size_t kMostPatches = 4096;
constexpr double kFinestCells = 256;  // cells of patches, across the scene
constexpr int kMostBounces = 3;       // light with more bounces is dim compared with the other side's

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

// The light on one side of a part, and whether an eye sees it.
struct SideLight {
  double sum = 0, max = 0;
  std::size_t points = 0;
  bool seen = false;

  void add(double light) {
    sum += light;
    max = std::max(max, light);
    ++points;
  }
  bool counts_against(const SideLight& other) const {
    return seen || max > kLit * other.sum / static_cast<double>(other.points);
  }
};

// By triangle, whether an eye sees its front and its back, by way of panes and cut-outs too.
using SeenSides = std::vector<std::array<std::atomic<bool>, 2>>;

// What time leaves undone is told by the light alone.
void find_seen(const Accel& accel, std::span<const Vec3> eyes, const Stage& stage, SeenSides& seen) {
  (void)parallel_for(stage, "", eyes.size(), [&](std::size_t e) {
    for (std::uint32_t k = 0; k < kSightLines; ++k) {
      Ray ray{eyes[e], square_to_sphere(Sampler(mix64(stage.context.seed), e, k).next2())};
      for (int passes = 0; passes < kMaxPasses; ++passes) {
        const Hit hit = accel.intersect(ray);
        if (!hit) break;
        seen[hit.triangle][hit.front ? 0 : 1] = true;
        if (!may_transmit(accel.scene().material_of(hit.triangle))) break;
        ray.origin = spawn_origin(accel.scene(), hit.triangle, hit.barycentric, ray.direction);
      }
    }
    stage.count(kSightLines);
  });
}

// Parameters of lit_sides().
struct SideProbe {
  const Transport& transport;
  const SeenSides& seen;
  std::size_t points = 0;  // of each part
  std::uint64_t seed = 0;
};

LitSides lit_sides(const SideProbe& probe, std::span<const std::uint32_t> part, std::uint64_t& rays) {
  const auto& [t, seen, points, seed] = probe;
  const Scene& scene = t.accel.scene();
  std::vector<double> area_until;
  double total = 0;
  SideLight front, back;
  for (const std::uint32_t triangle : part) {
    area_until.push_back(total += triangle_area(scene, triangle));
    front.seen |= seen[triangle][0], back.seen |= seen[triangle][1];
  }
  for (std::size_t k = 0; k < points; ++k) {
    Sampler sampler(mix64(seed), part.front(), static_cast<std::uint32_t>(k));
    const double area = sampler.next1() * total;
    const auto at = std::lower_bound(area_until.begin(), area_until.end(), area) - area_until.begin();
    const std::uint32_t triangle = part[std::min<std::size_t>(at, part.size() - 1)];
    const Vec2 barycentric = square_to_triangle(sampler.next2());
    for (SideLight* side : {&front, &back}) {
      if (k >= kMeanPoints && side->counts_against(side == &front ? back : front)) continue;
      const SurfacePoint point = point_on_side(t.accel, triangle, barycentric, side == &front);
      Sampler own = sampler;
      const IrradianceSample e = sample_irradiance(t, point, own, rays);
      side->add(luminance(e.direct + e.indirect));
    }
    if (front.counts_against(back) && back.counts_against(front)) return LitSides::kBoth;
  }
  if (!back.counts_against(front)) return LitSides::kFront;
  return front.counts_against(back) ? LitSides::kBoth : LitSides::kBack;
}

}  // namespace

Result<FoundSides> find_lit_sides(const Transport& transport, std::span<const Vec3> eyes, Context& context) {
  const Hash128 where = context.units ? hash_of(std::vector<Vec3>(eyes.begin(), eyes.end())) : Hash128();
  const Parts parts = in_patches(transport.accel.scene(), find_parts(transport.accel.scene()));
  const std::size_t points = std::clamp(kAllPoints / std::max<std::size_t>(1, parts.count()), kMeanPoints, kPoints);
  Transport short_paths = transport;
  short_paths.options.max_bounces = std::min(transport.options.max_bounces, kMostBounces);
  std::vector<LitSides> of_part(parts.count(), LitSides::kBoth);
  std::atomic<std::uint64_t> rays{0};
  const Stage stage{context, &rays};
  SeenSides seen(transport.accel.scene().triangles.size());
  if (parts.count() > 0) find_seen(transport.accel, eyes, stage, seen);
  UnitLoop loop{.stage = "sides", .count = parts.count(), .rays = static_cast<double>(points * kRaysAPoint)};
  loop.inputs = [&](std::size_t i, Archive& key) { key(i, where); };
  loop.compute = [&](std::size_t i) {
    std::uint64_t traced = 0;
    of_part[i] = lit_sides({short_paths, seen, points, context.seed}, parts.of(i), traced);
    return traced;
  };
  loop.results = [&](std::size_t i, Archive& archive) { archive(of_part[i]); };
  if (const Status evaluated = parallel_units(stage, loop); !evaluated && context.stop)
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
