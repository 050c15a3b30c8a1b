// Illuminance at points against closed forms, and whether its stated error tells the truth.
#include <gtest/gtest.h>

#include "bake/reference/illuminance.h"
#include "formats/core/color.h"
#include "tests/bake/support/glass_slab.h"

namespace oriel {
namespace {

using test::SceneParts;

std::vector<PointIlluminance> measure(const Scene& scene, const std::vector<MeasurePoint>& points,
                                      const LuxOptions& options, std::uint64_t seed = 1, int threads = 0) {
  Context context;
  context.seed = seed;
  context.threads = threads;
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  return *illuminance_at({accel, lights, {}}, points, options, context);
}

TEST(Illuminance, PunctualLightsAreExact) {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  Light lamp;
  lamp.position = {0, 2, 0};
  lamp.intensity = {100, 200, 400};
  parts.scene().lights = {lamp};
  Scene scene = parts.finish();
  scene.origin = {1000, 0, 0};  // scene space is world minus origin
  const auto e = measure(scene, {{{1000, 0, 0}, {0, 1, 0}}, {{1000, 1, 1}, {0, 0, -3}}, {{1000, 1, 0}, {1, 0, 0}}}, {});
  EXPECT_NEAR(e[0].direct.g, 50, 1e-3);
  EXPECT_NEAR(e[0].direct.b, 100, 2e-3);
  EXPECT_NEAR(e[1].direct.g, 200 / 2 * std::sqrt(0.5), 1e-2) << "the normal's length does not count";
  EXPECT_NEAR(e[2].direct.g, 0, 1e-6) << "edge-on";
  for (const PointIlluminance& r : e) {
    EXPECT_NEAR(r.luminance_error, 0, 1e-4);
    EXPECT_EQ(r.indirect, DVec3(0));
    EXPECT_TRUE(r.converged);
    EXPECT_EQ(r.samples, 1024u);
  }
}

// Closed room, every face emits M and reflects rho: E = M / (1 - rho) at every point (flux balance). Points come as
// near to edges as 1 mm, where the neighbour face fills a quarter of the view and sampling it by area alone would have
// unbounded variance.
struct Coverage {
  int points = 0, covered = 0;
  double squares = 0;  // of (value - truth) / stated error
};

Coverage coverage(const Scene& scene, const std::vector<MeasurePoint>& points, double truth,
                  const LuxOptions& options) {
  Coverage c;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const PointIlluminance& e : measure(scene, points, options, seed)) {
      const double z = (luminance(e.direct + e.indirect) - truth) / e.luminance_error;
      ++c.points;
      c.covered += std::abs(z) <= 1.96;
      c.squares += z * z;
      EXPECT_LT(std::abs(z), 6) << "Student's t of 31 degrees of freedom: once in a million";
    }
  return c;
}

std::vector<MeasurePoint> points_in_unit_room() {
  std::vector<MeasurePoint> points;
  for (const double a : {0.001, 0.02, 0.3, 0.5, 0.93, 0.999})
    for (const double b : {0.001, 0.4, 0.98})
      for (const auto& [p, n] : {std::pair{DVec3(a, 0, b), DVec3(0, 1, 0)}, {DVec3(0, a, b), DVec3(1, 0, 0)}})
        points.push_back({p, n, 0});
  return points;
}

// Emitters with a texture have no closed form: they are sampled, combined with the paths' own hits. A white texel.
void texture_emitters(SceneParts& parts) {
  parts.scene().images = {{"white", 1, 1, {255, 255, 255, 255}}};
  for (SceneMaterial& m : parts.scene().materials) m.emission_texture.image = 0;
}

void expect_honest(const Coverage& c) {
  EXPECT_GE(c.points, 200);
  EXPECT_GE(c.covered, 0.90 * c.points);
  EXPECT_LE(c.covered, 0.99 * c.points);
  EXPECT_NEAR(std::sqrt(c.squares / c.points), 1, 0.15) << "neither too small nor padded";
}

TEST(Illuminance, StatedErrorCoversTheTruthBetweenEmittingFaces) {
  for (const bool textured : {false, true}) {
    SceneParts parts;
    parts.box("room", parts.diffuse(Vec3(0.6f), Vec3(1)), Vec3(0), Vec3(1), true);
    if (textured) texture_emitters(parts);
    const Scene scene = parts.finish();
    expect_honest(coverage(scene, points_in_unit_room(), kPiD / 0.4, {0.01, 1u << 20}));
  }
}

// A single emitting face that adjoins the one with the points: E = π L F of two perpendicular rectangles.
double side_factor(double distance, double height, double along) {
  const double slant = std::hypot(distance, height);
  return (std::atan(along / distance) - distance / slant * std::atan(along / slant)) / (2 * kPiD);
}

class BesideAnEmittingFace : public ::testing::Test {
 protected:
  template <class Visit>
  void each(bool textured, const Visit& visit) {
    SceneParts parts;
    parts.quad("wall", parts.diffuse(Vec3(0), Vec3(1)), {0, 0, 1}, {0, 0, -1}, {0, 1, 0});  // faces +x
    parts.quad("floor", parts.diffuse(Vec3(0)), {0, 0, 1}, {1, 0, 0}, {0, 0, -1});
    if (textured) texture_emitters(parts);
    const Scene scene = parts.finish();
    for (const double x : {0.002, 0.01, 0.1, 0.6})
      for (const double z : {0.003, 0.01, 0.1, 0.2, 0.4, 0.5, 0.7, 0.8, 0.95})
        visit(scene, MeasurePoint{{x, 0, z}, {0, 1, 0}, 0}, kPiD * (side_factor(x, 1, z) + side_factor(x, 1, 1 - z)));
  }
};

TEST_F(BesideAnEmittingFace, PlainEmittersAreExact) {
  each(false, [](const Scene& scene, const MeasurePoint& point, double truth) {
    const PointIlluminance e = measure(scene, {point}, {})[0];
    EXPECT_NEAR(e.direct.g, truth, 2e-3 * truth) << "rounding lifts the point by 2e-6 of the scene's size";
    EXPECT_NEAR(e.luminance_error, 0, 1e-6);
  });
}

TEST_F(BesideAnEmittingFace, StatedErrorCoversTheTruth) {
  Coverage all;
  each(true, [&](const Scene& scene, const MeasurePoint& point, double truth) {
    const Coverage c = coverage(scene, {point}, truth, {0.005, 1u << 20});
    all.points += c.points;
    all.covered += c.covered;
    all.squares += c.squares;
  });
  expect_honest(all);
}

// Shadow rays to lamps and skies end at solid glass, and paths find what comes through: all of it, once.
TEST(Illuminance, LampsAndSkiesBehindGlassCountOnce) {
  const double expected = test::slab_irradiance(1.5, 0.2);
  for (const int above : {0, 1, 2}) {
    SceneParts parts;
    parts.box("slab", parts.add(test::solid_glass(1.5f, Vec3(1))), {-50, 0, -50}, {50, 0.2f, 50});
    parts.quad("ground", parts.diffuse(Vec3(0)), {-50, -0.2f, 50}, {100, 0, 0}, {0, 0, -100});
    if (above < 2) parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(1)), {-50, 0.3f, -50}, {100, 0, 0}, {0, 0, 100});
    if (above == 1) texture_emitters(parts);
    if (above == 2) {
      SkyImage& sky = parts.scene().sky_image = {2, 64, std::vector<Vec3>(128, Vec3(1))};
      std::fill(sky.texels.begin() + 64, sky.texels.end(), Vec3(0.5f));  // below: one colour alone is not sampled
    }
    const PointIlluminance e = measure(parts.finish(), {{{0, -0.1, 0}, {0, 1, 0}}}, {0.002, 1u << 18})[0];
    EXPECT_NEAR((e.direct.g + e.indirect.g) / expected, 1, 0.01) << above;
  }
}

// Half of a lamp is hidden: its closed form times a sampled share.
TEST(Illuminance, StatedErrorCoversTheTruthInAPenumbra) {
  SceneParts parts;
  const auto black = parts.diffuse(Vec3(0));
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(1)), {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});  // faces down
  parts.quad("screen", black, {-4, 0.5f, -4}, {4, 0, 0}, {0, 0, 8});                       // hides x < 0
  const double a = 1 / std::sqrt(2.0);
  const double half = 2 * (a * std::atan(a));  // two squares of side 1 at height 1 over a corner (Howell B-3), times π
  // One place as many points: each has random numbers of its own.
  const std::vector<MeasurePoint> points(40, MeasurePoint{{0, 0, 0}, {0, 1, 0}, 0});
  expect_honest(coverage(parts.finish(), points, half, {0.003, 1u << 20}));
}

TEST(Illuminance, StopsAtTheErrorAskedFor) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f), Vec3(0.1f)), Vec3(0), Vec3(2), true);
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(50)), {0.5f, 1.9f, 0.5f}, {0.3f, 0, 0}, {0, 0, 0.3f});
  const Scene scene = parts.finish();
  const std::vector<MeasurePoint> points{{{0.3, 0, 0.4}, {0, 1, 0}}, {{0, 1.5, 1}, {1, 0, 0}}};
  const auto coarse = measure(scene, points, {0.02, 1u << 22}), fine = measure(scene, points, {0.002, 1u << 22});
  const auto capped = measure(scene, points, {1e-9, 4096}), fixed = measure(scene, points, {0, 8192});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double e = luminance(fine[i].direct + fine[i].indirect);
    EXPECT_LE(coarse[i].luminance_error, 0.0202 * e);
    EXPECT_LE(fine[i].luminance_error, 0.00202 * e);
    EXPECT_GT(fine[i].samples, coarse[i].samples);
    EXPECT_EQ(capped[i].samples, 4096u);
    EXPECT_FALSE(capped[i].converged);
    EXPECT_EQ(fixed[i].samples, 8192u);
  }
}

TEST(Illuminance, SameNumbersForOneAndTwoThreads) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f, 0.3f, 0.2f), Vec3(0.1f)), Vec3(0), Vec3(2), true);
  const Scene scene = parts.finish();
  const std::vector<MeasurePoint> points{{{0.3, 0, 0.4}, {0, 1, 0}}, {{0, 1.5, 1}, {1, 0, 0}}, {{1, 1, 1}, {1, 2, 3}}};
  const auto one = measure(scene, points, {}, 7, 1), two = measure(scene, points, {}, 7, 2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(one[i].direct, two[i].direct);
    EXPECT_EQ(one[i].indirect, two[i].indirect);
    EXPECT_EQ(one[i].standard_error, two[i].standard_error);
  }
}

TEST(Illuminance, PointsInsideBodiesAreTold) {
  SceneParts parts;
  const auto grey = parts.diffuse(Vec3(0.5f));
  parts.box("room", grey, Vec3(0), Vec3(2), true);
  parts.box("block", grey, Vec3(0.5f), Vec3(1));
  const auto e = measure(parts.finish(),
                         {{{0.7, 0.7, 0.7}, {0, 1, 0}},
                          {{0.7, 1.2, 0.7}, {0, 1, 0}},
                          {{1, 0.7, 0.7}, {1, 0, 0}},
                          {{1, 0.7, 0.7}, {-1, 0, 0}}},
                         {});
  EXPECT_TRUE(e[0].buried);
  EXPECT_FALSE(e[1].buried);
  EXPECT_FALSE(e[2].buried) << "on the block, facing out";
  EXPECT_TRUE(e[3].buried) << "on the block, facing in";
}

TEST(Illuminance, NoLightIsZeroAndStopsAtOnce) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f)), Vec3(0), Vec3(2), true);
  const auto e = measure(parts.finish(), {{{1, 0, 1}, {0, 1, 0}}}, {});
  EXPECT_EQ(e[0].direct + e[0].indirect, DVec3(0));
  EXPECT_EQ(e[0].samples, 1024u);
}

TEST(Illuminance, StopsWhenAsked) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f), Vec3(1)), Vec3(0), Vec3(2), true);
  const Scene scene = parts.finish();
  Context context;
  context.stop = true;
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const std::vector<MeasurePoint> points{{{1, 0, 1}, {0, 1, 0}}};
  const auto result = illuminance_at({accel, lights, {}}, points, {}, context);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kStopped);
}

}  // namespace
}  // namespace oriel
