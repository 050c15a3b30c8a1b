// Options that change nothing with a pack and the other options: a user who gave one is told.
#pragma once

#include <string>
#include <vector>

#include "formats/pack/pack.h"
#include "player/session/arguments.h"

namespace oriel {

// A line for each option of arguments.given that changes nothing, with the reason.
std::vector<std::string> idle_options(const Pack& pack, const PlayArguments& arguments);

// The options that can be idle.
std::vector<std::string> idle_option_names();

}  // namespace oriel
