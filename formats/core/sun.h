// Where the sun stands: Meeus 1998, "Astronomical Algorithms", chapters 7, 12, 13, 25 (low accuracy: 0.01°) and 28,
// which are NOAA's calculator too.
#pragma once

#include <string>

#include "formats/core/result.h"

namespace oriel {

// Of the Gregorian calendar, 1901 to 2099.
struct Date {
  int year = 2000, month = 1, day = 1;

  bool operator==(const Date&) const = default;
};

// "2026-06-21". Error kUsage: no such day, or none of those years.
Result<Date> parse_date(const std::string& text);
std::string date_text(const Date& date);
int day_of_year(const Date& date);  // 1 to 366

// Angles of the disk's centre as if there were no air: refraction lifts it by 0.5° at the horizon, 0.1° at 10°. As seen
// from the earth's centre: parallax is 0.002°.
struct SunPosition {
  double elevation_deg = 0;         // -90 to 90, above the horizon
  double azimuth_deg = 0;           // 0 to 360, clockwise from north
  double declination_deg = 0;       // north of the equator
  double equation_of_time_min = 0;  // a sundial's time less the mean sun's
};

// utc_h: hours since 0 h UTC of the date; days before and after it too. Degrees north and east.
SunPosition sun_position(const Date& date, double utc_h, double latitude_deg, double longitude_deg);

// When a sundial shows that hour (12: the sun is in the meridian), as hours since 0 h UTC of the date; the date is the
// sundial's.
double utc_of_solar_time(const Date& date, double solar_h, double longitude_deg);

}  // namespace oriel
