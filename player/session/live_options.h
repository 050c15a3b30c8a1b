// Options of lamps that move.
#pragma once

#include "formats/cli/option.h"
#include "player/scene/frame_options.h"

namespace oriel {

// group: that help lists them in.
std::vector<Option> live_options(const char* group, LiveSettings& out);

}  // namespace oriel
