// How tall people are, in rooms of one shape and several sizes.
#include "bake/visibility/eye_height.h"

#include <gtest/gtest.h>

#include "bake/visibility/eye_region.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

// A room of 5 x 2.7 x 4 m with a table and a camera 1.6 m over the floor, all times `size`.
Scene room(float size, bool camera, float camera_height = 1.6f) {
  test::SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f));
  parts.box("room", wall, {0, 0, 0}, size * Vec3(5, 2.7f, 4), true);
  parts.box("table", wall, size * Vec3(2, 0, 1.5f), size * Vec3(3, 0.7f, 2.5f));
  Scene scene = parts.finish();
  if (camera) {
    Camera at;
    at.eye = size * Vec3(1, camera_height, 1);
    scene.cameras = {at};
  }
  return scene;
}

std::optional<EyeHeight> told(const Scene& scene, bool unit_guessed = false) {
  const auto accel = Accel::build(scene);
  EXPECT_TRUE(accel);
  return guess_eye_height(*accel, unit_guessed);
}

TEST(EyeHeightTest, UsualRoomsTellNothing) {
  EXPECT_FALSE(told(room(1, true)));
  EXPECT_FALSE(told(room(1.2f, true)));
  EXPECT_FALSE(told(room(1, false)));
  EXPECT_FALSE(told(room(1, true, 0.4f))) << "a camera at the floor";
  EXPECT_FALSE(told(room(1, true, 2.55f))) << "one under the ceiling";
  EXPECT_FALSE(told(room(2.5f, false))) << "halls are that high, and no camera says otherwise";
}

TEST(EyeHeightTest, CamerasOfLargeAndSmallRoomsTell) {
  for (const float size : {0.5f, 2.5f, 4.0f}) {
    const auto found = told(room(size, true));
    ASSERT_TRUE(found) << size;
    EXPECT_NEAR(found->eye_height_m, 1.6f * size, 1e-3f);
    EXPECT_NEAR(found->room_height_m, 2.7f * size, 0.01f);
    EXPECT_EQ(found->cameras, 1u);
  }
}

TEST(EyeHeightTest, RoomsOfAGuessedUnitTell) {
  const auto found = told(room(3, false), true);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->eye_height_m, 4.8f, 0.05f);
  EXPECT_EQ(found->cameras, 0u);
}

// What people of another size can walk on is the same floor, as many times larger.
TEST(EyeHeightTest, TheirFloorsGoWithThem) {
  double share[2];
  int i = 0;
  for (const float size : {1.0f, 2.5f}) {
    const Scene scene = room(size, true);
    const auto accel = Accel::build(scene);
    ASSERT_TRUE(accel);
    Context context;
    EyeOptions options;
    options.walk = options.walk.scaled(size);
    const auto region = find_eye_region(*accel, options, context);
    ASSERT_TRUE(region);
    ASSERT_FALSE(region->grids.empty());
    EXPECT_FLOAT_EQ(region->grids[0].eye_height_m, 1.6f * size);
    double area = 0;
    for (const WalkGrid& grid : region->grids) area += grid.walkable_m2();
    share[i++] = area / (size * size);
  }
  EXPECT_NEAR(share[0], share[1], 0.02 * share[0]);
}

}  // namespace
}  // namespace oriel
