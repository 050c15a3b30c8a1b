// Movers under the mouse: no OpenGL.
#pragma once

#include <optional>

#include "formats/pack/pack.h"
#include "formats/query/mover_pose.h"
#include "formats/query/triangle_hit.h"
#include "player/navigation/view.h"

namespace oriel {

struct PickRay {
  Vec3 from{0}, direction{0, 0, -1};  // pack space; direction: unit
};
// place: of a pixel in the picture, [0,1]², (0, 0) the top left corner.
PickRay ray_through(const View& view, const Vec2& place);

struct Grip {
  std::size_t mover = 0;  // into Pack::movers
  Vec3 at{0};             // where it was taken, pack space
};
// The mover that the ray meets first, if nothing that stands still is before it. Every triangle counts, from both
// sides.
std::optional<Grip> grip_mover(const Pack& pack, std::span<const MoverPose> poses, const PickRay& ray);

// Where the ray meets the level plane of that height, at most `farthest` away.
std::optional<Vec3> on_level(const PickRay& ray, float height, float farthest);

// The move of that mover, which is added, where it stands, if there is none of its name.
MoverMove& move_of(std::vector<MoverMove>& moves, const Mover& mover, const MoverPose& pose, const DVec3& origin);

}  // namespace oriel
