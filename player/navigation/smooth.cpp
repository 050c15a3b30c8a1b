#include "player/navigation/smooth.h"

#include <algorithm>
#include <cmath>

#include "formats/query/camera.h"
#include "formats/query/path.h"

namespace oriel {
namespace {

constexpr int kSteps = 8;  // in a standard deviation
constexpr int kReach = 3;  // standard deviations

struct Pose {
  DVec3 eye{0}, forward{0};
};

Pose pose_of(const CameraPath& path, float time_s) {
  const Camera camera = camera_on_path(path, time_s);
  return {DVec3(camera.eye), DVec3(camera.forward)};
}

// Before the start and after the end: the mirror image through that point.
Pose extended_pose(const CameraPath& path, float time_s) {
  const float end = path_duration_s(path), inside = std::clamp(time_s, 0.0f, end);
  if (inside == time_s) return pose_of(path, time_s);
  const Pose at = pose_of(path, inside), image = pose_of(path, std::clamp(2 * inside - time_s, 0.0f, end));
  return {2.0 * at.eye - image.eye, 2.0 * at.forward - image.forward};
}

}  // namespace

Camera smoothed_camera_on_path(const CameraPath& path, float time_s, float sigma_s) {
  const Camera plain = camera_on_path(path, time_s);
  if (!(sigma_s > 0) || path.keys.size() < 2) return plain;
  const float time = std::clamp(time_s, 0.0f, path_duration_s(path));
  Pose sum;
  double weights = 0;
  for (int i = -kSteps * kReach; i <= kSteps * kReach; ++i) {
    const double x = static_cast<double>(i) / kSteps, weight = std::exp(-0.5 * x * x);
    const Pose pose = extended_pose(path, time + static_cast<float>(x) * sigma_s);
    sum.eye += weight * pose.eye;
    sum.forward += weight * pose.forward;
    weights += weight;
  }
  Camera camera = look_at(Vec3(0), normalize_or(Vec3(sum.forward), plain.forward), plain.vertical_fov_rad);
  camera.name = plain.name;
  camera.eye = Vec3(sum.eye / weights);
  return camera;
}

}  // namespace oriel
