#include <gtest/gtest.h>

#include <limits>

#include "formats/query/path.h"

namespace oriel {
namespace {

CameraPath corner() {
  return {"corner",
          0.9f,
          {{1, Vec3(0), Vec3(0, 0, -1)}, {2, Vec3(2, 0, 0), Vec3(-1, 0, 0)}, {4, Vec3(2, 4, 0), Vec3(-1, 0, 0)}}};
}

TEST(Path, IsLinearInPositionAndAngle) {
  EXPECT_FLOAT_EQ(path_duration_s(corner()), 3);
  const Camera quarter = camera_on_path(corner(), 0.25f);
  EXPECT_LT(glm::length(quarter.eye - Vec3(0.5f, 0, 0)), 1e-6f);
  EXPECT_LT(glm::length(quarter.forward - Vec3(-std::sin(kPi / 8), 0, -std::cos(kPi / 8))), 1e-6f);
  EXPECT_FLOAT_EQ(quarter.vertical_fov_rad, 0.9f);
  EXPECT_LT(glm::length(camera_on_path(corner(), 2.0f).eye - Vec3(2, 2, 0)), 1e-6f);
}

TEST(Path, KeysAreMetExactlyAndEndsHold) {
  const CameraPath path = corner();
  for (const CameraKey& key : path.keys) {
    EXPECT_EQ(camera_on_path(path, key.time_s - 1).eye, key.eye);
    EXPECT_LT(glm::length(camera_on_path(path, key.time_s - 1).forward - key.forward), 1e-6f);
  }
  const float inf = std::numeric_limits<float>::infinity();
  for (const float early : {-1.0f, -inf, std::numeric_limits<float>::quiet_NaN()})
    EXPECT_EQ(camera_on_path(path, early).eye, Vec3(0));
  for (const float late : {3.0f, 1e30f, inf}) EXPECT_EQ(camera_on_path(path, late).eye, Vec3(2, 4, 0));
}

TEST(Path, DegenerateKeysGiveFiniteCameras) {
  EXPECT_TRUE(is_finite(camera_on_path({}, 1).forward));
  CameraPath path{"odd",
                  1,
                  {{0, Vec3(1), Vec3(0, 0, -1)},
                   {0, Vec3(2), Vec3(0, 0, 1)},
                   {1, Vec3(3), Vec3(0, 0, -1)},
                   {2, Vec3(3), Vec3(0, 1, 0)},
                   {3, Vec3(4), Vec3(0)}}};
  for (float t = -0.5f; t < 3.5f; t += 0.01f) {
    const Camera camera = camera_on_path(path, t);
    ASSERT_TRUE(is_finite(camera.eye) && is_finite(camera.forward)) << t;
    ASSERT_NEAR(glm::length(camera.forward), 1, 1e-5f) << t;
    ASSERT_LT(std::abs(glm::dot(camera.up, camera.forward)), 0.9999999f) << t;
  }
  // Opposite directions turn about the vertical: half way it looks to the side, not up.
  EXPECT_NEAR(camera_on_path(path, 0.5f).forward.y, 0, 1e-6f);
  EXPECT_NEAR(std::abs(camera_on_path(path, 0.5f).forward.x), 1, 1e-6f);
  const CameraPath single{"one", 1, {{5, Vec3(7), Vec3(1, 0, 0)}}};
  EXPECT_EQ(camera_on_path(single, 3).eye, Vec3(7));
  EXPECT_EQ(path_duration_s(single), 0);
}

TEST(Path, TurnsAtConstantSpeedAlsoByTinyAngles) {
  const float angle = 1e-3f;
  const CameraPath path{"tiny", 1, {{0, Vec3(0), Vec3(0, 0, -1)}, {1, Vec3(0), forward_from(angle, 0)}}};
  for (float t = 0; t <= 1; t += 0.125f) EXPECT_NEAR(yaw_of(camera_on_path(path, t)), t * angle, 1e-7f);
}

}  // namespace
}  // namespace oriel
