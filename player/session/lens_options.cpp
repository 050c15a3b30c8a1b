#include "player/session/lens_options.h"

#include <fmt/format.h>

#include "formats/core/json.h"
#include "formats/core/text.h"

namespace oriel {

std::vector<Option> lens_options(const char* group, LensSettings& out) {
  return {
      {"--accumulate", group,
       "A picture is the mean of so many frames, each through other points of its pixels, of the lens and of the time "
       "that it is open, of lamps that movers shade and of frosted glass. Default: 1, or 64 with --aperture or "
       "--shutter",
       number(out.frames, 1, 65536), Use::kRare, "accumulate", "", "--compare --panorama"},
      {"--aperture", group,
       "Diameter of the lens, as 25mm (one of 50 mm at f/2): what is before or behind the focus is blurred",
       length(out.aperture_m), Use::kRare, "aperture", "", "--compare --panorama"},
      {"--focus", group, "How far away things are sharp, along the view. auto: what is in the middle of the picture",
       length(out.focus_m, "auto"), Use::kRare, "focus", "", "", "--aperture"},
      {"--shutter", group,
       "Seconds that the lens is open, as 0.02: what moves is blurred, the eye along --path and movers",
       number(out.shutter_s, 0, 3600), Use::kRare, "shutter", "", "--compare --panorama"},
  };
}

OptionValue length(float& metres, const std::string& zero) {
  return {zero.empty() ? "LENGTH" : zero + "|LENGTH",
          [&metres, zero](const std::string& typed) -> Status {
            static constexpr Unit kUnits[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}};
            metres = 0;
            if (!zero.empty() && typed == zero) return {};
            ORIEL_TRY(const double found, parse_quantity(typed, kUnits, "length", "1.6m or 25mm"));
            metres = static_cast<float>(found);
            return {};
          },
          [&metres, zero] { return metres > 0 ? fmt::format("{:g}m", metres) : zero; },
          [&metres, zero] { return metres > 0 || zero.empty() ? Json(metres) : Json(zero); }};
}

}  // namespace oriel
