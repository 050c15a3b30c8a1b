// A time between the hours that were baked.
#pragma once

#include "formats/assets/day.h"
#include "formats/core/result.h"

namespace oriel {

// The two hours around a time, linear between them.
struct BetweenHours {
  std::size_t before = 0, after = 0;  // into Day::hours
  float share = 0;                    // of the one after, 0 to 1
};
// Error kUsage: outside of the hours that the day has, or it has none.
Result<BetweenHours> hours_around(const Day& day, float hour);

// By group of as many, how many times its baked light is shown at that hour; others than the day's keep 1.
Result<std::vector<float>> weights_at(const Day& day, float hour, std::size_t groups);

// Whether neither of the two hours around has a sun; nor where there are none around.
bool is_night(const Day& day, float hour);

// "14:30", rounded to the minute.
std::string clock_text(float hour);
// "solar time", "UTC", "UTC+02:00".
std::string clock_name(const Day& day);

}  // namespace oriel
