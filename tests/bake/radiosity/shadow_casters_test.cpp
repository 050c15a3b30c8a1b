// What is in the way of sharp light, told without a ray.
#include "bake/radiosity/shadow_casters.h"

#include <gtest/gtest.h>

#include "tests/bake/radiosity/baked.h"

namespace oriel {
namespace {

using test::SceneParts;

constexpr double kThickness = 1e-5;  // up to which things lie in a plane, m

// A square of 20 cm at a place on z = -1 that looks along z.
ShadowBeam beam_from(const DVec3& middle, const Light& light) {
  return {light,
          {middle + DVec3(-0.1, -0.1, 0), middle + DVec3(0.1, -0.1, 0), middle + DVec3(0.1, 0.1, 0),
           middle + DVec3(-0.1, 0.1, 0)},
          {0, 0, 1},
          kThickness};
}

Light lamp() {
  Light light;
  light.position = {0, 1.5f, 3}, light.intensity = Vec3(100);
  return light;
}

// In z = 0 two sheets side by side, `gap` apart, and a box before them that hides a part.
Scene sheets(float gap) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.5f));
  parts.quad("left", matt, {-2, 0, 0}, {2.5f, 0, 0}, {0, 3, 0});
  parts.quad("right", matt, {0.5f + gap, 0, 0}, {1.5f, 0, 0}, {0, 3, 0});
  parts.box("box", matt, {-0.02f, 1.4f, 0.5f}, {0.02f, 1.6f, 0.6f});
  parts.scene().lights = {lamp()};
  return parts.finish();
}

bool is_dark(const Scene& scene, const DVec3& middle) {
  const std::array<std::uint32_t, 1> lights{0};
  const ShadowCasters casters(scene, lights);
  const ShadowBeam beam = beam_from(middle, scene.lights[0]);
  return casters.stop_all(beam, casters.in(beam, 0), 0);
}

TEST(ShadowCasters, StopAllBehindASheetWithoutAnEndInTheBeam) {
  const Scene one = sheets(0), parted = sheets(0.001f);
  EXPECT_TRUE(is_dark(one, {0, 1.5, -1}));      // behind its diagonal and the box
  EXPECT_TRUE(is_dark(one, {0.667, 1.5, -1}));  // behind an edge that two quads share
  EXPECT_FALSE(is_dark(parted, {0.667, 1.5, -1}));
  EXPECT_FALSE(is_dark(one, {2.667, 1.5, -1}));  // across the sheet's end
  EXPECT_FALSE(is_dark(one, {3.5, 1.5, -1}));    // beside it
  EXPECT_FALSE(is_dark(one, {0, 1.5, 0.2}));     // before it, the box in the way of some rays
}

TEST(ShadowCasters, StopNotAllWhereASheetPassesThroughTheSquare) {
  SceneParts parts;
  parts.quad("sheet", parts.diffuse(Vec3(0.5f)), {-2, 1.55f, -2}, {4, 0, 0}, {0, -0.1f, 6});
  parts.scene().lights = {lamp()};
  const Scene scene = parts.finish();
  EXPECT_FALSE(is_dark(scene, {0, 1.533, -1}));
  EXPECT_TRUE(is_dark(scene, {0, 1.3, -1}));  // all under it, where it goes on behind the square's plane
}

// Two sides of the box are edge-on but for rounding, and show no edge of their own.
TEST(ShadowCasters, WhatIsEdgeOnIsNotInTheWay) {
  for (const float turn : {-1e-8f, 0.0f, 1e-8f}) {
    SceneParts parts;
    parts.box("box", parts.diffuse(Vec3(0.5f)), {-0.5f, 1, 0.5f}, {0.5f, 2, 1.5f});
    Light sun;
    sun.type = LightType::kDirectional;
    sun.direction = glm::normalize(Vec3(turn, -0.5f, -1)), sun.angular_radius_rad = 0.00465f;
    parts.scene().lights = {sun};
    const Scene scene = parts.finish();
    const std::array<std::uint32_t, 1> lights{0};
    const ShadowCasters casters(scene, lights);
    const ShadowBeam wide(sun, {DVec3(-3, -3, -1), DVec3(3, -3, -1), DVec3(3, 3, -1), DVec3(-3, 3, -1)}, {0, 0, 1},
                          kThickness);
    const std::vector<std::uint32_t> found = casters.in(wide, 0);
    EXPECT_EQ(found.size(), 4u) << turn;  // its front and its top
    int ends = 0;
    for (const std::uint32_t t : found)
      for (std::size_t k = 0; k < 3; ++k) ends += casters.ends_shadow(t, k, 0) ? 1 : 0;
    EXPECT_EQ(ends, 6) << turn;  // the outline
  }
}

}  // namespace
}  // namespace oriel
