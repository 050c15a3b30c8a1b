// What the user has set lamps to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/core/result.h"
#include "formats/pack/pack.h"

namespace oriel {

// Of a group of lamps.
struct LightSetting {
  bool on = true;
  float value = 1;              // times the light that was baked
  std::optional<Vec3> color;    // of its light, linear, of luminance 1, instead of its own
  std::optional<float> kelvin;  // that color is of, if any
  std::optional<float> hour;    // of a group that is an hour of the pack's day: the time shown, by which it counts

  bool operator==(const LightSetting&) const = default;
};

// Linear light of a black body, Rec. 709, of luminance 1; channels that it has none of are 0. 1667 to 25000 K (Kang et
// al. 2002, "Design of Advanced Color Temperature Control System for HDTV Applications").
inline constexpr float kLeastKelvin = 1667, kMostKelvin = 25000;
Vec3 color_of_kelvin(float kelvin);

// As the pack has them.
std::vector<LightSetting> settings_of(const Pack& pack);

// "NAME=0.3", "NAME=off", "NAME=on", "NAME=2700K" or "NAME=#rrggbb" (sRGB; how bright it is does not count), one after
// the other; several values of a name with spaces between. The last = divides. NAME may be * for all groups, day for
// sun and sky of all hours, or hour, whose value is a time of the pack's day. Error kUsage: what was found and
// expected, a name that the pack does not know with those that it knows. from: what errors name, an option or a file.
Status set_lights(const Pack& pack, const std::vector<std::string>& changes, std::vector<LightSetting>& settings,
                  const std::string& from = "--light");

// Shows the pack's day at that time; other lamps stay as they are. Error kUsage: none of its hours, or no day.
Status set_hour(const Pack& pack, float hour, std::vector<LightSetting>& settings);
// The time that is shown; nothing where the pack has no day.
std::optional<float> shown_hour(const Pack& pack, const std::vector<LightSetting>& settings);

// A JSON file, {"hour": 14.5, "desk": "0.3 2700K", "hall": "off"}, as changes. Errors kIo, kInvalid.
Result<std::vector<std::string>> read_lights(const std::string& file);
// The same of what was set; an empty text where all is as the pack has it.
std::string lights_json(const Pack& pack, const std::vector<LightSetting>& settings);

// By group, times what was baked: FrameOptions::lights.
std::vector<Vec3> factors_of(const Pack& pack, const std::vector<LightSetting>& settings);

}  // namespace oriel
