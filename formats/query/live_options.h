// How many lights stand for a lamp that has moved (live_lights.h).
#pragma once

#include <cstdint>

namespace oriel {

struct LiveOptions {
  std::uint32_t lights = 64;   // for each lamp, at least one for each of its own; 0: none
  std::uint32_t bounces = 16;  // of its light; 0: direct light alone

  bool operator==(const LiveOptions&) const = default;
};
inline constexpr std::uint32_t kMostLiveLights = 100000;

}  // namespace oriel
