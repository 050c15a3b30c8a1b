// What of a sky the maps miss: black ones too, as holes would be filled with the light beside them.
#include <gtest/gtest.h>

#include "bake/radiance/samples.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

// A mirror that looks at a panel under the sky.
Scene terrace(bool panel) {
  test::SceneParts parts;
  parts.add(SceneMaterial{});
  parts.diffuse(Vec3(0.5f));
  parts.quad("mirror", 0, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  if (panel) parts.quad("panel", 1, {0.7f, -2, 2}, {-1.4f, 0, 0}, {0, 4, 0});
  Scene scene = parts.finish();
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
    const Scene scene = terrace(panel);
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

}  // namespace
}  // namespace oriel
