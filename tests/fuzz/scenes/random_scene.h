// A random scene from a seed: any of the parts, at any scale and place.
#pragma once

#include <set>
#include <string>

#include "tests/fuzz/scenes/glb.h"

namespace oriel::fuzz {

struct RandomScene {
  Bytes glb;
  std::vector<std::string> parts;  // their names, as all_parts() has them
  double scale = 1;                // metres a unit of the parts
  double area_m2 = 0;              // of its surfaces
  Sources sources;                 // radiance and lights do not depend on the scale
};

// `without`: names of parts to leave out; the others stay as they are, so that what fails can be made smaller. With
// plain_space the scale is 1 and the place the origin.
RandomScene random_scene(std::uint64_t seed, const std::set<std::string>& without = {}, bool plain_space = false);

}  // namespace oriel::fuzz
