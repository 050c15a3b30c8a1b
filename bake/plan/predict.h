// What a bake would cost, from small ones of the same scene on the same machine.
#pragma once

#include "bake/plan/census.h"

namespace oriel {

struct Component {
  std::string name;  // "preparation", "radiosity", "material", "radiance", "movers"
  double seconds = 0;
  std::uint64_t rays = 0;       // of radiosity
  std::uint64_t bytes = 0;      // in the pack
  std::uint64_t raw_bytes = 0;  // of maps, as --memory counts them
  double error = -1;            // relative, of what it shows; < 0: not predicted
};

// One thing that was asked for beside what is predicted.
struct Limit {
  std::string option;  // "--error", "--time"
  double asked = 0, predicted = 0;
  bool holds = true;
  std::string text;  // one sentence
};

struct Prediction {
  double pilot_seconds = 0;
  std::vector<Component> components;
  double seconds = 0;  // sum
  std::uint64_t bytes = 0;
  std::vector<Limit> limits;
};

// Work that grows with texels on surfaces and with the length of edges (of shadows, charts) drawn in texels: a √n + b n
// with a, b >= 0, through the work w at two numbers of texels, n[0] < n[1].
struct TexelWork {
  double edges = 0, surfaces = 0;
  double at(double texels) const;
};
TexelWork fit_work(const double (&texels)[2], const double (&work)[2]);

// Bakes the lightmap with texels 8 and 4 times as large (1/64 and 1/16 of them; finer ones for small scenes) and
// extrapolates rays, bytes and squared errors by TexelWork (rays by texels where their limit ends the pilot); seconds
// are rays over the rate measured in the finer one. Reflections are planned and timed as the bake itself does. Movers
// are not predicted. `spent`: seconds that preparation took; with them all ends after some 25 s. Error kStopped and
// those of the stages.
Result<Prediction> predict(const CensusInput& in, const Census& census, double spent, Context& context);

}  // namespace oriel
