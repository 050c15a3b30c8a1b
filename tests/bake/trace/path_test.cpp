// The path tracer against closed forms.
#include <gtest/gtest.h>

#include "bake/trace/path.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

struct Mean {
  Vec3 direct, indirect;
};

// Mean irradiance at the middle of a triangle.
Mean irradiance_at(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric, std::uint32_t samples) {
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const Transport transport{accel, lights, {}};
  DVec3 direct(0), indirect(0);
  std::uint64_t rays = 0;
  const SurfacePoint p = geometry_at(scene, {triangle, 0, barycentric, true}, -geometric_normal(scene, triangle));
  for (std::uint32_t i = 0; i < samples; ++i) {
    Sampler sampler(1, 0, i);
    const IrradianceSample e = sample_irradiance(transport, p, sampler, rays);
    direct += DVec3(e.direct);
    indirect += DVec3(e.indirect);
  }
  return {Vec3(direct / double(samples)), Vec3(indirect / double(samples))};
}

// A closed sphere of albedo ρ and uniform radiance L: E = πL / (1 - ρ) everywhere, at every scale.
class Furnace : public ::testing::TestWithParam<std::pair<float, float>> {};

TEST_P(Furnace, HoldsTheSeries) {
  const auto [albedo, scale] = GetParam();
  SceneParts parts;
  parts.sphere("sphere", parts.diffuse(Vec3(albedo), Vec3(2)), Vec3(0), scale, 3, true);
  const Scene scene = parts.finish();
  const float expected = kPi * 2 / (1 - albedo);
  const Mean e = irradiance_at(scene, 5, Vec2(1.0f / 3), albedo > 0.9f ? 65536 : 8192);
  // Four standard errors of the roulette's path lengths.
  EXPECT_NEAR((e.direct + e.indirect).g / expected, 1, 0.015);
  EXPECT_NEAR(e.direct.g / (kPi * 2), 1, 0.01);
}
INSTANTIATE_TEST_SUITE_P(Albedos, Furnace,
                         ::testing::Values(std::pair{0.0f, 1.0f}, std::pair{0.5f, 1.0f}, std::pair{0.8f, 1.0f},
                                           std::pair{0.95f, 1.0f}, std::pair{0.5f, 1e-4f}, std::pair{0.5f, 1e6f}));

TEST(Path, PointSpotAndDirectionalLights) {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  Light point;
  point.position = {0, 2, 0};
  point.intensity = {100, 50, 25};
  parts.scene().lights = {point};
  const auto centre = [&] { return irradiance_at(parts.finish(), 0, Vec2(0, 0.5f), 16); };  // (0, 0, 0)
  EXPECT_NEAR(centre().direct.r, 25, 0.01);
  EXPECT_NEAR(centre().direct.b, 6.25, 0.01);

  Light spot = point;
  spot.type = LightType::kSpot;
  spot.direction = glm::normalize(Vec3(1, -1, 0));
  spot.outer_cone_rad = 0.5f;
  parts.scene().lights = {spot};
  EXPECT_EQ(centre().direct, Vec3(0)) << "45° off a cone of 29°";
  spot.direction = {0, -1, 0};
  parts.scene().lights = {spot};
  EXPECT_NEAR(centre().direct.r, 25, 0.01);

  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = glm::normalize(Vec3(0, -1, 1));
  sun.intensity = Vec3(1000);
  parts.scene().lights = {sun};
  EXPECT_NEAR(centre().direct.g, 1000 * std::sqrt(0.5f), 0.1);

  parts.scene().lights.clear();
  parts.scene().sky = Vec3(10);
  EXPECT_NEAR(centre().direct.g, 10 * kPi, 0.01);
}

// A square emitter of side 1 facing the floor from height 1: configuration factor dA → coaxial square (Howell B-4).
TEST(Path, AreaLightHasItsFormFactor) {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  parts.quad("light", parts.diffuse(Vec3(0), Vec3(100)), {-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1});
  const float x = 0.5f, root = std::sqrt(1 + x * x);
  const float factor = 4 * (1 / (2 * kPi)) * (2 * x / root * std::atan(x / root));
  EXPECT_NEAR(irradiance_at(parts.finish(), 0, Vec2(0, 0.5f), 4096).direct.g / (kPi * 100 * factor), 1, 5e-3);
}

// The same, close above a floor so large that its points are rounded to a share of the distance; at three scales.
class CloseLamp : public ::testing::TestWithParam<float> {};

TEST_P(CloseLamp, IsNotHiddenByItself) {
  const float scale = GetParam();
  for (const float height : {3.0f, 0.1f}) {
    SceneParts parts;
    parts.quad("floor", parts.diffuse(Vec3(0)), Vec3(-200, 0, 200) * scale, Vec3(400, 0, 0) * scale,
               Vec3(0, 0, -400) * scale);
    parts.quad("light", parts.diffuse(Vec3(0), Vec3(100)), Vec3(-0.5f, height, -0.5f) * scale, Vec3(1, 0, 0) * scale,
               Vec3(0, 0, 1) * scale);
    const float x = 0.5f / height, root = std::sqrt(1 + x * x);
    const float factor = 4 * (1 / (2 * kPi)) * (2 * x / root * std::atan(x / root));
    EXPECT_NEAR(irradiance_at(parts.finish(), 0, Vec2(0, 0.5f), 16384).direct.g / (kPi * 100 * factor), 1, 0.01)
        << height;
  }
}
INSTANTIATE_TEST_SUITE_P(Scales, CloseLamp, ::testing::Values(1e-3f, 1.0f, 1e3f));

// Light sampling alone reads low where a whole face emits beside the receiver: MIS must not.
TEST(Path, AdjoiningEmitterIsNotReadLow) {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0)), {0, 0, 1}, {1, 0, 0}, {0, 0, -1});
  parts.quad("wall", parts.diffuse(Vec3(0), Vec3(1 / kPi)), {0, 0, 1}, {0, 0, -1}, {0, 1, 0});  // faces +x
  // Mean over the floor: the factor of two unit squares with a common edge (Howell C-14).
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const Transport transport{accel, lights, {}};
  double sum = 0;
  std::uint64_t rays = 0;
  constexpr std::uint32_t kSamples = 32768;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    Sampler sampler(1, 0, i);
    const Vec2 u = sampler.next2();
    const Vec2 b = u.x + u.y > 1 ? 1.0f - u : u;
    const std::uint32_t t = u.x + u.y > 1 ? 1 : 0;
    const SurfacePoint p = geometry_at(scene, {t, 0, b, true}, {0, -1, 0});
    sum += sample_irradiance(transport, p, sampler, rays).direct.g;
  }
  EXPECT_NEAR(sum / kSamples, 0.200044, 0.001);
}

// A large panel that shines from a few of its texels only: sampled by its mean, weighted by what is met.
TEST(Path, TexturedEmitterShinesFromItsBrightTexels) {
  constexpr std::uint32_t kSize = 100;
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  SceneMaterial panel;
  panel.base_color = Vec3(0);
  panel.metallic = panel.specular = 0;
  panel.emission = Vec3(1e4f);
  panel.emission_texture.image = 0;
  panel.emission_texture.nearest = true;
  parts.quad("panel", parts.add(panel), {-2, 1, -2}, {4, 0, 0}, {0, 0, 4});  // faces down
  Image image{"dots", kSize, kSize, std::vector<std::uint8_t>(4 * kSize * kSize, 0)};
  double expected = 0;
  for (const auto& [x, y] : {std::pair{50u, 49u}, {60u, 47u}, {37u, 58u}, {3u, 3u}}) {
    for (int c = 0; c < 4; ++c) image.texels[4 * (y * kSize + x) + static_cast<std::uint32_t>(c)] = 255;
    const double px = -2 + 4 * (x + 0.5) / kSize, pz = -2 + 4 * (y + 0.5) / kSize, r2 = px * px + pz * pz + 1;
    expected += 1e4 * (4.0 / kSize) * (4.0 / kSize) / (r2 * r2);
  }
  parts.scene().images.push_back(image);
  const double got = irradiance_at(parts.finish(), 0, Vec2(0, 0.5f), 1u << 20).direct.g;
  EXPECT_NEAR(got / expected, 1, 0.01);
}

TEST(Path, LightFindsItsWayOverAMirror) {
  // A black floor under a downward-facing wall of light that only a mirror overhead can show it.
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  SceneMaterial mirror;
  mirror.metallic = 1;
  mirror.roughness = 0;
  parts.quad("mirror", parts.add(mirror), {-50, 2, -50}, {100, 0, 0}, {0, 0, 100});                 // faces down
  parts.quad("panel", parts.diffuse(Vec3(0), Vec3(100)), {-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1});  // faces up
  // The mirrored panel lies at height 3 and faces down; the panel itself (one-sided, black) hides a square of half side
  // 0.5 at height 1, that is of half side 1.5 at height 3: all of it.
  EXPECT_NEAR(irradiance_at(parts.finish(), 0, Vec2(0, 0.5f), 1024).indirect.g, 0, 1e-6);
  parts.scene().triangles.resize(4);
  parts.scene().triangle_surface.resize(4);
  parts.scene().surfaces.resize(2);
  parts.quad("panel", 2, {2, 1, 0.5f}, {1, 0, 0}, {0, 0, -1});
  const Mean e = irradiance_at(parts.finish(), 0, Vec2(0, 0.5f), 65536);
  // Midpoint quadrature of ∫ L cos cos / r² over the mirrored panel.
  double expected = 0;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 100; ++j) {
      const double px = 2 + (i + 0.5) / 100, pz = -0.5 + (j + 0.5) / 100, r2 = px * px + pz * pz + 9;
      expected += 100 * 9 / (r2 * r2) * 1e-4;
    }
  EXPECT_EQ(e.direct, Vec3(0));
  EXPECT_NEAR(e.indirect.g / expected, 1, 0.03);
}

// Light in a closed box of perfect metal dies on the lamp alone, after hundreds of bounces: E = πL. Every sampled lobe
// weighs a little more than it reflects (samples below the horizon are lost), and paths of so many bounces would weigh
// nothing or thousands.
TEST(Path, MetalBoxesLeaveNoLightToFewHeavyPaths) {
  constexpr float kLuminance = 10;
  SceneParts parts;
  SceneMaterial metal;
  metal.base_color = Vec3(1);
  metal.metallic = 1;
  metal.roughness = 0.6f;
  parts.box("room", parts.add(metal), Vec3(-2), Vec3(2), true);
  parts.box("lamp", parts.diffuse(Vec3(0), Vec3(kLuminance)), Vec3(-0.15f), Vec3(0.15f));
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const Transport transport{accel, lights, {}};
  const SurfacePoint p = point_on_side(scene, 0, Vec2(0.2f, 0.3f));
  constexpr std::uint32_t kSamples = 4096;
  double sum = 0, squares = 0;
  std::uint64_t rays = 0;
  for (std::uint32_t k = 0; k < kSamples; ++k) {
    Sampler sampler(1, 0, k);
    const IrradianceSample e = sample_irradiance(transport, p, sampler, rays);
    const double share = (e.direct + e.indirect).g / (kPi * kLuminance);
    sum += share, squares += share * share;
  }
  const double mean = sum / kSamples, deviation = std::sqrt(squares / kSamples - mean * mean);
  EXPECT_NEAR(mean, 1, 4 * deviation / std::sqrt(kSamples));
  EXPECT_LT(deviation, 12) << "of one sample";
}

}  // namespace
}  // namespace oriel
