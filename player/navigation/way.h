// Ways over a pack's floors: where people can walk from here to there. No OpenGL.
#pragma once

#include <limits>

#include "player/navigation/floors.h"

namespace oriel {

struct WayOptions {
  float reach_m = 1.0f;  // a goal may be this far beside the nearest place to stand, and a start too
  StepOptions step;
};

// The eyes at the corners of a short way from `eye` to where somebody stands at `goal` (a point of a floor, pack
// space); without the first. Straight between its corners every step is one that Floors::walk takes. Empty: nobody can
// stand there, or come there from here.
std::vector<Vec3> find_way(const Floors& floors, const Vec3& eye, const Vec3& goal, const WayOptions& options = {});

// Where people can come to who shall go to a point of a surface.
struct NearestWay {
  std::vector<Vec3> way;  // as find_way; one corner where there is no way from `eye`
  float short_m = 0;      // from where it ends, at the feet, to the point
  bool glides = false;    // nobody can walk from `eye`: it is flown to straight
};
// The way to that place which is nearest to `goal` of all that people reach on foot from `eye`; from an eye that stands
// on no floor the nearest place of any floor. Nothing without a floor.
std::optional<NearestWay> find_nearest_way(const Floors& floors, const Vec3& eye, const Vec3& goal,
                                           const WayOptions& options = {});

// Walking along one.
struct Walker {
  std::vector<Vec3> way;  // its corners that are still ahead
  bool glides = false;    // through the air, walls included: from where nobody can walk
  float speed_m_s = 1.4f;
  float nearest_m = std::numeric_limits<float>::infinity();  // that it has come to the next corner
  float stuck_s = 0;                                         // without coming nearer

  bool on() const { return !way.empty(); }
};

// Starts along a way: at speed_m_s, or faster so that it takes no more than some seconds.
Walker start_walking(const Vec3& eye, std::vector<Vec3> way, float speed_m_s);

// Where it wants to stand after dt_s, at the eye's own height: for Floors::walk, which decides; one that glides is
// there, at the way's height. Ends the way where it does, and where it comes no further for half a second.
Vec3 walk_on(Walker& walker, const Vec3& eye, float dt_s);

}  // namespace oriel
