// What --light takes, and what it makes of the lamps.
#include <gtest/gtest.h>

#include "formats/core/color.h"
#include "formats/core/file.h"
#include "player/session/light_settings.h"
#include "player/session/live_options.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

Pack pack_as_baked() {
  Pack pack = testing::tiny_mapped_pack();
  pack.light_groups[0].value = 1, pack.light_groups[0].color = Vec3(1);
  pack.day = {};
  return pack;
}

std::vector<Vec3> factors(const Pack& pack, const std::vector<std::string>& changes) {
  std::vector<LightSetting> settings = settings_of(pack);
  const Status set = set_lights(pack, changes, settings);
  EXPECT_TRUE(set) << set.error().text();
  return factors_of(pack, settings);
}

std::string refusal(const Pack& pack, const std::string& change) {
  std::vector<LightSetting> settings = settings_of(pack);
  const Status set = set_lights(pack, {change}, settings);
  return set ? "" : set.error().text();
}

TEST(Hours, AreReadAsNumbersAndOfClocks) {
  std::optional<float> hour;
  const OptionValue value = clock_hour(hour);
  for (const auto& [typed, hours] : {std::pair("14.5", 14.5f), std::pair("14:30", 14.5f), std::pair("0:00", 0.0f),
                                     std::pair("24:00", 24.0f), std::pair("08:15", 8.25f)}) {
    ASSERT_TRUE(value.set(typed)) << typed;
    EXPECT_EQ(hour, hours);
  }
  for (const char* bad : {"", "24:01", "14:60", "14:", ":30", "14:3x", "-1:30", "25", "noon"})
    EXPECT_FALSE(value.set(bad)) << bad;
}

TEST(Lights, AreDimmedSwitchedAndColoured) {
  const Pack pack = pack_as_baked();
  const Vec3 own = pack.light_groups[0].own_color;
  EXPECT_EQ(factors(pack, {}), std::vector<Vec3>(2, Vec3(1)));
  EXPECT_EQ(factors(pack, {"desk=0.3"}), (std::vector<Vec3>{Vec3(0.3f), Vec3(1)}));
  EXPECT_EQ(factors(pack, {"desk=0.3", "desk=off"})[0], Vec3(0));
  EXPECT_EQ(factors(pack, {"*=off", "hall=on"}), (std::vector<Vec3>{Vec3(0), Vec3(1)}));
  // Red of the luminance that the lamp has.
  const Vec3 red = factors(pack, {"desk=#ff0000"})[0] * own;
  EXPECT_NEAR(luminance(red), 1, 1e-5);
  EXPECT_EQ(red.g, 0);
  EXPECT_EQ(red.b, 0);
  const Vec3 dimmed = factors(pack, {"desk=2700K 0.5"})[0] * own;
  EXPECT_NEAR(luminance(dimmed), 0.5f, 1e-5);
}

// Planck's locus in xy: 2856 K is the CIE's illuminant A; 6504 K is a little pinker than D65.
TEST(Lights, HaveTheColourOfATemperature) {
  const auto expect = [](float kelvin, double x, double y) {
    const DVec3 c(color_of_kelvin(kelvin));
    const DVec3 xyz(0.4124564 * c.r + 0.3575761 * c.g + 0.1804375 * c.b,
                    0.2126729 * c.r + 0.7151522 * c.g + 0.0721750 * c.b,
                    0.0193339 * c.r + 0.1191920 * c.g + 0.9503041 * c.b);
    EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), x, 0.001);
    EXPECT_NEAR(xyz.y / (xyz.x + xyz.y + xyz.z), y, 0.001);
  };
  expect(2856, 0.4476, 0.4074);
  expect(6504, 0.3135, 0.3237);
  for (float k = kLeastKelvin; k <= kMostKelvin; k += 100) {
    const Vec3 color = color_of_kelvin(k);
    EXPECT_TRUE(is_finite(color));
    EXPECT_NEAR(luminance(color), 1, 1e-5);
  }
}

TEST(Lights, RefuseWhatTheyDoNotKnow) {
  const Pack pack = pack_as_baked();
  const std::string unknown = refusal(pack, "desc=off");
  EXPECT_NE(unknown.find("found the light group \"desc\", expected one of the pack's"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("\"desk\""), std::string::npos) << unknown;
  for (const char* bad : {"desk", "=off", "desk=", "desk=-1", "desk=101", "desk=nan", "desk=1600K", "desk=#ff",
                          "desk=#000000", "desk=dim"})
    EXPECT_NE(refusal(pack, bad), "") << bad;
  EXPECT_NE(refusal(testing::tiny_pack(), "desk=off").find("no light groups"), std::string::npos);
}

TEST(Lights, AreKeptInAFile) {
  const testing::TemporaryFolder folder;
  const Pack pack = pack_as_baked();
  std::vector<LightSetting> settings = settings_of(pack), again = settings;
  EXPECT_EQ(lights_json(pack, settings), "");
  ASSERT_TRUE(set_lights(pack, {"desk=0.25 2700K", "hall=#ff8000 off"}, settings));
  const std::string json = lights_json(pack, settings);
  const auto file = folder.path() / "evening.json";
  ASSERT_TRUE(write_file_atomically(file, std::as_bytes(std::span(json))));
  const auto changes = read_lights(file.string());
  ASSERT_TRUE(changes);
  ASSERT_TRUE(set_lights(pack, *changes, again));
  EXPECT_EQ(again[0], settings[0]);
  EXPECT_FALSE(again[1].on);
  EXPECT_NEAR(glm::length(*again[1].color - *settings[1].color), 0, 0.02);
  EXPECT_EQ(factors_of(pack, again)[1], Vec3(0));
  const std::string broken = "[1]";
  ASSERT_TRUE(write_file_atomically(file, std::as_bytes(std::span(broken))));
  EXPECT_FALSE(read_lights(file.string()));
  EXPECT_FALSE(read_lights((folder.path() / "none.json").string()));
}

// The pack's groups as the hours 9 and 15 of a day.
Pack pack_of_a_day() {
  Pack pack = pack_as_baked();
  for (std::uint32_t g = 0; g < 2; ++g) {
    DayHour hour;
    hour.hour = 9 + 6 * static_cast<float>(g), hour.group = g;
    pack.day.hours.push_back(hour);
    pack.light_groups[g].value = g == 0 ? 2.0f : 0.0f;
  }
  pack.day.shown_hour = 9;
  return pack;
}

TEST(Hours, AreShownByTheirSharesOfTheDay) {
  const Pack pack = pack_of_a_day();
  EXPECT_EQ(factors(pack, {}), (std::vector<Vec3>{Vec3(2), Vec3(0)})) << "as it opens";
  EXPECT_EQ(factors(pack, {"hour=15"}), (std::vector<Vec3>{Vec3(0), Vec3(2)}));
  EXPECT_EQ(factors(pack, {"hour=10.5"}), (std::vector<Vec3>{Vec3(1.5f), Vec3(0.5f)}));
  EXPECT_EQ(factors(pack, {"hour=10.5", "*=off"}), std::vector<Vec3>(2, Vec3(0)));
  EXPECT_EQ(factors(pack, {"hour=10.5", "*=0.5"}), (std::vector<Vec3>{Vec3(0.75f), Vec3(0.25f)}));
  EXPECT_NE(refusal(pack, "hour=16").find("expected 9 to 15 (solar time)"), std::string::npos)
      << refusal(pack, "hour=16");
  EXPECT_NE(refusal(pack, "hour=noon"), "");
  EXPECT_NE(refusal(pack_as_baked(), "hour=12").find("no day"), std::string::npos);
}

// One hour's lamps are no lamps that somebody would switch: the day is.
TEST(Hours, AreSetTogether) {
  Pack pack = pack_of_a_day();
  EXPECT_EQ(factors(pack, {"hour=10.5", "day=0.5"}), (std::vector<Vec3>{Vec3(0.75f), Vec3(0.25f)}));
  EXPECT_EQ(factors(pack, {"day=off"}), std::vector<Vec3>(2, Vec3(0)));
  const std::string one = refusal(pack, "desk=off");  // the hour 9
  EXPECT_NE(one.find("expected day for sun and sky of every hour"), std::string::npos) << one;
  EXPECT_NE(refusal(pack, "dusk=off").find("\"day\""), std::string::npos) << refusal(pack, "dusk=off");
  std::vector<LightSetting> settings = settings_of(pack), again = settings;
  ASSERT_TRUE(set_lights(pack, {"day=0.5 off"}, settings));
  EXPECT_EQ(lights_json(pack, settings), "{\n  \"day\": \"0.5 off\"\n}");
  ASSERT_TRUE(set_lights(pack, {"day=0.5 off"}, again));
  EXPECT_EQ(again, settings);
  const Status set = set_lights(pack, {"hour=30"}, settings, "evening.json");
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().where, "evening.json") << set.error().text();
}

TEST(Hours, ComeBackAfterAllWasSwitchedOff) {
  const Pack pack = pack_of_a_day();
  EXPECT_EQ(factors(pack, {"*=off", "hour=15"}), (std::vector<Vec3>{Vec3(0), Vec3(2)}));
}

TEST(Hours, AreKeptInAFile) {
  const Pack pack = pack_of_a_day();
  std::vector<LightSetting> settings = settings_of(pack), again = settings;
  EXPECT_EQ(lights_json(pack, settings), "");
  ASSERT_TRUE(set_hour(pack, 13.25f, settings));
  EXPECT_EQ(shown_hour(pack, settings), 13.25f);
  const std::string json = lights_json(pack, settings);
  EXPECT_EQ(json, "{\n  \"hour\": 13.25\n}");
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "afternoon.json";
  ASSERT_TRUE(write_file_atomically(file, std::as_bytes(std::span(json))));
  ASSERT_TRUE(set_lights(pack, read_lights(file.string()).value(), again));
  EXPECT_EQ(again, settings);
}

}  // namespace
}  // namespace oriel
