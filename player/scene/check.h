// Whether a device can draw a pack. That the pack is sound is for formats/pack to tell (validate.h), which looked at it
// when it was opened.
#pragma once

#include "formats/pack/pack.h"
#include "player/gpu/device.h"

namespace oriel {

// Error kRuntime names what exceeds the device.
Status check_drawable(const Pack& pack, const gpu::Device& device);

}  // namespace oriel
