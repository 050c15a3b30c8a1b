// The window.
#pragma once

#include <functional>

#include "formats/pack/deferred.h"
#include "player/options/arguments.h"

namespace oriel {

// Shows the pack until the user closes the window. Errors: kRuntime (no display, no OpenGL 3.3), kUsage, kStopped once
// `stopped` says so.
Status play_in_window(DeferredPack pack, const PlayArguments& arguments, const std::function<bool()>& stopped);

}  // namespace oriel
