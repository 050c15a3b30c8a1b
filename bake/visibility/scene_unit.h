// Rooms, found by rays from surfaces: whether a scene's numbers can be metres, and where its roofs are.
#pragma once

#include <optional>
#include <vector>

#include "bake/trace/accel.h"

namespace oriel {

struct UnitGuess {
  double metres = 1;       // that one unit of the file is likely to be; 1: these are metres, if they are no feet
  double room_height = 0;  // typical height of its rooms, in units: the median, weighted by its square
};

// Looks for places that a person fits into: floors with something 1.9 to 30 m overhead that shows its front, ceilings
// over one, and floors between walls as high as that with nothing overhead, for modellers leave ceilings out to look
// in. Where there are hardly any, but rooms all the same (something overhead, and walls on three of four sides), or
// these are a kilometre high, the unit is that in which they are likest to 2.7 m high at the median. Boards, and boxes
// that stand on others, are no rooms from within. Rooms of 8.5 without a camera may be feet: that is told, with metres.
// Nothing where the numbers can be metres or no room tells.
std::optional<UnitGuess> guess_unit(const Accel& accel);

// Of the rooms that points of surfaces lie in, each weighted as in guess_unit(), m; nothing without a room.
std::optional<double> typical_room_height(const Accel& accel);

// Points of floors with a roof 1.9 to 30 m overhead, scene space: some of any building, however small it is beside the
// ground that it stands on.
std::vector<Vec3> roofed_places(const Accel& accel);

}  // namespace oriel
