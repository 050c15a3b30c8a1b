// What the random numbers of a lightmap are drawn for. Each purpose has an offset of its own from the bake's seed, so
// that no two share their points or directions.
#pragma once

#include <cstdint>

namespace oriel::seeds {

inline constexpr std::uint64_t kCrowded = 0x4ea5;        // rays that find out whether something is close to a texel
inline constexpr std::uint64_t kMoreSites = 0x3a17;      // points of texels beyond their first ones
inline constexpr std::uint64_t kWalls = 0x9a27;          // points of a texel that a wall may part
inline constexpr std::uint64_t kBounces = 0xb0;          // rays between patches
inline constexpr std::uint64_t kGather = 0x9a7e;         // gathered directions
inline constexpr std::uint64_t kBright = 0xb416;         // rays at bright texels, and points on these
inline constexpr std::uint64_t kLampPaths = 0x1a39;      // particles from lamps
inline constexpr std::uint64_t kPolished = 0x501d;       // particles of suns from polished surfaces
inline constexpr std::uint64_t kSurvival = 0x50b1;       // rays that find out how often paths are worth going on
inline constexpr std::uint64_t kPolygonLight = 0xd1ec;   // + the light's number: points on it
inline constexpr std::uint64_t kSharpLight = 0x9f00;     // + the light's number: points of punctual lights with a size
inline constexpr std::uint64_t kMirroredLight = 0x3177;  // + its number: the same of those seen in mirrors
inline constexpr std::uint64_t kFrostedLight = 0xf057;   // + the sample's number: which panes, and points of them
inline constexpr std::uint64_t kSky = 0x50f;             // directions of a sky image
inline constexpr std::uint64_t kManyLights = 0x9e11;     // + the pick's number: which of many lights
inline constexpr std::uint64_t kFramePixels = 0xf4a3e;   // what eyes look at, for the stated error
inline constexpr std::uint64_t kHeldOutPixels = 0x4e1d;  // the same, for the measured one
inline constexpr std::uint64_t kDetail = 0xde7a;         // + steps along a finer cell: all of its points
inline constexpr std::uint64_t kCertificate = 0xce27;    // + the estimate's number: paths that measure it

}  // namespace oriel::seeds
