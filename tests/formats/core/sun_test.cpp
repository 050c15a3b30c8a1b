// The sun's place against published values, and how bright it and the sky are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/core/daylight.h"
#include "formats/core/sun.h"

namespace oriel {
namespace {

constexpr double kAsked_deg = 0.02;
constexpr double kObliquity_deg = 23.4381;  // of 2026, with nutation

// Reda and Andreas 2004, "Solar Position Algorithm for Solar Radiation Applications" (NREL/TP-560-34302), table A5.1:
// topocentric elevation without refraction.
TEST(Sun, StandsWhereNrelsExampleHasIt) {
  const SunPosition sun = sun_position({2003, 10, 17}, 12.5 + 30.0 / 3600 + 7, 39.742476, -105.1786);
  EXPECT_NEAR(sun.elevation_deg, 39.872046, kAsked_deg);
  EXPECT_NEAR(sun.azimuth_deg, 194.340241, kAsked_deg);
  EXPECT_NEAR(sun.declination_deg, -9.31434, kAsked_deg);
  EXPECT_NEAR(sun.equation_of_time_min, 14.641503, kAsked_deg * 4);
}

// NREL's SOLPOS, its test run of Atlanta on 22 July 1999: azimuth 97.032875°, elevation 48.409931° with 0.0142° of
// refraction (Bennett 1982: 1 / tan(h + 7.31 / (h + 4.4)) minutes, 0.89').
TEST(Sun, StandsWhereSolposHasIt) {
  const SunPosition sun = sun_position({1999, 7, 22}, 9 + 45.0 / 60 + 37.0 / 3600 + 5, 33.65, -84.43);
  EXPECT_NEAR(sun.azimuth_deg, 97.032875, kAsked_deg);
  EXPECT_NEAR(sun.elevation_deg, 48.409931 - 0.0142, kAsked_deg);
}

// Meeus 1998, examples 25.a and 28.a: 13 October 1992, 0 h.
TEST(Sun, HasTheDeclinationAndEquationOfTimeOfMeeus) {
  const SunPosition sun = sun_position({1992, 10, 13}, 0, 0, 0);
  EXPECT_NEAR(sun.declination_deg, -7.78507, 0.001);
  EXPECT_NEAR(sun.equation_of_time_min, 13 + 42.6 / 60, 0.02);
}

// Of 2026 (U.S. Naval Observatory, "Earth's Seasons"): 20 March 14:46, 21 June 8:25, 23 September 0:05, 21 December
// 20:50 UTC. At an equinox the sun crosses the equator, at a solstice it turns back. The algorithm is good for 0.01° of
// longitude, which is 0.004° of declination.
TEST(Sun, CrossesAndTurnsAtThePublishedTimes) {
  const auto declination = [](Date date, double utc_h) { return sun_position(date, utc_h, 0, 0).declination_deg; };
  EXPECT_NEAR(declination({2026, 3, 20}, 14 + 46.0 / 60), 0, 0.004);
  EXPECT_NEAR(declination({2026, 9, 23}, 5.0 / 60), 0, 0.004);
  for (const auto& [date, utc_h, sign] :
       {std::tuple(Date{2026, 6, 21}, 8 + 25.0 / 60, 1), {Date{2026, 12, 21}, 20 + 50.0 / 60, -1}}) {
    EXPECT_NEAR(sign * declination(date, utc_h), kObliquity_deg, 0.001);
    const double before = sign * declination(date, utc_h - 24), after = sign * declination(date, utc_h + 24);
    EXPECT_NEAR(before, after, 0.0003);  // to half an hour
    EXPECT_NEAR(before, kObliquity_deg, 0.005);
    EXPECT_LT(before, sign * declination(date, utc_h) - 0.003);
  }
}

// Noon at the solstices, by the latitude; the sun of the equinox rises in the east.
TEST(Sun, RisesAndCulminatesByTheLatitude) {
  for (const double latitude : {-60.0, -33.9, 0.0, 23.4381, 52.5, 66.0}) {
    const double noon = utc_of_solar_time({2026, 6, 21}, 12, 13.4);
    const SunPosition sun = sun_position({2026, 6, 21}, noon, latitude, 13.4);
    EXPECT_NEAR(sun.elevation_deg, 90 - std::abs(latitude - kObliquity_deg), kAsked_deg) << latitude;
    if (std::abs(latitude - kObliquity_deg) > 0.1) {
      EXPECT_NEAR(std::cos(sun.azimuth_deg * kPiD / 180), latitude > kObliquity_deg ? -1 : 1, 1e-6) << latitude;
    }
    // Where its centre is on the horizon: cos A = sin δ / cos φ.
    const double azimuth = std::acos(std::sin(sun.declination_deg * kPiD / 180) / std::cos(latitude * kPiD / 180));
    double low = noon - 12, high = noon;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (sun_position({2026, 6, 21}, middle, latitude, 13.4).elevation_deg > 0 ? high : low) = middle;
    }
    if (std::abs(latitude) < 66) {
      EXPECT_NEAR(sun_position({2026, 6, 21}, high, latitude, 13.4).azimuth_deg, azimuth * 180 / kPiD, kAsked_deg)
          << latitude;
    }
  }
}

TEST(Sun, NeverSetsOrNeverRisesNearThePoles) {
  for (double h = 0; h < 24; ++h) {
    EXPECT_NEAR(sun_position({2026, 6, 21}, h, 90, 0).elevation_deg, kObliquity_deg, 0.005);
    EXPECT_NEAR(sun_position({2026, 6, 21}, h, -90, 0).elevation_deg, -kObliquity_deg, 0.005);
    EXPECT_GT(sun_position({2026, 6, 21}, h, 69.65, 18.96).elevation_deg, 3);  // Tromsø
    EXPECT_LT(sun_position({2026, 12, 21}, h, 69.65, 18.96).elevation_deg, -3);
  }
}

// At every longitude and season, at once.
TEST(Sun, IsInTheMeridianAtTwelve) {
  for (const double longitude : {-179.0, -75.0, 0.0, 13.4, 120.0})
    for (int month = 1; month <= 12; ++month) {
      const Date date{2026, month, 15};
      const SunPosition noon = sun_position(date, utc_of_solar_time(date, 12, longitude), 52.5, longitude);
      EXPECT_NEAR(noon.azimuth_deg, 180, 1e-6);
      const SunPosition six = sun_position(date, utc_of_solar_time(date, 6, longitude), 0, longitude);
      EXPECT_NEAR(six.elevation_deg, 0, 1e-6);
    }
}

TEST(Sun, TakesDaysThatThereAre) {
  EXPECT_EQ(parse_date("2024-02-29").value(), (Date{2024, 2, 29}));
  EXPECT_EQ(date_text({2026, 6, 21}), "2026-06-21");
  EXPECT_EQ(day_of_year({2024, 12, 31}), 366);
  EXPECT_EQ(day_of_year({2026, 12, 31}), 365);
  for (const char* bad : {"2026-02-29", "2026-13-01", "2026-00-01", "2026-06-31", "1900-01-01", "2100-01-01",
                          "26-06-21", "2026-6-21", "2026-06-21x", "", "21.06.2026", "2026-06--1"})
    EXPECT_FALSE(parse_date(bad)) << bad;
  EXPECT_THAT(parse_date("2026-02-30").error().text(), ::testing::HasSubstr("has 28 days"));
}

// IESNA's handbook: 40° north, a clear summer solstice at noon gives 8821 fc of the sun on level ground.
TEST(MeanDaylight, IsThatOfTheHandbook) {
  constexpr double kLuxOfFootcandle = 10.7639;
  const double elevation = 90 - 40 + 23.44;
  const MeanDaylight clear = mean_daylight(12, 172, elevation);
  EXPECT_NEAR(clear.sun_lux * std::sin(elevation * kPiD / 180) / kLuxOfFootcandle / 8821, 1, 1e-3);
  EXPECT_NEAR(mean_daylight(12, 172, 90).sky_lux, 16300, 1e-6);
  EXPECT_NEAR(mean_daylight(8, 172, 30).sky_lux, 300 + 22500, 1e-6);
  EXPECT_NEAR(mean_daylight(1, 172, 30).sky_lux, 300 + 10500, 1e-6);
  EXPECT_EQ(mean_daylight(1, 172, 30).sun_lux, 0);
  EXPECT_EQ(mean_daylight(16, 172, 30).sun_lux, 0);
  EXPECT_LT(mean_daylight(8, 172, 30).sun_lux, 0.4 * mean_daylight(12, 172, 30).sun_lux);
  for (const double down : {0.0, -10.0}) {
    EXPECT_EQ(mean_daylight(12, 1, down).sun_lux, 0);
    EXPECT_EQ(mean_daylight(12, 1, down).sky_lux, 0);
  }
}

}  // namespace
}  // namespace oriel
