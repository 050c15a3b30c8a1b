// Pictures without a display.
#pragma once

#include "formats/pack/pack.h"
#include "player/options/arguments.h"

namespace oriel {

// Draws each camera of the arguments, or frames along a path, into files. Timings go to stderr. Errors: kUsage, kIo,
// kRuntime, kStopped.
Status play_offscreen(Pack pack, const PlayArguments& arguments);

}  // namespace oriel
