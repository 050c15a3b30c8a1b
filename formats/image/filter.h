// Separable filters on planes of values.
#pragma once

#include <vector>

namespace oriel {

// One channel of a picture, row by row.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;
};

// Correlates with along(x) · down(y), both of odd length and centred; beyond its border a plane goes on as its border.
Plane filtered(const Plane& plane, const std::vector<double>& along, const std::vector<double>& down);

// exp(-x² / (2 sigma²)) for x = -radius … radius, scaled to a sum of 1. sigma > 0.
std::vector<double> gaussian(double sigma, int radius);

}  // namespace oriel
