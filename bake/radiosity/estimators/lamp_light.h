// The number of light-tracing particles, balanced against gather rays.
#pragma once

#include "bake/radiosity/estimators/group_filter.h"
#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/gather/gather.h"
#include "bake/radiosity/gather/lamp_paths.h"
#include "bake/radiosity/texels/frame_error.h"

namespace oriel {

// The initial number of particles per half: eight a texel; with a fixed number of gather rays, one for every eight.
std::uint64_t first_particles(std::size_t texels, const RadiosityOptions& options);

// Sets HalfSums::additional from the particles.
void set_additional(const LampLight& lamps, HalfSums& sums);

// Light by particles, filtered apart from gathered light: caustics have edges where gathered light has none. Empty
// without particles.
struct AdditionalLight {
  std::vector<Vec3> light;  // HalfSums::additional, lux
  GroupedLight grouped;     // HalfSums::additional_grouped
};
AdditionalLight smooth_additional(const LampLight& lamps, const Texels& texels, const TexelGraph& graph,
                                  const HalfSums& sums, Context& context);

// True if doubling the particles reduces the squared error of frames by more per cost than doubling the rays does,
// judged by the unfiltered noise of both. light: of texels, lux.
bool particles_pay(const LampLight& lamps, const HalfSums& sums, std::span<const Vec3> light, const FrameError& frames);

}  // namespace oriel
