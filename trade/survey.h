// What of a scene decides which knobs it has a use for, read from a quick bake of it.
#pragma once

#include <string>
#include <vector>

#include "formats/pack/pack.h"

namespace oriel::trade {

struct SceneFacts {
  double diagonal_m = 0;  // of the scene's bounds
  double area_m2 = 0;     // of all surfaces: how many texels there will be
  bool planar = false;    // planar reflectors
  bool curved = false;    // curved ones
  bool glossy = false;    // a reflector with a lobe wider than a mirror's
  bool movers = false;
  std::vector<std::string> cameras;  // whose frames are judged, as --camera of oriel-bake render and oriel-play take it
};

// `cameras`: how many at most, > 0. Of the scene's cameras the first, then those that look at most of the reflectors
// that the others do not; without cameras (a bake adds one where there are neither these nor paths) the player's own
// first view.
SceneFacts survey(const Pack& pack, std::size_t cameras);

// A texel for a scene of that size: a hundredth of its diagonal, rounded to 1, 2 or 5 times a power of ten; at most
// the bake's default of 10 cm. Metres.
double fitting_texel_m(double diagonal_m);

}  // namespace oriel::trade
