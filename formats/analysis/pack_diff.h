// What of the light changed between two packs of one building, surface by surface.
#pragma once

#include <string>
#include <vector>

#include "formats/pack/pack.h"

namespace oriel {

enum class SurfaceState { kBoth, kOnlyInFirst, kOnlyInSecond };

// A part of the mesh. Light is compared at the same points of the same triangles, whatever the atlases; where a part's
// triangles are not the same in both packs, only the means are.
struct SurfaceChange {
  std::string name, material;
  SurfaceState state = SurfaceState::kBoth;
  bool same_shape = true;
  double area_m2 = 0;                    // in the first pack that has it
  double before_lux = 0, after_lux = 0;  // mean illuminance
  double rms_lux = 0;                    // root mean square of the difference; of the means where the shape changed
  float block_m = 0;                     // texels are of another size: of means over blocks of this side; 0: of points
  double noise_lux = 0;                  // what the two standard errors alone make of it
  double before_error_lux = 0, after_error_lux = 0;  // root mean square of the standard error

  double change_lux() const;  // of rms_lux, what noise does not explain
};

struct OptionChange {
  std::string name;           // path in the provenance, joined by dots
  std::string before, after;  // as JSON; empty: not there
};

struct PackDiff {
  std::vector<SurfaceChange> surfaces;  // those first whose light changed most: change_lux() times area
  std::vector<OptionChange> options;
  double mean_lux = 0;  // over all surfaces of the first pack

  // The largest change of a surface by its mean, or by 1 % of the scene's where it is darker.
  double largest() const;
  double share(const SurfaceChange& surface) const;
};

// points: on each part, at least one a triangle.
PackDiff diff_packs(const Pack& before, const Pack& after, std::size_t points = 4096);

}  // namespace oriel
