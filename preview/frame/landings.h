// Where light lands on its way: each place shines back what it reflects diffusely (instant radiosity, Keller 1997).
#pragma once

#include "preview/frame/guided_sources.h"

namespace oriel {

struct Landing {
  Vec3 place{0}, normal{0, 0, 1};  // on the side that the light came to
  Vec3 power{0};                   // radiance times area: what leaves along the normal, cd
  float magnitude = 0;             // of the surface's coordinates, as SurfacePoint
};

// Of particles on their way through all reflections and glass each place with reflection. On the mean over many all of
// them shine back what surfaces reflect, after any number of bounces; what lobes reflect goes in all directions, too.
// Each pass has 2048 other particles of each kind of source, an eighth of one from afar that has no guides. Seed and
// threads: the context's. Error kStopped.
Result<std::vector<Landing>> land_particles(const Transport& transport, const GuidedSources& sources,
                                            std::uint32_t pass, Context& context);

}  // namespace oriel
