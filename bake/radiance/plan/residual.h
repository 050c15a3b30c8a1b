// What no planned map shows: second surfaces along a map's rays, kept in a map of their own.
#pragma once

#include "bake/radiance/capture.h"
#include "bake/radiance/plan/samples.h"

namespace oriel {

struct ResidualOptions {
  std::uint32_t samples = 32768;       // of a reflector, by which what is missing is found
  double least_missing = 2e-4;         // share of their weight that is worth a residual
  std::uint32_t max_resolution = 512;  // of its longer side
  std::uint32_t spread = 4;            // pixels around a missing sample that are looked at too
};

// Adds a residual map to each reflector whose maps (captured) miss some of what eyes (scene space) see in it: with the
// eye and element of that map of its from which most of the missing is in line, valid only where it holds it. It is
// put behind that element's other maps, and the reflectors' maps are numbered anew. The same for any number of threads.
// Error kStopped.
Status add_residuals(const Surroundings& surroundings, const OutgoingRadiance& outgoing, std::span<const Vec3> eyes,
                     const ResidualOptions& options, Context& context, std::vector<FoundReflector>& reflectors,
                     std::vector<RadianceMap>& maps);

}  // namespace oriel
