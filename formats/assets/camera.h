// Cameras of the scene, and walks through it.
#pragma once

#include <string>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// Looks along forward; up is not parallel to it. Pack space (metres, relative to Mesh::origin).
struct Camera {
  std::string name;
  Vec3 eye{0};
  Vec3 forward{0, 0, -1};
  Vec3 up{0, 1, 0};
  float vertical_fov_rad = 1.0f;  // (0, π); 0: orthographic, see half_height
  float half_height = 0;          // metres, orthographic only
};

struct CameraKey {
  float time_s = 0;
  Vec3 eye{0};
  Vec3 forward{0, 0, -1};
};

// Keys in order of time; linear between them.
struct CameraPath {
  std::string name;
  float vertical_fov_rad = 1.0f;
  std::vector<CameraKey> keys;
};

}  // namespace oriel
