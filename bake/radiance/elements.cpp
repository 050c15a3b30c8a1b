#include "bake/radiance/elements.h"

#include <algorithm>

#include "bake/radiance/reproject.h"
#include "formats/core/rectangle.h"

namespace oriel {
namespace {

constexpr double kMinCoverage = 1e-3;  // of an element by the reflector's polygons
constexpr std::uint32_t kMinShortSide = 8;

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

std::vector<Element> covered_elements(const Scene& scene, const FoundReflector& found, const ElementGrid& grid) {
  const Reflector& r = found.reflector;
  const Vec2 step = (r.upper - r.lower) / Vec2(grid.x, grid.y);
  std::vector<Element> elements;
  for (std::uint32_t y = 0; y < grid.y; ++y)
    for (std::uint32_t x = 0; x < grid.x; ++x) {
      const Vec2 lower = r.lower + step * Vec2(x, y);
      elements.push_back(
          {lower, Vec2(x + 1 == grid.x ? r.upper.x : lower.x + step.x, y + 1 == grid.y ? r.upper.y : lower.y + step.y),
           y * grid.x + x});
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

UVec2 map_size(const Element& element, std::uint32_t resolution) {
  const Vec2 size = element.upper - element.lower;
  const float longer = std::max(size.x, size.y);
  const auto pixels = [&](float side) {
    return static_cast<std::uint32_t>(
        std::clamp<long>(std::lround(resolution * side / longer), std::min(kMinShortSide, resolution), resolution));
  };
  return {pixels(size.x), pixels(size.y)};
}

RadianceMap blank_map(std::uint32_t reflector, const Vec3& eye, const Element& element, std::uint32_t resolution) {
  const UVec2 size = map_size(element, resolution);
  RadianceMap map;
  map.reflector = reflector;
  map.element = element.index;
  map.eye = eye;
  map.lower = element.lower;
  map.upper = element.upper;
  map.width = size.x;
  map.height = size.y;
  return map;
}

}  // namespace oriel
