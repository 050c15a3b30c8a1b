#include "bake/visibility/lit_eyes.h"

#include <algorithm>
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
constexpr std::uint32_t kPaths = 32;          // from each
constexpr double kDark = 1e-5;                // of the light elsewhere: a crack in a shell; a cinema has ten times that
constexpr std::uint64_t kStream = 0x11614e7;  // of random numbers

// By eye: the mean luminance around it, cd/m².
Result<std::vector<double>> light_around(const Transport& t, std::span<const Vec3> eyes, std::uint64_t stream,
                                         Context& context) {
  std::vector<double> found(eyes.size());
  ORIEL_TRY_VOID(parallel_for(context, "", eyes.size(), [&](std::size_t i) {
    std::uint64_t rays = 0;
    for (std::uint32_t k = 0; k < kPaths; ++k) {
      Sampler sampler(context.seed, stream + i, k);
      const PathLight light = trace_path(t, {eyes[i], square_to_sphere(sampler.next2())}, 0, sampler, rays);
      const double seen = luminance(light.emitted + light.sky + light.scattered);
      if (std::isfinite(seen)) found[i] += seen / kPaths;
    }
  }));
  return found;
}

}  // namespace

Status leave_the_dark(const Transport& transport, EyeRegion& region, Context& context) {
  if (region.grids.empty() || !region.points.empty()) return {};
  ORIEL_TRY(const std::vector<double> on_floors,
            light_around(transport, sample_eyes(region, kEyes, context.seed), kStream, context));
  const float beside = 0.5f * max_component(region.upper - region.lower);
  EyeRegion around, anywhere;
  around.lower = region.lower - Vec3(beside, 0, beside), around.upper = region.upper + beside;
  const std::vector<Vec3> places = sample_eyes(around, kPlaces, context.seed);
  ORIEL_TRY(const std::vector<double> seen, light_around(transport, places, kStream + kEyes, context));
  const auto mean = [](const std::vector<double>& of) { return std::reduce(of.begin(), of.end()) / of.size(); };
  if (mean(on_floors) > kDark * mean(seen)) return {};
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

}  // namespace oriel
