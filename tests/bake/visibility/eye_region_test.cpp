// Where people can stand, in rooms whose floor plans are known.
#include "bake/visibility/eye_region.h"

#include <gtest/gtest.h>

#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

// The scene as the importer leaves it: relative to the middle of its bounds.
Scene centred(Scene scene, const DVec3& world = DVec3(0)) {
  const Vec3 middle = 0.5f * (scene.lower + scene.upper);
  for (Vec3& p : scene.positions) p -= middle;
  for (Camera& c : scene.cameras) c.eye -= middle;
  scene.lower -= middle;
  scene.upper -= middle;
  scene.origin = world + DVec3(middle);
  return scene;
}

EyeRegion region_of(const Scene& scene, const EyeOptions& options = {}, int threads = 2) {
  const auto accel = Accel::build(scene);
  EXPECT_TRUE(accel);
  Context context;
  context.threads = threads;
  auto region = find_eye_region(*accel, options, context);
  EXPECT_TRUE(region);
  return *region;
}

double walkable_m2(const EyeRegion& region) {
  double area = 0;
  for (const WalkGrid& grid : region.grids) area += grid.walkable_m2();
  return area;
}

// Whether a cell of the region holds the point (world x, z) at that floor height.
bool stands(const Scene& scene, const EyeRegion& region, const DVec3& world) {
  const Vec3 p(world - scene.origin);
  for (const WalkGrid& grid : region.grids) {
    const Vec2 at = (Vec2(p.x, p.z) - grid.lower) / grid.cell_m;
    if (at.x < 0 || at.y < 0 || at.x >= static_cast<float>(grid.width) || at.y >= static_cast<float>(grid.height))
      continue;
    const std::size_t c = static_cast<std::size_t>(at.y) * grid.width + static_cast<std::size_t>(at.x);
    if (grid.walkable(c) && std::abs(grid.floor_y[c] - p.y) < 0.05f) return true;
  }
  return false;
}

Camera camera_at(const Vec3& eye) {
  Camera camera;
  camera.eye = eye;
  return camera;
}

// Two rooms of 4 x 4 m and 2.6 m height, side by side along x, a door of 1 m and 2 m height between them if asked for.
SceneParts two_rooms(bool door) {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f));
  parts.box("room", wall, {0, 0, 0}, {8, 2.6f, 4}, true);
  if (door) {
    parts.box("left of door", wall, {3.9f, 0, 0}, {4.1f, 2.6f, 1.5f});
    parts.box("right of door", wall, {3.9f, 0, 2.5f}, {4.1f, 2.6f, 4});
    parts.box("over door", wall, {3.9f, 2, 1.5f}, {4.1f, 2.6f, 2.5f});
  } else {
    parts.box("wall", wall, {3.9f, 0, 0}, {4.1f, 2.6f, 4});
  }
  return parts;
}

TEST(EyeRegion, DoorsLeadFromRoomToRoom) {
  for (const bool door : {true, false}) {
    SceneParts parts = two_rooms(door);
    Scene scene = centred(parts.finish());
    scene.cameras = {camera_at(Vec3(DVec3(1, 1.6, 1) - scene.origin))};
    const EyeRegion region = region_of(scene);
    EXPECT_TRUE(region.note.empty());
    EXPECT_TRUE(stands(scene, region, {2, 0, 2}));
    EXPECT_EQ(stands(scene, region, {6, 0, 2}), door);
    EXPECT_EQ(stands(scene, region, {4, 0, 2}), door) << "in the doorway";
    EXPECT_FALSE(stands(scene, region, {0.1, 0, 2})) << "closer to a wall than a person is wide";
    // A person's radius less on every side, to within a cell each.
    const double expected = door ? 2 * 3.4 * 3.5 + 0.7 * 0.5 : 3.4 * 3.5;
    EXPECT_NEAR(walkable_m2(region), expected, 0.15 * expected);
    for (const Vec3& eye : sample_eyes(region, 400, 3)) {
      const DVec3 world = DVec3(eye) + scene.origin;
      EXPECT_TRUE(world.x > 0 && world.x < (door ? 8 : 3.9) && world.z > 0 && world.z < 4);
      EXPECT_NEAR(world.y, 1.6, 0.2001);
    }
  }
}

TEST(EyeRegion, StairsLeadUpAndTablesDoNot) {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f));
  parts.box("hall", wall, {0, 0, 0}, {10, 6, 6}, true);
  // Twelve steps of 0.25 m by 0.3 m rise along x to a gallery 3 m up, which is a storey over half of the hall.
  for (int i = 0; i < 12; ++i) {
    const float x = 1 + 0.3f * static_cast<float>(i), y = 0.25f * static_cast<float>(i + 1);
    parts.box("step", wall, {x, 0, 0}, {x + 0.3f, y, 1.5f});
  }
  parts.box("gallery", wall, {4.6f, 2.8f, 0}, {10, 3, 6});
  parts.box("table", wall, {6, 0.7f, 2}, {8, 0.75f, 4});
  parts.box("crate", wall, {1, 0, 4}, {2.5f, 0.9f, 5.5f});
  Scene scene = centred(parts.finish());
  scene.cameras = {camera_at(Vec3(DVec3(0.5, 1.6, 3) - scene.origin))};
  const EyeRegion region = region_of(scene);
  EXPECT_TRUE(stands(scene, region, {3, 0, 3}));
  EXPECT_TRUE(stands(scene, region, {9, 0, 5})) << "under the gallery";
  EXPECT_TRUE(stands(scene, region, {2.65, 1.5, 0.7})) << "on the stairs";
  EXPECT_TRUE(stands(scene, region, {7, 3, 3})) << "on the gallery, over the table";
  EXPECT_FALSE(stands(scene, region, {7, 0.75, 3})) << "on the table";
  EXPECT_FALSE(stands(scene, region, {7, 0, 3})) << "under the table";
  EXPECT_FALSE(stands(scene, region, {1.75, 0.9, 4.75})) << "on the crate";
  EXPECT_EQ(region.grids.size(), 2u);
}

// A camera low over a mezzanine, within reach of the hall's floor too: it stands on what is right under it.
TEST(EyeRegion, StartsOnTheFloorRightUnderTheCamera) {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f));
  parts.box("hall", wall, {0, 0, 0}, {10, 6, 6}, true);
  parts.box("mezzanine", wall, {5, 2, 0}, {10, 2.2f, 6});
  Scene scene = centred(parts.finish());
  scene.cameras = {camera_at(Vec3(DVec3(8, 2.7, 3) - scene.origin))};
  const EyeRegion region = region_of(scene);
  EXPECT_TRUE(stands(scene, region, {8, 2.2, 3}));
  EXPECT_FALSE(stands(scene, region, {8, 0, 3}));
  EXPECT_FALSE(stands(scene, region, {2, 0, 3}));
}

TEST(EyeRegion, HeldOutEyesAreNotPlannedFor) {
  SceneParts parts = two_rooms(true);
  Scene scene = centred(parts.finish());
  const Vec3 given(DVec3(1, 1.6, 1) - scene.origin);
  scene.cameras = {camera_at(given)};
  EyeOptions file{EyeSource::kFile, {DVec3(given) + scene.origin}, {}};
  for (const EyeRegion& region : {region_of(scene), region_of(scene, file)}) {
    const auto planned = sample_eyes(region, 256, 1);
    EXPECT_NE(std::find(planned.begin(), planned.end(), given), planned.end());
    for (const Vec3& eye : held_out_eyes(region, 60, 1)) {
      EXPECT_EQ(std::find(planned.begin(), planned.end(), eye), planned.end());
      if (region.grids.empty()) {
        EXPECT_LE(max_component(glm::abs(eye - given)), 0.2001f);
      }
    }
  }
}

TEST(EyeRegion, WithoutCamerasTheLargestRoofedRegion) {
  SceneParts parts = two_rooms(false);
  const auto ground = parts.diffuse(Vec3(0.5f));
  parts.box("narrower", ground, {6.5f, 0, 0}, {8, 2.6f, 4});                // the second room has less floor
  parts.quad("garden", ground, {-20, -0.2f, 30}, {40, 0, 0}, {0, 0, -25});  // and the open ground has most
  const Scene scene = centred(parts.finish());
  const EyeRegion region = region_of(scene);
  EXPECT_TRUE(stands(scene, region, {2, 0, 2}));
  EXPECT_FALSE(stands(scene, region, {5, 0, 2}));
  EXPECT_FALSE(stands(scene, region, {0, -0.2, 15}));
}

TEST(EyeRegion, WithoutAFloorTheBox) {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f));
  parts.quad("wall", wall, {0, 0, 0}, {4, 0, 0}, {0, 3, 0});
  parts.quad("ceiling", wall, {0, 3, 0}, {4, 0, 0}, {0, 0, 4});
  const Scene scene = centred(parts.finish());
  const EyeRegion region = region_of(scene);
  EXPECT_TRUE(region.grids.empty());
  EXPECT_NE(region.note.find("found no floor"), std::string::npos) << region.note;
  for (const Vec3& eye : sample_eyes(region, 100, 1))
    EXPECT_TRUE(glm::all(glm::lessThanEqual(glm::abs(eye), 0.5f * (scene.upper - scene.lower) + 1e-5f)));
}

TEST(EyeRegion, FarFromTheOriginAndOnAnyThreadsTheSame) {
  SceneParts parts = two_rooms(true);
  Scene near = centred(parts.finish()), far = centred(parts.finish(), DVec3(1e6, -1e6, 3e6));
  near.cameras = far.cameras = {camera_at(Vec3(DVec3(1, 1.6, 1) - near.origin))};
  const auto eyes_near = sample_eyes(region_of(near, {}, 1), 100, 5),
             eyes_far = sample_eyes(region_of(far, {}, 3), 100, 5);
  EXPECT_EQ(eyes_near, eyes_far);
  EXPECT_NE(eyes_near, sample_eyes(region_of(near), 100, 6));
  EXPECT_TRUE(stands(far, region_of(far), DVec3(6, 0, 2) + DVec3(1e6, -1e6, 3e6)));
}

TEST(EyeRegion, LargeScenesGetLargerColumns) {
  SceneParts parts;
  parts.quad("plain", parts.diffuse(Vec3(0.5f)), {-500, 0, 500}, {1000, 0, 0}, {0, 0, -1000});
  EyeOptions options;
  options.walk.max_columns = 10000;
  Scene scene = parts.finish();
  const EyeRegion all = region_of(scene, options);
  ASSERT_EQ(all.grids.size(), 1u);
  EXPECT_NEAR(all.grids[0].cell_m, 10, 0.6f);
  EXPECT_NEAR(walkable_m2(all), 1e6, 5e4);
  scene.cameras = {camera_at({100, 1.6f, 0})};
  EXPECT_NEAR(walkable_m2(region_of(scene, options)), 2 * 25 * 25, 200) << "only what is near, along the floor's axes";
}

TEST(EyeRegion, EyesOfAFile) {
  const auto eyes = parse_eyes("# a walk\n 1 2 3 \r\n\n-0.5\t1e1 0\n", "walk.txt");
  ASSERT_TRUE(eyes) << eyes.error().text();
  EXPECT_EQ(*eyes, (std::vector<DVec3>{{1, 2, 3}, {-0.5, 10, 0}}));
  for (const auto& [text, message] : {std::pair{"1 2\n", "walk.txt:1: found '1 2', expected three numbers x y z"},
                                      {"1 2 3\n1 2 3 4", "walk.txt:2"},
                                      {"1 2 nan", "walk.txt:1"},
                                      {"a b c", "walk.txt:1"},
                                      {"# nothing\n", "walk.txt: found no eye"}}) {
    const auto bad = parse_eyes(text, "walk.txt");
    ASSERT_FALSE(bad) << text;
    EXPECT_NE(bad.error().text().find(message), std::string::npos) << bad.error().text();
  }
  SceneParts parts = two_rooms(true);
  const Scene scene = centred(parts.finish(), {1000, 0, 0});
  EyeOptions options{EyeSource::kFile, {{1001, 1.6, 1}, {1002, 1.6, 1}}, {}};
  const auto sampled = sample_eyes(region_of(scene, options), 3, 1);
  EXPECT_EQ(sampled[0], sampled[2]);
  EXPECT_NEAR(sampled[1].x - sampled[0].x, 1, 1e-5);
}

}  // namespace
}  // namespace oriel
