// Walking on a pack's floors: walls stop, stairs carry, ledges hold.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "formats/assets/walk_grid.h"

namespace oriel {

struct StepOptions {
  float step_m = 0.4f;     // between neighbouring cells, up and down; a little more than the grid's own highest step
  float settle_s = 0.08f;  // in which an eye comes e-fold nearer to its height after a step
  float gravity_m_s2 = 9.81f;
  float beside_m = 1;  // an eye so near a floor, beside it, may only come nearer
};

// A cell of a walk grid that somebody stands on.
struct Stand {
  std::uint32_t grid = 0;
  std::size_t cell = 0;
  Vec3 eye{0};  // over its middle, pack space
};

class Floors {
 public:
  explicit Floors(std::vector<WalkGrid> grids) : grids_(std::move(grids)) {}

  // Where an eye stands that walks from `from` to `to` within dt_s, pack space: stopped by what is no floor, sliding
  // along it; at the floor's eye height, by and by, and falling where the floor is more than a step below
  // (fall_m_s: how fast, kept from step to step). Far from any floor it goes where it wants, at its height.
  Vec3 walk(const Vec3& from, const Vec3& to, float dt_s, float& fall_m_s, const StepOptions& options = {}) const;

  // The eye height (y) over the highest floor at (x, z) that is at most a step above the feet of an eye at `eye`.
  std::optional<float> eye_level(const Vec2& at, float eye_y, const StepOptions& options = {}) const;

  // The cell of that floor.
  std::optional<Stand> stand(const Vec2& at, float eye_y, const StepOptions& options = {}) const;
  // Where an eye stands, or the nearest cell about as high, at most `reach_m` beside it.
  std::optional<Stand> nearest_stand(const Vec3& eye, float reach_m, const StepOptions& options = {}) const;
  // The cell nearest to a point of a floor, at most a step higher or lower and `reach_m` beside it.
  std::optional<Stand> nearest_stand_on(const Vec3& floor, float reach_m, const StepOptions& options = {}) const;
  // The point of the highest floor right below a place.
  std::optional<Vec3> floor_below(const Vec3& place) const;
  bool empty() const { return grids_.empty(); }
  float cell_of(const Stand& stand) const { return grids_[stand.grid].cell_m; }
  float coarsest_cell_m() const;  // 0 without a grid

 private:
  // The nearest cell to a place, whose value of `height` is at most `off_m` from the place's y.
  template <class Height>
  std::optional<Stand> nearest(const Vec3& place, float reach_m, float off_m, const Height& height) const;
  // Along x and z to the middle of the nearest cell about as high; infinite beyond beside_m.
  float distance_to_floor(const Vec3& eye, const StepOptions& options) const;

  std::vector<WalkGrid> grids_;
};

}  // namespace oriel
