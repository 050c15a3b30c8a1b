// How reflections are shown, as options.
#pragma once

#include "formats/cli/option.h"
#include "player/session/arguments.h"

namespace oriel {

std::vector<Option> reflection_options(const char* group, PlayArguments& out);

}  // namespace oriel
