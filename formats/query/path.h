// Camera paths by time.
#pragma once

#include "formats/query/camera.h"

namespace oriel {

// Seconds from the first key to the last; 0 without keys.
float path_duration_s(const CameraPath& path);

// The camera `time_s` seconds after the path's first key: positions linear, directions at constant angular speed
// between the keys around. Before the first key and after the last it stands still; a time that is not a number is the
// start. A path without keys gives Camera{}.
Camera camera_on_path(const CameraPath& path, float time_s);

}  // namespace oriel
