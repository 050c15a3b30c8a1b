// One frame of the preview into a file.
#pragma once

#include <chrono>

#include "preview/arguments.h"

namespace oriel {

// started: when the user did. Errors of loading, kRuntime of the device, kIo, kStopped.
Status preview_offscreen(const PreviewArguments& arguments, Context& context,
                         std::chrono::steady_clock::time_point started);

}  // namespace oriel
