// When alpha counts as whole.
#pragma once

namespace oriel {

inline constexpr float kOpaqueAlpha = 254.5f / 255;  // what rounds to 255 of 8 bits

}  // namespace oriel
