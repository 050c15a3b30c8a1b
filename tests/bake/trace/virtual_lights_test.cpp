// Lights in mirrors against closed forms.
#include "bake/trace/virtual_lights.h"

#include <gtest/gtest.h>

#include "tests/bake/support/light_meter.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::LightMeter;
using test::point_light;
using test::SceneParts;

SceneMaterial mirror(const Vec3& color) {
  SceneMaterial m;
  m.base_color = color;
  m.metallic = 1, m.roughness = 0;
  return m;
}
SceneMaterial pane(const Vec3& color, float transmission = 1) {
  SceneMaterial m;
  m.base_color = color;
  m.metallic = 0, m.roughness = 0, m.transmission = transmission, m.double_sided = true;
  return m;
}
Light sun_at(float height_deg, float lux = 1000) {
  const float h = height_deg * kPi / 180;
  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = {std::cos(h), -std::sin(h), 0};
  sun.intensity = Vec3(lux);
  return sun;
}
double schlick(double f0, double cosine) {
  return f0 + (1 - f0) * std::pow(1 - cosine, 5);
}

// A mirror of 1 m² in the middle of the floor.
SceneParts floor_mirror(const Vec3& color = Vec3(0.9f)) {
  SceneParts parts;
  parts.quad("mirror", parts.add(mirror(color)), {-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1});
  return parts;
}

TEST(VirtualLights, ASunOnAFloorMirrorLightsTheCeiling) {
  SceneParts parts = floor_mirror();
  parts.scene().lights = {sun_at(60)};
  const LightMeter meter(parts.finish());
  ASSERT_EQ(meter.lights().mirrored().size(), 1u);
  // At 3 m the patch is the mirror moved by 3 cot 60° along the way of the light.
  const float shift = 3 / std::sqrt(3.0f);
  const double sine = std::sin(kPiD / 3), expected = 1000 * sine * schlick(0.9, sine);
  for (const float x : {-0.499f, -0.3f, 0.0f, 0.499f})
    for (const float z : {-0.499f, 0.1f, 0.499f})
      EXPECT_NEAR(meter.at({shift + x, 3, z}, {0, -1, 0}).g / expected, 1, 1e-3) << x << " " << z;
  for (const float x : {-0.501f, 0.501f}) EXPECT_EQ(meter.at({shift + x, 3, 0}, {0, -1, 0}), DVec3(0)) << x;
  EXPECT_EQ(meter.at({shift, 3, 0.501f}, {0, -1, 0}), DVec3(0));
}

// Eight lamps in one place bring what one of eight times the light does, and a path asks one of their images.
TEST(VirtualLights, APathAsksOneForAll) {
  constexpr std::uint32_t kPaths = 4096;
  std::array<double, 2> light{}, rays{};
  for (const std::size_t many : {0, 1}) {
    SceneParts parts = floor_mirror();
    parts.quad("ceiling", parts.diffuse(Vec3(0.5f)), {-9, 3, -9}, {18, 0, 0}, {0, 0, 18});
    parts.quad("sensor", parts.diffuse(Vec3(0)), {1.6f, 2, 1.6f}, {0, 0, 1}, {1, 0, 0});
    for (int i = 0; i < (many ? 8 : 1); ++i) parts.scene().lights.push_back(point_light({0, 1, 0}, many ? 10 : 80));
    const Scene scene = parts.finish();
    const Accel accel = *Accel::build(scene);
    const LightSet lights(scene);
    const SurfacePoint sensor = point_on_side(accel, 4, Vec2(1.0f / 3), true);
    std::uint64_t traced = 0;
    for (std::uint32_t k = 0; k < kPaths; ++k) {
      Sampler sampler(1, 0, k);
      light[many] += sample_irradiance({accel, lights, {.max_bounces = 2}}, sensor, sampler, traced).indirect.g;
    }
    rays[many] = static_cast<double>(traced) / kPaths;
  }
  EXPECT_NEAR(light[1] / light[0], 1, 0.05);
  EXPECT_NEAR(rays[1] / rays[0], 1, 0.1);
}

TEST(VirtualLights, ASunsDiskBlursThePatchAndKeepsItsLight) {
  SceneParts parts = floor_mirror();
  parts.scene().lights = {sun_at(90)};
  parts.scene().lights[0].angular_radius_rad = 0.05f;
  const LightMeter meter(parts.finish());
  double sum = 0;
  constexpr int kSteps = 40;  // 2 × 2 m
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < kSteps; ++k)
      sum += meter.at({(i + 0.5f) * 2 / kSteps - 1, 3, (k + 0.5f) * 2 / kSteps - 1}, {0, -1, 0}, 64).g;
  EXPECT_NEAR(sum * 4 / (kSteps * kSteps) / 900, 1, 5e-3);
  EXPECT_NEAR(meter.at({0.5f, 3, 0}, {0, -1, 0}, 1024).g / 450, 1, 0.05) << "half of the disk at the edge";
}

TEST(VirtualLights, APointInAMirrorIsALampBehindIt) {
  SceneParts parts = floor_mirror();
  parts.scene().lights = {point_light({0, 1, 0})};
  const LightMeter meter(parts.finish());
  const Vec3 p(0.6f, 2, 0.2f);
  const DVec3 to = DVec3(0, -1, 0) - DVec3(p);
  const double d2 = glm::dot(to, to), cosine = -to.y / std::sqrt(d2);
  const double image = 100 / d2 * cosine * schlick(0.9, cosine);
  const double straight = 100 / (0.36 + 1 + 0.04) / std::sqrt(1.4);
  EXPECT_NEAR(meter.at(p, {0, -1, 0}).g, straight + image, 1e-3 * image);
  const double beside = 100 / (0.36 + 1 + 0.04) / std::sqrt(1.4);
  EXPECT_NEAR(meter.at({0.6f, 0, 0.2f}, {0, 1, 0}).g, beside, 1e-3 * beside) << "beside the mirror on the floor";
}

// A lamp that paths meet by chance in the mirror, in place of the point.
TEST(VirtualLights, ASmallLampByPathsIsTheSame) {
  SceneParts parts = floor_mirror();
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(1000)), {-0.15f, 1, -0.15f}, {0.3f, 0, 0}, {0, 0, 0.3f});  // down
  const Vec3 p(0.6f, 1.5f, 0.2f);  // it sees the lamp in the mirror alone
  const double paths = LightMeter(parts.finish()).at(p, {0, -1, 0}, 1 << 20).g;
  SceneParts point = floor_mirror();
  point.quad("shade", point.diffuse(Vec3(0)), {-0.15f, 1.001f, -0.15f}, {0.3f, 0, 0}, {0, 0, 0.3f});
  point.scene().lights = {point_light({0, 1, 0}, 90)};
  const double cosine = 2.5 / std::sqrt(2.5 * 2.5 + 0.4);
  const double image = LightMeter(point.finish()).at(p, {0, -1, 0}).g * cosine;  // as a flat lamp shines
  EXPECT_NEAR(paths / image, 1, 0.05) << "800 paths of a million, 3.5 %";
  EXPECT_GT(image, 5);
}

TEST(VirtualLights, ASpotsConeIsMirrored) {
  SceneParts parts = floor_mirror();
  Light spot = point_light({0, 1, 0});
  spot.type = LightType::kSpot, spot.direction = {0, -1, 0}, spot.inner_cone_rad = 0.1f, spot.outer_cone_rad = 0.2f;
  parts.scene().lights = {spot};
  const LightMeter meter(parts.finish());
  EXPECT_NEAR(meter.at({0, 2, 0}, {0, -1, 0}).g, 100.0 / 9 * 0.9, 0.01);
  EXPECT_EQ(meter.at({3 * std::tan(0.21f), 2, 0}, {0, -1, 0}), DVec3(0));
}

TEST(VirtualLights, TwoMirrorsOneAfterTheOther) {
  SceneParts parts = floor_mirror(Vec3(0.5f));
  parts.quad("upper", parts.add(mirror(Vec3(0.8f))), {-2, 1, -2}, {4, 0, 0}, {0, 0, 4});  // it looks down
  parts.scene().lights = {point_light({-0.3f, 0.5f, 0})};
  const LightMeter meter(parts.finish());
  // Beside the lower mirror, of the lamp and of its images by one, two and three mirrors; those by more miss it.
  const auto from = [&](double height) {
    const double d2 = 1.8 * 1.8 + height * height, cosine = height / std::sqrt(d2);
    return std::pair(100 / d2 * cosine, cosine);
  };
  const auto [direct, c0] = from(0.5);
  const auto [once, c1] = from(1.5);
  const auto [twice, c2] = from(2.5);
  const auto [thrice, c3] = from(3.5);
  const double expected = direct + once * schlick(0.8, c1) + twice * schlick(0.8, c2) * schlick(0.5, c2) +
                          thrice * schlick(0.8, c3) * schlick(0.5, c3) * schlick(0.8, c3);
  EXPECT_NEAR(meter.at({1.5f, 0, 0}, {0, 1, 0}).g / expected, 1, 1e-4);
}

TEST(VirtualLights, ASunAsWideAsTheSkyReachesAllThatItDid) {
  SceneParts parts = floor_mirror();
  parts.scene().lights = {sun_at(60)};
  parts.scene().lights[0].angular_radius_rad = kPi / 2;
  const Scene scene = parts.finish();
  const LightSet lights(scene);
  ASSERT_EQ(lights.mirrored().size(), 1u);
  EXPECT_TRUE(lights.mirrored()[0].may_reach({2, 3, 0}, 0));
}

TEST(VirtualLights, WhatTheyMayNotReachTheyDoNotLight) {
  SceneParts parts = floor_mirror(Vec3(0.5f));
  const auto metal = parts.add(mirror(Vec3(0.8f)));
  parts.quad("upper", metal, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2});
  parts.quad("slanted", metal, {-1.5f, 0, 0.5f}, {0.3f, 0.9f, 0}, {0, 0, -1});
  parts.scene().lights = {sun_at(70), sun_at(60), point_light({0.2f, 1, 0.1f})};
  parts.scene().lights[1].angular_radius_rad = 0.05f;
  const Scene scene = parts.finish();
  const LightSet lights(scene);
  const VirtualLights& mirrored = lights.mirrored();
  ASSERT_GT(mirrored.size(), 5u);
  int shone = 0, passed_over = 0;
  for (std::uint32_t k = 0; k < 20000; ++k) {
    Sampler sampler(1, 0, k);
    const Vec2 a = sampler.next2();
    const Vec3 p(10 * a.x - 5, 6 * sampler.next1() - 1, 10 * a.y - 5);
    const double radius = double{sampler.next1()};
    const DVec3 centre = DVec3(p) + DVec3(0, 0.999 * radius, 0);
    for (std::size_t i = 0; i < mirrored.size(); ++i) {
      if (!mirrored[i].may_reach(DVec3(p), 0)) ++passed_over;
      if (mirrored.sample(i, lights, p, sampler.next2()).share == Vec3(0)) continue;
      ++shone;
      EXPECT_TRUE(mirrored[i].may_reach(DVec3(p), 0)) << i << " at " << p.x << " " << p.y << " " << p.z;
      EXPECT_TRUE(mirrored[i].may_reach(centre, radius)) << i << " at " << p.x << " " << p.y << " " << p.z;
    }
  }
  EXPECT_GT(shone, 1000);
  EXPECT_GT(passed_over, 10000 * int(mirrored.size())) << "most are never asked";
}

TEST(VirtualLights, APaneReflectsAndPassesNoMoreThanCame) {
  for (const float height : {5.0f, 30.0f, 60.0f, 89.0f}) {
    SceneParts parts;
    parts.quad("pane", parts.add(pane({0.9f, 0.5f, 0.1f})), {-50, 0, 50}, {100, 0, 0}, {0, 0, -100});
    parts.scene().lights = {sun_at(height)};
    const LightMeter meter(parts.finish());
    const double came = 1000 * std::sin(height * kPiD / 180);
    const Vec3 above = meter.at({0, 0.5f, 0}, {0, -1, 0}), below = meter.at({0, -0.5f, 0}, {0, 1, 0});
    EXPECT_GT(above.g, 0.03 * came);
    EXPECT_LE(above.r + below.r, came * 1.001);
    EXPECT_NEAR(below.g / below.r, 0.5 / 0.9, 1e-3) << "tinted by the pane";
    EXPECT_NEAR(above.g, above.r, 1e-4 * came) << "and not by its face";
  }
}

TEST(VirtualLights, ShadowsFallOnBothLegs) {
  SceneParts parts = floor_mirror();
  const auto black = parts.diffuse(Vec3(0));
  parts.scene().lights = {sun_at(60)};
  const Vec3 p(3 / std::sqrt(3.0f), 3, 0);
  SceneParts before = parts, after = parts;
  before.quad("before", black, {-1, 1, -0.2f}, {0.8f, 0, 0}, {0, 0, 0.4f});  // over (-0.58, 1)
  after.quad("after", black, {0.4f, 1, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f});
  EXPECT_GT(LightMeter(parts.finish()).at(p, {0, -1, 0}).g, 700);
  EXPECT_EQ(LightMeter(before.finish()).at(p, {0, -1, 0}), DVec3(0));
  EXPECT_EQ(LightMeter(after.finish()).at(p, {0, -1, 0}), DVec3(0));
}

TEST(VirtualLights, MirrorsThatFaceEachOtherEnd) {
  SceneParts parts;
  const auto m = parts.add(mirror(Vec3(0.95f)));
  parts.quad("left", m, {-1, -1, -1}, {0, 2, 0}, {0, 0, 2});
  parts.quad("right", m, {1, -1, -1}, {0, 0, 2}, {0, 2, 0});
  parts.scene().lights = {point_light({0.2f, 0, 0})};
  const LightMeter meter(parts.finish());
  EXPECT_EQ(meter.lights().mirrored().size(), 16u) << "eight images each way";
  EXPECT_EQ(meter.lights().mirrored().left_out(), 0);
  const Vec3 e = meter.at({0, 0, 0.5f}, {0, 0, -1});
  EXPECT_TRUE(is_finite(e));
  EXPECT_GT(e.g, 100 / (0.04 + 0.25) * 0.5);
}

TEST(VirtualLights, ScenesWithoutMirrorsPayNothing) {
  SceneParts matt;
  matt.quad("floor", matt.diffuse(Vec3(0.5f)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  matt.scene().lights = {sun_at(60), point_light({0, 1, 0})};
  EXPECT_TRUE(VirtualLights(matt.finish()).empty());
  SceneParts dark = floor_mirror();
  EXPECT_TRUE(VirtualLights(dark.finish()).empty()) << "no light";
  SceneParts rough = floor_mirror();
  rough.scene().materials[0].roughness = 0.2f;
  rough.scene().lights = {sun_at(60)};
  EXPECT_TRUE(VirtualLights(rough.finish()).empty()) << "paths find its lobe";
  SceneParts off = floor_mirror();
  off.scene().lights = {sun_at(60)};
  off.scene().light_mirrors = 0;
  EXPECT_TRUE(VirtualLights(off.finish()).empty());
  SceneParts ball;
  ball.sphere("ball", ball.add(mirror(Vec3(1))), Vec3(0), 1, 3);
  ball.scene().lights = {sun_at(60)};
  EXPECT_TRUE(VirtualLights(ball.finish()).empty()) << "not flat";
}

TEST(VirtualLights, AnIndexOfOneReflectsNothingAndZeroIsAMirror) {
  for (const auto& [ior, expected] : {std::pair{1.0f, 0.0}, std::pair{0.0f, 1.0}, std::pair{0.5f, -1.0}}) {
    SceneParts parts;
    SceneMaterial m = pane(Vec3(1));
    m.ior = ior;
    parts.quad("pane", parts.add(m), {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    parts.scene().lights = {sun_at(60)};
    const LightMeter meter(parts.finish());
    const double came = 1000 * std::sin(kPiD / 3);
    const float up = meter.at({0, 0.5f, 0}, {0, -1, 0}).g, down = meter.at({0, -0.5f, 0}, {0, 1, 0}).g;
    EXPECT_LE(up + down, came * 1.001) << ior;
    if (expected >= 0) {
      EXPECT_NEAR(up, expected * came, 1e-3 * came) << ior;
    }
  }
}

TEST(VirtualLights, PanesInOnePlaneAreOneMirror) {
  SceneParts parts;
  const auto glass = parts.add(pane(Vec3(1)));
  for (int i = 0; i < 6; ++i) parts.quad("pane", glass, {i * 1.1f, 0, 0}, {1, 0, 0}, {0, 2, 0});
  parts.scene().lights = {point_light({2, 1, 3})};
  const LightMeter meter(parts.finish());
  EXPECT_EQ(meter.lights().mirrored().size(), 1u);
  EXPECT_EQ(meter.lights().mirrored().mirrors().size(), 2u) << "a front and a back";
  const Vec3 through(1.05f, 1, 0);  // between two panes
  const auto at = [&](const Vec3& on) { return on + (on - Vec3(2, 1, -3)) * 0.5f; };
  EXPECT_EQ(meter.at(at(through), {0, 0, -1}), DVec3(0));
  EXPECT_GT(meter.at(at({1.2f, 1, 0}), {0, 0, -1}).g, 0.1);
}

}  // namespace
}  // namespace oriel
