// Light that lamps send by way of specular reflections, to a part of the error asked for.
#pragma once

#include "bake/radiosity/frames/frame_error.h"
#include "bake/radiosity/gather/gather.h"
#include "bake/radiosity/radiosity.h"

namespace oriel {

// Fills HalfSums::beside and leaves such light out of what rays find. With as many particles as keep its noise, once
// it is filtered, below a third of the error asked for. Without an error: one particle for
// every eight rays. direct: lux by texel. Error kStopped; `options.enough` ends it with what there is.
Status follow_lamps(const Texels& texels, Surroundings& around, std::span<const Vec3> direct, const FrameError& frames,
                    double error, const RadiosityOptions& options, Context& context, HalfSums& sums,
                    std::atomic<std::uint64_t>& rays);

}  // namespace oriel
