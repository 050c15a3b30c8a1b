#include "formats/query/day_hours.h"

#include <algorithm>
#include <cmath>

namespace oriel {

Result<BetweenHours> hours_around(const Day& day, float hour) {
  if (day.empty())
    return fail(ErrorCode::kUsage, "--hour", "found an hour, but the pack has no day: oriel-bake --day makes one");
  const std::vector<DayHour>& hours = day.hours;
  if (hours.size() == 1 && hour != hours.front().hour)
    return fail(ErrorCode::kUsage, "--hour", "found {:g}, expected {:g} ({}), the one hour that the pack was baked for",
                hour, hours.front().hour, clock_name(day));
  if (!(hour >= hours.front().hour && hour <= hours.back().hour))
    return fail(ErrorCode::kUsage, "--hour", "found {:g}, expected {:g} to {:g} ({}), for which the pack was baked",
                hour, hours.front().hour, hours.back().hour, clock_name(day));
  const auto after = std::ranges::lower_bound(hours, hour, {}, &DayHour::hour);
  BetweenHours found;
  found.after = static_cast<std::size_t>(after - hours.begin());
  found.before = found.after > 0 ? found.after - 1 : 0;
  const float from = hours[found.before].hour, to = hours[found.after].hour;
  found.share = to > from ? (hour - from) / (to - from) : 1;
  return found;
}

Result<std::vector<float>> weights_at(const Day& day, float hour, std::size_t groups) {
  ORIEL_TRY(const BetweenHours between, hours_around(day, hour));
  std::vector<float> weights(groups, 1.0f);
  for (const DayHour& of : day.hours)
    if (of.group != kNight) weights[of.group] = 0;
  const auto times = static_cast<float>(day.lit());
  const DayHour &before = day.hours[between.before], &after = day.hours[between.after];
  if (before.group != kNight) weights[before.group] += times * (1 - between.share);
  if (after.group != kNight) weights[after.group] += times * between.share;
  return weights;
}

bool is_night(const Day& day, float hour) {
  const auto between = hours_around(day, hour);
  if (!between) return true;
  const bool before = day.hours[between->before].group != kNight && between->share < 1;
  const bool after = day.hours[between->after].group != kNight && between->share > 0;
  return !before && !after;
}

std::string clock_text(float hour) {
  const auto minutes = std::lround(60 * static_cast<double>(hour));
  return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

std::string clock_name(const Day& day) {
  if (day.solar_time) return "solar time";
  if (day.utc_offset_h == 0) return "UTC";
  return fmt::format("UTC{}{}", day.utc_offset_h < 0 ? '-' : '+', clock_text(std::abs(day.utc_offset_h)));
}

}  // namespace oriel
