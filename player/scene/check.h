// Whether a pack can be drawn: everything that the player would otherwise read out of bounds.
#pragma once

#include "formats/pack/validate.h"
#include "player/gpu/device.h"

namespace oriel {

// Error kInvalid names the first index, size or number that does not fit; kRuntime names what exceeds the device.
Status check_drawable(const Pack& pack, const gpu::Device& device, ImagePixels pixels = ImagePixels::kHere);

}  // namespace oriel
