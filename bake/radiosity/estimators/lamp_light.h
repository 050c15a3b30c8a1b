// How many particles lamps send, beside the rays of the gather.
#pragma once

#include "bake/radiosity/estimators/group_filter.h"
#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/gather/gather.h"
#include "bake/radiosity/gather/lamp_paths.h"
#include "bake/radiosity/texels/frame_error.h"

namespace oriel {

// Of each half, to begin with: eight a texel; where the rays of texels are given, one for every eight of these.
std::uint64_t first_particles(std::size_t texels, const RadiosityOptions& options);

// Fills HalfSums::beside, but of texels that keep theirs.
void put_beside(const LampLight& lamps, const std::vector<bool>& keep, HalfSums& sums);

// What put_beside put there, filtered by itself: what ends at a shadow's edge does not reach under a bench. Empty where
// no particle was followed.
struct LightBeside {
  std::vector<Vec3> light;  // HalfSums::beside
  GroupedLight grouped;     // HalfSums::additional_grouped
};
LightBeside smooth_beside(const LampLight& lamps, const Texels& texels, const TexelGraph& graph, const HalfSums& sums,
                          Context& context);

// Whether twice as many particles take more of the squared error of frames away, for what they cost, than twice as many
// rays: by the noise of both before the filter, which both share. light: of texels, lux.
bool particles_pay(const LampLight& lamps, const HalfSums& sums, std::span<const Vec3> light, const FrameError& frames);

}  // namespace oriel
