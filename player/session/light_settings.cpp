#include "player/session/light_settings.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "formats/core/color.h"
#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/core/text.h"
#include "formats/query/day_hours.h"

namespace oriel {
namespace {

constexpr const char *kHour = "hour", *kDay = "day";
constexpr float kMostValue = 100;   // of a dimmer
constexpr float kLeastOwn = 0.01f;  // of a lamp's own colour: what it has less of is not made more of

Vec3 of_luminance_one(const Vec3& color) {
  return color / std::max(luminance(color), 1e-6f);
}

float linear_of_srgb(int byte) {
  const float v = static_cast<float>(byte) / 255;
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

std::optional<float> number_of(const std::string& text) {
  char* end = nullptr;
  const float value = std::strtof(text.c_str(), &end);
  if (text.empty() || *end != 0 || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<Vec3> color_of_hex(const std::string& text) {
  if (text.size() != 7 || text[0] != '#' || text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
    return std::nullopt;
  const auto code = std::stoul(text.substr(1), nullptr, 16);
  const auto channel = [&](unsigned shift) { return linear_of_srgb(static_cast<int>(code >> shift & 0xff)); };
  const Vec3 color(channel(16), channel(8), channel(0));
  if (!(max_component(color) > 0)) return std::nullopt;
  return of_luminance_one(color);
}

// One value; false where it is none.
bool take_value(const std::string& value, LightSetting& setting) {
  if (value == "off" || value == "on") {
    setting.on = value == "on";
    return true;
  }
  if (const auto color = color_of_hex(value)) {
    setting.color = color, setting.kelvin.reset();
    return true;
  }
  if (value.ends_with("K") || value.ends_with("k")) {
    const auto kelvin = number_of(value.substr(0, value.size() - 1));
    if (!kelvin || *kelvin < kLeastKelvin || *kelvin > kMostKelvin) return false;
    setting.kelvin = kelvin, setting.color = color_of_kelvin(*kelvin);
    return true;
  }
  const auto number = number_of(value);
  if (!number || *number < 0 || *number > kMostValue) return false;
  setting.value = *number, setting.on = true;
  return true;
}

// Names of groups, the day's hours as one.
std::vector<std::string> names_of(const Pack& pack, const std::vector<LightSetting>& settings) {
  std::vector<std::string> names;
  bool has_day = false;
  for (std::size_t g = 0; g < settings.size(); ++g)
    if (!settings[g].hour)
      names.push_back(pack.light_groups[g].name);
    else if (!std::exchange(has_day, true))
      names.emplace_back(kDay);
  return names;
}

Status unknown(const Pack& pack, const std::vector<LightSetting>& settings, const std::string& name,
               const std::string& from) {
  const std::vector<std::string> names = names_of(pack, settings);
  if (names.empty())
    return fail(ErrorCode::kUsage, from,
                "found \"{}\", but the pack has no light groups: oriel-bake --light-groups makes some", name);
  if (std::ranges::any_of(pack.light_groups, [&](const LightGroup& group) { return group.name == name; }))
    return fail(ErrorCode::kUsage, from,
                "found \"{}\", expected {} for sun and sky of every hour, or {}=14.5 for the time shown", name, kDay,
                kHour);
  return fail(ErrorCode::kUsage, from, "found the light group \"{}\", expected one of the pack's: {}", name,
              names_like(name, names));
}

// Values of one name, with spaces between.
Status take_values(const std::string& name, const std::string& values, const std::string& from, LightSetting& setting) {
  std::istringstream read(values);
  std::string value;
  int count = 0;
  for (; read >> value; ++count)
    if (!take_value(value, setting))
      return fail(ErrorCode::kUsage, from,
                  "found \"{}\" for \"{}\", expected 0 to {}, on, off, {} to {} K as 2700K, or a colour as #ff8800",
                  value, name, kMostValue, kLeastKelvin, kMostKelvin);
  if (count > 0) return {};
  return fail(ErrorCode::kUsage, from, "found nothing for \"{}\", expected a value as 0.3 or off", name);
}

}  // namespace

Vec3 color_of_kelvin(float kelvin) {
  const double t = 1000 / std::clamp<double>(kelvin, kLeastKelvin, kMostKelvin);
  const double x = kelvin <= 4000 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                                  : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
  const double y = kelvin <= 2222   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                   : kelvin <= 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                                    : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  const DVec3 xyz(x / y, 1, (1 - x - y) / y);
  const DVec3 rgb(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                  -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                  0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
  return of_luminance_one(glm::max(Vec3(rgb), Vec3(0)));
}

std::vector<LightSetting> settings_of(const Pack& pack) {
  std::vector<LightSetting> settings;
  for (const LightGroup& group : pack.light_groups) {
    LightSetting& setting = settings.emplace_back();
    setting.value = group.value;
    if (group.color != Vec3(1)) setting.color = of_luminance_one(group.color * group.own_color);
  }
  for (const DayHour& hour : pack.day.hours)
    if (hour.group != kNight) settings[hour.group].value = 1, settings[hour.group].hour = pack.day.shown_hour;
  return settings;
}

Status set_hour(const Pack& pack, float hour, std::vector<LightSetting>& settings) {
  ORIEL_TRY_VOID(hours_around(pack.day, hour));
  for (const DayHour& of : pack.day.hours)
    if (of.group != kNight) settings[of.group].hour = hour, settings[of.group].on = true;
  return {};
}

std::optional<float> shown_hour(const Pack& pack, const std::vector<LightSetting>& settings) {
  for (const DayHour& hour : pack.day.hours)
    if (hour.group != kNight) return settings[hour.group].hour;
  return std::nullopt;
}

Status set_lights(const Pack& pack, const std::vector<std::string>& changes, std::vector<LightSetting>& settings,
                  const std::string& from) {
  for (const std::string& change : changes) {
    const auto divides = change.rfind('=');
    if (divides == std::string::npos || divides == 0)
      return fail(ErrorCode::kUsage, from, "found \"{}\", expected NAME=0.3, NAME=off, NAME=2700K or NAME=#rrggbb",
                  change);
    const std::string name = change.substr(0, divides), values = change.substr(divides + 1);
    const auto known = [&](const LightGroup& group) { return group.name == name; };
    const bool taken = std::ranges::any_of(pack.light_groups, known);  // by lamps
    if (name == kHour && !taken) {
      const auto hour = number_of(values);
      if (!hour) return fail(ErrorCode::kUsage, from, "found \"{}\" for the hour, expected a time as 14.5", values);
      if (Status set = set_hour(pack, *hour, settings); !set)
        return fail(ErrorCode::kUsage, from, "{}: {}", kHour, set.error().message);
      continue;
    }
    bool any = false;
    for (std::size_t g = 0; g < settings.size(); ++g) {
      const bool meant = settings[g].hour ? name == kDay && !taken : name == pack.light_groups[g].name;
      if (name != "*" && !meant) continue;
      any = true;
      ORIEL_TRY_VOID(take_values(name, values, from, settings[g]));
    }
    if (!any) return unknown(pack, settings, name, from);
  }
  return {};
}

Result<std::vector<std::string>> read_lights(const std::string& file) {
  ORIEL_TRY(const Bytes bytes, read_file(file));
  const Json json = Json::parse(bytes).value_or(Json());
  constexpr const char* kExpected = "expected {\"group\": \"0.3 2700K\", …}";
  if (!json.is_object()) return invalid(file, "found no JSON object, {}", kExpected);
  std::vector<std::string> changes;
  for (const auto& [name, value] : json.items()) {
    if (!value.is_string() && !value.is_number())
      return invalid(file, "found no text or number for \"{}\", {}", name, kExpected);
    changes.push_back(name + "=" + (value.is_string() ? value.get<std::string>() : value.dump()));
  }
  return changes;
}

std::string lights_json(const Pack& pack, const std::vector<LightSetting>& settings) {
  Json json = Json::object();
  const std::vector<LightSetting> before = settings_of(pack);
  if (shown_hour(pack, settings) != shown_hour(pack, before)) json[kHour] = *shown_hour(pack, settings);
  // Hours of a day are set alike.
  for (std::size_t g = 0; g < settings.size(); ++g) {
    LightSetting s = settings[g];
    s.hour = before[g].hour;
    if (s == before[g]) continue;
    std::string text = fmt::format("{}", s.value);
    if (s.kelvin) {
      text += fmt::format(" {:.0f}K", *s.kelvin);
    } else if (s.color) {
      const Vec3 shown = *s.color / max_component(*s.color);
      text += " #";
      for (int c = 0; c < 3; ++c) {
        const float v = shown[c] <= 0.0031308f ? 12.92f * shown[c] : 1.055f * std::pow(shown[c], 1 / 2.4f) - 0.055f;
        text += fmt::format("{:02x}", static_cast<int>(std::lround(255 * std::clamp(v, 0.0f, 1.0f))));
      }
    }
    if (!s.on) text += " off";
    json[s.hour ? kDay : pack.light_groups[g].name] = text;
  }
  return json.empty() ? std::string() : json.dump(2);
}

std::vector<Vec3> factors_of(const Pack& pack, const std::vector<LightSetting>& settings) {
  std::vector<float> weights(settings.size(), 1.0f);
  if (const auto hour = shown_hour(pack, settings))
    if (auto of_hour = weights_at(pack.day, *hour, settings.size())) weights = std::move(*of_hour);
  std::vector<Vec3> factors;
  for (std::size_t g = 0; g < settings.size(); ++g) {
    const LightSetting& s = settings[g];
    const Vec3 tint = s.color ? *s.color / glm::max(pack.light_groups[g].own_color, Vec3(kLeastOwn)) : Vec3(1);
    factors.push_back(s.on ? weights[g] * s.value * tint : Vec3(0));
  }
  return factors;
}

}  // namespace oriel
