// The preview's window.
#pragma once

#include <chrono>

#include "preview/arguments.h"

namespace oriel {

// Until the user closes it, or context.stop is set; the file is followed. Errors: kRuntime (no display, no OpenGL 3.3),
// those of the file where it was never read, kStopped. started: when the user did.
Status preview_in_window(const PreviewArguments& arguments, Context& context,
                         std::chrono::steady_clock::time_point started);

}  // namespace oriel
