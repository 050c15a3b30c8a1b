// Whether anybody can see a point of a surface: what lies in the gap behind a panel, under a plinth or a carpet nobody
// looks at, and its darkness must not show where the gap ends. A gap with a lamp in it counts as seen: its light leaves
// it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bake/trace/path.h"

namespace oriel {

// Whether that side of a triangle is a lamp's.
bool is_lamp(const Scene& scene, std::uint32_t triangle, bool front);

class Onlookers {
 public:
  // eyes: where people look from, scene space; none: every point counts as seen. Both must outlive it.
  Onlookers(const Transport& transport, std::span<const Vec3> eyes)
      : accel_(transport.accel), lights_(transport.lights), eyes_(eyes) {}

  // The nearest eyes before a texel, found when first asked for.
  using Nearest = std::optional<std::vector<Vec3>>;

  // False where all but one of a dozen rays from a texel's point end within reach_m, as in a gap, no lamp is in there,
  // and none of the nearest eyes has a line of sight to it. Most points take two rays. The same for the same id.
  bool see(const SurfacePoint& surface, float reach_m, const SampleId& id, Nearest& nearest, std::uint64_t& rays) const;
  // Whether one of the nearest eyes has a line of sight to a point off the surface, of that normal.
  bool in_sight(const Vec3& point, const Vec3& normal, Nearest& nearest, std::uint64_t& rays) const;
  // Whether any of very many eyes has one, as where all near ones may stand behind a wall.
  bool in_sight_of_any(const Vec3& point, const Vec3& normal, std::uint64_t& rays) const;
  bool any() const { return !eyes_.empty(); }

 private:
  bool in_dark_gap(const SurfacePoint& surface, float reach_m, Sampler& sampler, std::uint64_t& rays) const;
  bool is_lit_from_near(const SurfacePoint& surface, float reach_m, Sampler& sampler, std::uint64_t& rays) const;
  std::vector<Vec3> nearest_to(const Vec3& point, const Vec3& normal, std::size_t most) const;

  const Accel& accel_;
  const LightSet& lights_;
  std::span<const Vec3> eyes_;
};

}  // namespace oriel
