// The places that reflections were planned for, as tiles on the floors. No OpenGL.
#pragma once

#include <vector>

#include "player/navigation/zone.h"

namespace oriel {

// Triangles, three corners each, pack space; colours by corner, RGBA8 as shown.
struct ZoneMesh {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> colors;
};

inline constexpr float kTileHeight_m = 0.02f;  // over the floor
inline constexpr float kEyeSize_m = 0.05f;     // of what marks an eye: less than its zone, which would hide the room
inline constexpr Vec3 kZoneColor{0.15f, 0.7f, 0.25f};       // where eyes were planned for, sRGB
inline constexpr Vec3 kZoneEdgeColor{0.55f, 0.65f, 0.15f};  // beside that, where what they see still holds
inline constexpr Vec3 kZoneEyeColor{0.2f, 0.45f, 0.9f};     // cameras, paths and eyes of a file

// Tiles over the cells of its grids that somebody stands on, and over those beside them; a small octahedron at each
// of its eyes. Its box is not in it.
ZoneMesh zone_mesh(const Zone& zone);

}  // namespace oriel
