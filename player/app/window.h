// The window.
#pragma once

#include "formats/pack/pack.h"
#include "player/app/arguments.h"

namespace oriel {

// Shows the pack until the user closes the window. Errors: kRuntime (no display, no OpenGL 3.3), kUsage, kStopped after
// a signal.
Status play_in_window(Pack pack, const PlayArguments& arguments);

}  // namespace oriel
