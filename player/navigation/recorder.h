// Walks as they happen.
#pragma once

#include "formats/assets/camera.h"

namespace oriel {

// A path that starts at time 0 with this camera. An orthographic one is recorded as if it were 60° high.
CameraPath start_recording(const Camera& camera);

// The camera dt_s later. While it stands still the last key moves on instead of new ones being added.
void record(const Camera& camera, float dt_s, CameraPath& path);

}  // namespace oriel
