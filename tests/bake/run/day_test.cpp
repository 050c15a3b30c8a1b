// --day: what it takes, and which lights it makes.
#include <gtest/gtest.h>

#include "bake/run/light_groups.h"
#include "bake/scene/daylight.h"
#include "bake/scene/sky.h"
#include "formats/core/daylight.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

DayOptions solstice(const std::string& hours) {
  DayOptions o;
  EXPECT_TRUE(parse_day("2026-06-21@52.5,13.4", o));
  EXPECT_TRUE(parse_hours(hours, o));
  return o;
}

TEST(DayOptions, AreReadAndWritten) {
  DayOptions o;
  ASSERT_TRUE(parse_day("2026-06-21@-52.5,13.4,30", o));
  EXPECT_TRUE(o.wanted);
  EXPECT_EQ(o.date, (Date{2026, 6, 21}));
  EXPECT_EQ(std::tie(o.latitude_deg, o.longitude_deg, o.north_deg), std::tuple(-52.5, 13.4, 30.0));
  EXPECT_EQ(day_text(o), "2026-06-21@-52.5,13.4,30");
  EXPECT_EQ(hours_text(o), "8-18/1");
  for (const char* hours : {"8-18/1", "14.5-14.5/1", "6.25-20/0.25", "8-18/2+02:00", "0-24/1-03:30"}) {
    ASSERT_TRUE(parse_hours(hours, o)) << hours;
    DayOptions again;
    ASSERT_TRUE(parse_hours(hours_text(o), again)) << hours_text(o);
    EXPECT_EQ(std::tie(o.from_h, o.to_h, o.solar_time, o.utc_offset_h),
              std::tie(again.from_h, again.to_h, again.solar_time, again.utc_offset_h));
    if (o.from_h < o.to_h) {
      EXPECT_EQ(o.step_h, again.step_h);
    }
  }
  EXPECT_EQ(o.utc_offset_h, -3.5);
  EXPECT_FALSE(o.solar_time);
}

TEST(DayOptions, RefuseWhatTheyCannotBe) {
  DayOptions o;
  for (const char* bad : {"", "2026-06-21", "2026-02-30@52,13", "2026-06-21@", "2026-06-21@52", "2026-06-21@91,13",
                          "2026-06-21@52,181", "2026-06-21@52,13,400", "2026-06-21@52,13,4,5", "2026-06-21@52;13",
                          "2026-06-21@nan,13", "2026-06-21@52,13,", "52,13@2026-06-21"})
    EXPECT_FALSE(parse_day(bad, o)) << bad;
  EXPECT_FALSE(o.wanted);
  for (const char* bad :
       {"", "18-8/1", "8-18/0", "8-18/-1", "8-18/0.001", "8-25/1", "-1-5/1", "8-", "-", "8/1", "8-18/", "8-18/x",
        "8-18/1+15:00", "8-12:00", "8.025-8.5/0.016666667", "8-18/1+02:60", "8:30-18:00/1", "8-18/1/2", "nan-18/1"})
    EXPECT_FALSE(parse_hours(bad, o)) << bad;
  EXPECT_EQ(hours_text(o), "8-18/1") << "what was there before";
  EXPECT_TRUE(parse_hours("14.5-05:00", o));
  EXPECT_EQ(hours_text(o), "14.5-05:00") << "no later hour: a clock behind UTC";
}

// The image's share of level illuminance, summed over its texels' upper half.
double level_lux(const Scene& scene, std::size_t part) {
  const SkyImage& image = scene.sky_image;
  double sum = 0;
  for (std::uint32_t y = 0; y < image.height / 2; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const double theta = kPiD * (y + 0.5) / image.height;
      sum += scene.sky_parts.luminance[(std::size_t{y} * image.width + x) * scene.sky_parts.groups.size() + part] *
             std::cos(theta) * std::sin(theta) * (kPiD / image.height) * (2 * kPiD / image.width);
    }
  return sum;
}

TEST(Daylight, IsTheMeanOfItsHours) {
  Scene scene;
  Context context;
  ASSERT_TRUE(add_daylight(solstice("8-16/4"), scene, context));
  ASSERT_EQ(scene.day.hours.size(), 3u);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.day.shown_hour, 12);
  EXPECT_NEAR(scene.day.hours[0].to_sun.y, scene.day.hours[2].to_sun.y, 1e-3) << "morning and afternoon are alike";
  EXPECT_GT(scene.day.hours[0].to_sun.x, 0.5f) << "in the east";
  EXPECT_LT(scene.day.hours[2].to_sun.x, -0.5f);
  EXPECT_NEAR(scene.day.hours[1].to_sun.y, std::sin((90 - 52.5 + 23.436) * kPiD / 180), 1e-3);
  EXPECT_GT(scene.day.hours[1].to_sun.z, 0.4f) << "in the south";
  Vec3 mean(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const DayHour& hour = scene.day.hours[k];
    EXPECT_FLOAT_EQ(scene.lights[k].intensity.g, hour.sun_lux / 3);
    EXPECT_EQ(scene.lights[k].direction, -hour.to_sun);
    EXPECT_NEAR(level_lux(scene, k) / (hour.sky_lux / 3), 1, 2e-3);
    mean += hour.sky / 3.0f;
    // The brightest place of the sky is the sun's.
    std::vector<float> shares;
    shares_of_sky(scene, hour.to_sun, shares);
    for (std::size_t other = 0; other < 3; ++other) EXPECT_GE(shares[k], shares[other]);
  }
  EXPECT_NEAR(mean.g / scene.sky.g, 1, 1e-4);
}

// Parts sum to the image, in between texels too.
TEST(Daylight, IsSharedOutExactly) {
  Scene scene;
  Context context;
  ASSERT_TRUE(add_daylight(solstice("6-18/3"), scene, context));
  for (int i = 0; i < 1000; ++i) {
    const double up = 1 - (i + 0.5) / 500, phi = 2.39996 * i, level = std::sqrt(1 - up * up);
    const Vec3 direction(DVec3(level * std::cos(phi), up, level * std::sin(phi)));
    const Vec3 all = sky_radiance(scene, direction);
    Vec3 sum(0);
    each_owner(scene, sky_owner(scene), direction, all, [&](std::uint32_t, const Vec3& part) { sum += part; });
    ASSERT_NEAR(sum.g / all.g, 1, 1e-5);
  }
}

TEST(Daylight, TurnsWithNorth) {
  DayOptions o = solstice("12");
  o.north_deg = 90;  // north is +X
  Scene scene;
  Context context;
  ASSERT_TRUE(add_daylight(o, scene, context));
  EXPECT_LT(scene.day.hours[0].to_sun.x, -0.4f) << "the south is -X";
  EXPECT_NEAR(scene.day.hours[0].to_sun.z, 0, 1e-3);
}

TEST(Daylight, KnowsClocks) {
  Scene sundial, clock;
  Context context;
  ASSERT_TRUE(add_daylight(solstice("12"), sundial, context));
  // Berlin's summer time on that day: noon of the sun is at 13:08.2 (13.4° east is 53.6 min, the equation -1.8 min).
  ASSERT_TRUE(add_daylight(solstice("13.1367+02:00"), clock, context));
  EXPECT_NEAR(glm::length(sundial.day.hours[0].to_sun - clock.day.hours[0].to_sun), 0, 1e-3);
  EXPECT_EQ(clock.day.utc_offset_h, 2);
}

TEST(Daylight, TellsOfNightAndTakesOtherSunsOut) {
  Scene scene;
  Light sun;
  sun.name = "Sun", sun.type = LightType::kDirectional, sun.intensity = Vec3(1e5f);
  Light lamp;
  lamp.name = "lamp";
  scene.lights = {sun, lamp};
  std::string warned;
  Context context;
  context.warn = [&](const Warning& warning) { warned += warning.text + "\n"; };
  ASSERT_TRUE(add_daylight(solstice("0-24/6"), scene, context));
  EXPECT_EQ(scene.day.hours[0].group, kNight);
  EXPECT_EQ(scene.day.lit(), 3u);
  EXPECT_NE(warned.find("no light of the day: 00:00, 24:00"), std::string::npos) << warned;
  EXPECT_NE(warned.find("directional lights: \"Sun\""), std::string::npos) << warned;
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_EQ(scene.lights[0].name, "lamp");
  EXPECT_EQ(scene.lights[1].name, "sun 06:00");
}

TEST(Daylight, NeedsASunAndFewHours) {
  Context context;
  Scene scene;
  DayOptions polar = solstice("8-18/1");
  polar.date = {2026, 12, 21}, polar.latitude_deg = 80;
  const Status night = add_daylight(polar, scene, context);
  ASSERT_FALSE(night);
  EXPECT_EQ(night.error().code, ErrorCode::kUsage);
  EXPECT_NE(night.error().text().find("below the horizon"), std::string::npos);
  const Status many = add_daylight(solstice("4-20/0.25"), scene, context);
  ASSERT_FALSE(many);
  EXPECT_NE(many.error().text().find("expected at most 31"), std::string::npos) << many.error().text();
  EXPECT_TRUE(scene.day.empty());
  DayOptions midnight = solstice("0-24/1");
  midnight.latitude_deg = 80;
  ASSERT_TRUE(add_daylight(midnight, scene, context));
  EXPECT_EQ(scene.day.lit(), 25u);
}

TEST(Daylight, OvercastHasNoSun) {
  DayOptions o = solstice("10-14/2");
  o.sky_type = 1;
  Scene scene;
  Context context;
  ASSERT_TRUE(add_daylight(o, scene, context));
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_EQ(scene.sky_parts.groups.size(), 3u);
}

// Hours first, whatever else is asked for; lamps in no group are one more.
TEST(Daylight, MakesItsHoursGroups) {
  for (const LightGrouping by : {LightGrouping::kOff, LightGrouping::kMarked, LightGrouping::kEach}) {
    test::SceneParts parts;
    parts.quad("panel", parts.diffuse(Vec3(0.5f), Vec3(100)), Vec3(0), {1, 0, 0}, {0, 0, 1});
    parts.scene().surfaces.back().node_path = "panel";
    Scene scene = parts.finish();
    Context context;
    ASSERT_TRUE(add_daylight(solstice("8-16/4"), scene, context));
    ASSERT_TRUE(assign_light_groups({by, {}, {}}, scene, context));
    ASSERT_EQ(scene.light_groups.size(), 4u);
    EXPECT_EQ(scene.light_groups[1].name, "day 12:00");
    EXPECT_EQ(scene.light_groups[1].lamps, (std::vector<std::string>{"sun 12:00", "sky 12:00"}));
    EXPECT_EQ(scene.light_groups[3].name, by == LightGrouping::kEach ? "panel" : kOtherLamps);
    EXPECT_EQ(scene.lights[2].light_group, 2u);
    EXPECT_EQ(scene.surfaces[0].light_group, 3u);
  }
}

}  // namespace
}  // namespace oriel
