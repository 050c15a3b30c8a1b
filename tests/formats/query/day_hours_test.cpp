// Times between the hours of a day.
#include "formats/query/day_hours.h"

#include <gtest/gtest.h>

namespace oriel {
namespace {

// Hours 4 (night), 6, 8 and 10; groups 0 to 2 are the day's, 3 is a lamp's.
Day day() {
  Day d;
  for (int i = 0; i < 4; ++i) {
    DayHour hour;
    hour.hour = 4 + 2 * static_cast<float>(i);
    hour.group = i == 0 ? kNight : static_cast<std::uint32_t>(i - 1);
    d.hours.push_back(hour);
  }
  return d;
}

TEST(DayHours, AreShownAloneAndBetween) {
  using Weights = std::vector<float>;
  EXPECT_EQ(weights_at(day(), 6, 4).value(), (Weights{3, 0, 0, 1}));
  EXPECT_EQ(weights_at(day(), 10, 4).value(), (Weights{0, 0, 3, 1}));
  EXPECT_EQ(weights_at(day(), 8.5f, 4).value(), (Weights{0, 2.25f, 0.75f, 1}));
  EXPECT_EQ(weights_at(day(), 4, 4).value(), (Weights{0, 0, 0, 1}));  // night
  EXPECT_EQ(weights_at(day(), 5, 4).value(), (Weights{1.5f, 0, 0, 1}));
  Day one = day();
  one.hours = {one.hours[1]};
  EXPECT_EQ(weights_at(one, 6, 2).value(), (Weights{1, 1}));
}

TEST(DayHours, AreNightWhereNoSunIsAround) {
  EXPECT_TRUE(is_night(day(), 4));
  EXPECT_FALSE(is_night(day(), 5)) << "between night and six";
  EXPECT_FALSE(is_night(day(), 6));
  EXPECT_FALSE(is_night(day(), 10));
}

TEST(DayHours, RefuseOthersAndSayWhichThereAre) {
  for (const float hour : {3.9f, 10.1f, NAN}) {
    const auto weights = weights_at(day(), hour, 4);
    ASSERT_FALSE(weights);
    EXPECT_NE(weights.error().text().find("expected 4 to 10 (solar time)"), std::string::npos)
        << weights.error().text();
  }
  const auto none = weights_at({}, 12, 1);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().text().find("the pack has no day"), std::string::npos);
}

TEST(DayHours, AreToldAsAClockDoes) {
  EXPECT_EQ(clock_text(8), "08:00");
  EXPECT_EQ(clock_text(14.5f), "14:30");
  EXPECT_EQ(clock_text(11.9999f), "12:00");
  Day d;
  EXPECT_EQ(clock_name(d), "solar time");
  d.solar_time = false;
  EXPECT_EQ(clock_name(d), "UTC");
  d.utc_offset_h = -3.5f;
  EXPECT_EQ(clock_name(d), "UTC-03:30");
}

}  // namespace
}  // namespace oriel
