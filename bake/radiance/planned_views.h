// The few viewpoints that show what eyes will see: instead of the paper's hemispheres all around.
#pragma once

#include "bake/radiance/reflector_plan.h"
#include "bake/radiance/samples.h"
#include "bake/radiance/views.h"

namespace oriel {

struct PlannedViewOptions {
  std::span<const Vec3> eyes{};   // scene space: for whom maps are planned
  ChoiceOptions choice;           // max_maps: of an element of element_m; larger ones get as many times more, but no
                                  // more than kMostMapsPerElement
  float element_m = 3;            // metres: the paper's
  std::uint32_t samples = 4096;   // for each element_m square, at most for four of a reflector
  std::uint32_t hemisphere = 64;  // candidates: the paper's
  std::uint32_t mirrored_eyes = 128;  // and mirror images of eyes that see the element
  std::uint32_t max_elements = 16;    // of a reflector: it is divided while that makes it sharper
  std::uint32_t map_resolution = 0;   // of all maps; 0: what is worth its pixels
  // Of a map's pixel: the solid angle that it must show, on average over eyes, seen newly or sharper, sr times
  // reflectance. A pixel of a screen that shows a mirror is two thousand times as much.
  double pixel_price = 1e-9;
  std::uint64_t memory_bytes = std::uint64_t{128} << 20;  // of all maps, kMapBytesPerPixel each
};

// Leaves those reflectors in which an eye sees anything, at most `limit` of them, ordered by their reflectance times
// the solid angle that they fill on average; says which were left out and why. Error kStopped.
Status keep_seen_reflectors(const Accel& accel, std::span<const Vec3> eyes, std::uint32_t limit, Context& context,
                            FoundReflectors& found);

// Plans the maps of all reflectors that have maps for the eyes, and sets each one's elements_x, elements_y,
// first_map and map_count: an element's maps in the order in which they were chosen. Candidates are hemispheres behind
// the element (without those whose mirror image is outside the scene) and mirrored eyes. Where memory_bytes does not
// suffice, pixels get dearer until all fits: maps that show least for their size are left out or get coarser. The same
// for any number of threads. Error kStopped.
Result<ViewPlan> plan_views_for_eyes(const ReflectedSurroundings& surroundings, const PlannedViewOptions& options,
                                     Context& context, std::vector<FoundReflector>& reflectors);

}  // namespace oriel
