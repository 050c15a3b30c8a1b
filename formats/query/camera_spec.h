// Which camera a user means: by name, number, point or time.
#pragma once

#include <span>
#include <string_view>

#include "formats/core/result.h"
#include "formats/query/camera.h"

namespace oriel {

// What a pack offers.
struct CameraChoices {
  std::span<const Camera> cameras;
  std::span<const CameraPath> paths;
  DVec3 origin{0};  // Mesh::origin
};

// One of, tried in this order:
//   NAME               a camera of the pack (the first of that name)
//   INDEX              a camera by its place, from 0
//   NAME@SECONDS       a point of a camera path, SECONDS after its start (clamped to its ends)
//   ex,ey,ez,tx,ty,tz  eye and target in world coordinates, metres; 60° high
// Errors: kUsage, with the names there are.
Result<Camera> parse_camera(std::string_view text, const CameraChoices& choices);

// The camera to start with: the first camera, else the start of the first path, else overview() of the bounds (pack
// space). A baked pack has a camera: where its scene had none the baker chose one (bake/visibility/first_look.h).
Camera initial_camera(const CameraChoices& choices, const Vec3& lower, const Vec3& upper);

}  // namespace oriel
