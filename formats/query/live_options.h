// How many lights stand for a lamp that has moved (live_lights.h).
#pragma once

#include <cstdint>
#include <optional>

namespace oriel {

// Who brings a moved lamp's bounced light: rays from texel to texel (LiveBounces), or lights where random walks meet
// surfaces (Keller 1997).
enum class LiveIndirect { kTexels, kLights };

struct LiveOptions {
  std::uint32_t lights = 64;  // in all, for each lamp; 0: none
  LiveIndirect indirect = LiveIndirect::kTexels;
  float direct_share = 0.5f;  // of them on the lamp, [0,1], where lights bring bounced light too; else all are
  std::optional<std::uint32_t> bounces = {};  // 0: direct light alone; none: 16 by texels, 3 by lights

  std::uint32_t bounce_count() const { return bounces.value_or(indirect == LiveIndirect::kTexels ? 16 : 3); }
  bool operator==(const LiveOptions&) const = default;
};
inline constexpr std::uint32_t kMostLiveLights = 100000;

}  // namespace oriel
