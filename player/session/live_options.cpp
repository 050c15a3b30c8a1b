#include "player/session/live_options.h"

#include <fmt/format.h>

#include "player/session/option_names.h"

namespace oriel {

std::vector<Option> live_options(const char* group, LiveSettings& out) {
  return {
      {"--live-lights", group, "Lights that stand for a lamp that was moved: more are smoother and slower",
       number(out.lights.lights, 1, kMostLiveLights), Use::kRare, "live_lights"},
  };
}

OptionValue clock_hour(std::optional<float>& out) {
  OptionValue value = number(out, 0, 24);
  value.type = "HOUR|HH:MM";
  value.set = [set = value.set](const std::string& typed) -> Status {
    int hours = 0, minutes = 0, read = 0;
    const bool clock = std::sscanf(typed.c_str(), "%2d:%2d%n", &hours, &minutes, &read) == 2 &&
                       read == static_cast<int>(typed.size()) && hours >= 0 && minutes >= 0 && minutes < 60;
    if (set(clock ? fmt::format("{}", hours + minutes / 60.0) : typed)) return {};
    return fail(ErrorCode::kUsage, "", "found '{}', expected an hour from 0 to 24 as 14.5 or 14:30", typed);
  };
  return value;
}

}  // namespace oriel
