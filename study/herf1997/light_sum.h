// Light at the texels of a receiver from the samples that reach them, each with its own weight cosθ cosθ' / r².
#pragma once

#include <span>

#include "study/herf1997/blocked_rows.h"
#include "study/herf1997/occluder_view.h"
#include "study/herf1997/simd.h"

namespace oriel::study {

// Irradiance of texel centres in units of the power's own, row by row: Σ over samples that are not blocked of
// power · cosθ cosθ' / r² (Herf 1997, equation 3.2). Lengths are scaled by the light's height, so any unit will do.
class LightSum {
 public:
  LightSum(const OccluderView& view, const ShadowReceiver& receiver, const ShadowLight& light);

  // rows: of the view's apexes. out: width * height.
  void run(const BlockedRows& rows, Simd simd, std::span<float> out) const;

 private:
  struct Kernel;
  // By sample and as numbers of a texel's place: a row passes a sample at `along` with a square distance of its own.
  // All in units of the largest height of a sample. One more than there are, of weight 0.
  std::vector<float> along_, across_, height2_, weight_;
  float step_ = 0, step_across_ = 0, skew_ = 0;           // a texel along its row; a row across and along
  float emission_ = 0, emission_x_ = 0, emission_y_ = 0;  // light's normal · (sample - texel), an affine function
  bool double_sided_ = false;
};

}  // namespace oriel::study
