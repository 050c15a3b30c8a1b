// View samples: positions from which a scene is looked at, and their visibility of surface points. No view looks into
// the gap behind a panel or under a carpet, and the gap's darkness must not show where it ends. A gap with a lamp in it
// counts as visible, because its light leaves it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bake/trace/path.h"

namespace oriel {

// True if that side of a triangle emits light.
bool is_lamp(const Scene& scene, std::uint32_t triangle, bool front);

class ViewSamples {
 public:
  // eyes: view positions, scene space, m; none: every point counts as visible. Both arguments must outlive this.
  ViewSamples(const Transport& transport, std::span<const Vec3> eyes)
      : accel_(transport.accel), lights_(transport.lights), eyes_(eyes) {}

  // The nearest views in front of a texel, filled at the first query.
  using Nearest = std::optional<std::vector<Vec3>>;

  // False for a point in a dark gap that none of the nearest views sees: all but one of a dozen rays from it end within
  // reach_m, m, and no lamp is in there. Most points take two rays. The result is a function of the id.
  bool sees(const SurfacePoint& surface, float reach_m, const SampleId& id, Nearest& nearest,
            std::uint64_t& rays) const;
  // True if one of the nearest views has a line of sight to a point off the surface with that normal.
  bool in_sight(const Vec3& point, const Vec3& normal, Nearest& nearest, std::uint64_t& rays) const;
  // The same for many more views: all near ones may stand behind a wall.
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
