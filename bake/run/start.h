// The camera that a pack starts with.
#pragma once

#include "bake/run/baked_light.h"
#include "bake/run/options.h"
#include "formats/pack/pack.h"

namespace oriel {

enum class Start : std::uint8_t { kOfScene, kInside, kOutside };

// Where the scene has no camera and no walk, adds one to the pack: "start" (bake/visibility/first_look.h), on the
// floors of the eyes that the bake is for, or where these are given, wherever people could walk. Says which it is.
// Error kStopped.
Result<Start> choose_start(const BakeOptions& options, const WalkOptions& people, const EyeRegion& region,
                           const BakedScene& baked, Context& context, Pack& pack);

}  // namespace oriel
