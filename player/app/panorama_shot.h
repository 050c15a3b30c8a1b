// Panoramas into files.
#pragma once

#include "player/app/shots.h"
#include "player/passes/frame.h"

namespace oriel {

// All that is seen from each shot's eye into its file, of the arguments' size (2:1). One exposure holds for all
// directions: the mean of what the six faces of a cube meter. Errors: kUsage where the device's textures are too small,
// kIo, kRuntime, kStopped.
Status draw_panoramas(const std::vector<Shot>& shots, const PlayArguments& arguments, GpuScene& scene,
                      Renderer& renderer);

}  // namespace oriel
