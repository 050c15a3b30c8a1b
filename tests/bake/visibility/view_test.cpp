// What people see of a scene, how large it is beside them, and which ground they walk on.
#include <gtest/gtest.h>

#include "bake/visibility/scene_unit.h"
#include "bake/visibility/view_importance.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

Accel accel_of(const Scene& scene) {
  auto accel = Accel::build(scene);
  EXPECT_TRUE(accel);
  return std::move(*accel);
}

EyeRegion ground_of(const Scene& scene) {
  Context context;
  auto region = find_eye_region(accel_of(scene), {}, context);
  EXPECT_TRUE(region);
  return *region;
}

double ground_m2(const EyeRegion& region) {
  double area = 0;
  for (const WalkGrid& grid : region.grids) area += grid.walkable_m2();
  return area;
}

// A pavilion of 8 x 8 m: a roof on a wall, on a square lawn.
Scene pavilion(float lawn_m, bool dome) {
  SceneParts parts;
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  parts.quad("lawn", m, {-0.5f * lawn_m, 0, -0.5f * lawn_m}, {0, 0, lawn_m}, {lawn_m, 0, 0});
  parts.box("roof", m, {-4, 3, -4}, {4, 3.2f, 4});
  parts.box("wall", m, {-4, 0, -4}, {4, 3, -3.8f});
  if (dome) parts.sphere("dome", m, Vec3(0), lawn_m, 3, true);
  return parts.finish();
}

TEST(OpenGround, IsWalkedOnOnlyNearARoof) {
  const double small = ground_m2(ground_of(pavilion(30, false))), large = ground_m2(ground_of(pavilion(300, false)));
  EXPECT_GT(small, 100);  // under the roof and 5 m around it
  EXPECT_LT(small, 18.5 * 18.5);
  EXPECT_NEAR(large, small, 0.05 * small);
  EXPECT_GT(ground_of(pavilion(300, false)).left_out_m2, 1000);  // of what is searched
}

TEST(OpenGround, ADomeIsNoRoof) {
  EXPECT_NEAR(ground_m2(ground_of(pavilion(300, true))), ground_m2(ground_of(pavilion(300, false))), 40);
}

TEST(OpenGround, CountsAroundACameraThatStandsThere) {
  Scene scene = pavilion(300, false);
  Camera camera;
  camera.eye = {100, 1.6f, 0};
  camera.vertical_fov_rad = 1;
  scene.cameras.push_back(camera);
  const double area = ground_m2(ground_of(scene));
  EXPECT_GT(area, 500);  // 25 m around the camera, along the floor's two axes: 2 · 25² m²
  EXPECT_LT(area, 2000);
}

// A closed room of 6 x 2.7 x 5 m with a box in it, in some unit.
Scene unit_room(float unit, bool ground = false) {
  SceneParts parts;
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  parts.box("room", m, Vec3(0), unit * Vec3(6, 2.7f, 5), true);
  parts.box("shell", m, unit * Vec3(-0.2f), unit * Vec3(6.2f, 2.9f, 5.2f));
  parts.box("table", m, unit * Vec3(1, 0.6f, 1), unit * Vec3(2, 0.8f, 3));
  if (ground) parts.quad("ground", m, unit * Vec3(-500, -0.2f, -500), unit * Vec3(0, 0, 1000), unit * Vec3(1000, 0, 0));
  return parts.finish();
}

TEST(SceneUnit, IsToldByRooms) {
  for (const auto& [unit, metres] : {std::pair{1000.0f, 0.001}, {100.0f, 0.01}, {0.001f, 1000.0}, {0.01f, 100.0}}) {
    const auto guess = guess_unit(accel_of(unit_room(unit)));
    ASSERT_TRUE(guess) << unit;
    EXPECT_DOUBLE_EQ(guess->metres, metres);
    EXPECT_NEAR(guess->room_height, 2.7 * unit, 0.9 * unit);  // less above the table and below it
  }
}

// Desks in millimetres: from a leg's end the inside of a board of 25 mm is as high as a room of 25 m.
TEST(SceneUnit, BoardsAreNoRooms) {
  for (const float unit : {1000.0f, 100.0f}) {
    SceneParts parts;
    const std::uint32_t m = parts.diffuse(Vec3(0.5f));
    parts.box("office", m, Vec3(0), unit * Vec3(20, 2.7f, 10), true);
    for (int i = 0; i < 12; ++i) {
      const Vec3 at(1.0f + 3.0f * static_cast<float>(i % 6), 0, i < 6 ? 2 : 7);
      parts.box("top", m, unit * (at + Vec3(0, 0.7f, 0)), unit * (at + Vec3(1.6f, 0.725f, 0.8f)));
      for (const float x : {0.0f, 1.55f})
        for (const float z : {0.0f, 0.75f})
          parts.box("leg", m, unit * (at + Vec3(x, 0, z)), unit * (at + Vec3(x + 0.05f, 0.7f, z + 0.05f)));
    }
    const auto guess = guess_unit(accel_of(parts.finish()));
    ASSERT_TRUE(guess) << unit;
    EXPECT_NEAR(guess->metres * unit, 1, 1e-9);
  }
}

TEST(SceneUnit, MetresStay) {
  EXPECT_FALSE(guess_unit(accel_of(unit_room(1))));
  EXPECT_FALSE(guess_unit(accel_of(unit_room(1, true))));  // a wide plane around it tells nothing
  EXPECT_FALSE(guess_unit(accel_of(unit_room(5))));        // a hall
  EXPECT_FALSE(guess_unit(accel_of(pavilion(1000, true))));
}

// Rooms whose ceilings were left out to look in; the only thing with something overhead is the floor below a table.
TEST(SceneUnit, RoomsWithoutCeilingsKeepMetres) {
  SceneParts parts;
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", m, Vec3(0), Vec3(0, 0, 5), Vec3(6, 0, 0));
  for (const auto& [corner, along] : {std::pair{Vec3(0), Vec3(6, 0, 0)},
                                      {Vec3(6, 0, 5), Vec3(-6, 0, 0)},
                                      {Vec3(0, 0, 5), Vec3(0, 0, -5)},
                                      {Vec3(6, 0, 0), Vec3(0, 0, 5)}})
    parts.quad("wall", m, corner, along, Vec3(0, 2.6f, 0));
  parts.box("table", m, Vec3(1, 0.38f, 1), Vec3(3, 0.42f, 3));
  for (const float x : {1.0f, 2.95f})
    for (const float z : {1.0f, 2.95f}) parts.box("leg", m, Vec3(x, 0, z), Vec3(x + 0.05f, 0.38f, z + 0.05f));
  EXPECT_FALSE(guess_unit(accel_of(parts.finish())));
}

// A room with a chair of boxes that touch, a lamp under the ceiling, and a shelf of boards 0.25 m apart.
Scene chair_room(float unit, bool double_sided) {
  SceneParts parts;
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  const auto box = [&](Vec3 low, Vec3 high, bool inward = false) {
    parts.box("box", m, unit * low, unit * high, inward);
  };
  box({0, 0, 0}, {4.2f, 2.6f, 3.6f}, true);
  box({1.4f, 0.42f, 2}, {1.85f, 0.45f, 2.4f});
  box({1.4f, 0.45f, 2.37f}, {1.85f, 0.9f, 2.4f});
  for (const float x : {1.4f, 1.81f})
    for (const float z : {2.0f, 2.36f}) box({x, 0, z}, {x + 0.04f, 0.42f, z + 0.04f});
  for (int i = 0; i < 6; ++i) {
    const float y = 0.25f * static_cast<float>(i);
    box({3, y, 0}, {4, y + 0.02f, 0.3f});
    box({3, y + 0.02f, 0}, {3.02f, y + 0.25f, 0.3f}), box({3.98f, y + 0.02f, 0}, {4, y + 0.25f, 0.3f});
  }
  Scene scene = parts.finish();
  for (auto& material : scene.materials) material.double_sided = double_sided;
  return scene;
}

TEST(SceneUnit, TouchingBoxesAreNoRooms) {
  for (const bool double_sided : {false, true})
    for (const double metres : {0.001, 0.01, 0.0254}) {
      const auto guess = guess_unit(accel_of(chair_room(static_cast<float>(1 / metres), double_sided)));
      ASSERT_TRUE(guess) << metres << double_sided;
      EXPECT_DOUBLE_EQ(guess->metres, metres) << double_sided;
    }
}

TEST(SceneUnit, BoxesOnAFloorKeepMetres) {
  for (const bool double_sided : {false, true}) {
    SceneParts parts;
    const std::uint32_t m = parts.diffuse(Vec3(0.5f));
    parts.quad("floor", m, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
    parts.box("low", m, {0, 0, -0.4f}, {1, 0.4f, 0.4f});
    parts.box("high", m, {0, 0.4f, -0.4f}, {0.3f, 1, 0.4f});
    Scene scene = parts.finish();
    scene.materials[m].double_sided = double_sided;
    EXPECT_FALSE(guess_unit(accel_of(scene))) << double_sided;
    EXPECT_FALSE(guess_unit(accel_of(chair_room(1, double_sided)))) << double_sided;
  }
}

// Rooms 8.5 high may be halls: without a camera that is said, and they stay metres.
TEST(SceneUnit, FeetAreSaid) {
  Scene scene = chair_room(1 / 0.3048f, false);
  const auto guess = guess_unit(accel_of(scene));
  ASSERT_TRUE(guess);
  EXPECT_EQ(guess->metres, 1);
  EXPECT_NEAR(guess->room_height, 2.6 / 0.3048, 0.1);
  scene.cameras = {Camera{}};
  EXPECT_FALSE(guess_unit(accel_of(scene)));
}

// Its seat is as wide as the scene, but no room from within.
TEST(SceneUnit, AChairAloneKeepsMetres) {
  SceneParts parts;
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  parts.box("seat", m, {0, 0.42f, 0}, {0.45f, 0.45f, 0.4f});
  parts.box("back", m, {0, 0.45f, 0.37f}, {0.45f, 0.9f, 0.4f});
  for (const float x : {0.0f, 0.41f})
    for (const float z : {0.0f, 0.36f}) parts.box("leg", m, {x, 0, z}, {x + 0.04f, 0.42f, z + 0.04f});
  EXPECT_FALSE(guess_unit(accel_of(parts.finish())));
}

TEST(SceneUnit, ThingsWithoutRoomsTellNothing) {
  SceneParts parts;
  parts.sphere("ball", parts.diffuse(Vec3(0.5f)), Vec3(0), 0.01f, 2);
  EXPECT_FALSE(guess_unit(accel_of(parts.finish())));
}

// Eyes in the middle of a closed room with a box around it that nobody sees from outside.
TEST(ViewImportance, CountsWhatIsSeen) {
  const Scene scene = unit_room(1);
  const Accel accel = accel_of(scene);
  EyeRegion region;
  region.points = {{3, 1.6f, 2.5f}};
  Context context;
  const auto seen = find_view_importance(accel, region, {.eyes = 16, .directions = 4096}, context);
  ASSERT_TRUE(seen);
  double pixels[3] = {};
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    pixels[scene.triangle_surface[t]] += seen->triangles[t].pixels;
  EXPECT_EQ(pixels[1], 0);  // the shell
  EXPECT_GT(pixels[2], 0);
  EXPECT_EQ(pixels[0] + pixels[2], seen->rays);
  // The walls' solid angle over d²: ∫ dω / d² / 4π, by a rule of its own, without the table.
  double inverse = 0;
  for (const TriangleView& t : seen->triangles) inverse += t.inverse_square;
  const double distance_m = std::sqrt(seen->rays / inverse);
  EXPECT_GT(distance_m, 1);
  EXPECT_LT(distance_m, 2.7);
}

TEST(ViewImportance, FollowsPanesAndOneMirror) {
  SceneParts parts;
  const std::uint32_t grey = parts.diffuse(Vec3(0.5f));
  SceneMaterial glass = parts.scene().materials[grey], mirror = glass;
  glass.transmission = 1, glass.base_color = Vec3(1);
  mirror.metallic = 1, mirror.roughness = 0, mirror.base_color = Vec3(1);
  // The eye looks along -z through a pane onto a mirror, and sees by it what stands behind the eye.
  parts.quad("pane", parts.add(glass), {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
  parts.quad("mirror", parts.add(mirror), {-1, -1, -2}, {2, 0, 0}, {0, 2, 0});
  parts.quad("behind", grey, {-9, -9, 3}, {0, 18, 0}, {18, 0, 0});
  const Scene scene = parts.finish();
  EyeRegion region;
  region.points = {{0, 0, 0}};
  Context context;
  const auto seen = find_view_importance(accel_of(scene), region, {.eyes = 4, .directions = 16384}, context);
  ASSERT_TRUE(seen);
  const auto pixels = [&](std::uint32_t surface) {
    return seen->triangles[2 * surface].pixels + seen->triangles[2 * surface + 1].pixels;
  };
  const auto inverse = [&](std::uint32_t surface) {
    return seen->triangles[2 * surface].inverse_square + seen->triangles[2 * surface + 1].inverse_square;
  };
  const double mirrored = pixels(1);
  EXPECT_GT(mirrored, 0.9 * pixels(0) * 0.295);  // the mirror fills 0.295 of the pane's solid angle as a square at 2 m
  // Seen directly the wall fills more than a quarter of all, from 3 m on; by the mirror from 7 m on.
  const double direct = seen->rays * 0.34;
  EXPECT_NEAR(pixels(2) - mirrored, direct, 0.1 * direct);
  EXPECT_LT(inverse(2), pixels(2) / 9);
}

}  // namespace
}  // namespace oriel
