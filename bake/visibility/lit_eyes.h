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

// A cube, a lamp, a machine alone has tops that pass for floors, or none. Where no camera is given, most of what is
// seen from the region can be seen from around the scene too, and most of what can be seen from there is not seen from
// the region, eyes are at 64 places around the scene, from beside it to where all of it is in the frame, with a note.
// A room's inside is not seen from around it; around a house on a lawn most is the lawn. Error kStopped.
Status stand_around_bodies(const Accel& accel, EyeRegion& region, Context& context);

}  // namespace oriel
