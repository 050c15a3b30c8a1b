// Sun and sky over a day: which groups of lamps are its hours.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

inline constexpr std::size_t kMaxDayHours = 1024;
inline constexpr std::uint32_t kNight = ~0u;

// Of one time of the day. The sun is down where group is kNight: no light, and nothing below.
struct DayHour {
  float hour = 0;                // by the day's clock
  std::uint32_t group = kNight;  // into Pack::light_groups: sun and sky of this hour
  Vec3 to_sun{0, 1, 0};          // unit, pack space
  float sun_lux = 0;             // on a plane that faces the sun
  float sky_lux = 0;             // on open level ground, without the sun
  Vec3 sky{0};                   // mean radiance all around, cd/m²
};

// All light of a pack holds the mean of the hours with a sun: the light of each, over their number. What an hour alone
// gives is its group that many times.
struct Day {
  std::string date;                           // "2026-06-21"
  float latitude_deg = 0, longitude_deg = 0;  // north, east
  float north_deg = 0;                        // of -Z, clockwise as seen from above
  bool solar_time = true;                     // the clock is a sundial: 12 where the sun is in the meridian; else
  float utc_offset_h = 0;                     // it is so many hours ahead of UTC
  std::uint8_t sky_type = 12;                 // of ISO 15469
  float shown_hour = 12;                      // when the pack is opened
  std::vector<DayHour> hours;                 // ascending; none: the pack has no day

  bool empty() const { return hours.empty(); }
  std::size_t lit() const {
    std::size_t count = 0;
    for (const DayHour& hour : hours) count += hour.group == kNight ? 0 : 1;
    return count;
  }
};

}  // namespace oriel
