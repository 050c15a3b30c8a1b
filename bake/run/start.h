// The camera that a pack starts with.
#pragma once

#include "bake/run/task.h"

namespace oriel {

enum class Start : std::uint8_t { kOfScene, kInside, kOutside };

// Where the scene has no camera and no walk, adds one to the pack: "start" (bake/visibility/first_look.h), on the
// floors of the eyes that the bake is for, or where these are given, wherever people could walk. Says which it is.
// Error kStopped.
Result<Start> choose_start(const BakeTask& bake);

}  // namespace oriel
