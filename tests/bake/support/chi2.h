// χ² of sampled directions against their pdf.
#pragma once

#include <cmath>
#include <vector>

#include "bake/trace/sampler.h"

namespace oriel::test {

// Independent numbers in [0,1): Sobol's are too even for a χ² test.
inline float independent(std::uint64_t i) {
  return static_cast<float>(mix64(i) >> 40) * 0x1p-24f;
}

// In an equal-area grid of (z, φ), over the hemisphere z > 0 or the whole sphere: how many standard deviations above
// its mean. draw(u, v) gives a direction or nothing.
template <class Draw, class Pdf>
double chi2_excess(const Draw& draw, const Pdf& pdf, double lowest_z = 0) {
  constexpr int kRows = 16, kColumns = 24, kSub = 12;
  constexpr std::uint32_t kSamples = 200000;
  const double height = 1 - lowest_z;
  std::vector<double> found(kRows * kColumns), expected(kRows * kColumns);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const auto u = [&](std::uint64_t k) { return independent(mix64(i * 8 + k)); };
    const auto w = draw(u(0), Vec2(u(1), u(2)));
    if (!w || w->z <= lowest_z) continue;
    const double phi = std::atan2(w->y, w->x) / (2 * kPiD) + 0.5;
    const int row = std::min(kRows - 1, static_cast<int>((w->z - lowest_z) / height * kRows)),
              column = std::min(kColumns - 1, static_cast<int>(phi * kColumns));
    found[row * kColumns + column] += 1;
  }
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      for (int a = 0; a < kSub; ++a)
        for (int b = 0; b < kSub; ++b) {
          const double z = lowest_z + height * (row + (a + 0.5) / kSub) / kRows,
                       phi = 2 * kPiD * ((column + (b + 0.5) / kSub) / kColumns - 0.5);
          const double r = std::sqrt(1 - z * z);
          expected[row * kColumns + column] += pdf(Vec3(r * std::cos(phi), r * std::sin(phi), z)) * kSamples * 2 *
                                               kPiD * height / (kRows * kColumns * kSub * kSub);
        }
  double chi2 = 0;
  int cells = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (expected[i] > 10) {
      chi2 += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
      ++cells;
    }
  return (chi2 - cells) / std::sqrt(2.0 * cells);
}

}  // namespace oriel::test
