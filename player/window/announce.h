// A word to the user of what a key has done.
#pragma once

#include <string>

#include "player/session/session.h"

namespace oriel {

// After perform(): how it stands now. Empty where what it did says so itself.
std::string announce(const Command& command, const Pack& pack, const Session& session);

}  // namespace oriel
