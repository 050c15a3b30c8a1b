// Ray queries against a scene. Embree stands behind this header and nowhere else.
#pragma once

#include <memory>
#include <span>

#include "bake/scene/scene.h"
#include "bake/trace/dropped.h"
#include "formats/core/result.h"

namespace oriel {

// Scene space, metres. direction: unit. Intersections with distance in (0, max_distance).
struct Ray {
  Vec3 origin{0};
  Vec3 direction{0, 0, 1};
  float max_distance = 3.0e38f;
  // Of shadow rays: solid glass lets light through unbent, as of lights that no path meets. False: it stands in the
  // way, and paths find what it bends.
  bool past_solids = true;
  // Flat frosted panes (PlanarMirrors::frosted_panes) let light through straight. False: they stand in the way of it,
  // and FrostedLights has what they spread.
  bool past_frosted = true;
};

struct Hit {
  std::uint32_t triangle = ~0u;  // into Scene::triangles; ~0u: nothing was hit
  float distance = 0;            // metres
  Vec2 barycentric{0};           // weights of the triangle's second and third vertex
  bool front = true;             // the ray came from the front (counter-clockwise) side
  explicit operator bool() const { return triangle != ~0u; }
};

struct AccelOptions {
  bool reproducible = false;  // pin the instruction set (SSE4.2), so that results do not depend on the CPU's type
  int threads = 0;            // that build the hierarchy; 0: all
};

// A triangle and its twin (Scene::twin) are one to rays, which meet the front of one or of the other. So are one-sided
// opaque surfaces that lie in one place, back to back.
//
// Immutable once built; queries may run from any thread. Holds a reference to the scene, which must outlive it.
// Rays that are not finite are answered as misses (Debian's Embree would abort on them).
class Accel {
 public:
  // kInvalid when the scene has no triangle, kRuntime when Embree fails (out of memory).
  static Result<Accel> build(const Scene& scene, const AccelOptions& options = {});
  Accel(Accel&&) noexcept;
  Accel& operator=(Accel&&) noexcept;
  ~Accel();

  // The same for another scene, whose triangles lie as this one's and let light through where this one's do, with the
  // same flat frosted panes if there are lights: nothing is built again. Each may end before the other. As build():
  // that scene must outlive it.
  Accel of(const Scene& scene) const;

  const Scene& scene() const;

  // The nearest surface, whatever its material.
  Hit intersect(const Ray& ray) const;
  // Share of light, per channel, that passes along the ray: 0 where an opaque surface is in the way, else the product
  // of what alpha-masked and transmissive surfaces and solid glass let through.
  Vec3 transmittance(const Ray& ray) const;

  // The product for rays that light must pass one after the other; `rays` counts those that were traced.
  Vec3 transmittance_of_all(std::span<const Ray> legs, std::uint64_t& rays) const;

  // The same for many rays; several times faster where neighbours in the span start and point alike. Sizes are equal.
  void intersect(std::span<const Ray> rays, std::span<Hit> hits) const;
  void transmittance(std::span<const Ray> rays, std::span<Vec3> passed) const;

  // Where whoever traces these rays tells of samples of light that were no numbers.
  DroppedSamples& dropped() const;

 private:
  struct Impl;
  explicit Accel(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// The point of a triangle, by interpolation: more precise than origin + t * direction.
Vec3 point_on(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric);

// p moved towards `side` (unit) by what covers its rounding error and no more, so that a ray from there neither meets
// its own surface at distance 0 nor leaks through a thin wall. magnitude: the largest |coordinate| that p was computed
// from.
Vec3 offset_origin(const Vec3& p, const Vec3& side, float magnitude);

// The origin of a ray that leaves a surface: point_on(), moved to the side of `direction`.
Vec3 spawn_origin(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric, const Vec3& direction);

}  // namespace oriel
