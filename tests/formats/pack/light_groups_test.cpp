// Light groups in packs: what goes in comes out, and damage is named.
#include "tests/formats/pack/hostile.h"

namespace oriel {
namespace {

using namespace testing;

TEST(Pack, LightGroupsComeBack) {
  const Pack in = tiny_mapped_pack(), out = decode_pack(tiny_file()).value();
  ASSERT_EQ(out.light_groups.size(), 2u);
  for (std::size_t g = 0; g < 2; ++g) {
    const LightGroup &a = out.light_groups[g], &b = in.light_groups[g];
    EXPECT_EQ(
        std::tie(a.name, a.lamps, a.value, a.color, a.own_color, a.materials, a.emitters, a.bright_lights, a.sky),
        std::tie(b.name, b.lamps, b.value, b.color, b.own_color, b.materials, b.emitters, b.bright_lights, b.sky));
    EXPECT_EQ(std::tie(a.reflectors, a.surrounds, a.probes), std::tie(b.reflectors, b.surrounds, b.probes));
  }
  ASSERT_EQ(out.page_groups.size(), 1u);
  const PageGroups &a = out.page_groups[0], &b = in.page_groups[0];
  EXPECT_EQ(std::tie(a.page, a.width, a.height, a.detail_width, a.detail_height, a.exponent, a.rest, a.rest_of_detail),
            std::tie(b.page, b.width, b.height, b.detail_width, b.detail_height, b.exponent, b.rest, b.rest_of_detail));
  ASSERT_EQ(a.others.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_EQ(std::tie(a.others[k].group, a.others[k].light, a.others[k].detail),
              std::tie(b.others[k].group, b.others[k].light, b.others[k].detail));
}

TEST(Pack, MotionsOfLampsComeBack) {
  Pack in = tiny_mapped_pack();
  LightGroup& lamp = in.light_groups[0];
  lamp.rest = {{1, 2, 3}, {0, 0, 0, 1}};
  lamp.keys = {{0, {{1, 2, 3}, {0, 0, 0, 1}}}, {2, {{1, 2, 4}, {0, 1, 0, 0}}}};
  const auto bytes = encode_pack(in);
  ASSERT_TRUE(bytes);
  const Pack out = decode_pack(*bytes).value();
  EXPECT_EQ(out.light_groups[0].rest, lamp.rest);
  ASSERT_EQ(out.light_groups[0].keys.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(out.light_groups[0].keys[k].time_s, lamp.keys[k].time_s);
    EXPECT_EQ(out.light_groups[0].keys[k].pose, lamp.keys[k].pose);
  }
  EXPECT_TRUE(out.light_groups[1].keys.empty());
  EXPECT_EQ(out.light_groups[1].rest, MoverPose());
}

TEST(Pack, DaysComeBack) {
  const Day in = tiny_mapped_pack().day, out = decode_pack(tiny_file()).value().day;
  EXPECT_EQ(std::tie(out.date, out.latitude_deg, out.longitude_deg, out.north_deg, out.solar_time, out.utc_offset_h,
                     out.sky_type, out.shown_hour),
            std::tie(in.date, in.latitude_deg, in.longitude_deg, in.north_deg, in.solar_time, in.utc_offset_h,
                     in.sky_type, in.shown_hour));
  ASSERT_EQ(out.hours.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const DayHour &a = out.hours[i], &b = in.hours[i];
    EXPECT_EQ(std::tie(a.hour, a.group, a.to_sun, a.sun_lux, a.sky_lux, a.sky),
              std::tie(b.hour, b.group, b.to_sun, b.sun_lux, b.sky_lux, b.sky));
  }
  EXPECT_EQ(out.lit(), 1u);
}

TEST(Hostile, Days) {
  const std::string day = "section DAYH (hours of a day): ";
  expect_refusal(with_raw(kDaySection, 0, ~0u), day + "its counts need more");  // date
  expect_refusal(with_raw(kDaySection, 38, ~0u), day + "found 4294967295 hours");
  expect_refusal(with_raw(kDaySection, 38, 3u), day + "its counts need more");
}

TEST(Hostile, LightGroups) {
  const std::string group = "section LGRP (light groups): ", page = "section GLMP 0 (light of groups on a page): ";
  expect_refusal(with_raw(kLightGroupSection, 0, ~0u), group + "its counts need more");
  expect_refusal(with_raw(kLightGroupSection, 8, ~0u), group + "its counts need more");  // lamps
  expect_refusal(with_raw(kPageGroupsSection, 4, 0u), page + "element 0: found 0 x 4 texels");
  expect_refusal(with_raw(kPageGroupsSection, 4, 32768u), page + "its counts need more");
  expect_refusal(with_raw(kPageGroupsSection, 12, 16385u), page + "element 0: found details of 16385");
  expect_refusal(with_raw(kPageGroupsSection, 20, 113), page + "element 0: found scale exponent 113");
  expect_refusal(with_raw(kPageGroupsSection, 24, 65u), page + "element 0: found light of 65 groups");
  expect_refusal(with_raw(kPageGroupsSection, 24, 3u), page + "its counts need more");
  expect_refusal(with_record(kPageGroupsSection, [](SectionRecord& r) { r.count = 2; }), page + "found 2 elements");
}

}  // namespace
}  // namespace oriel
