#include "bake/radiance/views.h"

#include "bake/radiance/reproject.h"

namespace oriel {
namespace {

// Between rings and from the pole to the first.
double arc_between(int rings, const RingArc& of) {
  return of.arc_rad / (rings + of.short_of);
}

}  // namespace

bool is_inside(const Scene& scene, const Vec3& p, float margin) {
  return glm::all(glm::greaterThanEqual(p, scene.lower - margin)) &&
         glm::all(glm::lessThanEqual(p, scene.upper + margin));
}

std::vector<Vec3> hemisphere_directions(std::uint32_t count, const RingArc& of) {
  std::vector<Vec3> directions{{0, 0, -1}};
  if (count <= 1) return directions;
  // Rings at θ_k = k Δ; their natural number of points is 2π sinθ_k / Δ. The number of rings whose natural total is
  // nearest to what is asked, its points then shared out in proportion.
  const auto natural = [&](int rings) {
    const double arc = arc_between(rings, of);
    double total = 0;
    for (int k = 1; k <= rings; ++k) total += 2 * kPiD * std::sin(k * arc) / arc;
    return total;
  };
  const double wanted = count - 1;
  int rings = 1;
  while (rings < 64 && std::abs(std::log(natural(rings + 1) / wanted)) < std::abs(std::log(natural(rings) / wanted)))
    ++rings;
  const double arc = arc_between(rings, of);
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

}  // namespace oriel
