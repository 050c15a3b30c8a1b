// Walking on a pack's floors: walls stop, stairs carry, ledges hold.
#pragma once

#include <optional>
#include <vector>

#include "formats/assets/walk_grid.h"

namespace oriel {

// How tall those are that a scene was modelled for, as a share of a person whose eyes are 1.6 m over the floor: steps,
// speeds and reaches go with it.
inline constexpr float kUsualEyeHeight_m = 1.6f;

struct StepOptions {
  float step_m = 0.4f;     // between neighbouring cells, up and down; a little more than the grid's own highest step
  float settle_s = 0.08f;  // in which an eye comes e-fold nearer to its height after a step
  float gravity_m_s2 = 9.81f;
  float beside_m = 1;  // an eye so near a floor, beside it, may only come nearer

  // Of people of another size. Falling stays as fast for their eyes.
  StepOptions scaled(float size) const { return {step_m * size, settle_s, gravity_m_s2 * size, beside_m * size}; }
};

// A cell of a walk grid that somebody stands on.
struct Stand {
  std::uint32_t grid = 0;
  std::size_t cell = 0;
  Vec3 eye{0};  // over its middle, pack space
};

// Where a point is seen from above.
inline Vec2 on_map(const Vec3& p) {
  return {p.x, p.z};
}

class Floors {
 public:
  // eye_height_m: of eyes over all floors; 0: as the grids have it.
  explicit Floors(std::vector<WalkGrid> grids, float eye_height_m = 0);

  // Where an eye stands that walks from `from` to `to` within dt_s, pack space: stopped by what is no floor, sliding
  // along it; at the floor's eye height, by and by (an eye that begins lower rises to it), and falling where the floor
  // is more than a step below (fall_m_s: how fast, kept from step to step). Far from any floor it goes where it wants,
  // at its height.
  Vec3 walk(const Vec3& from, const Vec3& to, float dt_s, float& fall_m_s, const StepOptions& options = {}) const;

  // The eye height (y) over the highest floor at (x, z) that is at most a step above the feet of an eye at `eye`.
  std::optional<float> eye_level(const Vec2& at, float eye_y, const StepOptions& options = {}) const;

  // The cell of that floor.
  std::optional<Stand> stand(const Vec2& at, float eye_y, const StepOptions& options = {}) const;
  // Where an eye stands, or the nearest cell of its storey, at most `reach_m` beside it.
  std::optional<Stand> nearest_stand(const Vec3& eye, float reach_m, const StepOptions& options = {}) const;
  // The cell nearest to a point of a floor, at most a step higher or lower and `reach_m` beside it.
  std::optional<Stand> nearest_stand_on(const Vec3& floor, float reach_m, const StepOptions& options = {}) const;
  // The cell nearest to a point, wherever that is.
  std::optional<Stand> nearest_to(const Vec3& point) const;
  // The point of the highest floor right below a place.
  std::optional<Vec3> floor_below(const Vec3& place) const;
  bool empty() const { return grids_.empty(); }
  // Of eyes over the floor; the usual one without a grid.
  float eye_height_m() const { return grids_.empty() ? kUsualEyeHeight_m : grids_.front().eye_height_m; }
  // Of people here (StepOptions::scaled).
  float size() const { return eye_height_m() / kUsualEyeHeight_m; }
  // Under the eye of one who stands there.
  Vec3 floor_of(const Stand& stand) const;
  float cell_of(const Stand& stand) const { return grids_[stand.grid].cell_m; }
  float coarsest_cell_m() const;  // 0 without a grid

 private:
  // The nearest cell to a place that suits(grid, cell).
  template <class Suits>
  std::optional<Stand> nearest(const Vec3& place, float reach_m, const Suits& suits) const;
  // The cell of the highest floor right below a place.
  std::optional<Stand> below(const Vec3& place) const;
  // Along x and z to the middle of the nearest cell of the eye's storey; infinite beyond beside_m.
  float distance_to_floor(const Vec3& eye, const StepOptions& options) const;

  std::vector<WalkGrid> grids_;
};

}  // namespace oriel
