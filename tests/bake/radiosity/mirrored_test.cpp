// Lights in mirrors on texels: the light, its edges, and that nothing is found twice.
#include <gtest/gtest.h>

#include "bake/radiosity/ledger.h"
#include "formats/core/color.h"
#include "tests/bake/radiosity/baked.h"
#include "tests/bake/support/glass_slab.h"

namespace oriel {
namespace {

using test::Baked;
using test::SceneParts;

SceneMaterial mirror(float reflectance) {
  SceneMaterial m;
  m.base_color = Vec3(reflectance);
  m.metallic = 1, m.roughness = 0;
  return m;
}

// The sun over a floor mirror of 1 m² under a ceiling at 2 m.
Scene sunny(float albedo = 0) {
  SceneParts parts;
  parts.quad("mirror", parts.add(mirror(0.9f)), {-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1});
  parts.quad("ceiling", parts.diffuse(Vec3(albedo)), {0, 2, -1}, {2.5f, 0, 0}, {0, 0, 2});
  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = {0.5f, -std::sqrt(0.75f), 0};
  sun.intensity = Vec3(1000);
  parts.scene().lights = {sun};
  return parts.finish();
}

struct Patch {
  double inside = 0, outside = 0;  // largest error of a texel inside; largest light outside
  int texels = 0;                  // inside
};

Patch measure(const Baked& b, double expected, float texel) {
  Patch patch;
  const float shift = 2 / std::sqrt(3.0f);
  for (std::size_t p = 0; p < b.texel_map.size(); ++p)
    for (std::size_t i = 0; i < b.texel_map[p].texel.size(); ++i) {
      const TexelPoint at = sample_texel(b.atlas, b.texel_map[p], i, Vec3(0.5f));
      if (b.scene.surfaces[b.scene.triangle_surface[at.triangle]].name != "ceiling") continue;
      const Vec3 on = point_on(b.scene, at.triangle, at.barycentric);
      const double e = b.radiosity.pages[p].irradiance[b.texel_map[p].texel[i]].g;
      const float beyond = std::max(std::abs(on.x - shift), std::abs(on.z)) - 0.5f;
      if (beyond < -texel) patch.inside = std::max(patch.inside, std::abs(e / expected - 1)), ++patch.texels;
      if (beyond > texel) patch.outside = std::max(patch.outside, e);
    }
  return patch;
}

class MirroredSun : public ::testing::TestWithParam<Estimator> {};

TEST_P(MirroredSun, ThePatchOnTheCeilingIsTheClosedForm) {
  constexpr float kTexel = 0.1f;
  const double sine = std::sqrt(0.75), reflectance = 0.9 + 0.1 * std::pow(1 - sine, 5);
  RadiosityOptions options;
  options.estimator = GetParam();
  const Patch patch = measure(test::bake(sunny(), kTexel, options), 1000 * sine * reflectance, kTexel);
  RecordProperty("inside", std::to_string(patch.inside));
  EXPECT_LT(patch.inside, 0.005);
  EXPECT_GE(patch.texels, 49) << "a patch of 1 m² by texels of 10 cm";
  EXPECT_LT(patch.outside, 0.5) << "of 780 lux";
}
INSTANTIATE_TEST_SUITE_P(Estimators, MirroredSun, ::testing::Values(Estimator::kCached, Estimator::kReference));

// What else the sun may pass before it lights a floor.
enum class Way : std::uint8_t { kTwoMirrors, kSlab, kPane };

Scene sunny_floor(Way way) {
  SceneParts parts;
  float middle = 0;
  if (way == Way::kTwoMirrors) {  // the upper one shades the floor where it throws the light of the lower one
    const auto m = parts.add(mirror(0.9f));
    middle = 2 / std::sqrt(3.0f);
    parts.quad("lower", m, {-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1});
    parts.quad("upper", m, {middle / 2 - 0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1});
  } else if (way == Way::kSlab) {
    parts.box("slab", parts.add(test::solid_glass(1.5f, {0, 1, 4})), {-0.6f, 0.1f, -0.6f}, {0.6f, 0.3f, 0.6f});
  } else {
    SceneMaterial pane = test::solid_glass();
    pane.base_color = {0.9f, 0.5f, 0.1f}, pane.solid = false, pane.double_sided = true;
    parts.quad("pane", parts.add(pane), {-0.6f, 0.1f, 0.6f}, {1.2f, 0, 0}, {0, 0, -1.2f});
  }
  parts.quad("floor", parts.diffuse(Vec3(0)), {middle - 0.4f, 0, 0.4f}, {0.8f, 0, 0}, {0, 0, -0.8f});
  parts.scene().lights = sunny().lights;
  return parts.finish();
}

DVec3 passed(Way way) {
  const double sine = std::sqrt(0.75), reflected = fresnel_dielectric(1.5, sine);
  if (way == Way::kTwoMirrors) return DVec3(std::pow(0.9 + 0.1 * std::pow(1 - sine, 5), 2));
  if (way == Way::kPane) return DVec3(0.9, 0.5, 0.1) * (1 - reflected);
  DVec3 slab;
  for (int c = 0; c < 3; ++c) slab[c] = test::slab_transmittance(1.5, sine, std::array{0.0, 0.2, 0.8}[c]);
  return slab;
}

class SunnyFloor : public ::testing::TestWithParam<std::tuple<Way, Estimator>> {};

TEST_P(SunnyFloor, LightIsTheClosedFormAndTheLedgerCloses) {
  const auto [way, estimator] = GetParam();
  RadiosityOptions options;
  options.samples = 64, options.estimator = estimator;
  const Baked b = test::bake(sunny_floor(way), 0.1f, options);
  const DVec3 expected = 1000 * std::sqrt(0.75) * passed(way);
  DVec3 worst(0);
  int texels = 0;
  b.each_texel([&](const LightmapPage& page, std::uint32_t texel, std::uint32_t triangle) {
    if (b.scene.surfaces[b.scene.triangle_surface[triangle]].name != "floor") return;
    worst = glm::max(worst, glm::abs(DVec3(page.irradiance[texel]) / expected - 1.0)), ++texels;
  });
  for (int c = 0; c < 3; ++c) EXPECT_LT(worst[c], 0.01) << "channel " << c;
  EXPECT_GE(texels, 64);
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  Context context;
  const Ledger ledger = *keep_ledger({{accel, lights, {}}, b.atlas, b.texel_map}, b.radiosity, 400'000, context);
  EXPECT_LE(ledger.closure(), 4 * ledger.closure_error() + 1e-6);
  EXPECT_LE(ledger.disagreement(), 0.01 + 3 * ledger.disagreement_error());
  EXPECT_LE(ledger.disagreement_error(), 0.01);
}
INSTANTIATE_TEST_SUITE_P(Ways, SunnyFloor,
                         ::testing::Combine(::testing::Values(Way::kTwoMirrors, Way::kSlab, Way::kPane),
                                            ::testing::Values(Estimator::kCached, Estimator::kReference)));

// A closed room with a lamp and a mirror: what texels keep is what particles bring.
Scene room(std::uint32_t lights, bool pane) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f)), Vec3(0), Vec3(2), true);
  SceneMaterial glass;
  glass.base_color = {0.9f, 0.6f, 0.3f};
  glass.metallic = 0, glass.roughness = 0, glass.transmission = 1, glass.double_sided = true;
  if (pane)
    parts.quad("pane", parts.add(glass), {1, 0.2f, 0.2f}, {0, 1.6f, 0}, {0, 0, 1.6f});
  else
    parts.quad("mirror", parts.add(mirror(0.9f)), {0.01f, 0.2f, 1.8f}, {0, 0, -1.6f}, {0, 1.6f, 0});
  Light point;
  point.position = {0.6f, 1.2f, 0.9f}, point.intensity = Vec3(10);
  Light spot = point;
  spot.type = LightType::kSpot, spot.direction = glm::normalize(Vec3(-1, -0.5f, 0.2f)), spot.intensity = Vec3(30);
  parts.scene().lights = {point, spot};
  parts.scene().lights.resize(lights);
  return parts.finish();
}

class MirroredRooms : public ::testing::TestWithParam<bool> {};

TEST_P(MirroredRooms, KeepWhatParticlesBring) {
  RadiosityOptions options;
  options.samples = 64;
  const Baked b = test::bake(room(2, GetParam()), 0.1f, options);
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  ASSERT_FALSE(lights.mirrored().empty());
  Context context;
  const Ledger ledger = *keep_ledger({{accel, lights, {}}, b.atlas, b.texel_map}, b.radiosity, 400'000, context);
  EXPECT_LE(ledger.closure(), 4 * ledger.closure_error() + 1e-6);
  EXPECT_LE(ledger.disagreement(), 0.005 + 3 * ledger.disagreement_error());
  EXPECT_LE(ledger.disagreement_error(), 0.005);
  // Without lights in mirrors the ledger says that light is missing.
  Scene without = b.scene;
  without.light_mirrors = 0;
  const Baked dark = test::bake(std::move(without), 0.1f, options);
  const Ledger open = *keep_ledger({{accel, lights, {}}, dark.atlas, dark.texel_map}, dark.radiosity, 400'000, context);
  EXPECT_GT(open.disagreement(), 0.005 + 3 * open.disagreement_error());
}
INSTANTIATE_TEST_SUITE_P(Panes, MirroredRooms, ::testing::Bool());

// By paths and by the cached estimator alike.
TEST(Mirrored, BothEstimatorsFindTheSame) {
  RadiosityOptions cached, reference;
  cached.samples = 128, cached.estimator = Estimator::kCached;
  reference.samples = 256, reference.estimator = Estimator::kReference;
  double sums[2] = {};
  for (int k = 0; k < 2; ++k) {
    const Baked b = test::bake(room(2, false), 0.2f, k == 0 ? cached : reference);
    b.each_texel([&](const LightmapPage& page, std::uint32_t texel, std::uint32_t) {
      sums[k] += luminance(page.irradiance[texel]);
    });
  }
  EXPECT_NEAR(sums[0] / sums[1], 1, 0.01);
}

}  // namespace
}  // namespace oriel
