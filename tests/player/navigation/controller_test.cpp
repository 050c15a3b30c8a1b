#include <gtest/gtest.h>

#include <limits>

#include "player/navigation/controller.h"

namespace oriel {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

Camera start() {
  return look_at(Vec3(1, 1.6f, 2), Vec3(1, 1.1f, 1), 1);
}  // to -z and down

MoveInput holding(bool MoveInput::*key) {
  MoveInput input;
  input.*key = true;
  return input;
}

TEST(Controller, WalkingKeepsTheEyesHeight) {
  MoveState state;
  const Camera next = move_camera(start(), state, holding(&MoveInput::forward), 0.1f);
  EXPECT_FLOAT_EQ(next.eye.y, 1.6f);
  EXPECT_NEAR(next.eye.z, 2 - 0.14f, 1e-6f);
  EXPECT_EQ(next.forward, start().forward);
  EXPECT_NEAR(move_camera(start(), state, holding(&MoveInput::right), 0.1f).eye.x, 1.14f, 1e-6f);
  EXPECT_NEAR(move_camera(start(), state, holding(&MoveInput::left), 0.1f).eye.x, 0.86f, 1e-6f);
  EXPECT_EQ(move_camera(start(), state, holding(&MoveInput::up), 0.1f).eye, start().eye);
}

TEST(Controller, FlyingFollowsTheGaze) {
  MoveState state;
  state.fly = true;
  const Camera next = move_camera(start(), state, holding(&MoveInput::forward), 0.1f);
  EXPECT_LT(glm::length(next.eye - (start().eye + 0.14f * start().forward)), 1e-6f);
  EXPECT_NEAR(move_camera(start(), state, holding(&MoveInput::up), 0.1f).eye.y, 1.74f, 1e-6f);
  EXPECT_NEAR(move_camera(start(), state, holding(&MoveInput::down), 0.1f).eye.y, 1.46f, 1e-6f);
}

TEST(Controller, DiagonalsAreNotFasterAndOppositesCancel) {
  MoveState state;
  MoveInput input = holding(&MoveInput::forward);
  input.right = true;
  EXPECT_NEAR(glm::distance(move_camera(start(), state, input, 0.1f).eye, start().eye), 0.14f, 1e-6f);
  input = holding(&MoveInput::forward);
  input.back = true;
  EXPECT_EQ(move_camera(start(), state, input, 0.1f).eye, start().eye);
}

TEST(Controller, SpeedFollowsKeyAndWheelWithinItsLimits) {
  MoveState state;
  MoveInput input = holding(&MoveInput::forward);
  input.fast = true;
  EXPECT_NEAR(glm::distance(move_camera(start(), state, input, 0.1f).eye, start().eye), 0.56f, 1e-5f);
  input = {};
  input.wheel = 2;
  move_camera(start(), state, input, 0.1f);
  EXPECT_NEAR(state.speed_m_s, 1.4f * 1.44f, 1e-5f);
  input.wheel = -1e30f;
  move_camera(start(), state, input, 0.1f);
  EXPECT_FLOAT_EQ(state.speed_m_s, MoveOptions{}.min_speed_m_s);
  input.wheel = 1e30f;
  for (int i = 0; i < 3; ++i) move_camera(start(), state, input, 0.1f);
  EXPECT_FLOAT_EQ(state.speed_m_s, MoveOptions{}.max_speed_m_s);
}

TEST(Controller, TheMouseTurnsAndPitchStopsShortOfVertical) {
  MoveState state;
  MoveInput input;
  input.mouse_x_px = 100;
  const Camera right = move_camera(look_at(Vec3(0), Vec3(0, 0, -1), 1), state, input, 0.01f);
  EXPECT_NEAR(yaw_of(right), -0.25f, 1e-5f);
  EXPECT_GT(right.forward.x, 0);
  input = {};
  input.mouse_y_px = -1e6f;
  const Camera up = move_camera(start(), state, input, 0.01f);
  EXPECT_NEAR(pitch_of(up), MoveOptions{}.max_pitch_rad, 1e-3f);
  EXPECT_NEAR(yaw_of(up), yaw_of(start()), 1e-3f);
  // And back down again: the heading survived.
  input.mouse_y_px = 1e6f;
  EXPECT_NEAR(yaw_of(move_camera(up, state, input, 0.01f)), yaw_of(start()), 1e-2f);
}

TEST(Controller, ARolledCameraStaysRolledUntilItTurns) {
  MoveState state;
  Camera camera = start();
  camera.up = glm::normalize(Vec3(1, 1, 0));
  EXPECT_EQ(move_camera(camera, state, holding(&MoveInput::forward), 0.1f).up, camera.up);
  MoveInput input;
  input.mouse_x_px = 1;
  EXPECT_EQ(move_camera(camera, state, input, 0.1f).up, Vec3(0, 1, 0));
}

TEST(Controller, NothingStrangeGetsThrough) {
  for (const float strange : {0.0f, -1.0f, kNan, kInf, -kInf, 1e30f, 1e-40f}) {
    for (const bool fly : {false, true}) {
      MoveState state;
      state.fly = fly;
      MoveInput input = holding(&MoveInput::forward);
      input.up = true;
      input.mouse_x_px = input.mouse_y_px = input.wheel = strange;
      const Camera next = move_camera(start(), state, input, strange);
      EXPECT_TRUE(is_finite(next.eye)) << strange;
      EXPECT_TRUE(is_finite(next.forward)) << strange;
      EXPECT_NEAR(glm::length(next.forward), 1, 1e-5f) << strange;
      EXPECT_TRUE(std::isfinite(state.speed_m_s)) << strange;
      EXPECT_LE(glm::distance(next.eye, start().eye), 0.1f * MoveOptions{}.max_speed_m_s * 1.001f);
    }
  }
  MoveState state;
  EXPECT_EQ(move_camera(start(), state, holding(&MoveInput::forward), 0).eye, start().eye);
  EXPECT_EQ(move_camera(start(), state, holding(&MoveInput::forward), -5).eye, start().eye);
  state.speed_m_s = kNan;
  EXPECT_TRUE(is_finite(move_camera(start(), state, holding(&MoveInput::forward), 0.1f).eye));
}

TEST(Controller, AStickWalksAsFarAsItIsPushed) {
  MoveState state;
  MoveInput input;
  input.stick = {0, 1, 0.5f};
  EXPECT_NEAR(move_camera(start(), state, input, 0.1f).eye.z, 2 - 0.07f, 1e-6f);
  EXPECT_FLOAT_EQ(move_camera(start(), state, input, 0.1f).eye.y, 1.6f) << "walking nobody rises";
  input.stick = {3, 0, 4};
  EXPECT_NEAR(glm::distance(move_camera(start(), state, input, 0.1f).eye, start().eye), 0.14f, 1e-6f);
  input.forward = input.right = true;
  input.stick = {-1, kNan, kInf};
  EXPECT_NEAR(move_camera(start(), state, input, 0.1f).eye.z, 2 - 0.14f, 1e-6f) << "right and left cancel";
}

// Whatever is done, the centre stays in the middle of the view; distances as told.
TEST(Controller, OrbitsTurnAroundTheirCentre) {
  MoveState state;
  Camera camera = start();
  const Vec3 centre = camera.eye + 2.0f * camera.forward;
  state.orbit = centre;
  const auto moved = [&](const MoveInput& input) {
    camera = move_camera(camera, state, input, 0.1f);
    EXPECT_LT(glm::distance(camera.eye + glm::distance(camera.eye, centre) * camera.forward, centre), 1e-4f);
    return glm::distance(camera.eye, centre);
  };
  MoveInput input;
  input.mouse_x_px = 300;
  input.mouse_y_px = -2000;
  EXPECT_NEAR(moved(input), 2, 1e-4f);
  EXPECT_NEAR(pitch_of(camera), MoveOptions{}.max_pitch_rad, 1e-4f);
  EXPECT_NEAR(moved(holding(&MoveInput::forward)), 2 * std::exp(-0.1f), 1e-4f);
  EXPECT_NEAR(moved(holding(&MoveInput::back)), 2, 1e-4f);
  const float yaw = yaw_of(camera);
  moved(holding(&MoveInput::right));
  EXPECT_NEAR(std::fabs(std::remainder(yaw_of(camera) - yaw, 2 * kPi)), 0.1f, 1e-4f);
  input = {};
  input.wheel = 2;
  EXPECT_NEAR(moved(input), 2 / 1.44f, 1e-4f);
  EXPECT_FLOAT_EQ(state.speed_m_s, 1.4f) << "the wheel is the distance's";
  input.wheel = 1e30f;
  EXPECT_NEAR(moved(input), MoveOptions{}.nearest_orbit_m, 1e-4f);
  input = {};
  input.wheel = input.mouse_x_px = kNan;
  input.stick = {kInf, kNan, -kInf};
  EXPECT_TRUE(is_finite(move_camera(camera, state, input, kInf).eye));
}

}  // namespace
}  // namespace oriel
