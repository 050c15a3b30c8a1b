// A smooth walk along waypoints.
#pragma once

#include <span>

#include "scenes/kit/scene_builder.h"

namespace oriel::sample {

struct TrackOptions {
  int frames = 600;
  double frames_per_second = 30;
  double corner_radius = 1.2;  // m: how far from a waypoint the path starts to turn
  double look_ahead = 1.6;     // m: the eye looks at the point of the path so far ahead
  double ease = 0.08;          // share of the time for starting, and for stopping
  float vertical_fov_rad = 1.0472f;
};

// Straight lines between the waypoints (eye positions, at least two, distinct neighbours) with parabolic corners,
// walked at constant speed but for the ends.
Path walk_along(std::string name, std::span<const Vec3> waypoints, const TrackOptions& options = {});

}  // namespace oriel::sample
