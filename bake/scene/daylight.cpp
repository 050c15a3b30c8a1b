#include "bake/scene/daylight.h"

#include <charconv>

#include "bake/scene/sky.h"
#include "formats/core/color.h"
#include "formats/core/daylight.h"
#include "formats/query/day_hours.h"

namespace oriel {
namespace {

constexpr double kRadians = kPiD / 180;
constexpr std::uint32_t kSkyRows = 256;  // 0.7°: but for the sun's own disk a sky changes over ten degrees
constexpr std::uint32_t kColumns = 2 * kSkyRows;
// What the light of sunrise sheds on level ground under a clear sky, lux (Schlyter 1997, "Radiometry and photometry in
// astronomy"): a directional light below it is no sun, but a fill light or a moon.
constexpr double kDimmestSun_lux = 400;
constexpr int kMeanDistanceDay = 94;          // 4 April: the earth is as far from the sun as on the mean (Meeus 1998)
constexpr double kShortestStep_h = 2.0 / 60;  // hours are named by the minute

// The whole text.
bool read_number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

// "+02:00" at the end: taken off the text, hours ahead of UTC. What may as well be a later hour, as in "8-12:00", is
// none.
std::optional<double> take_offset(std::string& text) {
  if (text.size() < 6 || text[text.size() - 3] != ':') return std::nullopt;
  const std::size_t at = text.size() - 6;
  double hours = 0, minutes = 0;
  if ((text[at] != '+' && text[at] != '-') || !read_number(text.substr(at + 1, 2), hours) ||
      !read_number(text.substr(at + 4, 2), minutes) || minutes >= 60)
    return std::nullopt;
  double before = 0;
  if (text[at] == '-' && read_number(text.substr(0, at), before) && hours >= before) return std::nullopt;
  const double offset = (text[at] == '-' ? -1 : 1) * (hours + minutes / 60);
  text.resize(at);
  return offset;
}

struct Hour {
  DayHour told;
  CieSky sky;
  double zenith_cd_m2 = 0, ground_cd_m2 = 0;
};

Hour hour_at(const DayOptions& o, double clock_h) {
  Hour hour;
  hour.told.hour = static_cast<float>(clock_h);
  const double utc_h = o.solar_time ? utc_of_solar_time(o.date, clock_h, o.longitude_deg) : clock_h - o.utc_offset_h;
  const SunPosition sun = sun_position(o.date, utc_h, o.latitude_deg, o.longitude_deg);
  if (sun.elevation_deg <= 0) return hour;
  const DVec3 to_sun = sky_direction(sun.elevation_deg * kRadians, (sun.azimuth_deg + o.north_deg) * kRadians);
  const MeanDaylight light = mean_daylight(o.sky_type, day_of_year(o.date), sun.elevation_deg);
  hour.told.group = 0;
  hour.told.to_sun = Vec3(to_sun);
  hour.told.sun_lux = static_cast<float>(light.sun_lux), hour.told.sky_lux = static_cast<float>(light.sky_lux);
  hour.sky = {o.sky_type, to_sun};
  hour.zenith_cd_m2 = light.sky_lux / hour.sky.illuminance();
  hour.ground_cd_m2 = o.ground / kPiD * (light.sky_lux + light.sun_lux * to_sun.y);
  return hour;
}

std::vector<Hour> hours_of(const DayOptions& o) {
  std::vector<Hour> hours;
  const auto last = static_cast<int>(std::floor((o.to_h - o.from_h) / o.step_h + 1e-6));
  for (int i = 0; i <= last; ++i) hours.push_back(hour_at(o, o.from_h + i * o.step_h));
  return hours;
}

Vec3 direction_of_texel(std::uint32_t x, std::uint32_t y) {
  const double theta = kPiD * (y + 0.5) / kSkyRows, phi = 2 * kPiD * ((x + 0.5) / (2 * kSkyRows) - 0.5);
  return Vec3(DVec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)));
}

// Of each texel, cd/m².
std::vector<double> sky_of(const Hour& hour) {
  std::vector<double> radiances;
  for (std::uint32_t y = 0; y < kSkyRows; ++y)
    for (std::uint32_t x = 0; x < kColumns; ++x) {
      const DVec3 direction(direction_of_texel(x, y));
      radiances.push_back(direction.y > 0 ? hour.zenith_cd_m2 * hour.sky.luminance(direction) : hour.ground_cd_m2);
    }
  return radiances;
}

SkyImage black_sky() {
  return {kColumns, kSkyRows, std::vector<Vec3>(std::size_t{kColumns} * kSkyRows, Vec3(0)), 0};
}

// The image of all hours together, each over their number, and what of it is whose.
void add_skies(std::vector<Hour>& hours, std::size_t lit, Scene& scene) {
  scene.sky_image = black_sky();
  scene.sky_parts.luminance.assign(scene.sky_image.texels.size() * lit, 0);
  SkyImage alone = scene.sky_image;
  for (Hour& hour : hours) {
    if (hour.told.group == kNight) continue;
    const std::vector<double> radiances = sky_of(hour);
    for (std::size_t texel = 0; texel < radiances.size(); ++texel) {
      const auto share = static_cast<float>(radiances[texel] / static_cast<double>(lit));
      alone.texels[texel] = Vec3(static_cast<float>(radiances[texel]));
      scene.sky_parts.luminance[texel * lit + hour.told.group] = share;
      scene.sky_image.texels[texel] += Vec3(share);
    }
    hour.told.sky = sky_mean(alone);
    scene.sky_parts.groups.push_back(hour.told.group);
  }
  scene.sky = sky_mean(scene.sky_image);
}

void add_suns(const std::vector<Hour>& hours, std::size_t lit, Scene& scene) {
  for (std::size_t k = 0; k < hours.size(); ++k) {
    const DayHour& hour = hours[k].told;
    if (hour.group == kNight || !(hour.sun_lux > 0)) continue;
    Light sun;
    sun.name = "sun " + clock_text(hour.hour);
    sun.type = LightType::kDirectional;
    sun.direction = -hour.to_sun;
    sun.right = frame_from_normal(sun.direction)[0];
    sun.intensity = Vec3(hour.sun_lux / static_cast<float>(lit));
    sun.angular_radius_rad = kSunRadius_rad;
    sun.hour = static_cast<std::int32_t>(k);
    scene.lights.push_back(std::move(sun));
  }
}

// A second sun would shine all day.
void take_out_suns(Scene& scene, Context& context) {
  std::string names;
  for (const Light& light : scene.lights)
    if (light.type == LightType::kDirectional) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", light.name);
  if (names.empty()) return;
  std::erase_if(scene.lights, [](const Light& light) { return light.type == LightType::kDirectional; });
  context.warning("sun-replaced",
                  fmt::format("the sun of --day takes the place of the file's directional lights: {}", names));
}

}  // namespace

Status parse_day(const std::string& text, DayOptions& options) {
  constexpr const char* kExpected = "DATE@LATITUDE,LONGITUDE[,NORTH] as 2026-06-21@52.5,13.4";
  const std::size_t at = text.find('@');
  if (at == std::string::npos) return fail(ErrorCode::kUsage, "", "found '{}', expected {}", text, kExpected);
  ORIEL_TRY(options.date, parse_date(text.substr(0, at)));
  std::vector<double> numbers;
  for (std::size_t from = at + 1; from <= text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    if (!read_number(std::string_view(text).substr(from, to - from), numbers.emplace_back()))
      numbers.clear(), from = text.size();
    from = std::max(from, to) + 1;
  }
  if (numbers.size() != 2 && numbers.size() != 3)
    return fail(ErrorCode::kUsage, "", "found '{}', expected {}", text, kExpected);
  if (std::abs(numbers[0]) > 90)
    return fail(ErrorCode::kUsage, "", "found latitude {}, expected -90 to 90 degrees", numbers[0]);
  if (std::abs(numbers[1]) > 180)
    return fail(ErrorCode::kUsage, "", "found longitude {}, expected -180 to 180 degrees", numbers[1]);
  if (numbers.size() == 3 && std::abs(numbers[2]) > 360)
    return fail(ErrorCode::kUsage, "", "found north at {}, expected -360 to 360 degrees clockwise from -Z", numbers[2]);
  options.latitude_deg = numbers[0], options.longitude_deg = numbers[1];
  options.north_deg = numbers.size() == 3 ? numbers[2] : 0;
  options.wanted = true;
  return {};
}

Status parse_hours(const std::string& text, DayOptions& options) {
  std::string hours = text;
  const auto offset = take_offset(hours);
  const std::size_t slash = hours.find('/'), dash = hours.find('-');
  const bool span = dash != std::string::npos;
  DayOptions read = options;
  read.step_h = 1;
  const std::string_view all = hours;
  const bool numbers = read_number(all.substr(0, span ? dash : all.size()), read.from_h) &&
                       (!span || read_number(all.substr(dash + 1, slash - dash - 1), read.to_h)) &&
                       (slash == std::string::npos || (span && read_number(all.substr(slash + 1), read.step_h)));
  if (!numbers || (offset && std::abs(*offset) > 14))
    return fail(ErrorCode::kUsage, "", "found '{}', expected FROM-TO/STEP in hours, as 8-18/1, 14.5 or 8-18/1+02:00",
                text);
  if (!span) read.to_h = read.from_h;
  if (!(read.from_h >= 0 && read.to_h <= 24))
    return fail(ErrorCode::kUsage, "", "found hours from {:g} to {:g}, expected 0 to 24", read.from_h, read.to_h);
  if (read.from_h > read.to_h)
    return fail(ErrorCode::kUsage, "", "found hours from {:g} to {:g}, expected the earlier one first", read.from_h,
                read.to_h);
  if (!(read.step_h >= kShortestStep_h))
    return fail(ErrorCode::kUsage, "", "found a step of {:g} hours, expected two minutes at least, as /0.5",
                read.step_h);
  read.solar_time = !offset;
  read.utc_offset_h = offset.value_or(0);
  options = read;
  return {};
}

std::string day_text(const DayOptions& o) {
  if (!o.wanted) return {};
  return fmt::format("{}@{},{}{}", date_text(o.date), o.latitude_deg, o.longitude_deg,
                     o.north_deg != 0 ? fmt::format(",{}", o.north_deg) : "");
}

std::string hours_text(const DayOptions& o) {
  std::string text =
      o.from_h == o.to_h ? fmt::format("{}", o.from_h) : fmt::format("{}-{}/{}", o.from_h, o.to_h, o.step_h);
  if (!o.solar_time)
    text +=
        fmt::format("{}{}", o.utc_offset_h < 0 ? '-' : '+', clock_text(static_cast<float>(std::abs(o.utc_offset_h))));
  return text;
}

void add_clear_sky(Scene& scene, Context& context) {
  const Light* sun = nullptr;
  const auto lux = [](const Light& light) { return luminance(light.intensity); };
  for (const Light& light : scene.lights)
    if (light.type == LightType::kDirectional && light.direction.y < 0 && lux(light) >= kDimmestSun_lux &&
        (sun == nullptr || lux(light) > lux(*sun)))
      sun = &light;
  if (sun == nullptr) return;
  const DVec3 to_sun = -glm::normalize(DVec3(sun->direction));
  const double elevation_deg = std::asin(std::min(1.0, to_sun.y)) / kRadians;
  const DayOptions day;
  const MeanDaylight light = mean_daylight(day.sky_type, kMeanDistanceDay, elevation_deg);
  const double noon_lux = mean_daylight(day.sky_type, kMeanDistanceDay, 90).sun_lux;
  // At the horizon the model's sun is black.
  const double most = std::max(1.0, lux(*sun) / noon_lux);
  const double sky_lux = light.sky_lux * std::min(most, lux(*sun) / std::max(light.sun_lux, 1e-9 * noon_lux));
  Hour hour;
  hour.sky = {day.sky_type, to_sun};
  hour.zenith_cd_m2 = sky_lux / hour.sky.illuminance();
  hour.ground_cd_m2 = day.ground / kPiD * (sky_lux + lux(*sun) * to_sun.y);
  scene.sky_image = black_sky();
  const std::vector<double> radiances = sky_of(hour);
  for (std::size_t texel = 0; texel < radiances.size(); ++texel)
    scene.sky_image.texels[texel] = Vec3(static_cast<float>(radiances[texel]));
  scene.sky = sky_mean(scene.sky_image);
  context.warning("sky-added",
                  fmt::format("sky: the sun \"{}\" of {:.3g} lux stands {:.0f}° high and the file has no sky: a clear "
                              "one of that height is added, {:.3g} lux (--sky none leaves it out)",
                              sun->name, lux(*sun), elevation_deg, sky_lux));
}

Status add_daylight(const DayOptions& options, Scene& scene, Context& context) {
  std::vector<Hour> hours = hours_of(options);
  std::uint32_t lit = 0;
  std::string nights;
  for (Hour& hour : hours)
    if (hour.told.group != kNight)
      hour.told.group = lit++;
    else
      nights += fmt::format("{}{}", nights.empty() ? "" : ", ", clock_text(hour.told.hour));
  Day day{date_text(options.date),
          static_cast<float>(options.latitude_deg),
          static_cast<float>(options.longitude_deg),
          static_cast<float>(options.north_deg),
          options.solar_time,
          static_cast<float>(options.utc_offset_h),
          static_cast<std::uint8_t>(options.sky_type),
          12,
          {}};
  if (lit == 0)
    return fail(ErrorCode::kUsage, "--day",
                "found the sun below the horizon at all of {} ({}), expected an hour by day", hours_text(options),
                clock_name(day));
  if (lit > kMostDayHours)
    return fail(ErrorCode::kUsage, "--hours", "found {} hours with a sun, expected at most {}: a longer step than {:g}",
                lit, kMostDayHours, options.step_h);
  if (!nights.empty()) context.warning("night", "the sun is below the horizon, no light of the day: " + nights);
  take_out_suns(scene, context);
  add_suns(hours, lit, scene);
  add_skies(hours, lit, scene);
  for (const Hour& hour : hours) day.hours.push_back(hour.told);
  // The one in the middle of those with a sun.
  for (const DayHour& hour : day.hours)
    if (hour.group == lit / 2) day.shown_hour = hour.hour;
  scene.day = std::move(day);
  return {};
}

}  // namespace oriel
