// Flat, uniformly emitting polygons: their irradiance in closed form, and points on them for shadow rays.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bake/scene/scene.h"

namespace oriel {

// Coplanar, connected emissive triangles of one surface with one radiance.
struct PolygonLight {
  Vec3 radiance{0};  // cd/m²
  Vec3 normal{0, 0, 1};
  bool double_sided = false;
  std::vector<std::uint32_t> triangles;       // into Scene::triangles
  std::vector<std::array<Vec3, 3>> corners;   // by triangle, counter-clockwise seen from the front, scene space
  std::vector<std::array<Vec3, 2>> boundary;  // directed edges that no two triangles share
  std::vector<double> cumulative_area;        // by triangle, m²
  Vec3 center{0};
  float radius = 0;     // of the sphere around center that holds it, metres
  float magnitude = 0;  // largest |coordinate|: what a point's rounding error is relative to

  double area_m2() const { return cumulative_area.back(); }
};

// All emissive triangles whose emission is not textured, as polygons, in order of their first triangle.
std::vector<PolygonLight> find_polygon_lights(const Scene& scene);

// Whether find_polygon_lights finds all that surfaces emit: no emission is textured.
bool all_emission_is_plain(const Scene& scene);

// Where light is received: a point, its shading normal and the normal of the real surface there (both unit). Incidence
// is weighted by both cosines as the path tracer does it: max(0, n·ω) + max(0, n·ω') for ω above the real surface, ω'
// its mirror image below (docs/notes/conventions.md); with n = g, or on a rounded surface, that is plain irradiance.
struct Receiver {
  Vec3 position{0};
  Vec3 normal{0, 0, 1};
  Vec3 geometric_normal{0, 0, 1};
  float rounded = 0;  // height_of_rounded(), m

  const Vec3& horizon() const { return rounded > 0 ? normal : geometric_normal; }  // of what it receives
  Vec3 mirrored_normal() const { return normal - 2 * glm::dot(normal, geometric_normal) * geometric_normal; }
};

// The weight of light from ω (unit). punctual: of a point, a spot or a sun, of which nothing is mirrored: light of one
// direction would jump from facet to facet of a hollow.
inline float incidence(const Receiver& r, const Vec3& direction, bool punctual = false) {
  if (glm::dot(r.horizon(), direction) <= 0) return 0;
  const float straight = std::max(0.0f, glm::dot(r.normal, direction));
  if (punctual || r.normal == r.horizon()) return straight;
  return straight + std::max(0.0f, glm::dot(r.mirrored_normal(), direction));
}

// Unoccluded irradiance from a polygon over its radiance, steradians times cosine: [0, π]. Lambert's formula for the
// polygon clipped at the horizon (Lambert 1760; Baum et al. 1989).
float polygon_irradiance(const PolygonLight& light, const Receiver& receiver);

// A point of a polygon as seen from p.
struct PolygonSample {
  Vec3 direction{0, 0, 1};  // unit, towards the light
  float distance = 0;       // that a shadow ray must go; <= 0 where the light touches the point
  float solid_angle = 0;    // 1 / pdf per steradian
};

// A polygon as seen from a receiver, which must outlive it: what all its points have in common is found once.
class PolygonView {
 public:
  PolygonView(const PolygonLight& light, const Receiver& receiver);

  // Nearly in proportion to incidence() per solid angle where a triangle is large as seen from the receiver: spherical
  // triangles (Arvo 1995) warped by the cosines at their corners (Hart et al. 2020); else by area. Then incidence times
  // solid_angle hardly varies, and a ratio of such weights hardly has a bias. Nothing where the point sees the polygon
  // edge-on or from behind. u in [0,1)².
  std::optional<PolygonSample> sample(const Vec2& u) const;

 private:
  struct Triangle {
    std::array<Vec3, 3> to;         // from the receiver to its corners
    std::array<Vec3, 3> direction;  // the same, unit; only where solid_angle > 0
    std::array<float, 3> cosine;    // incidence() there, with a floor that keeps every direction possible
    float area = 0;                 // m²
    float solid_angle = 0;          // 0 where the receiver touches a corner
    float alpha = 0;                // angle at the first corner, where the solid angle is large

    // Nearly its irradiance over its radiance.
    float weight() const { return solid_angle * (cosine[0] + cosine[1] + cosine[2]); }
  };
  static constexpr std::size_t kFew = 8;

  float area_of(std::size_t k) const;
  Triangle see(std::size_t k) const;
  // `other`: where the chosen one is put that is not kept.
  const Triangle& choose(Vec2& u, float& probability, Triangle& other) const;
  static Vec3 on_sphere(const Triangle& triangle, const Vec2& u);

  const PolygonLight& light_;
  const Receiver& receiver_;
  float height_ = 0;                 // over the light's plane
  std::array<Triangle, kFew> seen_;  // where there are no more
  float sum_ = 0;                    // of their weights
};
inline std::optional<PolygonSample> sample_polygon(const PolygonLight& light, const Receiver& receiver, const Vec2& u) {
  return PolygonView(light, receiver).sample(u);
}

}  // namespace oriel
