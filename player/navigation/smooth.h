// Walks without the jerks of hands.
#pragma once

#include "formats/assets/camera.h"

namespace oriel {

// The camera of camera_on_path (formats/query/path.h), its eye and direction averaged over time by a Gaussian of this
// standard deviation, cut at three of them. Beyond its ends the path goes on as its mirror image through them, so that
// it begins and ends where it did, and steady moves stay as they are. sigma_s ≤ 0: as it is. A pure function: the same
// time gives the same camera.
Camera smoothed_camera_on_path(const CameraPath& path, float time_s, float sigma_s);

}  // namespace oriel
