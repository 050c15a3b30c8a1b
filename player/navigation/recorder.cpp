#include "player/navigation/recorder.h"

#include <algorithm>

namespace oriel {
namespace {

constexpr float kOrthographicFov = kPi / 3;

bool same_pose(const CameraKey& a, const CameraKey& b) {
  return a.eye == b.eye && a.forward == b.forward;
}

}  // namespace

CameraPath start_recording(const Camera& camera) {
  const float fov = camera.vertical_fov_rad > 0 ? camera.vertical_fov_rad : kOrthographicFov;
  return {"walk", fov, {{0, camera.eye, camera.forward}}};
}

void record(const Camera& camera, float dt_s, CameraPath& path) {
  std::vector<CameraKey>& keys = path.keys;
  const CameraKey key{keys.back().time_s + std::max(dt_s, 0.0f), camera.eye, camera.forward};
  const std::size_t n = keys.size();
  if (n >= 2 && same_pose(keys[n - 1], key) && same_pose(keys[n - 2], key)) {
    keys.back().time_s = key.time_s;
  } else {
    keys.push_back(key);
  }
}

}  // namespace oriel
