// Eyes where there is light, and something to see.
#include "bake/visibility/lit_eyes.h"

#include <gtest/gtest.h>

#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

enum class House { kShell, kWithALamp, kInTheDark, kWithACamera };

// A house of 6 m with thick walls in the sun.
Scene house(House kind) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.7f));
  parts.box("outside", white, {-3.2f, -0.2f, -3.2f}, {3.2f, 3.2f, 3.2f});
  const Vec3 x(6, 0, 0), y(0, 3, 0), z(0, 0, 6);
  parts.quad("floor", white, {-3, 0, 3}, x, -z);
  parts.quad("north", white, {-3, 0, -3}, x, y);
  parts.quad("south", white, {3, 0, 3}, -x, y);
  parts.quad("west", white, {-3, 0, 3}, -z, y);
  parts.quad("east", white, {3, 0, -3}, z, y);
  parts.quad("ceiling", white, {-3, 3, -3}, x, z);
  if (kind == House::kWithALamp) parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(1)), {0, 2.9f, 0}, 0.1f * x, 0.1f * z);
  if (kind != House::kInTheDark)
    parts.scene().lights.push_back(
        {.name = "sun", .type = LightType::kDirectional, .direction = Vec3(0, -1, 0), .intensity = Vec3(20)});
  if (kind == House::kWithACamera) parts.scene().cameras.push_back({.name = "inside", .eye = Vec3(0, 1.6f, 0)});
  return parts.finish();
}

EyeRegion found(const Scene& scene) {
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  Context context;
  EyeRegion region = *find_eye_region(accel, {}, context);
  EXPECT_FALSE(region.grids.empty()) << "the floor inside";
  EXPECT_TRUE(leave_the_dark({accel, lights, {}}, region, context));
  return region;
}

TEST(LitEyes, LeaveAShellThatIsLitFromOutside) {
  const EyeRegion region = found(house(House::kShell));
  EXPECT_TRUE(region.grids.empty());
  ASSERT_FALSE(region.points.empty());
  for (const Vec3& eye : region.points)
    EXPECT_TRUE(std::abs(eye.x) > 3 || eye.y > 3 || eye.y < 0 || std::abs(eye.z) > 3) << "inside it is dark";
  EXPECT_NE(region.note.find("no light reaches the"), std::string::npos) << region.note;
}

TEST(LitEyes, StayWhereThereIsLightOrSomebodyWantsThem) {
  for (const House kind : {House::kWithALamp, House::kInTheDark, House::kWithACamera}) {
    const EyeRegion region = found(house(kind));
    EXPECT_FALSE(region.grids.empty());
    EXPECT_EQ(region.points.size(), kind == House::kWithACamera ? 1u : 0u);
    EXPECT_TRUE(region.note.empty());
  }
}

EyeRegion stood(const Scene& scene) {
  const Accel accel = *Accel::build(scene);
  Context context;
  EyeRegion region = *find_eye_region(accel, {}, context);
  EXPECT_TRUE(stand_around_bodies(accel, region, context));
  return region;
}

// Of a block of 4 m with a slab over a part of its top people who stand there see next to nothing; from around it all
// is.
TEST(LitEyes, StandAroundABodyAlone) {
  SceneParts parts;
  const auto stone = parts.diffuse(Vec3(0.5f));
  parts.box("block", stone, {-2, 0, -2}, {2, 4, 2});
  parts.box("slab", stone, {-2, 6.2f, -2}, {0, 6.4f, 2});
  const Scene scene = parts.finish();
  EXPECT_FALSE(find_eye_region(*Accel::build(scene), {}, *std::make_unique<Context>())->grids.empty()) << "the top";
  const EyeRegion region = stood(scene);
  EXPECT_TRUE(region.grids.empty());
  ASSERT_EQ(region.points.size(), 64u);
  float lowest = 10, highest = -10;
  for (const Vec3& eye : region.points) {
    EXPECT_GT(glm::distance(eye, 0.5f * (scene.lower + scene.upper)), scene.radius());
    lowest = std::min(lowest, eye.y), highest = std::max(highest, eye.y);
  }
  EXPECT_LT(lowest, 0);
  EXPECT_GT(highest, 6.4f);
  EXPECT_NE(region.note.find("from around the scene"), std::string::npos) << region.note;
}

// A house has an inside, with or without a lawn of a hectare around it; a flat without ceilings is seen from within.
TEST(LitEyes, StayInBuildings) {
  EXPECT_FALSE(stood(house(House::kShell)).grids.empty());
  SceneParts lawn, flat;
  const auto white = lawn.diffuse(Vec3(0.7f));
  lawn.quad("lawn", white, {-50, -0.2f, 50}, {100, 0, 0}, {0, 0, -100});
  lawn.box("outside", white, {-3.2f, -0.2f, -3.2f}, {3.2f, 3.2f, 3.2f});
  lawn.quad("floor", white, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
  lawn.quad("ceiling", white, {-3, 3, -3}, {6, 0, 0}, {0, 0, 6});
  EXPECT_FALSE(stood(lawn.finish()).grids.empty());
  flat.diffuse(Vec3(0.7f));
  flat.box("floor", white, {-6, -0.2f, -6}, {6, 0, 6});
  for (const float at : {-6.0f, -2.0f, 2.0f, 5.8f})
    flat.box("wall across", white, {at, 0, -6}, {at + 0.2f, 2.6f, std::abs(at) < 5 ? 4.0f : 6.0f});
  for (const float at : {-6.0f, 5.8f}) flat.box("wall along", white, {-6, 0, at}, {6, 2.6f, at + 0.2f});
  EXPECT_FALSE(stood(flat.finish()).grids.empty());
}

}  // namespace
}  // namespace oriel
