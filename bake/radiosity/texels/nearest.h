// What texels show whose light there was no time for.
#pragma once

#include "bake/radiosity/texels/texels.h"

namespace oriel {

// Leaves out `unfinished` texels: each is hidden and has the light of a near one that faces the same way, which rays
// find in its place too (Texels::nearest). Texels left out before keep away from those.
void leave_out(std::span<const std::uint32_t> unfinished, Texels& texels);

}  // namespace oriel
