// What changed between two packs of one building: the light by surface and by camera, and what it falls on.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "formats/analysis/asset_diff.h"

namespace oriel {

enum class SurfaceState { kBoth, kOnlyInFirst, kOnlyInSecond };

// A part of the mesh. Light is compared at the same points of the same triangles, whatever the atlases; where a part's
// triangles are not the same in both packs, only the means are.
struct SurfaceChange {
  std::string name, material;
  SurfaceState state = SurfaceState::kBoth;
  bool same_shape = true;
  double area_m2 = 0;                    // in the first pack that has it; none of what a camera sees
  double before_lux = 0, after_lux = 0;  // mean illuminance
  float block_m = 0;                     // texels are of another size: of means over blocks of this side; 0: of points
  double before_error_lux = 0, after_error_lux = 0;  // root mean square of the standard error
  // By channel, or of the one that differs most. Of the means alone where the shape changed.
  DVec3 bias_lux{0}, bias_variance{0};  // mean of the difference; of it what noise makes
  double rms_lux = 0;                   // root mean square of it
  double noise_lux = 0;                 // what the standard errors alone make of that
  // What noise does not explain: of the mean what is beyond its 95 % interval, of the mean square the noise's taken
  // off, and of means over blocks of four texels the 99th percentile of what is beyond the noise's own.
  double mean_change_lux = 0, rms_change_lux = 0, p99_change_lux = 0;

  double change_lux() const { return std::max({mean_change_lux, rms_change_lux, p99_change_lux}); }
};

struct OptionChange {
  std::string name;           // path in the provenance, joined by dots
  std::string before, after;  // as JSON; empty: not there
};

struct PackDiff {
  std::vector<SurfaceChange> surfaces;  // those first whose light changed most: change_lux() times area
  std::vector<SurfaceChange> cameras;   // light of what the first pack's cameras see, of surfaces in both packs
  double bias_lux = 0;                  // beyond its 95 % interval, over all surfaces in both packs
  std::vector<AssetChange> assets;
  std::vector<OptionChange> options;
  double mean_lux = 0;  // over all surfaces of the first pack

  // The largest change of a surface, a camera or the whole by its mean, or by 1 % of the scene's where it is darker.
  double largest() const;
  // Whether neither light nor assets changed by more, and no surface came, went or has another shape.
  bool within(double tolerance) const;
  double share(const SurfaceChange& surface) const;
};

// points: on each part, at least one a triangle.
PackDiff diff_packs(const Pack& before, const Pack& after, std::size_t points = 4096);

}  // namespace oriel
