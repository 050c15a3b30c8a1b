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
  std::size_t mover = 0;  // into Pack::movers, of a lamp into Pack::light_groups
  Vec3 at{0};             // where it was taken, pack space
  bool lamp = false;
};
// The mover that the ray meets first, if nothing that stands still is before it. Every triangle counts, from both
// sides.
std::optional<Grip> grip_mover(const Pack& pack, std::span<const MoverPose> poses, const PickRay& ray);

// The lamp whose shining surface the ray meets first of all that stands still. lamps: as lamps_at() has them.
std::optional<Grip> grip_lamp(const Pack& pack, std::span<const MoverPose> lamps, const PickRay& ray);

// Where the ray meets the level plane of that height, at most `farthest` away.
std::optional<Vec3> on_level(const PickRay& ray, float height, float farthest);

// The move of the mover of that name, which is added, at that place (world), if there is none.
MoverMove& move_of(std::vector<MoverMove>& moves, const std::string& name, const DVec3& at);

}  // namespace oriel
