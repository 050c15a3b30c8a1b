// A mover as maps of many lights draw it.
#pragma once

#include <optional>

#include "formats/assets/mover.h"
#include "player/scene/gpu_mesh.h"

namespace oriel {

// With fewer triangles, within a fiftieth of its size of what it is: maps are coarser than that, and there are hundreds
// of them. Nothing where it has few anyhow, or where there is no doing with fewer.
std::optional<GpuMover> make_shade_shape(const Mover& mover);

}  // namespace oriel
