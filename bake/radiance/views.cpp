#include "bake/radiance/views.h"

#include <algorithm>

#include "bake/radiance/reproject.h"

namespace oriel {
namespace {

// Between rings and from the pole to the first.
double arc_between(int rings, Rings which) {
  return which == Rings::kTo75 ? 75 * kPiD / 180 / rings : 0.5 * kPiD / (rings + 0.5);
}

constexpr std::uint32_t kMinResolution = 16;

struct EyePlanner {
  const Scene& scene;
  const std::vector<FoundReflector>& reflectors;
  const ViewOptions& options;
  std::vector<std::vector<Element>> elements;

  std::uint32_t resolution(std::size_t reflector, std::uint32_t divisor) const {
    const std::uint32_t full =
        options.map_resolution > 0 ? options.map_resolution : resolution_for(reflectors[reflector].roughness);
    return std::max(std::min(full, kMinResolution), full / divisor);
  }

  // Appends one reflector's maps (or only counts their bytes) and the number of viewpoints outside the scene.
  std::uint64_t reflector_maps(std::size_t r, const std::vector<Vec3>& directions, std::uint32_t divisor,
                               std::vector<RadianceMap>* maps, std::uint64_t& skipped) const {
    std::uint64_t bytes = 0;
    for (const Element& element : elements[r]) {
      const Vec3 centre(0.5f * (element.lower + element.upper), 0);
      const float radius = 0.5f * glm::length(element.upper - element.lower);
      for (const Vec3& direction : directions) {
        const Vec3 eye = centre + radius * direction;
        if (!is_inside(scene, pack_from_reflector(reflectors[r].reflector, mirrored(eye)), radius)) {
          ++skipped;
          continue;
        }
        bytes += map_bytes(element, resolution(r, divisor));
        if (maps) maps->push_back(blank_map(static_cast<std::uint32_t>(r), eye, element, resolution(r, divisor)));
      }
    }
    return bytes;
  }

  std::uint64_t total_bytes(std::size_t count, std::uint32_t views, std::uint32_t divisor) const {
    const std::vector<Vec3> directions = hemisphere_directions(views, Rings::kToRim);
    std::uint64_t bytes = 0, skipped = 0;
    for (std::size_t r = 0; r < count; ++r) bytes += reflector_maps(r, directions, divisor, nullptr, skipped);
    return bytes;
  }
};

// What fits into the memory allowed.
struct Fit {
  std::size_t reflectors;
  std::uint32_t views, divisor = 1;
};

Fit fit_memory(const EyePlanner& planner, std::vector<std::string>& omitted) {
  const ViewOptions& options = planner.options;
  Fit fit{planner.reflectors.size(), std::max(1u, options.views_per_element)};
  const std::uint64_t wanted = planner.total_bytes(fit.reflectors, fit.views, 1);
  if (wanted <= options.memory_bytes) return fit;
  while (fit.views > 1 && planner.total_bytes(fit.reflectors, fit.views, fit.divisor) > options.memory_bytes)
    --fit.views;
  while (fit.divisor < 64 && planner.total_bytes(fit.reflectors, fit.views, fit.divisor) > options.memory_bytes)
    fit.divisor *= 2;
  while (fit.reflectors > 0 && planner.total_bytes(fit.reflectors, fit.views, fit.divisor) > options.memory_bytes)
    --fit.reflectors;
  std::string line = memory_line(wanted, options.memory_bytes) +
                     fmt::format("{} of {} views per element", fit.views, std::max(1u, options.views_per_element));
  if (fit.divisor > 1) line += fmt::format(", 1/{} of the resolution", fit.divisor);
  if (fit.reflectors < planner.reflectors.size())
    line += fmt::format(", {} of {} reflectors", fit.reflectors, planner.reflectors.size());
  omitted.push_back(line);
  return fit;
}

}  // namespace

bool is_inside(const Scene& scene, const Vec3& p, float margin) {
  return glm::all(glm::greaterThanEqual(p, scene.lower - margin)) &&
         glm::all(glm::lessThanEqual(p, scene.upper + margin));
}

std::string memory_line(std::uint64_t wanted, std::uint64_t allowed) {
  return fmt::format("radiance maps would take {:.1f} MiB of {:.1f} MiB allowed: ",
                     static_cast<double>(wanted) / (1 << 20), static_cast<double>(allowed) / (1 << 20));
}

std::vector<Vec3> hemisphere_directions(std::uint32_t count, Rings which) {
  std::vector<Vec3> directions{{0, 0, -1}};
  if (count <= 1) return directions;
  // Rings at θ_k = k Δ; their natural number of points is 2π sinθ_k / Δ. The number of rings whose natural total is
  // nearest to what is asked, its points then shared out in proportion.
  const auto natural = [&](int rings) {
    const double arc = arc_between(rings, which);
    double total = 0;
    for (int k = 1; k <= rings; ++k) total += 2 * kPiD * std::sin(k * arc) / arc;
    return total;
  };
  const double wanted = count - 1;
  int rings = 1;
  while (rings < 64 && std::abs(std::log(natural(rings + 1) / wanted)) < std::abs(std::log(natural(rings) / wanted)))
    ++rings;
  const double arc = arc_between(rings, which);
  double sines = 0, before = 0;
  for (int k = 1; k <= rings; ++k) sines += std::sin(k * arc);
  for (int k = 1; k <= rings; ++k) {
    const double theta = k * arc;
    const double until = before + std::sin(theta) / sines * wanted;
    const long points = (k == rings ? std::lround(wanted) : std::lround(until)) - std::lround(before);
    before = until;
    for (long i = 0; i < points; ++i) {
      // Every other ring is turned by half a step, so that views do not line up.
      const double phi = 2 * kPiD * (static_cast<double>(i) + (k % 2 ? 0.25 : 0.75)) / static_cast<double>(points);
      directions.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta));
    }
  }
  return directions;
}

std::uint32_t resolution_for(float roughness) {
  if (roughness < 0.05f) return 256;
  return roughness <= 0.12f ? 192 : 128;
}

ViewPlan plan_views(const Scene& scene, std::vector<FoundReflector>& reflectors, const ViewOptions& options) {
  EyePlanner planner{.scene = scene, .reflectors = reflectors, .options = options, .elements = {}};
  for (FoundReflector& found : reflectors) {
    planner.elements.emplace_back();
    if (found.way == ReflectorWay::kGeometry) continue;
    const ElementGrid grid =
        element_grid(found.reflector.upper - found.reflector.lower, options.element_m, options.max_elements);
    found.reflector.elements_x = grid.x;
    found.reflector.elements_y = grid.y;
    planner.elements.back() = covered_elements(scene, found, grid);
  }
  ViewPlan plan;
  const Fit fit = fit_memory(planner, plan.omitted);
  plan.views_per_element = fit.views;
  const std::vector<Vec3> directions = hemisphere_directions(fit.views, Rings::kToRim);
  for (std::size_t r = 0; r < reflectors.size(); ++r) {
    Reflector& out = reflectors[r].reflector;
    std::uint64_t skipped = 0;
    out.first_map = static_cast<std::uint32_t>(plan.maps.size());
    if (r < fit.reflectors) planner.reflector_maps(r, directions, fit.divisor, &plan.maps, skipped);
    out.map_count = static_cast<std::uint32_t>(plan.maps.size()) - out.first_map;
    if (skipped > 0)
      plan.omitted.push_back(fmt::format("'{}': {} viewpoints see it from outside the scene", out.name, skipped));
  }
  return plan;
}

}  // namespace oriel
