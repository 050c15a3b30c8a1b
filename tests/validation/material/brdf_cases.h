// The suite's cases of functions: Fresnel, microfacets, Cook and Torrance.
#pragma once

#include <string>
#include <vector>

#include "tests/validation/suite.h"

namespace oriel::validation {

// One number that a function of ours gives.
struct FunctionReading {
  std::string name;
  double value = 0, expected = 0, tolerance = 0;  // absolute
};

std::vector<FunctionReading> fresnel_readings(const Suite& suite);     // NK, FRE
std::vector<FunctionReading> microfacet_readings(const Suite& suite);  // MIC
std::vector<FunctionReading> groove_readings(const Suite& suite);  // CTK: D·G with the grooves of Cook and Torrance

}  // namespace oriel::validation
