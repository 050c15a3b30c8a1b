// Small rooms with one thing each that light does.
#pragma once

#include <ostream>

#include "bake/scene/scene.h"

namespace oriel::test {

enum class Feature { kMatt, kGlossyFloor, kMirror, kGlass, kCutOut, kSphere, kPoint, kSky, kDielectric, kManyLamps };

std::ostream& operator<<(std::ostream& out, Feature feature);

// 2 m × 2 m × 2 m, open in front, with something standing in it; under the sky it has no ceiling.
Scene room(Feature feature);

}  // namespace oriel::test
