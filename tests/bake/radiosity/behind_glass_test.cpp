// Light through solid glass on texels: what shadow rays pass and what paths find is all of it, and nothing twice.
#include <gtest/gtest.h>

#include "bake/radiosity/ledger.h"
#include "tests/bake/radiosity/baked.h"
#include "tests/bake/support/glass_slab.h"

namespace oriel {
namespace {

using test::Baked;
using test::SceneParts;

enum class Around : std::uint8_t { kLamps, kTexturedLamps, kSky, kSkyImage };

// A floor close under a block of clear glass, and an even light of 1 cd/m² all around: of lamps or the sky, and of the
// floor itself, which the block mirrors.
Scene block_in(Around around) {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0), Vec3(1)), {-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1});
  parts.box("block", parts.add(test::solid_glass()), {-0.45f, 0.02f, -0.45f}, {0.45f, 0.3f, 0.45f});
  if (around == Around::kLamps || around == Around::kTexturedLamps)
    parts.box("lamps", parts.diffuse(Vec3(0), Vec3(1)), Vec3(-1), Vec3(1), true);
  if (around == Around::kTexturedLamps) {
    parts.scene().images = {{"white", 1, 1, {255, 255, 255, 255}}};
    parts.scene().materials.back().emission_texture.image = 0;
  }
  if (around == Around::kSky) parts.scene().sky = Vec3(1);
  if (around == Around::kSkyImage) {
    SkyImage& sky = parts.scene().sky_image = {2, 64, std::vector<Vec3>(128, Vec3(1))};
    std::fill(sky.texels.begin() + 64, sky.texels.end(), Vec3(0.999f));  // one colour alone is not sampled
  }
  return parts.finish();
}

class BehindABlock : public ::testing::TestWithParam<std::tuple<Around, Estimator>> {};

// Glass that absorbs nothing cannot be seen in it.
TEST_P(BehindABlock, EvenLightStaysEven) {
  const auto [around, estimator] = GetParam();
  RadiosityOptions options;
  options.samples = 1024, options.estimator = estimator;
  const Baked b = test::bake(block_in(around), 0.25f, options);
  double sum = 0;
  int texels = 0;
  b.each_texel([&](const LightmapPage& page, std::uint32_t texel, std::uint32_t triangle) {
    if (b.scene.surfaces[b.scene.triangle_surface[triangle]].name != "floor") return;
    sum += page.irradiance[texel].g, ++texels;
  });
  ASSERT_GE(texels, 16);
  EXPECT_NEAR(sum / texels / kPiD, 1, 0.01);
}
INSTANTIATE_TEST_SUITE_P(Lights, BehindABlock,
                         ::testing::Combine(::testing::Values(Around::kLamps, Around::kTexturedLamps, Around::kSky,
                                                              Around::kSkyImage),
                                            ::testing::Values(Estimator::kCached, Estimator::kReference)));

// A room with a block of glass under a lamp, whose light paths and particles bend.
TEST(BehindGlass, ARoomKeepsWhatParticlesBring) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f)), Vec3(0), Vec3(2), true);
  parts.box("block", parts.add(test::solid_glass(1.5f, Vec3(0.5f))), {0.6f, 0.5f, 0.6f}, {1.4f, 0.9f, 1.4f});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(100)), {0.8f, 1.99f, 0.8f}, {0.4f, 0, 0}, {0, 0, 0.4f});
  RadiosityOptions options;
  options.samples = 64, options.estimator = Estimator::kCached;
  const Baked b = test::bake(parts.finish(), 0.1f, options);
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  Context context;
  const Ledger ledger = *keep_ledger({{accel, lights, {}}, b.atlas, b.texel_map}, b.radiosity, 400'000, context);
  EXPECT_LE(ledger.closure(), 4 * ledger.closure_error() + 1e-6);
  EXPECT_LE(ledger.disagreement(), 0.005 + 3 * ledger.disagreement_error());
  EXPECT_LE(ledger.disagreement_error(), 0.005);
}

}  // namespace
}  // namespace oriel
