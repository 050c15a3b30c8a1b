// The camera that a pack starts with.
#pragma once

#include <functional>

#include "bake/run/task.h"
#include "bake/visibility/first_look.h"

namespace oriel {

enum class Start : std::uint8_t { kOfScene, kInside, kOutside };

// For a scene without cameras and paths: on the floors of the eyes that the bake is for, or where these are given,
// wherever people could walk. Error kStopped.
Result<FirstLook> find_start(const BakeTask& bake, const std::function<bool()>& enough);

}  // namespace oriel
