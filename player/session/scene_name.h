// What the scene of a pack is called.
#pragma once

#include <string>

#include "formats/pack/pack.h"

namespace oriel {

// The name of the scene's file without its ending, as the bake has recorded it; else that of the pack's own.
std::string scene_name(const Pack& pack, const std::string& file);

}  // namespace oriel
