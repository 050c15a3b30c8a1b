// Options that change nothing in a scene and with the other options: a user who gave one is told.
#pragma once

#include <string>
#include <vector>

#include "bake/run/options.h"

namespace oriel {

// What of a scene decides whether an option has an effect.
struct IdleFacts {
  bool suns = false;         // directional lights
  bool movers = false;       // nodes that move
  bool light_field = false;  // they, or lamps that move, need the light around
  bool reflectors = false;   // planar or curved ones that eyes see
  bool maps = false;         // radiance maps are planned
};

// A line for each option of options.given that changes nothing, with the reason.
std::vector<std::string> idle_options(const BakeOptions& options, const IdleFacts& facts);

// The options that can be idle.
std::vector<std::string> idle_bake_option_names();

}  // namespace oriel
