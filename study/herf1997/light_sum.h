// Light at the texels of a receiver from the samples that reach them, each with its own weight cosθ cosθ' / r².
#pragma once

#include <span>

#include "study/herf1997/blocked_rows.h"
#include "study/herf1997/occluder_view.h"
#include "study/herf1997/simd.h"

namespace oriel::study {

// Irradiance of texel centres in units of the power's own, row by row: Σ over samples that are not blocked of
// power · cosθ cosθ' / r² (Herf 1997, equation 3.2). Lengths are scaled by the light's height, so any unit will do.
//
// Where every sample is blocked nothing is summed. Where none is, the sum varies so slowly (its nearest pole is as far
// as the light is high) that squares of 32² texels are interpolated from a few Chebyshev points, to float's precision.
class LightSum {
 public:
  // powers: of the view's apexes, a number each.
  LightSum(const OccluderView& view, const ShadowReceiver& receiver, const ShadowLight& light,
           std::span<const float> powers);

  // rows: of the view's apexes. out: width * height.
  void run(const BlockedRows& rows, Simd simd, std::span<float> out) const;

  // By sample and as numbers of a texel's place: a row passes a sample at `along` with a square distance of its own.
  // All in units of the largest height of a sample.
  struct Samples {
    std::vector<float> along, across, height2, weight;
  };
  struct Steps {
    float along = 0, across = 0, skew = 0;               // a texel along its row; a row across and along
    float emission = 0, emission_x = 0, emission_y = 0;  // light's normal · (sample - texel), an affine function
    bool double_sided = false;
    int nodes = 0;  // Chebyshev points along a side of a square; 0: the sum is done in full
  };

 private:
  Samples samples_;
  Steps steps_;
};

}  // namespace oriel::study
