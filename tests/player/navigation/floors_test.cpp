// Walking on grids whose floors are known.
#include "player/navigation/floors.h"

#include <gtest/gtest.h>

#include <limits>

namespace oriel {
namespace {

constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();

// Cells of 0.25 m from (0, 0), rows along x.
WalkGrid grid_of(std::uint32_t width, const std::vector<float>& floors) {
  WalkGrid grid;
  grid.cell_m = 0.25f;
  grid.width = width;
  grid.height = static_cast<std::uint32_t>(floors.size()) / width;
  grid.floor_y = floors;
  return grid;
}

// A floor of 10 x 10 cells.
WalkGrid square() {
  return grid_of(10, std::vector<float>(100, 0.0f));
}

Vec3 walk_for(const Floors& floors, Vec3 eye, const Vec3& by, int steps) {
  float fall = 0;
  for (int i = 0; i < steps; ++i) eye = floors.walk(eye, eye + by, 1 / 60.0f, fall);
  return eye;
}

TEST(Floors, WallsStopAndLetSlide) {
  const Floors floors({square()});
  const Vec3 end = walk_for(floors, {1, 1.6f, 1}, {0.05f, 0, 0.02f}, 40);
  EXPECT_LT(end.x, 2.5f);
  EXPECT_GT(end.x, 2.2f);
  EXPECT_NEAR(end.z, 1.8f, 0.01f) << "along the wall it goes on";
  EXPECT_FLOAT_EQ(end.y, 1.6f);
}

TEST(Floors, AFastStepDoesNotJumpAGap) {
  std::vector<float> floors(40, 0.0f);
  floors[20] = kNowhere;
  const Vec3 end = walk_for(Floors({grid_of(40, floors)}), {1, 1.6f, 0.1f}, {8, 0, 0}, 1);
  EXPECT_LT(end.x, 5.0f);
  EXPECT_GT(end.x, 4.7f);
}

TEST(Floors, StairsClimbAndLedgesHold) {
  std::vector<float> floors;
  for (int i = 0; i < 20; ++i) floors.push_back(i < 5 ? 0 : i < 15 ? 0.25f * static_cast<float>(i - 4) : 4.0f);
  const Floors stairs({grid_of(20, floors)});
  const Vec3 top = walk_for(stairs, {0.2f, 1.6f, 0.1f}, {0.02f, 0, 0}, 400);
  EXPECT_NEAR(top.x, 15 * 0.25f, 0.03f) << "a wall of 1.5 m";
  EXPECT_NEAR(top.y, 2.5f + 1.6f, 0.01f);
  const Vec3 bottom = walk_for(stairs, top, {-0.02f, 0, 0}, 400);
  EXPECT_LT(bottom.x, 0.1f);
  EXPECT_NEAR(bottom.y, 1.6f, 0.01f);
  EXPECT_GT(walk_for(stairs, {4, 5.6f, 0.1f}, {-0.02f, 0, 0}, 400).x, 15 * 0.25f - 1e-4f) << "not over the ledge";
}

TEST(Floors, OneInTheAirFallsOntoTheFloor) {
  const Floors floors({square()});
  float fall = 0;
  Vec3 eye(1, 6.5f, 1);  // 4.9 m up: one second
  for (int i = 0; i < 54; ++i) eye = floors.walk(eye, eye, 1 / 60.0f, fall);
  EXPECT_NEAR(eye.y, 6.5f - 4.905f * 0.81f, 0.15f);
  for (int i = 0; i < 60; ++i) eye = floors.walk(eye, eye, 1 / 60.0f, fall);
  EXPECT_NEAR(eye.y, 1.6f, 1e-3f);
  EXPECT_EQ(fall, 0);
}

TEST(Floors, ACameraAtTheWallComesOntoTheFloorAndNothingTraps) {
  const Floors floors({square()});
  float fall = 0;
  const Vec3 beside(2.9f, 1.6f, 1);
  EXPECT_EQ(floors.walk(beside, beside + Vec3(0.1f, 0, 0), 0.1f, fall), beside);
  EXPECT_EQ(floors.walk(beside, beside - Vec3(0.1f, 0, 0), 0.1f, fall), beside - Vec3(0.1f, 0, 0));
  const Vec3 outside(50, 1.6f, 1);
  EXPECT_EQ(floors.walk(outside, outside + Vec3(1, 0, 0), 0.1f, fall).x, 51) << "far from any floor";
  EXPECT_EQ(Floors({}).walk(outside, beside, 0.1f, fall), beside) << "a pack without floors";
}

// A camera at a table's height, beside the floor: it slides along the edge, comes onto the floor and rises, and does
// not leave the room.
TEST(Floors, ALowCameraInACornerStaysInTheRoom) {
  const Floors floors({square()});
  float fall = 0;
  Vec3 eye(2.9f, 0.7f, 1);
  EXPECT_EQ(floors.walk(eye, eye + Vec3(0.1f, 0, 0), 0.1f, fall), eye) << "out of the room";
  const Vec3 slid = floors.walk(eye, eye + Vec3(0.1f, 0, -0.1f), 0.1f, fall);
  EXPECT_LE(slid.x, 2.9f);
  for (int i = 0; i < 60; ++i) eye = floors.walk(eye, eye - Vec3(0.02f, 0, 0), 1 / 60.0f, fall);
  EXPECT_LT(eye.x, 2);
  EXPECT_NEAR(eye.y, 1.6f, 0.01f);
}

TEST(Floors, OfTwoStoreysTheOneBelowTheFeet) {
  WalkGrid upper = square();
  upper.floor_y.assign(100, 3.0f);
  const Floors floors({square(), upper});
  EXPECT_FLOAT_EQ(*floors.eye_level({1, 1}, 1.6f), 1.6f);
  EXPECT_FLOAT_EQ(*floors.eye_level({1, 1}, 4.6f), 4.6f);
  EXPECT_FLOAT_EQ(*floors.eye_level({1, 1}, 4.0f), 1.6f);
}

}  // namespace
}  // namespace oriel
