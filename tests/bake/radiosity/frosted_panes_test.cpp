// Light that frosted panes spread, on texels: both estimators have it once, and the ledger knows it.
#include <gtest/gtest.h>

#include "bake/radiosity/ledger.h"
#include "formats/core/color.h"
#include "tests/bake/radiosity/baked.h"

namespace oriel {
namespace {

using test::Baked;
using test::SceneParts;

// A room of 4 x 3 x 4 m whose wall at x = 0 has a window of 1.6 x 1.2 m; the sun shines in.
Scene frosted_room(float roughness, bool lamp, bool polished = false) {
  SceneParts parts;
  const std::uint32_t white = parts.diffuse(Vec3(0.6f));
  SceneMaterial glass;
  glass.base_color = {0.9f, 0.8f, 0.7f};
  glass.metallic = 0, glass.roughness = roughness, glass.transmission = 1, glass.double_sided = true;
  SceneMaterial metal;
  metal.base_color = Vec3(0.9f), metal.metallic = 1, metal.roughness = 0.3f;
  parts.quad("floor", polished ? parts.add(metal) : white, {0, 0, 0}, {0, 0, 4}, {4, 0, 0});
  parts.quad("ceiling", white, {0, 3, 0}, {4, 0, 0}, {0, 0, 4});
  parts.quad("right", white, {4, 0, 0}, {0, 0, 4}, {0, 3, 0});
  parts.quad("back", white, {0, 0, 0}, {4, 0, 0}, {0, 3, 0});
  parts.quad("front", white, {0, 0, 4}, {0, 3, 0}, {4, 0, 0});
  for (const auto& [name, o, y, z] :
       {std::tuple("below", Vec3(0), 1.0f, 4.0f), std::tuple("above", Vec3(0, 2.2f, 0), 0.8f, 4.0f),
        std::tuple("beside", Vec3(0, 1, 0), 1.2f, 1.2f), std::tuple("beyond", Vec3(0, 1, 2.8f), 1.2f, 1.2f)}) {
    parts.quad(name, white, o, {0, y, 0}, {0, 0, z});
    parts.quad("outside", white, o, {0, 0, z}, {0, y, 0});
  }
  parts.quad("pane", parts.add(glass), {0, 1, 1.2f}, {0, 1.2f, 0}, {0, 0, 1.6f});
  Light light;
  light.type = lamp ? LightType::kPoint : LightType::kDirectional;
  light.position = {-1, 2, 2}, light.intensity = Vec3(lamp ? 100.0f : 1000.0f);
  light.direction = glm::normalize(Vec3(1, -0.6f, 0.1f));
  parts.scene().lights = {light};
  return parts.finish();
}

double flux(const Baked& b) {
  double sum = 0;
  b.each_texel([&](const LightmapPage& page, std::uint32_t texel, std::uint32_t triangle) {
    const auto& name = b.scene.surfaces[b.scene.triangle_surface[triangle]].name;
    if (name != "outside") sum += luminance(page.irradiance[texel]);
  });
  return sum;
}

class FrostedRooms : public ::testing::TestWithParam<std::tuple<float, bool>> {};

TEST_P(FrostedRooms, BothEstimatorsAndTheLedgerAgree) {
  const auto [roughness, lamp] = GetParam();
  RadiosityOptions cached, reference;
  cached.samples = 128, cached.estimator = Estimator::kCached;
  reference.samples = 128, reference.estimator = Estimator::kReference;
  const Baked b = test::bake(frosted_room(roughness, lamp), 0.2f, cached);
  const double by_paths = flux(test::bake(frosted_room(roughness, lamp), 0.2f, reference));
  EXPECT_NEAR(flux(b) / by_paths, 1, 0.02);
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  ASSERT_FALSE(lights.frosted().empty());
  Context context;
  const Ledger ledger = *keep_ledger({{accel, lights, {}}, b.atlas, b.texel_map}, b.radiosity, 400'000, context);
  EXPECT_LE(ledger.closure(), 4 * ledger.closure_error() + 1e-6);
  EXPECT_LE(ledger.disagreement(), 0.005 + 3 * ledger.disagreement_error());
  EXPECT_LE(ledger.disagreement_error(), 0.01);
}
INSTANTIATE_TEST_SUITE_P(Panes, FrostedRooms,
                         ::testing::Combine(::testing::Values(0.2f, 0.5f, 1.0f), ::testing::Bool()));

// What a glossy floor throws on, cast by particles and found by paths.
TEST(FrostedPanes, GlossyFloorsThrowTheirLightOnOnce) {
  for (const bool lamp : {false, true}) {
    double found[2];
    for (int k = 0; k < 2; ++k) {
      RadiosityOptions options;
      options.samples = k == 0 ? 128 : 512;
      options.estimator = k == 0 ? Estimator::kCached : Estimator::kReference;
      found[k] = flux(test::bake(frosted_room(0.4f, lamp, true), 0.25f, options));
    }
    EXPECT_NEAR(found[0] / found[1], 1, 0.03) << (lamp ? "lamp" : "sun");
  }
}

// A sharp patch has its brightest texels beside dark ones; a frosted window's light has no such step.
TEST(FrostedPanes, BlurThePatchOfTheSun) {
  const auto steepest = [](float roughness) {
    RadiosityOptions options;
    options.samples = 256;
    const Baked b = test::bake(frosted_room(roughness, false), 0.1f, options);
    double brightest = 0;
    b.each_texel([&](const LightmapPage& page, std::uint32_t texel, std::uint32_t triangle) {
      if (b.scene.surfaces[b.scene.triangle_surface[triangle]].name == "floor")
        brightest = std::max(brightest, double{luminance(page.irradiance[texel])});
    });
    return brightest;
  };
  const double clear = steepest(0), frosted = steepest(0.5f);
  EXPECT_GT(clear, 300);            // 1000 lux at 31° high
  EXPECT_LT(frosted, 0.6 * clear);  // spread over four times the floor and the walls
}

}  // namespace
}  // namespace oriel
