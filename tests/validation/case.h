// Published and closed-form cases as plain data: a scene, and numbers that its illuminance must give.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "bake/scene/scene.h"

namespace oriel::validation {

// World, metres, y up; weight of this point in the reading.
struct Probe {
  DVec3 position{0};
  DVec3 normal{0};
  double weight = 1;
};

enum class Over { kPoints, kMean, kWorst };
enum class Part { kTotal, kDirect, kIndirect };

// value = offset + scale · E in one colour channel, where E is the weighted sum over `probes`, the area-weighted mean
// over the surfaces `nodes`, or the illuminance on them that is farthest from what is expected.
struct Reading {
  std::string name;
  double expected = 0;
  double tolerance = 0;  // absolute
  Over over = Over::kPoints;
  std::vector<Probe> probes;
  std::vector<std::string> nodes;
  double offset = 0, scale = 1;
  int channel = 1;
  Part part = Part::kTotal;
  double reference_error = 0;                                   // standard error of `expected`
  double published = std::numeric_limits<double>::quiet_NaN();  // what a printed table says; for information
};

// Bounds over all readings of a case together: for references that are noisy themselves.
struct GridTolerance {
  double mean = 0;   // |Σ ours / Σ reference - 1|
  double nrmse = 0;  // rms difference over the mean
};

struct Case {
  std::string id;     // of the suite
  std::string label;  // "ENC-01, rho 0.5"
  Scene scene;
  std::vector<Reading> readings;
  GridTolerance grid;    // all zero: none
  double texel_m = 0;    // of the lightmap that resolves what the readings ask for; 0: not read from a texture
  double lux_error = 0;  // relative standard error a point
  int rule = 16;         // points along each side of a quad, for means at points; an eighth for the worst
};

}  // namespace oriel::validation
