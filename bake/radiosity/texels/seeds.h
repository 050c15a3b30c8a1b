// Seed offsets of a lightmap's random numbers. Each purpose has its own offset from the bake's seed, so that no two of
// them share points or directions.
#pragma once

#include <cstdint>

namespace oriel::seeds {

inline constexpr std::uint64_t kOccluderRays = 0x4ea5;       // rays that find occluders close to a texel
inline constexpr std::uint64_t kExtraSamplePoints = 0x3a17;  // sample points beyond the stored ones
inline constexpr std::uint64_t kWalls = 0x9a27;              // points of a texel that a wall may separate
inline constexpr std::uint64_t kBounces = 0xb0;              // rays between patches
inline constexpr std::uint64_t kGather = 0x9a7e;             // directions of the final gather
inline constexpr std::uint64_t kBright = 0xb416;             // light samples of bright texels, and points on them
inline constexpr std::uint64_t kLampPaths = 0x1a39;          // particles from lamps
inline constexpr std::uint64_t kPolished = 0x501d;           // particles of suns, starting at polished surfaces
inline constexpr std::uint64_t kSurvival = 0x50b1;           // calibration rays of path survival
inline constexpr std::uint64_t kPolygonLight = 0xd1ec;       // + the light's number: points on it
inline constexpr std::uint64_t kSharpLight = 0x9f00;         // + the light's number: points of sized punctual lights
inline constexpr std::uint64_t kMirroredLight = 0x3177;      // + its number: the same of their mirror images
inline constexpr std::uint64_t kFrostedLight = 0xf057;       // + the sample's number: frosted panes, and points on them
inline constexpr std::uint64_t kSky = 0x50f;                 // directions of a sky image
inline constexpr std::uint64_t kManyLights = 0x9e11;         // + the pick's number: a choice among many lights
inline constexpr std::uint64_t kFramePixels = 0xf4a3e;       // frame pixels of the stated error
inline constexpr std::uint64_t kHeldOutPixels = 0x4e1d;      // frame pixels of the held-out error
inline constexpr std::uint64_t kDetail = 0xde7a;             // + steps along a finer cell: all of its points
inline constexpr std::uint64_t kHeldOutPaths = 0xce27;       // + the estimate's number: paths of the held-out error

}  // namespace oriel::seeds
