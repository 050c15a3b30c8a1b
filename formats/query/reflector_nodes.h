// A planar reflector's space, and the grid over its bounds from which it sees its emitters.
#pragma once

#include "formats/assets/radiance_map.h"

namespace oriel {

// Points between pack space and a reflector's space. Rigid both ways, by differences to the origin: no matrix is
// inverted.
Vec3 reflector_from_pack(const Reflector& reflector, const Vec3& p);
Vec3 pack_from_reflector(const Reflector& reflector, const Vec3& p);

// The nodes of Reflector::visibility, row by row.
struct ReflectorNodes {
  std::uint32_t x = 2, y = 2;
  float lift_m = 0;          // of the points off the plane: over what is not quite flat
  std::vector<Vec3> points;  // pack space; those of the border a little inwards, off the walls around a reflector
};
ReflectorNodes lay_out_nodes(const Reflector& reflector, std::uint32_t x, std::uint32_t y);

inline constexpr float kNodeDistance_m = 0.125f;      // at most, where there are not too many
inline constexpr std::uint32_t kMostNodesAlong = 65;  // a side of the bounds
// At least 2.
std::uint32_t nodes_along(float side_m, float distance_m, std::uint32_t most);

// Nodes that the reflector does not cover take the mean of their neighbours that have a value, ring by ring: what lies
// there may be the inside of a wall. By node; none is covered: nothing changes.
void fill_uncovered(const ReflectorNodes& nodes, const std::vector<bool>& covered, std::vector<float>& shares);

}  // namespace oriel
