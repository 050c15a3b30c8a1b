// Point, spot and directional lights against closed forms.
#include <gtest/gtest.h>

#include "bake/scene/ldt.h"
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
  light.mirrored = true;
  EXPECT_NEAR(punctual_intensity(scene, light, {-s, -0.5f, 0}).g, 100, 0.01);
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

// Headers as LM-63 of 1986 to 2019 and their writers have them: 1000 cd times 0.5, and 0.5 again before 2019.
TEST(Ies, HeadersOfAllYearsAreRead) {
  const std::string numbers = "\n1 -1 1 3 1 1 2 0 0 0\n.5 .5 20\n0 45 90\n0\n1000 1000 1000\n";
  const auto candela = [](const std::string& text) {
    const auto file = parse_ies(text, "lamp.ies");
    return file ? file->profile.candela.front() : -1.0f;
  };
  for (const char* header :
       {"IESNA:LM-63-2002\nTILT=NONE", "IESNA: LM-63-1995\n[TEST] x\nTILT=NONE", "iesna:lm-63-2002\ntilt=none",
        "IESNA91\nTILT=NONE", "A luminaire of 1986\nTILT=NONE", "TILT=NONE",
        "\xEF\xBB\xBFIESNA:LM-63-2002\nTILT = NONE ", "IESNA:LM-63-2002\nTILT=askew.tlt"})
    EXPECT_EQ(candela(header + numbers), 250) << header;
  EXPECT_EQ(candela("IESNA:LM-63-2019\nTILT=NONE" + numbers), 500);
  std::string returns = "IESNA91\nTILT=NONE" + numbers;
  std::ranges::replace(returns, '\n', '\r');
  EXPECT_EQ(candela(returns), 250);
  EXPECT_EQ(candela("IESNA91\nTILT=NONE\n1,-1,1,3,1,1,2,0,0,0\n.5;.5;2D1\n0 45\n90\n0\n1.0D3 1000\n1000"), 250);
  const auto no_tilt = parse_ies("IESNA91" + numbers, "lamp.ies");
  ASSERT_FALSE(no_tilt);
  EXPECT_NE(no_tilt.error().text().find("expected a line TILT=NONE"), std::string::npos);
}

TEST(Ies, RangesOfAnglesAreCompleted) {
  const auto profile = [](const std::string& angles) {
    return parse_ies("IESNA91\nTILT=NONE\n1 -1 1 " + angles, "lamp.ies");
  };
  // 0 to 60: dark beyond.
  const auto narrow = profile("2 1 1 2 0 0 0 1 1 20 0 60 0 7 7");
  ASSERT_TRUE(narrow);
  EXPECT_EQ(profile_candela(narrow->profile, 59, 0), 7);
  EXPECT_EQ(profile_candela(narrow->profile, 61, 0), 0);
  // 0 to 270 in steps of 90: 360 is 0 again.
  const auto round = profile("2 4 1 2 0 0 0 1 1 20 0 90 0 90 180 270 1 1 2 2 3 3 4 4");
  ASSERT_TRUE(round);
  for (const auto& [angle, expected] : {std::pair{0.0f, 1.0f}, {90, 2}, {180, 3}, {270, 4}, {315, 2.5f}})
    EXPECT_NEAR(profile_candela(round->profile, 45, angle), expected, 1e-4) << angle;
  // 180 to 360 is the mirror image of 0 to 180.
  const auto half = profile("2 3 1 2 0 0 0 1 1 20 0 90 180 270 360 1 1 2 2 3 -0.01");
  ASSERT_TRUE(half);
  for (const auto& [angle, expected] : {std::pair{0.0f, 3.0f}, {90, 2}, {180, 1}, {270, 2}, {315, 2.5f}})
    EXPECT_NEAR(profile_candela(half->profile, 0, angle), expected, 1e-4) << angle;
  EXPECT_EQ(profile_candela(half->profile, 90, 0), 0);
  ASSERT_EQ(half->warnings.size(), 1u);
  EXPECT_NE(half->warnings[0].find("1 of 6 candela values are negative"), std::string::npos);
  EXPECT_FALSE(profile("2 2 1 2 0 0 0 1 1 20 0 90 0 45 1 1 2 2"));
  EXPECT_FALSE(profile("2 1 2 2 0 0 0 1 1 20 0 90 0 1 1"));  // type B
}

// An EULUMDAT file of four planes, gamma 0 and 90: intensities per 1000 lm of a lamp of 2000 lm.
std::string eulumdat(int symmetry, const std::string& intensities) {
  std::string text = "Maker\r\n1\r\n" + std::to_string(symmetry) + "\r\n4\r\n90\r\n2\r\n90\r\n";
  for (int i = 0; i < 15; ++i) text += "0\r\n";
  text += "100\r\n1,0\r\n0\r\n1\r\n1\r\nLED\r\n2000\r\n3000\r\n80\r\n20\r\n";
  for (int i = 0; i < 10; ++i) text += "0.5\r\n";
  return text + "0\r\n90\r\n180\r\n270\r\n0\r\n90\r\n" + intensities;
}

TEST(Eulumdat, SymmetriesUnfold) {
  struct Case {
    int symmetry;
    const char* intensities;     // of the planes that the file holds
    std::array<float, 4> plane;  // at C 0, 90, 180 and 270, cd
  };
  for (const Case& c : {Case{0, "1\n1\n2\n2\n3\n3\n4\n4\n", {2, 4, 6, 8}}, Case{1, "1\n1\n", {2, 2, 2, 2}},
                        Case{2, "1\n1\n2\n2\n3\n3\n", {2, 4, 6, 4}}, Case{3, "4\n4\n1\n1\n2\n2\n", {2, 4, 2, 8}},
                        Case{4, "1\n1\n2\n2\n", {2, 4, 2, 4}}}) {
    const auto file = parse_ldt(eulumdat(c.symmetry, c.intensities), "lamp.ldt");
    ASSERT_TRUE(file) << c.symmetry << file.error().text();
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(profile_candela(file->profile, 45, 90.0f * static_cast<float>(i)), c.plane[i], 1e-4)
          << c.symmetry << " plane " << i;
  }
}

TEST(Eulumdat, FluxIsThatOfTheLamp) {
  // Lambertian: 1000 lm give 1000/π cd along the axis; two angles make it linear, of flux 2π · I0 (1 - 2/π).
  const auto file = parse_ldt(eulumdat(1, "100\n-0.5\n"), "lamp.ldt");
  ASSERT_TRUE(file);
  EXPECT_NEAR(profile_flux(file->profile), 2 * kPiD * 200 * (1 - 2 / kPiD), 1e-3);
  for (const char* bad : {"1\n", "1\nx\n", "1\n1e99\n"}) {
    const auto refused = parse_ldt(eulumdat(1, bad), "lamp.ldt");
    ASSERT_FALSE(refused) << bad;
    EXPECT_NE(refused.error().text().find("lamp.ldt: line 5"), std::string::npos) << refused.error().text();
  }
  EXPECT_FALSE(parse_ldt("", "lamp.ldt"));
  EXPECT_FALSE(parse_ldt(eulumdat(5, ""), "lamp.ldt"));
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
