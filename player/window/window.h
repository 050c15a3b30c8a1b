// The window.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "formats/pack/deferred.h"
#include "player/session/arguments.h"

namespace oriel {

// Shows the pack until the user closes the window; its images come while it is shown. Errors: kRuntime (no display, no
// OpenGL 3.3), kUsage, kStopped once `stopped` says so. started: when the user did.
Status play_in_window(DeferredPack pack, const PlayArguments& arguments, const std::function<bool()>& stopped,
                      std::chrono::steady_clock::time_point started);

// A window that says why there is nothing to see, until the user closes it or presses a key. Nothing without a display.
void show_refusal(const std::string& reason, const std::function<bool()>& stopped);

}  // namespace oriel
