// Pictures without a display.
#pragma once

#include "formats/pack/deferred.h"
#include "player/session/arguments.h"

namespace oriel {

// Draws each camera of the arguments, or frames along a path, into files. Timings go to stderr. Errors: kUsage, kIo,
// kRuntime, kStopped.
Status play_offscreen(DeferredPack pack, const PlayArguments& arguments);

}  // namespace oriel
