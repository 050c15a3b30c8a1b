// How bright unlit surfaces are beside lit ones.
#pragma once

#include <span>

#include "bake/run/task.h"

namespace oriel {

// The luminance that shows as white where the log-average luminance of what eyes see is middle grey (18 %), cd/m²: that
// of white unlit surfaces in mirrors and maps, as frames show them. glTF gives unlit colours no unit, and frames show
// them as they are. 1 where the scene has no unlit surface, or nothing else that is lit. Error kStopped.
Result<float> unlit_white(const BakeTask& bake, const PathOptions& paths, std::span<const Vec3> eyes);

}  // namespace oriel
