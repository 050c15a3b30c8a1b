#include "bake/radiance/views.h"

#include <algorithm>

#include "bake/radiance/rectangle.h"
#include "bake/radiance/reproject.h"

namespace oriel {
namespace {

constexpr double kLowestRing = 75 * kPiD / 180;  // from the pole: views closer to the plane see it edge-on
constexpr double kMinCoverage = 1e-3;            // of an element by the reflector's polygons
constexpr std::uint32_t kMinShortSide = 8, kMinResolution = 16;

struct Element {
  Vec2 lower, upper;
};

// The elements that the reflector's triangles cover, row by row.
std::vector<Element> covered_elements(const Scene& scene, const FoundReflector& found, const ElementGrid& grid) {
  const Reflector& r = found.reflector;
  const Vec2 step = (r.upper - r.lower) / Vec2(grid.x, grid.y);
  std::vector<Element> elements;
  for (std::uint32_t y = 0; y < grid.y; ++y)
    for (std::uint32_t x = 0; x < grid.x; ++x) {
      const Vec2 lower = r.lower + step * Vec2(x, y);
      elements.push_back({lower, Vec2(x + 1 == grid.x ? r.upper.x : lower.x + step.x,
                                      y + 1 == grid.y ? r.upper.y : lower.y + step.y)});
    }
  std::vector<double> covered(elements.size());
  for (const std::uint32_t t : found.triangles) {
    std::array<DVec2, 3> triangle;
    for (int corner = 0; corner < 3; ++corner)
      triangle[corner] = DVec2(reflector_from_pack(r, scene.positions[scene.triangles[t][corner]]));
    const DVec2 low = glm::min(triangle[0], glm::min(triangle[1], triangle[2]));
    const DVec2 high = glm::max(triangle[0], glm::max(triangle[1], triangle[2]));
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const DVec2 lower(elements[i].lower), upper(elements[i].upper);
      if (high.x > lower.x && high.y > lower.y && low.x < upper.x && low.y < upper.y)
        covered[i] += clipped_area(triangle, lower, upper);
    }
  }
  std::vector<Element> out;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const DVec2 size(elements[i].upper - elements[i].lower);
    if (covered[i] > kMinCoverage * size.x * size.y) out.push_back(elements[i]);
  }
  return out;
}

bool outside(const Scene& scene, const Vec3& p, float margin) {
  for (int i = 0; i < 3; ++i)
    if (p[i] < scene.lower[i] - margin || p[i] > scene.upper[i] + margin) return true;
  return false;
}

IVec2 map_size(const Element& element, std::uint32_t resolution) {
  const Vec2 size = element.upper - element.lower;
  const float longer = std::max(size.x, size.y);
  const auto pixels = [&](float side) {
    return static_cast<int>(
        std::clamp<long>(std::lround(resolution * side / longer), std::min(kMinShortSide, resolution), resolution));
  };
  return {pixels(size.x), pixels(size.y)};
}

struct Planner {
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
      const IVec2 size = map_size(element, resolution(r, divisor));
      for (const Vec3& direction : directions) {
        const Vec3 eye = centre + radius * direction;
        if (outside(scene, pack_from_reflector(reflectors[r].reflector, mirrored(eye)), radius)) {
          ++skipped;
          continue;
        }
        bytes += kMapBytesPerPixel * static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
        if (!maps) continue;
        RadianceMap map;
        map.reflector = static_cast<std::uint32_t>(r);
        map.eye = eye;
        map.lower = element.lower;
        map.upper = element.upper;
        map.width = static_cast<std::uint32_t>(size.x);
        map.height = static_cast<std::uint32_t>(size.y);
        maps->push_back(std::move(map));
      }
    }
    return bytes;
  }

  std::uint64_t total_bytes(std::size_t count, std::uint32_t views, std::uint32_t divisor) const {
    const std::vector<Vec3> directions = hemisphere_directions(views);
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

Fit fit_memory(const Planner& planner, std::vector<std::string>& omitted) {
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
  std::string line =
      fmt::format("radiance maps would take {:.1f} MiB of {:.1f} MiB allowed: {} of {} views per element",
                  static_cast<double>(wanted) / (1 << 20), static_cast<double>(options.memory_bytes) / (1 << 20),
                  fit.views, std::max(1u, options.views_per_element));
  if (fit.divisor > 1) line += fmt::format(", 1/{} of the resolution", fit.divisor);
  if (fit.reflectors < planner.reflectors.size())
    line += fmt::format(", {} of {} reflectors", fit.reflectors, planner.reflectors.size());
  omitted.push_back(line);
  return fit;
}

}  // namespace

ElementGrid element_grid(const Vec2& size, float element_m, std::uint32_t max_elements) {
  const DVec2 s = glm::max(DVec2(size), DVec2(1e-30));
  double side = std::clamp<double>(element_m, 1e-30, 1e30);
  const double limit = std::max(1u, max_elements);
  // From a side that cannot be too large for the limit, so that the loop is short for any size.
  side = std::max({side, s.x / limit * 0.999, s.y / limit * 0.999});
  for (;;) {
    const DVec2 counts = glm::max(glm::ceil(s / side - 1e-6), DVec2(1));
    if (counts.x * counts.y <= limit)
      return {static_cast<std::uint32_t>(counts.x), static_cast<std::uint32_t>(counts.y)};
    side *= 1.02;
  }
}

std::vector<Vec3> hemisphere_directions(std::uint32_t count) {
  std::vector<Vec3> directions{{0, 0, -1}};
  if (count <= 1) return directions;
  // Rings at θ_k = k Δ; their natural number of points is 2π sinθ_k / Δ. The number of rings whose natural total is
  // nearest to what is asked, its points then shared out in proportion.
  const auto natural = [](int rings) {
    const double arc = kLowestRing / rings;
    double total = 0;
    for (int k = 1; k <= rings; ++k) total += 2 * kPiD * std::sin(k * arc) / arc;
    return total;
  };
  const double wanted = count - 1;
  int rings = 1;
  while (rings < 64 && std::abs(std::log(natural(rings + 1) / wanted)) < std::abs(std::log(natural(rings) / wanted)))
    ++rings;
  double sines = 0, before = 0;
  for (int k = 1; k <= rings; ++k) sines += std::sin(k * kLowestRing / rings);
  for (int k = 1; k <= rings; ++k) {
    const double theta = k * kLowestRing / rings;
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
  Planner planner{.scene = scene, .reflectors = reflectors, .options = options, .elements = {}};
  for (FoundReflector& found : reflectors) {
    const ElementGrid grid =
        element_grid(found.reflector.upper - found.reflector.lower, options.element_m, options.max_elements);
    found.reflector.elements_x = grid.x;
    found.reflector.elements_y = grid.y;
    planner.elements.push_back(covered_elements(scene, found, grid));
  }
  ViewPlan plan;
  const Fit fit = fit_memory(planner, plan.omitted);
  plan.views_per_element = fit.views;
  const std::vector<Vec3> directions = hemisphere_directions(fit.views);
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
