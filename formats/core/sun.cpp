#include "formats/core/sun.h"

#include <array>
#include <cstdio>

#include "formats/core/vec.h"

namespace oriel {
namespace {

constexpr double kRadians = kPiD / 180;

constexpr bool is_leap(int year) {
  return year % 4 == 0;  // so it is from 1901 to 2099
}

int days_of_month(const Date& date) {
  constexpr std::array<int, 12> kDays = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return kDays[static_cast<std::size_t>(date.month - 1)] + (date.month == 2 && is_leap(date.year) ? 1 : 0);
}

// Since noon of 1 January 2000, UTC, at 0 h of the date.
double days_since_2000(const Date& date) {
  const int years = date.year - 2000;
  const int leap_days = years >= 0 ? (years + 3) / 4 : years / 4;  // before 1 January of the year
  return 365.0 * years + leap_days + day_of_year(date) - 1 - 0.5;
}

// Into [-half, half).
double wrapped(double value, double half) {
  return value - 2 * half * std::floor(value / (2 * half) + 0.5);
}

struct Equatorial {
  double right_ascension_deg, declination_deg, sidereal_deg;  // sidereal time at Greenwich
};

Equatorial apparent_sun(double days) {
  const double t = days / 36525;
  const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = (357.52911 + t * (35999.05029 - t * 0.0001537)) * kRadians;
  const double centre = (1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly) +
                        (0.019993 - t * 0.000101) * std::sin(2 * anomaly) + 0.000289 * std::sin(3 * anomaly);
  const double node = (125.04 - 1934.136 * t) * kRadians;
  const double nutation_deg = -0.00478 * std::sin(node);  // in longitude
  const double longitude = (mean_longitude + centre - 0.00569 + nutation_deg) * kRadians;
  const double obliquity =
      (23.4392911 - t * (0.0130042 + t * (1.64e-7 - t * 5.04e-7)) + 0.00256 * std::cos(node)) * kRadians;
  const double sidereal =
      280.46061837 + 360.98564736629 * days + t * t * 0.000387933 + nutation_deg * std::cos(obliquity);
  return {std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude)) / kRadians,
          std::asin(std::sin(obliquity) * std::sin(longitude)) / kRadians, sidereal};
}

}  // namespace

Result<Date> parse_date(const std::string& text) {
  Date date;
  char rest = 0;
  const bool numbers =
      text.size() == 10 && std::sscanf(text.c_str(), "%4d-%2d-%2d%c", &date.year, &date.month, &date.day, &rest) == 3;
  if (numbers && date.month >= 1 && date.month <= 12 && date.day > days_of_month(date))
    return fail(ErrorCode::kUsage, "", "found the date '{}', expected one that exists: that month has {} days", text,
                days_of_month(date));
  if (!numbers || date.year < 1901 || date.year > 2099 || date.month < 1 || date.month > 12 || date.day < 1)
    return fail(ErrorCode::kUsage, "", "found the date '{}', expected a day from 1901 to 2099 as 2026-06-21", text);
  return date;
}

std::string date_text(const Date& date) {
  return fmt::format("{:04}-{:02}-{:02}", date.year, date.month, date.day);
}

int day_of_year(const Date& date) {
  int days = date.day;
  for (Date before{date.year, 1, 1}; before.month < date.month; ++before.month) days += days_of_month(before);
  return days;
}

SunPosition sun_position(const Date& date, double utc_h, double latitude_deg, double longitude_deg) {
  const Equatorial sun = apparent_sun(days_since_2000(date) + utc_h / 24);
  const double hour_angle_deg = wrapped(sun.sidereal_deg + longitude_deg - sun.right_ascension_deg, 180);
  const double h = hour_angle_deg * kRadians, d = sun.declination_deg * kRadians, p = latitude_deg * kRadians;
  const double up = std::sin(p) * std::sin(d) + std::cos(p) * std::cos(d) * std::cos(h);
  const double north = std::cos(p) * std::sin(d) - std::sin(p) * std::cos(d) * std::cos(h);
  const double east = -std::cos(d) * std::sin(h);
  SunPosition position;
  position.elevation_deg = std::atan2(up, std::hypot(north, east)) / kRadians;
  const double azimuth = std::atan2(east, north) / kRadians;
  position.azimuth_deg = azimuth < 0 ? azimuth + 360 : azimuth;
  position.declination_deg = sun.declination_deg;
  position.equation_of_time_min = 60 * wrapped(12 + hour_angle_deg / 15 - utc_h - longitude_deg / 15, 12);
  return position;
}

double utc_of_solar_time(const Date& date, double solar_h, double longitude_deg) {
  const double mean_h = solar_h - longitude_deg / 15;
  double utc_h = mean_h;
  // The equation of time changes by half a minute a day at most.
  for (int i = 0; i < 3; ++i) utc_h = mean_h - sun_position(date, utc_h, 0, longitude_deg).equation_of_time_min / 60;
  return utc_h;
}

}  // namespace oriel
