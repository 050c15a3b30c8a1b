// What random scenes are made of: each part is something that has broken a baker.
#pragma once

#include <span>

#include "tests/fuzz/scenes/glb.h"
#include "tests/fuzz/scenes/random.h"

namespace oriel::fuzz {

struct Part {
  const char* name;
  float chance;  // of being in a scene
  void (*add)(Glb&, Random&);
};

// Sizes are those of a room: a few metres about the origin, the floor at y = 0.
std::span<const Part> all_parts();

}  // namespace oriel::fuzz
