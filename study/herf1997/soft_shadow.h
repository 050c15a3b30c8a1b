// Soft shadow textures: the light of a flat lamp on a planar receiver, averaged over hard shadows of its samples.
//
// Herf 1997, "Efficient Generation of Soft Shadow Textures" (CMU-CS-97-138); docs/study/herf1997.md tells what is the
// paper's and what is ours.
#pragma once

#include "study/herf1997/count_methods.h"
#include "study/herf1997/light_sum.h"

namespace oriel::study {

struct SoftShadowOptions {
  CountMethod method = CountMethod::kBitRows;
  double touching =
      0;  // occluders no further from the receiver's plane, or the lamp's, cast nothing, metres; rounding is added
  Simd simd = best_simd();
};

// Keeps its memory from texture to texture. Not for two threads at once.
class SoftShadows {
 public:
  explicit SoftShadows(const SoftShadowOptions& options = {}) : options_(options) {}

  void set_touching(double touching) { options_.touching = touching; }
  // Irradiance by texel, lux for powers in candela: width * height.
  void run(const Occluders& occluders, const ShadowReceiver& receiver, const ShadowLight& light,
           std::vector<float>& out);

  // The first half of it: which texel centres which samples do not reach.
  const BlockedRows& block(const OccluderView& view, const ShadowReceiver& receiver);
  OccluderView view(const Occluders& occluders, const ShadowReceiver& receiver, const ShadowLight& light) const;

 private:
  SoftShadowOptions options_;
  ProjectedEdges projected_;
  BlockedRows rows_;
};

}  // namespace oriel::study
