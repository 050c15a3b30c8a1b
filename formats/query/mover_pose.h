// Where movers stand: by time, or as a user says.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/assets/mover.h"
#include "formats/core/result.h"

namespace oriel {

// Of the keys, which repeat: positions linear between them, rotations at constant angular speed. Before the first key
// it stands there; a time that is not a number is 0. Without keys, `rest`.
MoverPose pose_at(const MoverPose& rest, std::span<const MoverKey> keys, double time_s);

DMat4 pack_from_object(const MoverPose& pose);
// What takes an object from one place to another: pack space to pack space. Less than a micrometre: exactly none.
MoverPose motion_between(const MoverPose& from, const MoverPose& to);

// A mover put somewhere by hand.
struct MoverMove {
  std::string node;
  DVec3 position{0};   // of the node's origin, world metres
  double yaw_rad = 0;  // about up, counter-clockwise from above, from how it stands otherwise
};
// NODE=x,y,z or NODE=x,y,z,yaw with yaw in degrees. Error kUsage.
Result<MoverMove> parse_move(std::string_view text);
std::string text_of(const MoverMove& move);  // as parse_move() takes it

// `pose` moved so. origin: Mesh::origin.
MoverPose moved(const MoverPose& pose, const MoverMove& move, const DVec3& origin);

// Applies the moves to the poses of movers with those names. Error kUsage for a name that none has; it lists those most
// alike.
Status apply_moves(std::span<const MoverMove> moves, std::span<const std::string> names, const DVec3& origin,
                   std::span<MoverPose> poses);

}  // namespace oriel
