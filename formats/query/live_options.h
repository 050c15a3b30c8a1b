// How many lights stand for a lamp that has moved (live_lights.h).
#pragma once

#include <cstdint>

namespace oriel {

struct LiveOptions {
  std::uint32_t lights = 300;  // in all, for each lamp; 0: none
  float direct_share = 0.5f;   // of them on the lamp, [0,1]
  std::uint32_t bounces = 3;   // that walks are followed for; 0: direct light alone

  bool operator==(const LiveOptions&) const = default;
};
inline constexpr std::uint32_t kMostLiveLights = 100000, kMostLiveBounces = 16;

}  // namespace oriel
