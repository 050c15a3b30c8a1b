// Where a viewer starts in a scene that has no camera.
#pragma once

#include <functional>

#include "bake/jobs/context.h"
#include "bake/trace/accel.h"
#include "formats/assets/walk_grid.h"

namespace oriel {

// Radiance, cd/m², that a surface which a ray met on its front sends back along it.
using SurfaceLight = std::function<Vec3(const Hit& hit, const Vec3& towards_eye)>;

struct FirstLook {
  Camera camera;        // "start", 60° high
  bool inside = false;  // it stands on a floor
};

// Of up to 160 places on the grids, spread evenly, and all headings, the view that shows most: the share of the frame
// that is lit, times how many surfaces share it, times how far it reaches. Places stand half a metre off what is at
// eye height, where there are any. From outside, the whole scene in the frame, from the side that shows most: without a
// floor, where no place's frame shows surfaces in a quarter of it, and where the best place has no roof and shows less
// than that. Some 200 000 rays; the same for any number of threads. Once there is enough(), no further place is looked
// from. Error kStopped.
Result<FirstLook> find_first_look(const Accel& accel, std::span<const WalkGrid> grids, const SurfaceLight& light,
                                  Context& context, const std::function<bool()>& enough = {});

}  // namespace oriel
