#include "bake/visibility/lit_eyes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bake/jobs/parallel.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint32_t kEyes = 128;          // on the floors
constexpr std::uint32_t kPlaces = 512;        // elsewhere
constexpr std::size_t kMost = 64;             // of them
constexpr std::uint32_t kFew = 4;             // paths from each, that tell of most scenes that their floors are lit
constexpr std::uint32_t kPaths = 32;          // otherwise
constexpr double kDark = 1e-5;                // of the light elsewhere: a crack in a shell; a cinema has ten times that
constexpr std::uint64_t kStream = 0x11614e7;  // of random numbers
constexpr std::uint32_t kBodyPoints = 2048;   // of a scene that may be a body alone
constexpr std::array<float, 2> kAround{1.2f, 2.2f};  // of the scene's radius: how far eyes are from its middle

// By eye: the mean luminance around it, cd/m².
Result<std::vector<double>> light_around(const Transport& transport, std::span<const Vec3> eyes, std::uint32_t paths,
                                         std::uint64_t stream, Context& context) {
  // Whether light comes at all is known long before the last bounce of a white room.
  Transport t = transport;
  t.options.max_bounces = std::min(t.options.max_bounces, 32);
  std::vector<double> found(eyes.size());
  ORIEL_TRY_VOID(parallel_for(context, "", eyes.size(), [&](std::size_t i) {
    std::uint64_t rays = 0;
    for (std::uint32_t k = 0; k < paths; ++k) {
      Sampler sampler(context.seed, stream + i, k);
      const PathLight light = trace_path(t, {eyes[i], square_to_sphere(sampler.next2())}, 0, sampler, rays);
      const double seen = luminance(light.emitted + light.sky + light.scattered);
      if (std::isfinite(seen)) found[i] += seen / paths;
    }
  }));
  return found;
}

std::vector<Vec3> places_around(const Scene& scene, std::uint64_t seed) {
  std::vector<Vec3> eyes(kMost);
  const Vec3 middle = 0.5f * (scene.lower + scene.upper);
  for (std::size_t i = 0; i < kMost; ++i) {
    Sampler sampler(seed, kStream - 1, static_cast<std::uint32_t>(i));
    const Vec3 direction = square_to_sphere(sampler.next2());
    eyes[i] = middle + scene.radius() * glm::mix(kAround[0], kAround[1], sampler.next1()) * direction;
  }
  return eyes;
}

bool is_seen(const Accel& accel, const SurfacePoint& point, std::span<const Vec3> eyes) {
  return std::any_of(eyes.begin(), eyes.end(), [&](const Vec3& eye) {
    const float distance = glm::distance(eye, point.position);
    const Vec3 direction = (eye - point.position) / distance;
    if (glm::dot(direction, point.geometric_normal) <= 0) return false;
    return max_component(accel.transmittance({spawn_origin(point, direction), direction, distance})) > 0;
  });
}

// Fronts that rays from eyes meet.
std::vector<SurfacePoint> points_met(const Accel& accel, std::span<const Vec3> eyes, std::uint64_t seed) {
  std::vector<SurfacePoint> points;
  for (std::uint32_t i = 0; i < kBodyPoints; ++i) {
    const Vec3 direction = square_to_sphere(Sampler(seed, kStream, i).next2());
    const Hit hit = accel.intersect({eyes[i % eyes.size()], direction});
    if (!hit) continue;
    points.push_back(geometry_at(accel.scene(), hit, direction));
    if (!points.back().reflects) points.pop_back();
  }
  return points;
}

// Of the scene's fronts, by area.
std::vector<SurfacePoint> points_of_fronts(const Scene& scene, std::uint64_t seed) {
  std::vector<double> up_to;
  double all = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) up_to.push_back(all += triangle_area(scene, t));
  std::vector<SurfacePoint> points;
  for (std::uint32_t i = 0; i < kBodyPoints; ++i) {
    Sampler sampler(seed, kStream + 1, i);
    const auto at = std::upper_bound(up_to.begin(), up_to.end(), all * (i + sampler.next1()) / kBodyPoints);
    if (at == up_to.end()) continue;
    const auto triangle = static_cast<std::uint32_t>(at - up_to.begin());
    const SceneMaterial& material = scene.materials[scene.surfaces[scene.triangle_surface[triangle]].material];
    const bool front = !material.double_sided || sampler.next1() < 0.5f;
    points.push_back(point_on_side(scene, triangle, square_to_triangle(sampler.next2()), front));
  }
  return points;
}

// Of the points that eyes see, the share that others see too; 1 where they see none.
Result<double> share_also_seen(const Accel& accel, std::span<const SurfacePoint> points, std::span<const Vec3> eyes,
                               std::span<const Vec3> others, Context& context) {
  std::vector<std::uint8_t> met(points.size()), also(points.size());
  ORIEL_TRY_VOID(parallel_for(context, "", points.size(), [&](std::size_t i) {
    met[i] = is_seen(accel, points[i], eyes);
    also[i] = met[i] && is_seen(accel, points[i], others);
  }));
  const auto seen = std::count(met.begin(), met.end(), 1);
  return seen == 0 ? 1.0 : static_cast<double>(std::count(also.begin(), also.end(), 1)) / static_cast<double>(seen);
}

}  // namespace

Status leave_the_dark(const Transport& transport, EyeRegion& region, Context& context) {
  if (region.grids.empty() || !region.points.empty()) return {};
  const std::vector<Vec3> floors = sample_eyes(region, kEyes, context.seed);
  const float beside = 0.5f * max_component(region.upper - region.lower);
  EyeRegion around, anywhere;
  around.lower = region.lower - Vec3(beside, 0, beside), around.upper = region.upper + beside;
  const std::vector<Vec3> places = sample_eyes(around, kPlaces, context.seed);
  const auto mean = [](const std::vector<double>& of) { return std::reduce(of.begin(), of.end()) / of.size(); };
  std::vector<double> seen;
  for (const std::uint32_t paths : {kFew, kPaths}) {
    ORIEL_TRY(const std::vector<double> on_floors, light_around(transport, floors, paths, kStream, context));
    ORIEL_TRY(seen, light_around(transport, places, paths, kStream + kEyes, context));
    if (mean(on_floors) > kDark * mean(seen)) return {};
  }
  anywhere.lower = region.lower, anywhere.upper = region.upper;
  for (std::size_t i = 0; i < places.size() && anywhere.points.size() < kMost; ++i)
    if (seen[i] > 0) anywhere.points.push_back(places[i]);
  if (anywhere.points.empty()) return {};
  double m2 = 0;
  for (const WalkGrid& grid : region.grids) m2 += grid.walkable_m2();
  anywhere.note = fmt::format(
      "eye region: no light reaches the {:.0f} m² of floor that were found; the bake is planned for eyes around "
      "the scene that see light (--eyes)",
      m2);
  region = std::move(anywhere);
  return {};
}

Status stand_around_bodies(const Accel& accel, EyeRegion& region, Context& context) {
  if (!region.points.empty()) return {};
  EyeRegion around;
  around.points = places_around(accel.scene(), context.seed);
  around.lower = region.lower, around.upper = region.upper;
  const std::vector<Vec3> eyes = sample_eyes(region, kMost, context.seed);
  const Scene& scene = accel.scene();
  ORIEL_TRY(const double outside,
            share_also_seen(accel, points_met(accel, eyes, context.seed), eyes, around.points, context));
  if (outside <= 0.5) return {};
  ORIEL_TRY(const double known,
            share_also_seen(accel, points_of_fronts(scene, context.seed), around.points, eyes, context));
  if (known >= 0.5) return {};
  around.note = fmt::format(
      "eye region: {:.0f} % of what can be seen from around the scene {}; the bake is planned for eyes around it "
      "(--eyes)",
      100 * (1 - known), region.grids.empty() ? "is not seen from within its bounds" : "is not seen from its floors");
  region = std::move(around);
  return {};
}

}  // namespace oriel
