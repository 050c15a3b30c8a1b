// Where the clock and the user put movers.
#pragma once

#include "formats/pack/pack.h"
#include "formats/query/mover_pose.h"

namespace oriel {

// By Pack::movers: as their animations have them at that time, but for those that the moves name. Error kUsage for a
// name that no mover and no light group has.
Result<std::vector<MoverPose>> poses_at(const Pack& pack, std::span<const MoverMove> moves, double time_s);

}  // namespace oriel
