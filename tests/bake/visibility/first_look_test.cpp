// Where a viewer starts without a camera, in rooms whose answer is known.
#include "bake/visibility/first_look.h"

#include <gtest/gtest.h>

#include "bake/visibility/eye_region.h"
#include "formats/query/camera.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

const SurfaceLight kEven = [](const Hit&, const Vec3&) { return Vec3(100); };

FirstLook first_look(const Scene& scene, const SurfaceLight& light = kEven, int threads = 2) {
  const Accel accel = *Accel::build(scene);
  Context context;
  context.threads = threads;
  const auto region = find_eye_region(accel, {}, context);
  EXPECT_TRUE(region);
  const auto first = find_first_look(accel, region->grids, light, context);
  EXPECT_TRUE(first);
  EXPECT_EQ(first->camera.name, "start");
  return *first;
}

// Light on what lies where the condition holds.
SurfaceLight lit_where(const Scene& scene, const std::function<bool(const Vec3&)>& holds) {
  return [&scene, holds](const Hit& hit, const Vec3&) {
    return Vec3(holds(point_on(scene, hit.triangle, hit.barycentric)) ? 100 : 0);
  };
}

SceneParts long_room() {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f));
  parts.box("room", wall, {0, 0, 0}, {12, 2.6f, 4}, true);
  return parts;
}

void expect_clear(const Scene& scene, const Camera& camera) {
  const Accel accel = *Accel::build(scene);
  for (int i = 0; i < 72; ++i) {
    const Hit hit = accel.intersect({camera.eye, forward_from(2 * kPi * static_cast<float>(i) / 72, 0)});
    EXPECT_TRUE(!hit || hit.distance >= 0.5f) << i << ": " << hit.distance;
  }
}

TEST(FirstLook, LooksFromOnePlaceWhereTimeIsOver) {
  const Scene scene = long_room().finish();
  const Accel accel = *Accel::build(scene);
  Context context;
  const auto region = find_eye_region(accel, {}, context);
  std::atomic<int> looks{0};
  const SurfaceLight counted = [&](const Hit&, const Vec3&) { return ++looks, Vec3(100); };
  const auto first = find_first_look(accel, region->grids, counted, context, [] { return true; });
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->inside);
  EXPECT_LT(looks, 5000) << "of 200 000";
}

TEST(FirstLook, StandsInsideAtEyeHeightAndFacesTheLongestSight) {
  const Scene scene = long_room().finish();
  const FirstLook first = first_look(scene);
  EXPECT_TRUE(first.inside);
  EXPECT_NEAR(first.camera.eye.y, 1.6f, 0.01f);
  EXPECT_GT(std::abs(first.camera.forward.x), 0.9f);
  const float ahead = first.camera.forward.x > 0 ? 12 - first.camera.eye.x : first.camera.eye.x;
  EXPECT_GT(ahead, 8);  // from one end to the other
  expect_clear(scene, first.camera);
}

TEST(FirstLook, LooksAtWhatIsLit) {
  const Scene scene = long_room().finish();
  for (const bool left : {true, false}) {
    const FirstLook first = first_look(scene, lit_where(scene, [left](const Vec3& p) { return (p.x < 6) == left; }));
    EXPECT_TRUE(first.inside);
    EXPECT_EQ(first.camera.forward.x < 0, left);
  }
}

TEST(FirstLook, LooksAtWhatThereIsToSee) {
  for (const bool left : {true, false}) {
    SceneParts parts = long_room();
    const auto wood = parts.diffuse(Vec3(0.3f));
    // Along one end's wall: nobody can stand behind them.
    for (int i = 0; i < 6; ++i) {
      const float x = left ? 0.0f : 11.6f, z = 0.65f * static_cast<float>(i);
      parts.box("shelf", wood, {x, 0, z + 0.05f}, {x + 0.4f, 0.6f + 0.3f * static_cast<float>(i), z + 0.6f});
    }
    const FirstLook first = first_look(parts.finish());
    EXPECT_TRUE(first.inside);
    EXPECT_EQ(first.camera.forward.x < 0, left);
  }
}

TEST(FirstLook, AnObjectAloneIsSeenWholeFromItsLitSide) {
  SceneParts parts;
  parts.sphere("ball", parts.diffuse(Vec3(0.5f)), {0, 0, 0}, 0.3f, 3);
  const Scene scene = parts.finish();
  for (const Vec3& lit : {Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(-0.6f, 0, 0.8f)}) {
    const FirstLook first = first_look(scene, lit_where(scene, [&](const Vec3& p) { return glm::dot(p, lit) > 0; }));
    EXPECT_FALSE(first.inside);
    const Camera& camera = first.camera;
    EXPECT_GT(glm::dot(glm::normalize(camera.eye), lit), 0.7f);
    EXPECT_GT(camera.eye.y, 0);
    // The ball's outline stays within the frame.
    const float off = std::asin(0.3f / glm::length(camera.eye)) +
                      std::acos(std::min(glm::dot(camera.forward, -glm::normalize(camera.eye)), 1.0f));
    EXPECT_LT(off, 0.5f * camera.vertical_fov_rad);
  }
}

// A floor alone does not make a place to look from: nothing is seen from there.
TEST(FirstLook, NobodyStartsOnTopOfABlock) {
  SceneParts parts;
  const auto stone = parts.diffuse(Vec3(0.5f));
  parts.box("block", stone, {0, 0, 0}, {2, 2, 2});
  const FirstLook first = first_look(parts.finish());
  EXPECT_FALSE(first.inside);
  EXPECT_GT(first.camera.eye.y, 2);
}

TEST(FirstLook, ADarkSceneHasAStartToo) {
  const FirstLook first = first_look(long_room().finish(), [](const Hit&, const Vec3&) { return Vec3(0); });
  EXPECT_TRUE(first.inside);
  EXPECT_GT(std::abs(first.camera.forward.x), 0.9f);
}

TEST(FirstLook, ThreadsDoNotMatter) {
  const Scene scene = long_room().finish();
  const Camera one = first_look(scene, kEven, 1).camera, two = first_look(scene, kEven, 2).camera;
  EXPECT_EQ(one.eye, two.eye);
  EXPECT_EQ(one.forward, two.forward);
}

}  // namespace
}  // namespace oriel
