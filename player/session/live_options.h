// Options of lamps that move, and of the hour.
#pragma once

#include "formats/cli/option.h"
#include "player/scene/frame_options.h"

namespace oriel {

// group: that help lists them in.
std::vector<Option> live_options(const char* group, LiveSettings& out);

// As 14.5 or 14:30, [0, 24].
OptionValue clock_hour(std::optional<float>& out);

}  // namespace oriel
