// The inner loops of LightSum: 32 texels of a row at once.
#pragma once

#include <array>

#include "study/herf1997/light_sum.h"

namespace oriel::study {

inline constexpr int kStrip = 32;
inline constexpr int kMostNodes = 16;

struct StripTask {
  const LightSum::Samples& samples;
  const LightSum::Steps& steps;
  const BlockedRows& rows;
  std::span<float> out;
};

void sum_strips(const StripTask& task, Simd simd);

}  // namespace oriel::study
