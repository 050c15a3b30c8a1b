// What no planned map shows: second surfaces along a map's rays, kept in a map of their own.
#pragma once

#include "bake/radiance/capture.h"
#include "bake/radiance/samples.h"
#include "bake/radiance/views.h"

namespace oriel {

struct ResidualOptions {
  std::uint32_t samples = 32768;                   // of a reflector, by which what is missing is found
  double least_missing = 2e-4;                     // share of their weight that is worth a residual
  std::uint32_t max_resolution = 512;              // of its longer side
  std::uint32_t spread = 4;                        // pixels around a missing sample that are looked at too
  std::span<const Vec3> eyes{};                    // scene space: who misses what
  std::uint64_t memory_bytes = ~std::uint64_t{0};  // of all maps, kMapBytesPerPixel each
  // Eyes, scene space, none of which may miss more than this share of what it sees in a reflector; found by so many
  // samples for each of them.
  std::span<const Vec3> cameras{};
  double most_missing = 1e-3;
  std::uint32_t camera_samples = 2048;
};

// Adds residual maps to each reflector whose maps (captured) miss some of what eyes see in it, valid only
// where they hold it. One for what eyes miss on the mean, with the eye and element of that map of its from which most
// of the missing is in line; then one for each camera that misses too much, the worst first, from its own mirror image,
// until none does or an element has as many maps as the player asks. They are put behind that
// element's other maps, and the reflectors' maps are numbered anew. Where memory_bytes does not suffice, those of the
// least important reflectors are made smaller or left out, as plan.omitted says. The same for any number of threads.
// Error kStopped.
Status add_residuals(const LitSurroundings& lit, const ResidualOptions& options, const Stage& stage,
                     std::vector<FoundReflector>& reflectors, ViewPlan& plan);

}  // namespace oriel
