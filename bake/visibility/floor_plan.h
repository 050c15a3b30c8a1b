// Places in a scene where a person can stand, on a grid of columns, and the steps between them.
#pragma once

#include <array>
#include <vector>

#include "bake/jobs/context.h"
#include "bake/trace/accel.h"

namespace oriel {

struct WalkOptions {
  float cell_m = 0.25f;                 // side of a column; larger where max_columns would not reach
  std::uint32_t max_columns = 1 << 17;  // over the area searched
  float reach_m = 40;                   // how far from the nearest start the search goes, along x and z
  float head_room_m = 1.8f;             // free height over a floor
  float step_m = 0.35f;                 // highest step
  float radius_m = 0.25f;               // of a person
  float max_slope_deg = 45;             // of a floor
  float eye_height_m = 1.6f;
  float roof_m = 30;      // higher up, nothing is a roof: a dome that stands for the sky, say
  float doorstep_m = 5;   // how far from a roof people walk in the open, along the floor
  float outdoors_m = 25;  // and how far from a camera or a path that stands there

  // Of people of another size: all that goes with their bodies. How far they go does not.
  WalkOptions scaled(float size) const;
  float size() const { return eye_height_m / WalkOptions().eye_height_m; }
};

struct Place {
  float y = 0;                               // of the floor, scene space
  bool covered = false;                      // a roof is overhead, no higher than WalkOptions::roof_m
  std::array<std::int32_t, 2> next{-1, -1};  // the place one step on towards +x and +z, into FloorPlan::places
};

struct FloorPlan {
  Vec2 lower{0};  // x, z of the grid's corner, scene space
  float cell_m = 0;
  std::uint32_t width = 0, height = 0;  // columns along x and z
  std::vector<std::uint32_t> first;     // column c's places are first[c] … first[c + 1]; c = j * width + i
  std::vector<Place> places;            // by column, then by rising height
};

// Floors are found by rays down the columns' middles; a place has head room, and nothing is within a person's radius
// between the height of a step and the head. Two places are a step apart where their columns are neighbours, their
// heights differ by a step at most (where columns are wider than that, by a column's width) and a body's height of rays
// passes between them. The area is the scene's, within reach of the starts if there are any. Error kStopped.
Result<FloorPlan> find_floors(const Accel& accel, std::span<const Vec3> starts, const WalkOptions& options,
                              Context& context);

}  // namespace oriel
