#include "bake/radiance/ways.h"

#include <fmt/format.h>

#include "formats/core/check.h"

namespace oriel {

WayCosts way_costs(DrawnOn target) {
  // llvmpipe, one thread's time; and an NVIDIA H200 (docs/notes/reflections.md, "Geometry or maps").
  if (target == DrawnOn::kGpu) return {0.008, 0.0013, 0.00046, 0.14, 0.0057};
  return {1, 0.08, 0.13, 1, 0.53};
}

void choose_ways(WaysWanted wanted, DrawnOn target, std::span<const std::uint64_t> triangles,
                 std::span<FoundReflector> reflectors) {
  ORIEL_CHECK_EQ(triangles.size(), reflectors.size());
  const WayCosts costs = way_costs(target);
  for (std::size_t i = 0; i < reflectors.size(); ++i) {
    FoundReflector& r = reflectors[i];
    if (wanted != WaysWanted::kAuto) {
      r.way = wanted == WaysWanted::kGeometry ? ReflectorWay::kGeometry : ReflectorWay::kMaps;
      r.why = "as asked for";
      continue;
    }
    const double pixels = r.shown_sr * kPixelsPerSteradian;
    const double geometry =
        costs.geometry_ms +
        1e-3 * (costs.triangle_us * kInFrustum * static_cast<double>(triangles[i]) + costs.geometry_pixel_us * pixels);
    const double maps = costs.maps_ms + 1e-3 * costs.maps_pixel_us * pixels;
    r.way = geometry <= maps ? ReflectorWay::kGeometry : ReflectorWay::kMaps;
    r.why = fmt::format("where it is seen, {:.0f} pixels and {} triangles: {:.2g} ms by geometry, {:.2g} ms by maps",
                        pixels, triangles[i], geometry, maps);
  }
}

}  // namespace oriel
