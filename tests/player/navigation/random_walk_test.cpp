// Ten minutes of wandering about: nobody walks through a wall.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "bake/import/import.h"
#include "bake/visibility/eye_region.h"
#include "player/navigation/controller.h"
#include "player/navigation/floors.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

constexpr int kFrames = 10 * 60 * 60;

struct Wander {
  int crossed = 0;  // steps that a surface is in the way of
  float walked_m = 0;
  float lowest = 0, highest = 0;  // eyes
};

// Holds a key for a while, turns a little each frame, sometimes runs.
Wander wander(const Accel& accel, const EyeRegion& region, unsigned seed) {
  std::mt19937 generator(seed);
  const auto random = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(generator);
  };
  const Floors floors(region.grids);
  Camera camera;
  camera.eye = sample_eyes(region, 1, seed).at(0);
  camera.eye.y = floors.eye_level({camera.eye.x, camera.eye.z}, camera.eye.y + 0.3f).value_or(camera.eye.y);
  MoveState state;
  MoveInput input;
  Wander out{0, 0, camera.eye.y, camera.eye.y};
  float turn = 0;
  for (int i = 0; i < kFrames; ++i) {
    if (i % 40 == 0) {
      input = {};
      (random(0, 1) < 0.8f ? input.forward : random(0, 1) < 0.5f ? input.left : input.back) = true;
      input.fast = random(0, 1) < 0.2f;
      turn = random(-8, 8);
    }
    input.mouse_x_px = turn;
    const Vec3 from = camera.eye;
    camera = move_camera(camera, state, input, 1 / 60.0f);
    camera.eye = floors.walk(from, camera.eye, 1 / 60.0f, state.fall_m_s);
    const Vec3 way = camera.eye - from;
    const float length = glm::length(way);
    out.walked_m += length;
    out.lowest = std::min(out.lowest, camera.eye.y);
    out.highest = std::max(out.highest, camera.eye.y);
    if (length > 1e-5f) out.crossed += static_cast<bool>(accel.intersect({from, way / length, length}));
  }
  return out;
}

EyeRegion region_of(const Accel& accel) {
  Context context;
  auto region = find_eye_region(accel, {}, context);
  EXPECT_TRUE(region);
  return *region;
}

// A hall of two rooms with a door between, and stairs of 3 m along a wall onto a gallery.
TEST(RandomWalk, StaysInTheHallAndTakesTheStairs) {
  test::SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f));
  parts.box("hall", wall, {0, 0, 0}, {10, 6, 6}, true);
  for (int i = 0; i < 12; ++i) {
    const float x = 1 + 0.3f * static_cast<float>(i), y = 0.25f * static_cast<float>(i + 1);
    parts.box("step", wall, {x, 0, 0}, {x + 0.3f, y, 1.5f});
  }
  parts.box("gallery", wall, {4.6f, 2.8f, 0}, {10, 3, 6});
  parts.box("partition", wall, {7, 0, 0}, {7.1f, 2.8f, 4.5f});
  const Scene scene = parts.finish();
  const auto accel = Accel::build(scene);
  ASSERT_TRUE(accel);
  const Wander w = wander(*accel, region_of(*accel), 1);
  EXPECT_EQ(w.crossed, 0);
  EXPECT_GT(w.walked_m, 200);
  EXPECT_NEAR(w.lowest, 1.6f, 0.05f);
  EXPECT_NEAR(w.highest, 4.6f, 0.05f);
}

TEST(RandomWalk, StaysInsideRealScenes) {
  const char* folder = std::getenv("ORIEL_TEST_ASSETS");
  if (folder == nullptr) GTEST_SKIP() << "ORIEL_TEST_ASSETS names no folder of scenes";
  for (const char* name :
       {"bathroom/bathroom.glb", "modern-hall/modern-hall.glb", "wooden-staircase/wooden-staircase.glb"}) {
    Context context;
    const auto imported = import_gltf(std::filesystem::path(folder) / name, {}, context);
    ASSERT_TRUE(imported) << imported.error().text();
    const auto accel = Accel::build(imported->scene);
    ASSERT_TRUE(accel);
    const Wander w = wander(*accel, region_of(*accel), 2);
    std::printf("%s: walked %.0f m, eyes from %.2f to %.2f m\n", name, static_cast<double>(w.walked_m),
                static_cast<double>(w.lowest), static_cast<double>(w.highest));
    EXPECT_EQ(w.crossed, 0) << name;
    EXPECT_GT(w.walked_m, 50) << name;
  }
}

}  // namespace
}  // namespace oriel
