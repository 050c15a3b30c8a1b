// Lamps that are moved: groups of them, each as one thing. No OpenGL.
#pragma once

#include "formats/pack/pack.h"
#include "formats/query/mover_pose.h"

namespace oriel {

// A group's lamps as they were baked; pack space.
struct LampShape {
  std::vector<std::uint32_t> parts;   // of the mesh, ascending: those that shine
  std::vector<std::uint32_t> lights;  // of the light field: points and spots
  Vec3 centre{0};                     // of the box around them
  bool empty() const { return parts.empty() && lights.empty(); }
};
LampShape shape_of_lamp(const Pack& pack, const LightGroup& group);

// By light group, the pose that takes it from where it was baked to where it is: pack space to pack space. That is
// where the moves put its centre, else where its animation has it at that time. Moves of movers do not count. Empty: no
// lamp is moved. Error kUsage for a move of a group that has nothing to be moved.
Result<std::vector<MoverPose>> lamps_at(const Pack& pack, std::span<const MoverMove> moves, double time_s);

// A pose that leaves all where it is.
inline bool is_rest(const MoverPose& pose) {
  return pose == MoverPose{};
}

}  // namespace oriel
