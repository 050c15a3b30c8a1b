// The light that a mover meets where it stands, ready for its vertices: no OpenGL.
//
// Light is asked at the corners of a box inside the mover's, and taken as linear between them: a value and a gradient
// along the object's axes (Annen et al. 2004, "Spherical Harmonic Gradients for Mid-Range Illumination"), fitted by
// least squares with the light field's trust as weights.
#pragma once

#include "formats/assets/mover.h"
#include "formats/query/light_at.h"
#include "player/navigation/culling.h"

namespace oriel {

// What is linear over a mover: dot(fit, (1, q)), q in [-1,1]³ over its box.
struct LinearShare {
  std::uint32_t light = 0;  // into LightField::lights
  Vec4 fit{0};
};

struct MoverLight {
  // Rows by cluster of its transfer, of 3 (components + 1) texels: for the mean (k = 0) and component k, then colour c,
  // texel 3k + c is linear. Irradiance over π of a vertex: Σ_k weight_k dot(texel, (1, q)), weight_0 = 1; weights are
  // the codes of CompressedTransfer over 32767.
  std::vector<Vec4> table;
  std::vector<LinearShare> bright;  // lights that shine on it on their own, with the share of them that `table` lacks
};

// field.bands may be 0: no light. box: object space. all_in_harmonics: bright lights too, unshadowed by the mover, as
// harmonics; `bright` is empty then.
MoverLight light_mover(const LightField& field, const CompressedTransfer& transfer, const Bounds& box,
                       const MoverPose& pose, bool all_in_harmonics);

}  // namespace oriel
