#include "bake/visibility/eye_height.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bake/visibility/scene_unit.h"

namespace oriel {
namespace {

constexpr float kUsual_m = 1.6f, kUsualRoom_m = 2.7f;
constexpr float kLeastHeight = 0.6f, kMostHeight = 1.5f;  // of the usual: sitting people, and those on a landing
constexpr float kLowInRoom = 0.35f, kHighInRoom = 0.8f;   // where eyes are between floor and ceiling
constexpr float kFarthest = 10;                           // of the usual, down to a floor that is the camera's

float median(std::vector<float> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// Over what lies under them and faces up, of cameras with a perspective and of paths.
std::vector<float> camera_heights(const Accel& accel) {
  const Scene& scene = accel.scene();
  std::vector<float> heights;
  const auto add = [&](const Vec3& eye) {
    const Hit floor = accel.intersect({eye, {0, -1, 0}});
    if (floor && floor.distance < kFarthest * kUsual_m && std::fabs(geometric_normal(scene, floor.triangle).y) > 0.9f)
      heights.push_back(floor.distance);
  };
  for (const Camera& camera : scene.cameras)
    if (camera.vertical_fov_rad > 0) add(camera.eye);
  for (const CameraPath& path : scene.paths)
    for (const CameraKey& key : path.keys) add(key.eye);
  return heights;
}

bool is_usual(float eye_height) {
  return eye_height >= kLeastHeight * kUsual_m && eye_height <= kMostHeight * kUsual_m;
}

}  // namespace

std::optional<EyeHeight> guess_eye_height(const Accel& accel, bool unit_guessed) {
  EyeHeight found;
  const std::vector<float> heights = camera_heights(accel);
  if (heights.empty() && !unit_guessed) return std::nullopt;
  if (!heights.empty() && is_usual(median(heights))) return std::nullopt;
  const auto room = typical_room_height(accel);
  if (!room) return std::nullopt;
  found.room_height_m = static_cast<float>(*room);
  found.cameras = heights.size();
  found.eye_height_m = heights.empty() ? kUsual_m * found.room_height_m / kUsualRoom_m : median(heights);
  const float in_room = found.eye_height_m / found.room_height_m;
  if (is_usual(found.eye_height_m) || in_room < kLowInRoom || in_room > kHighInRoom) return std::nullopt;
  return found;
}

}  // namespace oriel
