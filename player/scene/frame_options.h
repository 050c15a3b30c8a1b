// What is asked of a frame, and what it cost.
#pragma once

#include <cstdint>

#include "player/scene/kernel_taps.h"
#include "player/scene/map_point.h"

namespace oriel {

// The stages of Bastos et al. 1999: what reflectors see (M), blurred (MK), modulated (MKR); the diffuse part (D); the
// frame.
enum class Show { kAll, kM, kMK, kMKR, kD };
enum class Reflectance { kTable, kSphereMap };

struct FrameOptions {
  Show show = Show::kAll;
  int maps_per_element = 2;  // radiance maps drawn for each reflector element in view; 0: none
  Selection selection = Selection::kAngle;
  KernelPlace kernel = KernelPlace::kLobe;
  Reflectance reflectance = Reflectance::kTable;
  bool mipmaps = true;  // false: textures at full resolution at each pixel's centre, as a ray tracer samples them
  float white = 0;      // cd/m² shown as white, for see-through unlit surfaces; 0: as the exposure meter finds
};

struct FrameStats {
  std::uint32_t draws = 0;
  std::uint64_t triangles = 0;
  std::uint32_t reflectors = 0;  // that had pixels in view
  std::uint32_t maps = 0;        // radiance maps reprojected
  std::uint64_t points = 0;      // of them
};

}  // namespace oriel
