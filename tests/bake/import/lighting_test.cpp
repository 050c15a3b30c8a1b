// What the options add to a file's lights: sky images, IES profiles, the sun's size. And what they refuse.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "bake/scene/ies.h"
#include "bake/scene/sky.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

constexpr const char* kIes = R"(IESNA:LM-63-2002
[TEST] 1
[MANUFAC] Nobody
TILT=NONE
1 1000 2 3 2 1 2 0.1 0.1 0
0.5 1 40
0 45 90
0 90
100 50 0
200, 100, 0
)";

TEST(Ies, ReadsAProfile) {
  const auto file = parse_ies(kIes, "a.ies");
  ASSERT_TRUE(file) << file.error().text();
  EXPECT_EQ(file->profile.vertical_deg, (std::vector<float>{0, 45, 90}));
  EXPECT_EQ(file->profile.horizontal_deg, (std::vector<float>{0, 90}));
  EXPECT_EQ(file->profile.candela, (std::vector<float>{100, 50, 0, 200, 100, 0})) << "times 2, times 0.5";
  EXPECT_TRUE(file->warnings.empty());
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Ies, TiltAndOlderHeadersAndOddLines) {
  for (const char* header : {"IESNA:LM-63-1995", "IESNA91", "IESNA:LM-63-2002 \r"})
    EXPECT_TRUE(parse_ies(replaced(kIes, "IESNA:LM-63-2002", header), "a")) << header;
  const auto tilted = parse_ies(replaced(kIes, "TILT=NONE", "TILT=INCLUDE\n1\n3\n0 45 90\n1 .9 .8"), "a");
  ASSERT_TRUE(tilted) << tilted.error().text();
  EXPECT_EQ(tilted->warnings.size(), 1u);
  EXPECT_EQ(tilted->profile.candela.size(), 6u);
  const auto more = parse_ies(std::string(kIes) + "\n7\n", "a");
  ASSERT_TRUE(more);
  EXPECT_EQ(more->warnings.size(), 1u);
}

TEST(Ies, EveryMistakeIsNamedWithItsLine) {
  struct Case {
    const char *from, *to, *message;
  };
  for (const Case& c : std::initializer_list<Case>{
           {"TILT=NONE", "", "expected a line TILT="},
           {"1 1000 2", "one 1000 2", "line 5: found 'one'"},
           {"3 2 1 2", "3 2 2 2", "line 5: found photometric type 2 (B)"},
           {"3 2 1 2", "3 2 3 2", "photometric type 3 (A)"},
           {"3 2 1 2", "3.5 2 1 2", "found 3.5, expected the number of vertical angles as a whole number"},
           {"3 2 1 2", "1e9 2 1 2", "found '1e9'"},
           {"3 2 1 2", "nan 2 1 2", "found 'nan'"},
           {"0.5 1 40", "-0.5 1 40", "line 6: found '-0.5', expected the ballast factor"},
           {"0 45 90", "0 45 45", "line 7: found vertical angle 45 after 45"},
           {"0 90\n", "0 120\n", "found horizontal angles from 0 to 120"},
           {"100 50 0", "100 inf 0", "found 'inf'"},
           {"200, 100, 0\n", "200, 100\n", "found the end of the file, expected candela value 6 of 6"},
       }) {
    const auto file = parse_ies(replaced(kIes, c.from, c.to), "a.ies");
    ASSERT_FALSE(file) << c.to;
    EXPECT_EQ(file.error().code, ErrorCode::kInvalid);
    EXPECT_NE(file.error().text().find(c.message), std::string::npos) << file.error().text();
    EXPECT_NE(file.error().text().find("a.ies: line "), std::string::npos);
  }
  // Every prefix is an error, and none a crash.
  const std::string text(kIes);
  for (std::size_t n = 0; n + 2 < text.size(); ++n) EXPECT_FALSE(parse_ies(text.substr(0, n), "a.ies")) << n;
}

Gltf with_lights() {
  Gltf g = triangle();
  g.use("KHR_lights_punctual");
  g.doc["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([
    {"type":"point","color":[1,0.5,0],"intensity":100},
    {"type":"directional","extras":{"oriel":{"angular_diameter_deg":0.5}}},
    {"type":"directional","extras":"anything"}])")
                                                             .value();
  const char* names[] = {"lamp", "sun", "moon"};
  for (int i = 0; i < 3; ++i) {
    g.doc["nodes"].push_back({{"name", names[i]}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    g.doc["scenes"][0]["nodes"].push_back(i + 1);
  }
  return g;
}

TEST(Lighting, ProfilesGoToTheirNodes) {
  const TempFolder folder;
  ImportOptions options;
  options.ies = {{"lamp", folder.write("a.ies", kIes)}};
  const Imported r = import(with_lights(), options);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(r.scene().lights[0].profile, 0);
  EXPECT_EQ(r.scene().lights[0].color, Vec3(1, 0.5f, 0));
  EXPECT_EQ(r.scene().lights[0].right, Vec3(1, 0, 0));
  EXPECT_EQ(r.scene().lights[1].profile, -1);
  EXPECT_EQ(r.result->inputs.back().first, "a.ies");

  for (const char* node : {"lampe", "sun"}) {
    options.ies = {{node, folder.path() / "a.ies"}};
    const Imported wrong = import(with_lights(), options);
    ASSERT_FALSE(wrong.ok());
    EXPECT_EQ(wrong.result.error().code, ErrorCode::kUsage);
    EXPECT_NE(wrong.error().find("the nearest are \"lamp\""), std::string::npos) << wrong.error();
  }
  options.ies = {{"lamp", folder.path() / "missing.ies"}};
  EXPECT_EQ(import(with_lights(), options).result.error().code, ErrorCode::kIo);
}

TEST(Lighting, TheSunHasASize) {
  const auto radius = [](const Imported& r, std::size_t light) { return r.scene().lights[light].angular_radius_rad; };
  Gltf g = with_lights();
  EXPECT_FLOAT_EQ(radius(import(g), 1), 0.25f * kPi / 180);
  EXPECT_FLOAT_EQ(radius(import(g), 2), 0.2665f * kPi / 180) << "as the sun";
  EXPECT_EQ(radius(import(g), 0), 0) << "a point";
  g.doc["nodes"][2]["extras"]["oriel"]["angular_diameter_deg"] = 2;
  EXPECT_FLOAT_EQ(radius(import(g), 1), kPi / 180) << "the node's own";
  ImportOptions options;
  options.sun_angle_deg = 4;
  EXPECT_FLOAT_EQ(radius(import(g, options), 1), 2 * kPi / 180);
  EXPECT_FLOAT_EQ(radius(import(g, options), 2), 2 * kPi / 180);
  options.sun_angle_deg = 0;
  EXPECT_EQ(radius(import(g, options), 1), 0);
  options.sun_angle_deg = 181;
  EXPECT_EQ(import(g, options).result.error().code, ErrorCode::kUsage);
  g.doc["nodes"][2]["extras"]["oriel"]["angular_diameter_deg"] = -1;
  EXPECT_NE(import(g).error().find("angular_diameter_deg"), std::string::npos);
}

// Of the sun alone, so high and so bright.
Gltf with_sun(double elevation_deg, double lux) {
  Gltf g = with_lights();
  const double half = elevation_deg * kPiD / 360;  // about +X: -Z goes down
  g.doc["nodes"][2]["rotation"] = {-std::sin(half), 0, 0, std::cos(half)};
  g.doc["extensions"]["KHR_lights_punctual"]["lights"][1]["intensity"] = lux;
  return g;
}

// On level ground, lux.
double sky_lux(const Scene& scene) {
  constexpr int kSteps = 200;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < kSteps; ++k) {
      const double up = std::sqrt((i + 0.5) / kSteps), out = std::sqrt(1 - up * up), phi = 2 * kPiD * k / kSteps;
      sum += sky_radiance(scene, Vec3(DVec3(out * std::cos(phi), up, out * std::sin(phi)))).g;
    }
  return kPiD * sum / (kSteps * kSteps);
}

TEST(ClearSky, StandsToTheFilesSunAsInNature) {
  ImportOptions options;
  options.clear_sky = true;
  // Gillette et al. 1984, clear: sun 127.5 exp(-0.21 / sin h) klx, sky 0.8 + 15.5 √sin h klx.
  for (const auto& [height, lux, expected] : {std::tuple{30.0, 83770.0, 11760.0},
                                              {30.0, 41885.0, 5880.0},
                                              {90.0, 103350.0 * 3, 16300.0 * 3},
                                              {3.0, 1e5, 800 + 15500 * std::sqrt(std::sin(3 * kPiD / 180))}}) {
    const Imported r = import(with_sun(height, lux), options);
    ASSERT_TRUE(r.ok()) << r.error();
    EXPECT_NEAR(sky_lux(r.scene()) / expected, 1, 0.02) << height << "°, " << lux << " lux";
    const double ground = 0.2 / kPiD * (expected + lux * std::sin(height * kPiD / 180));
    EXPECT_NEAR(sky_radiance(r.scene(), Vec3(0, -1, 0)).g / ground, 1, 0.01);
    EXPECT_TRUE(r.warned("--sky none")) << "told, with what leaves it out";
    // Brightest about the sun, which stands towards +Z.
    if (height == 30) {
      EXPECT_GT(sky_radiance(r.scene(), glm::normalize(Vec3(0, 0.5f, 0.86f))).g,
                3 * sky_radiance(r.scene(), glm::normalize(Vec3(0, 0.5f, -0.86f))).g);
    }
  }
}

TEST(ClearSky, IsThereForASunByDayAlone) {
  const auto has_sky = [](const Gltf& g, const ImportOptions& options) {
    const Imported r = import(g, options);
    EXPECT_TRUE(r.ok()) << r.error();
    return r.scene().sky != Vec3(0);
  };
  ImportOptions options;
  EXPECT_FALSE(has_sky(with_sun(30, 5e4), options)) << "who calls the library says what shines";
  options.clear_sky = true;
  EXPECT_TRUE(has_sky(with_sun(30, 5e4), options));
  EXPECT_TRUE(has_sky(with_sun(30, 683), options)) << "1 W/m² as Blender writes it";
  EXPECT_FALSE(has_sky(with_sun(-30, 5e4), options)) << "below the horizon";
  EXPECT_FALSE(has_sky(with_sun(30, 300), options)) << "a fill light";
  EXPECT_FALSE(has_sky(with_lights(), options)) << "level, 1 lux";
  options.sky = Vec3(7);
  EXPECT_EQ(import(with_sun(30, 5e4), options).scene().sky, Vec3(7)) << "as --sky has it";
}

TEST(LightScales, AreByNameAndTellOfNamesThatAreNot) {
  Gltf g = with_lights();
  json& glow = g.material();
  glow["name"] = "bulb glass", glow["emissiveFactor"] = {1, 1, 1};
  g.material()["name"] = "wall";
  ImportOptions options;
  options.lamp_scales = {{"", 0.5}, {"la*", 3}, {"sun", 2}};
  options.emission_scales = {{"bulb*", 683}};
  const Imported r = import(g, options);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(r.scene().lights[0].intensity, Vec3(150, 75, 0)) << "half, three times that";
  EXPECT_EQ(r.scene().lights[1].intensity, Vec3(2));
  EXPECT_EQ(r.scene().lights[2].intensity, Vec3(1));
  EXPECT_EQ(r.scene().materials[0].emission, Vec3(683));
  options.emission_scales = {{"wall", 2}};
  EXPECT_NE(import(g, options).error().find("the nearest are \"bulb glass\""), std::string::npos);
  options.emission_scales.clear(), options.lamp_scales = {{"lampe", 2}};
  EXPECT_NE(import(g, options).error().find("the nearest are \"lamp\""), std::string::npos);
}

// 4 × 2 texels, RGBE: (1, 0.5, 0.25) above, black below.
std::string tiny_hdr() {
  std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
  for (int i = 0; i < 4; ++i) text += std::string("\x80\x40\x20\x81", 4);
  return text + std::string(16, '\0');
}

TEST(Lighting, ASkyFileBecomesAnImage) {
  const TempFolder folder;
  ImportOptions options;
  options.sky_file = folder.write("sky.hdr", tiny_hdr());
  options.sky_scale = 100;
  options.sky_rotation_deg = 90;
  const Imported r = import(triangle(), options);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(r.scene().sky_image.width, 4u);
  EXPECT_EQ(r.scene().sky_image.texels[1], Vec3(100, 50, 25));
  EXPECT_FLOAT_EQ(r.scene().sky_image.rotation_rad, kPi / 2);
  EXPECT_NEAR(r.scene().sky.r, 50, 1e-3) << "the mean";
  EXPECT_EQ(r.result->inputs.back().first, "sky.hdr");
  EXPECT_TRUE(r.warnings.empty());
}

// An uncompressed scanline file of 2 × 1 32-bit floats, as OpenEXR's file layout document says.
std::string tiny_exr(const float (&rgb)[6]) {
  const auto bytes = [](auto value) { return std::string(reinterpret_cast<const char*>(&value), sizeof(value)); };
  const auto attribute = [&](const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + bytes(static_cast<std::int32_t>(value.size())) + value;
  };
  std::string channels;
  for (const char* name : {"B", "G", "R"})
    channels += std::string(name) + '\0' + bytes(std::int32_t{2}) + bytes(std::int32_t{0}) + bytes(std::int32_t{1}) +
                bytes(std::int32_t{1});
  const std::string window =
      bytes(std::int32_t{0}) + bytes(std::int32_t{0}) + bytes(std::int32_t{1}) + bytes(std::int32_t{0});
  std::string file = std::string("\x76\x2f\x31\x01\x02\0\0\0", 8) + attribute("channels", "chlist", channels + '\0') +
                     attribute("compression", "compression", std::string(1, '\0')) +
                     attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) +
                     attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
                     attribute("pixelAspectRatio", "float", bytes(1.0f)) +
                     attribute("screenWindowCenter", "v2f", bytes(0.0f) + bytes(0.0f)) +
                     attribute("screenWindowWidth", "float", bytes(1.0f)) + '\0';
  file += bytes(static_cast<std::uint64_t>(file.size() + 8));
  file += bytes(std::int32_t{0}) + bytes(std::int32_t{24});
  for (int c = 2; c >= 0; --c) file += bytes(rgb[c]) + bytes(rgb[3 + c]);
  return file;
}

TEST(Lighting, WhatIsNoRadianceIsReplacedAndCounted) {
  const TempFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  ImportOptions options;
  options.sky_file = folder.write("sky.exr", tiny_exr({nan, -1, 2, -0.5f, inf, 3}));
  const Imported r = import(triangle(), options);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(r.scene().sky_image.texels[0], Vec3(0, 0, 2));
  EXPECT_EQ(r.scene().sky_image.texels[1], Vec3(0, 65504, 3));
  EXPECT_TRUE(r.warned("1 values that are not a number and 2 negative"));
  EXPECT_TRUE(r.warned("1 infinite"));
}

TEST(Lighting, BrokenSkiesAreRefused) {
  const TempFolder folder;
  const auto error_of = [&](const std::string& name, const std::string& bytes, float scale = 1) {
    ImportOptions options;
    options.sky_file = bytes.empty() ? folder.path() / name : folder.write(name, bytes);
    options.sky_scale = scale;
    const Imported r = import(triangle(), options);
    EXPECT_FALSE(r.ok()) << name;
    return r.ok() ? ErrorCode::kRuntime : r.result.error().code;
  };
  EXPECT_EQ(error_of("missing.hdr", ""), ErrorCode::kIo);
  EXPECT_EQ(error_of("png.hdr", "\x89PNG\r\n"), ErrorCode::kInvalid);
  EXPECT_EQ(error_of("short.hdr", tiny_hdr().substr(0, 60)), ErrorCode::kInvalid);
  const std::string exr = tiny_exr({1, 1, 1, 1, 1, 1});
  EXPECT_EQ(error_of("short.exr", exr.substr(0, exr.size() - 8)), ErrorCode::kInvalid);
  EXPECT_EQ(error_of("header.exr", exr.substr(0, 40)), ErrorCode::kInvalid);
  EXPECT_EQ(error_of("scale.hdr", tiny_hdr(), -1), ErrorCode::kUsage);
}

}  // namespace
}  // namespace oriel::test
