// What differs between two packs of one building beside their light: materials, textures, lamps, shapes, cameras.
#pragma once

#include <string>
#include <vector>

#include "formats/pack/pack.h"

namespace oriel {

struct AssetChange {
  std::string asset, member;  // "material 'oak'", "roughness"
  std::string before, after;  // as JSON; empty: not there
  double change = 1;          // of numbers: relative to the largest of them
};

// Those first that changed most. Assets are matched by name, those without by their order.
std::vector<AssetChange> diff_assets(const Pack& before, const Pack& after);

}  // namespace oriel
