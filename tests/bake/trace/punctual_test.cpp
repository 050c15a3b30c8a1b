// Point, spot and directional lights against closed forms.
#include <gtest/gtest.h>

#include "bake/scene/ies.h"
#include "bake/trace/path.h"
#include "bake/trace/warp.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

// 0° to 90° in steps of 1°, I0 cosθ.
LightProfile lambertian(float candela) {
  std::string text = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 91 1 1 2 0 0 0\n1 1 10\n";
  for (int i = 0; i <= 90; ++i) text += fmt::format("{} ", i);
  text += "\n0\n";
  for (int i = 0; i <= 90; ++i) text += fmt::format("{}\n", candela * std::max(0.0, std::cos(i * kPiD / 180)));
  return parse_ies(text, "lambertian.ies")->profile;
}

// A floor of half side 3 under one light.
struct Floor {
  explicit Floor(const Light& light) {
    parts.quad("floor", parts.diffuse(Vec3(0)), {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
    parts.scene().lights = {light};
  }
  test::SceneParts parts;

  // Mean direct illuminance at (x, 0, 0).
  double lux(float x, std::uint32_t samples) {
    const Scene scene = parts.finish();
    const Accel accel = *Accel::build(scene);
    const LightSet lights(scene);
    const Transport transport{accel, lights, {}};
    const Hit hit = accel.intersect({{x, 0.01f, 0}, {0, -1, 0}});
    const SurfacePoint p = geometry_at(scene, hit, {0, -1, 0});
    double sum = 0;
    std::uint64_t rays = 0;
    for (std::uint32_t i = 0; i < samples; ++i) {
      Sampler sampler(1, 0, i);
      sum += sample_irradiance(transport, p, sampler, rays).direct.g;
    }
    return sum / samples;
  }
};

TEST(Profile, LambertianLightsAFloorAsTheClosedFormSays) {
  Light light;
  light.position = {0, 2, 0};
  light.direction = {0, -1, 0};
  light.right = {1, 0, 0};
  light.intensity = Vec3(7);  // not what the profile says: ignored
  light.profile = 0;
  Floor floor(light);
  floor.parts.scene().profiles = {lambertian(300)};
  for (const float x : {0.0f, 1.0f, 2.5f}) {
    const double d2 = 4 + x * x;
    EXPECT_NEAR(floor.lux(x, 4) / (300 * 4 / (d2 * d2)), 1, 1e-3) << x;  // I0 cosθ · cosθ / d²
  }
  // Horizontally, and upwards: nothing.
  const Scene scene = floor.parts.finish();
  EXPECT_EQ(punctual_intensity(scene, light, {0, 1, 0}), Vec3(0));
  EXPECT_NEAR(punctual_intensity(scene, light, {1, 0, 0}).g, 0, 1e-3);
  EXPECT_NEAR(punctual_power(scene, light).g / (kPiD * 300), 1, 1e-4);
}

TEST(Profile, AnglesFollowTheNode) {
  // A narrow beam at vertical 60°, horizontal 90°: half towards nadir, half towards node +Y.
  LightProfile beam{"beam", {0, 55, 60, 65, 90}, {0, 80, 90, 100, 360}, std::vector<float>(25, 0)};
  beam.candela[2 * 5 + 2] = 100;
  Scene scene;
  scene.profiles = {beam};
  Light light;
  light.profile = 0;  // as glTF leaves it: -Z down the beam, +X to the right
  const float s = std::sqrt(0.75f);
  EXPECT_NEAR(punctual_intensity(scene, light, {0, s, -0.5f}).g, 100, 0.01);
  EXPECT_NEAR(punctual_intensity(scene, light, {0, -s, -0.5f}).g, 0, 0.01);
  EXPECT_NEAR(punctual_intensity(scene, light, {s, 0, -0.5f}).g, 0, 0.01);
  light.direction = {0, -1, 0};
  light.right = {0, 0, 1};  // node +Y = right × direction = +X
  EXPECT_NEAR(punctual_intensity(scene, light, {s, -0.5f, 0}).g, 100, 0.01);
}

TEST(Profile, SymmetriesUnfold) {
  LightProfile p{"p", {0, 180}, {0, 45, 90}, {0, 0, 45, 45, 90, 90}};
  for (const auto& [angle, expected] : {std::pair{30.0f, 30.0f}, {150, 30}, {210, 30}, {330, 30}, {-30, 30}, {90, 90}})
    EXPECT_NEAR(profile_candela(p, 50, angle), expected, 1e-3) << angle;
  p.horizontal_deg = {0, 90, 180};
  p.candela = {0, 0, 90, 90, 180, 180};
  for (const auto& [angle, expected] : {std::pair{30.0f, 30.0f}, {150, 150}, {210, 150}, {330, 30}})
    EXPECT_NEAR(profile_candela(p, 50, angle), expected, 1e-3) << angle;
  p.horizontal_deg = {90, 180, 270};
  p.candela = {90, 90, 180, 180, 270, 270};
  for (const auto& [angle, expected] : {std::pair{100.0f, 100.0f}, {200, 200}, {30, 150}, {300, 240}})
    EXPECT_NEAR(profile_candela(p, 50, angle), expected, 1e-3) << angle;
  p.vertical_deg = {90, 180};
  EXPECT_EQ(profile_candela(p, 80, 100), 0);
}

// A pin spot of a degree shines on its axis as bright as it says, and nowhere beside.
TEST(Punctual, NarrowSpotsKeepTheirIntensity) {
  const Scene scene;
  Light spot;
  spot.type = LightType::kSpot;
  spot.direction = {0, 0, 1};
  spot.intensity = Vec3(7);
  for (const float outer : {0.3f, 0.03f, 0.003f}) {
    spot.inner_cone_rad = outer * 2 / 3, spot.outer_cone_rad = outer;
    const auto at = [&](float angle) {
      return punctual_intensity(scene, spot, Vec3(std::sin(angle), 0, std::cos(angle))).g;
    };
    EXPECT_FLOAT_EQ(at(0), 7) << outer;
    EXPECT_FLOAT_EQ(at(0.6f * outer), 7) << outer;
    EXPECT_EQ(at(1.1f * outer), 0) << outer;
  }
}

// Power is the integral of intensity, whatever the light.
TEST(Punctual, PowerIsTheIntegralOfIntensity) {
  Scene scene;
  scene.profiles = {{"p", {0, 30, 90, 140, 180}, {0, 70, 180}, {5, 9, 1, 0, 2, 5, 3, 8, 8, 2, 5, 1, 0, 4, 2}}};
  Light point, spot, tight, measured;
  point.intensity = spot.intensity = tight.intensity = Vec3(3);
  spot.type = tight.type = LightType::kSpot;
  spot.inner_cone_rad = 0.3f;
  tight.inner_cone_rad = 0.4999f;  // nearly no falloff
  spot.outer_cone_rad = tight.outer_cone_rad = 0.5f;
  measured.profile = 0;
  for (const Light& light : {point, spot, tight, measured}) {
    double sum = 0;
    constexpr int kSteps = 10000;  // a sharp cone ends within one
    for (int i = 0; i < kSteps; ++i)
      for (int k = 0; k < 180; ++k) {
        const double z = -1 + 2 * (i + 0.5) / kSteps, phi = 2 * kPiD * (k + 0.5) / 180, r = std::sqrt(1 - z * z);
        sum += punctual_intensity(scene, light, Vec3(DVec3(r * std::cos(phi), r * std::sin(phi), z))).g;
      }
    EXPECT_NEAR(sum * 4 * kPiD / (kSteps * 180) / punctual_power(scene, light).g, 1, 3e-3);
  }
}

Light sun_of(float diameter_deg) {
  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = {0, -1, 0};
  sun.intensity = Vec3(1000);
  sun.angular_radius_rad = diameter_deg * kPi / 360;
  return sun;
}

TEST(Sun, ItsSizeKeepsTheIlluminance) {
  for (const float diameter : {0.0f, 0.53f, 10.0f, 120.0f}) {
    Floor floor(sun_of(diameter));
    EXPECT_NEAR(floor.lux(0.3f, 1024) / 1000, 1, 1e-3) << diameter;
  }
}

// Under the edge of a half plane the shadow is half: the penumbra runs over twice the tangent of the radius.
TEST(Sun, CastsAPenumbra) {
  Floor floor(sun_of(10));
  floor.parts.quad("roof", 0, {-100, 1, -100}, {100, 0, 0}, {0, 0, 200});
  const float edge = std::tan(5 * kPi / 180);
  EXPECT_NEAR(floor.lux(0, 4096) / 1000, 0.5, 5e-3);
  EXPECT_NEAR(floor.lux(-1.05f * edge, 1024), 0, 1e-3);
  EXPECT_NEAR(floor.lux(1.05f * edge, 1024) / 1000, 1, 1e-3);
  const double part = floor.lux(0.5f * edge, 4096) / 1000;  // a chord at half the radius: 1/3 + √3/(4π) is cut off
  EXPECT_NEAR(part, 1 - (1 / 3.0 - std::sqrt(3.0) / (4 * kPiD)), 0.01);
}

TEST(Sun, DoesNotCrowdOutTheLamps) {
  Light lamp;
  lamp.position = {0, 1, 0};
  lamp.intensity = Vec3(10);
  Floor floor(lamp);
  floor.parts.scene().lights.push_back(sun_of(0.53f));
  floor.parts.scene().lights.back().intensity = Vec3(1e5f);
  floor.parts.quad("roof", 0, {-100, 2, -100}, {200, 0, 0}, {0, 0, 200});
  EXPECT_NEAR(floor.lux(0, 64) / 10, 1, 0.05) << "half of the samples go to the hidden sun, not nearly all";
}

}  // namespace
}  // namespace oriel
