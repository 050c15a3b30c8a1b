// Eyes where there is light.
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

}  // namespace
}  // namespace oriel
