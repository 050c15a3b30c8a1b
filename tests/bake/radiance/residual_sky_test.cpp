// What of a sky the maps miss: black ones too, as holes would be filled with the light beside them.
#include <gtest/gtest.h>

#include "bake/radiance/capture.h"
#include "bake/radiance/residual.h"
#include "bake/radiance/samples.h"
#include "tests/bake/radiance/uniform_views.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

// A mirror that looks at a panel under the sky.
Scene terrace(const Vec3& sky, bool panel, bool image) {
  test::SceneParts parts;
  parts.add(SceneMaterial{});
  parts.diffuse(Vec3(0.5f));
  parts.quad("mirror", 0, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  if (panel) parts.quad("panel", 1, {0.7f, -2, 2}, {-1.4f, 0, 0}, {0, 4, 0});
  Scene scene = parts.finish();
  scene.sky = sky;
  if (image) scene.sky_image = {2, 1, {sky, sky}};
  scene.lower = Vec3(-10);
  scene.upper = Vec3(10);
  return scene;
}

std::vector<FoundReflector> mirror_of(const Accel& accel) {
  std::vector<ReflectorMaterial> materials(accel.scene().materials.size(), ReflectorMaterial{1, Vec3(0), 0});
  materials[0] = {0, Vec3(0.9f), 1};
  ReflectorOptions options;
  options.min_open_share = 0;
  return find_reflectors(accel, materials, options).reflectors;
}

// In a row before the panel.
std::vector<Vec3> eyes_before() {
  std::vector<Vec3> eyes;
  for (int i = 0; i < 200; ++i) eyes.emplace_back(-1.5f + 3.0f * static_cast<float>(i) / 199, 0, 1.5f);
  return eyes;
}

TEST(SkySamples, ABlackSkyCountsBesideSurfacesAlone) {
  for (const bool panel : {false, true}) {
    const Scene scene = terrace(Vec3(0), panel, false);
    const auto accel = Accel::build(scene);
    ASSERT_TRUE(accel);
    const auto reflectors = mirror_of(*accel);
    ASSERT_EQ(reflectors.size(), 1u);
    Context context;
    const auto samples =
        sample_reflections(ReflectedSurroundings(*accel, reflectors, {}), 0, {eyes_before(), 500, 1}, context);
    ASSERT_TRUE(samples);
    const auto skies = std::count_if(samples->begin(), samples->end(), [](const auto& s) { return s.sky; });
    EXPECT_EQ(samples->empty(), !panel);
    EXPECT_EQ(skies > 0, panel);
  }
}

// One map cannot see the sky behind the panel; its residual has it, an image at infinity.
TEST(SkySamples, ResidualsHoldTheSkyBehindThings) {
  for (const Vec3& sky : {Vec3(0), Vec3(3, 4, 5)}) {
    const Scene scene = terrace(sky, true, true);
    const auto accel = Accel::build(scene);
    ASSERT_TRUE(accel);
    auto reflectors = mirror_of(*accel);
    ViewOptions options;
    options.map_resolution = 64;
    options.views_per_element = 1;
    ViewPlan plan = plan_views(scene, reflectors, options);
    ASSERT_EQ(plan.maps.size(), 1u);
    const std::vector<FoundReflector> as_planned = reflectors;
    const ReflectedSurroundings surroundings(*accel, as_planned, {});
    const OutgoingRadiance outgoing = [](const SeenSurface&) { return Vec3(100); };
    Context context;
    ASSERT_TRUE(capture_maps({surroundings, outgoing}, context, plan.maps));
    const auto eyes = eyes_before();
    const auto samples = sample_reflections(surroundings, 0, {eyes, 2000, 7}, context);
    ASSERT_TRUE(samples);
    std::vector<ReflectedSample> skies;
    for (const ReflectedSample& s : *samples)
      if (s.image.w == 0) skies.push_back(s);
    ASSERT_GT(skies.size(), 100u);
    const double before = judge_maps(surroundings, plan.maps, skies, context).seen;
    double total = 0, hidden = 0;  // in line with the map's eye, behind the panel
    for (const ReflectedSample& s : skies) {
      const Vec2 pixel = map_pixel(plan.maps[0], s) / Vec2(plan.maps[0].width, plan.maps[0].height);
      const bool in_window = std::min(pixel.x, pixel.y) >= 0 && std::max(pixel.x, pixel.y) < 1;
      total += s.weight;
      if (in_window && judge_maps(surroundings, plan.maps, {&s, 1}, context).seen == 0) hidden += s.weight;
    }
    ASSERT_TRUE(add_residuals({surroundings, outgoing}, {.eyes = eyes}, context, reflectors, plan));
    ASSERT_EQ(plan.maps.size(), 2u);
    const ViewQuality after = judge_maps(surroundings, plan.maps, skies, context);
    EXPECT_GT(hidden, 0.05 * total);
    EXPECT_GT(after.residual, 0.9 * hidden / total);
    EXPECT_NEAR(after.seen - before, after.residual, 1e-9);
    const RadianceMap& residual = plan.maps[1];
    EXPECT_GT(std::count(residual.valid.begin(), residual.valid.end(), 2), 10);
    for (std::size_t i = 0; i < residual.valid.size(); ++i) {
      if (residual.valid[i] != 2) continue;
      EXPECT_EQ(residual.disparity[i], 0);
      EXPECT_EQ(residual.radiance[i], sky);
    }
  }
}

}  // namespace
}  // namespace oriel
