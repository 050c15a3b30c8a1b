// Eyes are where there is something to see.
#pragma once

#include "bake/trace/path.h"
#include "bake/visibility/eye_region.h"

namespace oriel {

// A house that is a shell, lit from outside, has floors on which it is pitch-dark. Where floors were found, no camera
// is given, and paths from 128 eyes on them find next to no light beside what is seen from places in and around the
// scene (half its size), eyes are at up to 64 of these that see light, with a note. Left as it is where the scene is
// dark everywhere. Error kStopped.
Status leave_the_dark(const Transport& transport, EyeRegion& region, Context& context);

}  // namespace oriel
