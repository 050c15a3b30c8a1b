// Sun and sky of a place over the hours of a day.
#pragma once

#include "bake/jobs/context.h"
#include "bake/scene/scene.h"
#include "formats/core/sun.h"

namespace oriel {

inline constexpr std::size_t kMostDayHours = 31;  // with a sun, each being a light group: one more is for other lamps

inline constexpr float kSunRadius_rad = 0.2665f * (kPi / 180);  // as it is seen from the earth, on the mean

struct DayOptions {
  bool wanted = false;
  Date date;
  double latitude_deg = 0, longitude_deg = 0;  // north, east
  double north_deg = 0;                        // of -Z, clockwise as seen from above
  double from_h = 8, to_h = 18, step_h = 1;    // by the clock, 0 to 24
  bool solar_time = true;                      // the clock is a sundial; else it is
  double utc_offset_h = 0;                     // so far ahead of UTC
  int sky_type = 12;                           // 1 to 16 of formats/core/daylight.h
  double ground = 0.2;                         // reflectance of the level ground below the horizon
};

// "2026-06-21@52.5,13.4" or "2026-06-21@52.5,13.4,30": date, degrees north and east, and where north is, degrees
// clockwise from -Z. Error kUsage.
Status parse_day(const std::string& text, DayOptions& options);
// "8-18/1", "8-18" (each hour) or "14.5" (that time alone), solar time; with "+02:00" behind, hours of a clock that is
// so far ahead of UTC. Error kUsage.
Status parse_hours(const std::string& text, DayOptions& options);
std::string day_text(const DayOptions& options);  // as those take them; "" where no day is wanted
std::string hours_text(const DayOptions& options);

// A clear sky (type 12, CIE standard) to the strongest directional light that shines down with 400 lux at least, which
// is what sunrise sheds, and level ground below it. Where there is such a sun it is told, with how to leave it out.
// Illuminance: mean_daylight() of that height, times what the file's sun has over the model's. So sky and sun stand in
// nature's proportion; but a sun near the horizon as bright as at noon gets the sky of its height alone.
void add_clear_sky(Scene& scene, Context& context);

// Fills scene.day, and puts in the mean of its hours: of each the sun (a directional light, 0.533° across) and the sky,
// over the number of hours with a sun. Directional lights of the file are taken out, with a warning. Hours without a
// sun are told. DayHour::group counts hours with a sun from 0. Errors kUsage: no hour with a sun; more than
// kMostDayHours.
Status add_daylight(const DayOptions& options, Scene& scene, Context& context);

}  // namespace oriel
