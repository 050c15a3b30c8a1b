#include <gtest/gtest.h>

#include "scenes/generators.h"
#include "tests/scenes/probe.h"

namespace oriel::sample {
namespace {

using namespace testing;

constexpr RoomOptions kLandscape{.closed = false}, kAlone{.closed = false, .surroundings = false};
constexpr Vec3 kMiddle{3, 1.6f, 3};

const std::string& name_of(const SampleScene& scene, const std::vector<Triangle>& triangles, const Seen& seen) {
  return scene.nodes[triangles[seen.triangle].node].name;
}

TEST(Room, IsSoundWhateverIsAroundIt) {
  for (const RoomOptions& options : {RoomOptions{}, kLandscape, kAlone}) {
    const SampleScene scene = make_room(options);
    for (const Triangle& t : flatten(scene)) ASSERT_EQ(fault(t), "") << scene.nodes[t.node].name;
    EXPECT_EQ(coplanar_overlaps(scene), std::vector<std::string>{});
  }
}

TEST(Room, ClosedItHasNoCameraAndShowsFrontsOnly) {
  const SampleScene scene = make_room();
  EXPECT_TRUE(scene.cameras.empty());
  EXPECT_TRUE(scene.paths.empty());
  const auto triangles = flatten(scene);
  for (const Vec3& direction : directions(1000)) {
    const auto seen = cast(triangles, kMiddle, direction);
    ASSERT_TRUE(seen);
    EXPECT_TRUE(seen->front) << name_of(scene, triangles, *seen);
  }
}

TEST(Room, InALandscapeNoSightLeavesTheDome) {
  const SampleScene scene = make_room(kLandscape);
  const auto triangles = flatten(scene);
  for (const Vec3& direction : directions(500)) {
    const auto seen = cast(triangles, scene.cameras[0].eye, direction);
    ASSERT_TRUE(seen);
    EXPECT_TRUE(seen->front) << name_of(scene, triangles, *seen);
  }
  // Through the window: sky above eye height, ground below.
  for (const float y : {1.2f, 1.5f, 1.7f, 2.0f}) {
    const auto seen = cast(triangles, scene.cameras[1].eye, glm::normalize(Vec3(3, y, 6) - scene.cameras[1].eye));
    ASSERT_TRUE(seen);
    EXPECT_EQ(name_of(scene, triangles, *seen), y < 1.6f ? "ground" : "sky dome") << y;
  }
  // The eye also meets the dome just past the far edge of the ground.
  const Vec3 edge(3, -0.15f, 3 + kGroundSide / 2 + 1), eye(3, 1.6f, 5.9f);
  const auto past = cast(triangles, eye, glm::normalize(edge - eye));
  ASSERT_TRUE(past);
  EXPECT_EQ(name_of(scene, triangles, *past), "sky dome");
}

TEST(Room, TheSurroundingsAreAsLargeAsSaid) {
  const SampleScene scene = make_room(kLandscape);
  double ground = 0, top = 0;
  for (const Triangle& t : flatten(scene)) {
    if (scene.nodes[t.node].name == "ground") ground += 0.5 * glm::length(t.cross());
    if (scene.nodes[t.node].name == "sky dome") top = std::max(top, static_cast<double>(t.p[0].y));
  }
  EXPECT_NEAR(ground, static_cast<double>(kGroundSide) * kGroundSide, 1);
  EXPECT_NEAR(top, kDomeRadius, 1);
}

TEST(Room, TheSurroundingsCanBeLeftOutAndNothingElseChanges) {
  const SampleScene all = make_room(kLandscape), alone = make_room(kAlone);
  ASSERT_EQ(all.nodes.size(), alone.nodes.size() + 2);
  for (std::size_t i = 0; i < alone.nodes.size(); ++i) {
    EXPECT_EQ(all.nodes[i].name, alone.nodes[i].name);
    EXPECT_EQ(all.meshes[all.nodes[i].mesh].positions, alone.meshes[alone.nodes[i].mesh].positions);
  }
  EXPECT_EQ(all.nodes[alone.nodes.size()].name, "ground");
  EXPECT_EQ(all.nodes.back().name, "sky dome");
  EXPECT_EQ(all.cameras.size(), alone.cameras.size());
}

}  // namespace
}  // namespace oriel::sample
