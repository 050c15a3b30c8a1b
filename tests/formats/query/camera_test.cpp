#include <gtest/gtest.h>

#include "formats/query/camera.h"

namespace oriel {
namespace {

TEST(Headings, FollowTheirConvention) {
  EXPECT_LT(glm::length(forward_from(0, 0) - Vec3(0, 0, -1)), 1e-6f);
  EXPECT_LT(glm::length(forward_from(kPi / 2, 0) - Vec3(-1, 0, 0)), 1e-6f);
  EXPECT_LT(glm::length(forward_from(0, kPi / 2) - Vec3(0, 1, 0)), 1e-6f);
  for (float yaw = -3; yaw < 3.1f; yaw += 0.37f) {
    for (float pitch = -1.5f; pitch < 1.5f; pitch += 0.29f) {
      const Camera camera = look_at(Vec3(1, 2, 3), Vec3(1, 2, 3) + forward_from(yaw, pitch), 1);
      EXPECT_NEAR(yaw_of(camera), yaw, 1e-4f);
      EXPECT_NEAR(pitch_of(camera), pitch, 1e-4f);
    }
  }
}

TEST(Headings, OfVerticalCamerasComeFromTheirUp) {
  Camera down = look_at(Vec3(0), Vec3(0, -1, 0), 1);
  EXPECT_NEAR(yaw_of(down), 0, 1e-6f);
  EXPECT_NEAR(pitch_of(down), -kPi / 2, 1e-4f);
  down.up = Vec3(-1, 0, 0);
  EXPECT_NEAR(yaw_of(down), kPi / 2, 1e-6f);
  EXPECT_NEAR(yaw_of(look_at(Vec3(0), Vec3(0, 1, 0), 1)), 0, 1e-6f);
}

TEST(Axes, AreOrthonormalForAnyCamera) {
  for (const Vec3& forward :
       {Vec3(0, 0, -1), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(1e-20f, 0, 2e-20f), Vec3(3e18f, 1e18f, 0), Vec3(0)}) {
    for (const Vec3& up : {Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1), Vec3(0)}) {
      Camera camera;
      camera.forward = forward;
      camera.up = up;
      const Mat3 axes = pack_from_eye_axes(camera);
      EXPECT_NEAR(glm::determinant(axes), 1, 1e-5f);
      const Mat3 product = glm::transpose(axes) * axes;
      for (int i = 0; i < 3; ++i) EXPECT_LT(glm::length(product[i] - Mat3(1)[i]), 1e-5f);
      EXPECT_LT(glm::length(axes[2] + normalize_or(forward, Vec3(0, 0, -1))), 1e-5f);
    }
  }
}

TEST(PixelRays, SpanTheFieldOfView) {
  Camera camera = look_at(Vec3(5, 6, 7), Vec3(5, 6, 0), 1.2f);
  const float width = 200, height = 100;
  const PixelRay centre = pixel_ray(camera, 100, 50, width, height);
  EXPECT_EQ(centre.origin, camera.eye);
  EXPECT_LT(glm::length(centre.direction - Vec3(0, 0, -1)), 1e-6f);
  const Vec3 top = pixel_ray(camera, 100, 0, width, height).direction;
  EXPECT_NEAR(std::atan2(top.y, -top.z), 0.6f, 1e-6f);
  const Vec3 right = pixel_ray(camera, 200, 50, width, height).direction;
  EXPECT_NEAR(right.x / -right.z, 2 * std::tan(0.6f), 1e-5f);
  camera.vertical_fov_rad = 0;
  camera.half_height = 2;
  const PixelRay corner = pixel_ray(camera, 0, 0, width, height);
  EXPECT_LT(glm::length(corner.origin - Vec3(5 - 4, 6 + 2, 7)), 1e-5f);
  EXPECT_LT(glm::length(corner.direction - Vec3(0, 0, -1)), 1e-6f);
}

}  // namespace
}  // namespace oriel
