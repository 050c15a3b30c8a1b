// The energy ledger: against closed forms first, then that it finds what is wrong.
#include "bake/radiosity/ledger.h"

#include <gtest/gtest.h>

#include "bake/radiosity/particle.h"
#include "tests/bake/radiosity/baked.h"
#include "tests/bake/radiosity/rooms.h"

namespace oriel {
namespace {

using test::Baked;
using test::SceneParts;

constexpr std::uint64_t kRays = 200'000;

struct Kept {
  Baked baked;
  Ledger ledger;
};

Ledger ledger_of(const Baked& b, std::uint64_t rays = kRays, int threads = 0) {
  Context context;
  context.threads = threads;
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  return *keep_ledger({{accel, lights, {}}, b.atlas, b.texel_map}, b.radiosity, rays, context);
}

Kept keep(Scene scene, float texel_m, std::uint32_t samples) {
  Kept k{test::bake(std::move(scene), texel_m, {.samples = samples}), {}};
  k.ledger = ledger_of(k.baked);
  return k;
}

void expect_near(const Lumens& found, double expected) {
  EXPECT_NEAR(found.value, expected, 4 * found.error + 1e-5 * std::abs(expected));
}

void expect_closed(const Ledger& ledger) {
  EXPECT_LE(ledger.closure(), 4 * ledger.closure_error() + 1e-6);
  EXPECT_LE(ledger.closure_error(), 0.005);
}

Scene furnace(float albedo) {
  SceneParts parts;
  parts.sphere("sphere", parts.diffuse(Vec3(albedo), Vec3(1)), Vec3(0), 1, 2, true);
  return parts.finish();
}

Scene closed_box() {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.7f));
  parts.box("room", white, Vec3(0), Vec3(2), true);
  parts.quad("red", parts.diffuse({0.6f, 0.05f, 0.05f}), {0.001f, 0, 2}, {0, 0, -2}, {0, 2, 0});
  parts.box("block", white, {0.5f, 0, 0.4f}, {1.1f, 1.1f, 1});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(10, 7, 4)), {0.7f, 1.99f, 0.7f}, {0.5f, 0, 0}, {0, 0, 0.5f});
  return parts.finish();
}

TEST(Ledger, AFurnaceAbsorbsWhatItEmits) {
  const Kept k = keep(furnace(0.5f), 0.1f, 64);
  double area = 0;
  for (std::uint32_t t = 0; t < k.baked.scene.triangles.size(); ++t) area += triangle_area(k.baked.scene, t);
  EXPECT_NEAR(k.ledger.emitted_lm(), kPiD * area, 1e-4 * area);
  EXPECT_EQ(k.ledger.escaped.value, 0);
  EXPECT_EQ(k.ledger.lost_behind.value, 0);
  EXPECT_EQ(k.ledger.lost_guard.value, 0);
  expect_near(k.ledger.absorbed, k.ledger.emitted_lm());
  expect_near(k.ledger.on_texels, k.ledger.emitted_lm());
  EXPECT_NEAR(k.ledger.lightmap_lm, k.ledger.emitted_lm(), 0.005 * k.ledger.emitted_lm());
  expect_closed(k.ledger);
  EXPECT_TRUE(ledger_findings(k.ledger).empty());
}

TEST(Ledger, AllEscapesFromALampInEmptySpace) {
  SceneParts parts;
  parts.quad("lamp", parts.diffuse(Vec3(0.5f), Vec3(3)), {0, 0, 0}, {1, 0, 0}, {0, 2, 0});
  const Kept k = keep(parts.finish(), 0.2f, 16);
  EXPECT_NEAR(k.ledger.emitted_lm(), 6 * kPiD, 1e-4);
  EXPECT_NEAR(k.ledger.escaped.value, 6 * kPiD, 1e-4);
  EXPECT_NEAR(k.ledger.missing.value, 0, 1e-4);
  EXPECT_EQ(k.ledger.absorbed.value, 0);
  EXPECT_EQ(k.ledger.lightmap_lm, 0);
  EXPECT_TRUE(ledger_findings(k.ledger).empty());
}

TEST(Ledger, AClosedBoxKeepsItsLight) {
  const Kept k = keep(closed_box(), 0.08f, 256);
  EXPECT_LT(k.ledger.escaped.value + k.ledger.lost_behind.value, 1e-3 * k.ledger.emitted_lm());
  expect_near(k.ledger.absorbed, k.ledger.emitted_lm());
  expect_closed(k.ledger);
  EXPECT_TRUE(ledger_findings(k.ledger).empty());
}

// A convex body: no light meets it twice.
TEST(Ledger, ABlackBoxTakesTheSkysLight) {
  SceneParts parts;
  parts.box("box", parts.diffuse(Vec3(0)), Vec3(-1, -0.5f, -2), Vec3(1, 0.5f, 2));
  parts.scene().sky = Vec3(3);
  parts.scene().lights.push_back(
      {.name = "sun", .type = LightType::kDirectional, .direction = Vec3(0, -1, 0), .intensity = Vec3(10)});
  const Kept k = keep(parts.finish(), 0.5f, 64);
  const double sky = 3 * kPiD * 2 * (2 * 1 + 1 * 4 + 2 * 4), sun = 10 * 8;
  EXPECT_EQ(k.ledger.lamps_lm, 0);
  expect_near(k.ledger.from_afar, sky + sun);
  EXPECT_LT(k.ledger.from_afar.error, 0.02 * (sky + sun));
  EXPECT_NEAR(k.ledger.absorbed.value, k.ledger.from_afar.value, 1e-6 * sky) << "the same particles";
  EXPECT_NEAR(k.ledger.lightmap_lm, sky + sun, 0.005 * (sky + sun));
  EXPECT_TRUE(ledger_findings(k.ledger).empty());
}

TEST(Ledger, BacksOfOneSidedWallsLoseLight) {
  SceneParts parts;
  parts.quad("wall", parts.diffuse(Vec3(0.5f)), {-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
  parts.scene().lights.push_back({.name = "lamp",
                                  .type = LightType::kSpot,
                                  .position = Vec3(0, 0, -1),
                                  .direction = Vec3(0, 0, 1),
                                  .intensity = Vec3(5),
                                  .inner_cone_rad = 0.2f,
                                  .outer_cone_rad = 0.6f});
  const Kept k = keep(parts.finish(), 10, 16);
  EXPECT_GT(k.ledger.emitted_lm(), 0);
  expect_near(k.ledger.lost_behind, k.ledger.emitted_lm());
  EXPECT_EQ(k.ledger.absorbed.value, 0);
  EXPECT_EQ(k.ledger.escaped.value, 0);
}

class LedgerOfRooms : public ::testing::TestWithParam<test::Feature> {};

TEST_P(LedgerOfRooms, ClosesAndAgreesWithTheLightmap) {
  const Kept k = keep(test::room(GetParam()), 0.1f, 128);
  expect_closed(k.ledger);
  EXPECT_LE(k.ledger.disagreement(), kLedgerTolerance + 3 * k.ledger.disagreement_error())
      << k.ledger.lightmap_lm << " lm by the lightmap, " << k.ledger.on_texels.value;
  // Of the sky's particles many meet no surface, or one from outside.
  EXPECT_LE(k.ledger.disagreement_error(), GetParam() == test::Feature::kSky ? 0.02 : 0.01);
  EXPECT_GT(k.ledger.escaped.value, 0);
}
INSTANTIATE_TEST_SUITE_P(Features, LedgerOfRooms,
                         ::testing::Values(test::Feature::kGlossyFloor, test::Feature::kMirror, test::Feature::kGlass,
                                           test::Feature::kCutOut, test::Feature::kSphere, test::Feature::kPoint,
                                           test::Feature::kSky, test::Feature::kDielectric, test::Feature::kManyLamps));

// A lamp that shines on all sides hangs a centimetre below the ceiling: half of its light stays above it, where nobody
// sees the texels, and where the lightmap has none.
TEST(Ledger, TheGapAboveALampIsNotHeldAgainstTheLightmap) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.7f)), Vec3(0), Vec3(2), true);
  parts.box("lamp", parts.diffuse(Vec3(0.7f), Vec3(10)), {0.52f, 1.94f, 0.52f}, {1.48f, 1.99f, 1.48f});
  const Scene scene = parts.finish();
  Kept k{test::bake(scene, 0.1f, {.samples = 256, .eyes = {Vec3(1), Vec3(0.4f, 1.6f, 0.4f)}}), {}};
  k.ledger = ledger_of(k.baked);
  expect_closed(k.ledger);
  EXPECT_LT(k.ledger.on_texels.value, 0.8 * k.ledger.emitted_lm());
  EXPECT_TRUE(ledger_findings(k.ledger).empty()) << ledger_findings(k.ledger).front();
}

TEST(Ledger, WarnsOfALightmapThatIsWrong) {
  Kept k = keep(test::room(test::Feature::kMatt), 0.1f, 64);
  EXPECT_TRUE(ledger_findings(k.ledger).empty());
  for (LightmapPage& page : k.baked.radiosity.pages)
    for (Vec3& e : page.irradiance) e *= 1.05f;
  EXPECT_EQ(ledger_findings(ledger_of(k.baked)).size(), 1u);
}

TEST(Ledger, FindsThatLightIsMissingAndSaysHowMuch) {
  Ledger ledger = ledger_of(test::bake(closed_box(), 0.2f, {.samples = 16}));
  ledger.missing.value += 0.02 * ledger.emitted_lm();
  const std::vector<std::string> findings = ledger_findings(ledger);
  ASSERT_FALSE(findings.empty());
  EXPECT_NE(findings[0].find("the energy ledger is open: "), std::string::npos) << findings[0];
}

TEST(Ledger, IsTheSameForAnyNumberOfThreads) {
  const Baked b = test::bake(closed_box(), 0.2f, {.samples = 16});
  const Ledger one = ledger_of(b, kRays, 1), four = ledger_of(b, kRays, 4);
  EXPECT_EQ(one.absorbed.value, four.absorbed.value);
  EXPECT_EQ(one.on_texels.value, four.on_texels.value);
  EXPECT_EQ(one.lightmap_lm, four.lightmap_lm);
  EXPECT_EQ(one.rays, four.rays);
}

TEST(Ledger, NothingWithoutLight) {
  SceneParts parts;
  parts.box("box", parts.diffuse(Vec3(0.5f)), Vec3(-1), Vec3(1));
  const Kept k = keep(parts.finish(), 0.5f, 16);
  EXPECT_EQ(k.ledger.particles, 0u);
  EXPECT_EQ(k.ledger.closure(), 0);
  EXPECT_EQ(k.ledger.disagreement(), 0);
  EXPECT_TRUE(ledger_findings(k.ledger).empty());
}

TEST(Ledger, SurfacesKeepWhatTheyDoNotReflect) {
  ShadePoint matt;
  matt.diffuse = Vec3(0.3f, 0.5f, 1), matt.f0 = Vec3(0), matt.f90 = 0;
  EXPECT_LT(glm::length(absorptance(matt) - Vec3(0.7f, 0.5f, 0)), 1e-4f);
  matt.coverage = 0.5f;
  EXPECT_NEAR(absorptance(matt).r, 0.35f, 1e-4f);
}

}  // namespace
}  // namespace oriel
