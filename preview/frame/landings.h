// Where light lands on its way: each place shines back what it reflects diffusely (instant radiosity, Keller 1997).
#pragma once

#include "bake/jobs/context.h"
#include "bake/trace/path.h"

namespace oriel {

struct Landing {
  Vec3 place{0}, normal{0, 0, 1};  // on the side that the light came to
  Vec3 power{0};                   // radiance times area: what leaves along the normal, cd
  float magnitude = 0;             // of the surface's coordinates, as SurfacePoint
};

// Of `count` particles of each kind of source, on their way through all reflections and glass, each place with diffuse
// reflection. On the mean over many all of them shine back what diffuse surfaces reflect, after any number of bounces.
// Seed and threads: the context's. Error kStopped.
Result<std::vector<Landing>> land_particles(const Transport& transport, std::uint32_t count, Context& context);

}  // namespace oriel
