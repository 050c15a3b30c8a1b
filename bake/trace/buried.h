// Whether a point lies inside a closed body.
#pragma once

#include "bake/trace/path.h"

namespace oriel {

// Inside a closed body nearly every direction meets the back of one-sided faces. Asks `probes` cosine-distributed rays
// of a sampler of the caller's; most points in the open answer with one. One probe may miss (a crack); false else.
bool is_buried(const Accel& accel, const SurfacePoint& surface, int probes, Sampler& sampler, std::uint64_t& rays);

}  // namespace oriel
