// Whether a point of a surface lies inside other geometry.
#pragma once

#include "bake/trace/path.h"

namespace oriel {

// Inside a closed body nearly every direction meets the back of its faces. Random numbers of its own, a function of
// the id: a point is left out whatever light its path would have found, so that leaving out does not
// favour bright paths. Most points that are not buried answer with one ray. Adds to rays.
bool is_buried(const Transport& transport, const SurfacePoint& surface, const SampleId& id, std::uint64_t& rays);

}  // namespace oriel
