// Frames beside their path-traced reference, or beside what they were, in numbers and as a picture.
#pragma once

#include "formats/pack/deferred.h"
#include "player/session/arguments.h"

namespace oriel {

// Draws the view of the arguments' one camera, compares it with the file of `oriel-bake render`, prints a table to
// stdout and writes what the arguments ask for. The size is a whole multiple of the reference's: pixels are then
// averaged. Or with an earlier frame, .exr without further layers or .png, of the same size. Errors: kUsage, kIo,
// kInvalid, kRuntime; kDifferent where FLIP exceeds arguments.max_flip or the frame holds values that are not finite.
Status play_compare(DeferredPack pack, const PlayArguments& arguments);

}  // namespace oriel
