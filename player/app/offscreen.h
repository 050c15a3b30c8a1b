// Pictures without a display.
#pragma once

#include "formats/pack/pack.h"
#include "player/app/arguments.h"

namespace oriel {

// Draws each camera of the arguments, or frames along a path, into files. Timings go to stderr. Errors: kUsage, kIo,
// kRuntime, kStopped.
Status play_offscreen(Pack pack, const PlayArguments& arguments);

// The frame that a renderer drew last, as a picture file: .png as shown, .exr linear.
Status write_picture(class Renderer& renderer, const std::string& path, int width, int height, float ev100,
                     ToneCurve curve, const std::string& camera);

}  // namespace oriel
