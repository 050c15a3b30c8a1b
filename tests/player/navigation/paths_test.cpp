// Walks: as files, as recorded, without jerks.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "formats/core/file.h"
#include "formats/query/path.h"
#include "player/navigation/path_file.h"
#include "player/navigation/recorder.h"
#include "player/navigation/smooth.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

Camera camera_at(const Vec3& eye, const Vec3& forward = {0, 0, -1}) {
  Camera camera;
  camera.eye = eye;
  camera.forward = forward;
  return camera;
}

// Straight ahead for a second at 1 m/s, then still for another.
CameraPath ahead_and_still() {
  return {"walk", 1, {{0, {0, 0, 0}, {0, 0, -1}}, {1, {1, 0, 0}, {0, 0, -1}}, {2, {1, 0, 0}, {0, 0, -1}}}};
}

class PathFile : public ::testing::Test {
 protected:
  Result<CameraPath> read(const std::string& text) {
    EXPECT_TRUE(write_file_atomically(file_, std::as_bytes(std::span(text))));
    return read_path(file_, origin_);
  }
  oriel::testing::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "walk.json";
  const DVec3 origin_{1e6, 3, -250000};
};

TEST_F(PathFile, ComesBackAsItWas) {
  CameraPath path = ahead_and_still();
  path.keys[1].forward = glm::normalize(Vec3(1, -0.3f, 0.2f));
  ASSERT_TRUE(write_path(file_, path, origin_));
  const auto read = read_path(file_, origin_);
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->name, "walk");
  EXPECT_FLOAT_EQ(read->vertical_fov_rad, path.vertical_fov_rad);
  ASSERT_EQ(read->keys.size(), path.keys.size());
  for (std::size_t i = 0; i < path.keys.size(); ++i) {
    EXPECT_EQ(read->keys[i].time_s, path.keys[i].time_s);
    EXPECT_EQ(read->keys[i].eye, path.keys[i].eye);
    EXPECT_LT(glm::length(read->keys[i].forward - path.keys[i].forward), 1e-6f);
  }
  EXPECT_EQ(read_path(file_, origin_ + DVec3(1, 0, 0))->keys[0].eye, Vec3(-1, 0, 0)) << "of another pack";
}

TEST_F(PathFile, WhatIsWrongIsNamed) {
  EXPECT_EQ(read_path(folder_.path() / "absent.json", origin_).error().code, ErrorCode::kIo);
  const std::string head = R"({"oriel_path": 1, "vertical_fov_deg": 60, "keys": [)";
  const std::string key = R"({"t": 1, "eye": [0, 0, 0], "forward": [0, 0, -1]})";
  ASSERT_TRUE(read(head + key + "]}"));
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "JSON"},
      {"[]", "oriel_path"},
      {"{}", "oriel_path"},
      {R"({"oriel_path": 2})", "version 2"},
      {R"({"oriel_path": 1, "vertical_fov_deg": 180, "keys": []})", "180"},
      {R"({"oriel_path": 1, "vertical_fov_deg": 60, "keys": []})", "keys"},
      {head + key + R"(, {"t": 0.5, "eye": [0, 0, 0], "forward": [0, 0, -1]}]})", "key 1: found a time of 0.5"},
      {head + R"({"t": 0, "eye": [0, 0, 0], "forward": [0, 0, 0]}]})", "direction"},
      {head + R"({"t": 0, "eye": [0, 0], "forward": [0, 0, 1]}]})", "eye"},
      {head + R"({"t": 0, "eye": [1e300, 0, 0], "forward": [0, 0, 1]}]})", "far"},
      {head + R"({"t": 1e300, "eye": [0, 0, 0], "forward": [0, 0, 1]}]})", "time"},
      {head + R"({"t": "now", "eye": [0, 0, 0], "forward": [0, 0, 1]}]})", "\"t\""},
      {head + "7]}", "\"t\""}};
  for (const auto& [text, says] : cases) {
    const auto path = read(text);
    ASSERT_FALSE(path) << text;
    EXPECT_EQ(path.error().code, ErrorCode::kInvalid);
    EXPECT_NE(path.error().text().find(says), std::string::npos) << path.error().text() << " of " << text;
  }
}

TEST(Recorder, WalksAndRests) {
  CameraPath path = start_recording(camera_at({0, 0, 0}));
  record(camera_at({1, 0, 0}), 0.5f, path);
  for (int i = 0; i < 100; ++i) record(camera_at({1, 0, 0}), 0.25f, path);
  record(camera_at({2, 0, 0}), 0.5f, path);
  ASSERT_EQ(path.keys.size(), 4u) << "a rest is two keys";
  EXPECT_FLOAT_EQ(path_duration_s(path), 26);
  EXPECT_EQ(camera_on_path(path, 13).eye, Vec3(1, 0, 0));
  EXPECT_FLOAT_EQ(camera_on_path(path, 25.75f).eye.x, 1.5f);
  Camera plan = camera_at({0, 0, 0});
  plan.vertical_fov_rad = 0;
  EXPECT_GT(start_recording(plan).vertical_fov_rad, 0);
}

TEST(Smooth, KeepsEndsAndSteadyMoves) {
  const CameraPath path = ahead_and_still();
  EXPECT_LT(glm::length(smoothed_camera_on_path(path, 0, 0.2f).eye), 1e-6f);
  EXPECT_LT(glm::length(smoothed_camera_on_path(path, 2, 0.2f).eye - Vec3(1, 0, 0)), 1e-6f);
  EXPECT_NEAR(smoothed_camera_on_path(path, 0.3f, 0.1f).eye.x, 0.3f, 1e-6f) << "no corner within three deviations";
  EXPECT_EQ(smoothed_camera_on_path(path, 0.9f, 0).eye, camera_on_path(path, 0.9f).eye);
}

// At a corner the mean over a Gaussian of min(t, 0) is -σ E max(Z, 0) = -σ / √(2π); half of the turn there.
TEST(Smooth, RoundsACornerAsAGaussianDoes) {
  const float sigma = 0.2f;
  const Camera camera = smoothed_camera_on_path(ahead_and_still(), 1, sigma);
  EXPECT_NEAR(camera.eye.x, 1 - sigma / std::sqrt(2 * kPi), 0.005f * sigma);
  const CameraPath turn{
      "turn",
      1,
      {{0, Vec3(0), {0, 0, -1}}, {1, Vec3(0), {0, 0, -1}}, {1, Vec3(0), {1, 0, 0}}, {2, Vec3(0), {1, 0, 0}}}};
  const Vec3 half = smoothed_camera_on_path(turn, 1, sigma).forward;
  EXPECT_NEAR(glm::length(half), 1, 1e-6f);
  EXPECT_NEAR(std::atan2(half.x, -half.z), kPi / 4, 0.1f) << "one of 49 samples lies on the jump itself";
}

TEST(Smooth, HoldsOnNothing) {
  EXPECT_EQ(smoothed_camera_on_path({}, 1, 1).eye, Vec3(0));
  const CameraPath one{"one", 1, {{5, {1, 2, 3}, {0, 0, -1}}}};
  EXPECT_EQ(smoothed_camera_on_path(one, 9, 100).eye, Vec3(1, 2, 3));
  const Camera nowhen = smoothed_camera_on_path(ahead_and_still(), std::numeric_limits<float>::quiet_NaN(), 1);
  EXPECT_TRUE(is_finite(nowhen.eye));
}

}  // namespace
}  // namespace oriel
