// The fraction of a texel's diffuse reflection that its specular layers let through.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "bake/scene/shade.h"
#include "formats/core/archive.h"

namespace oriel {

// The mean over some points of 1 - max R(θ), [0,1], by the cosine of the viewing direction. R is the directional albedo
// of the specular layers, its largest channel (trace/albedo.h). The table's nodes are even in (1 - cosθ)², because R
// rises at grazing angles. The error is 0.003 at most for the steepest dielectrics, 0.01 where cosθ < 0.2, and 0.05
// where cosθ < 0.03.
class DiffuseShare {
 public:
  DiffuseShare() { share_.fill(kOne); }  // no specular layer
  explicit DiffuseShare(std::span<const ShadePoint> points);

  float at(float cosine) const {
    const float away = 1 - std::clamp(cosine, 0.0f, 1.0f), x = away * away * (kNodes - 1);
    const int left = std::min(static_cast<int>(x), kNodes - 2);
    const float f = x - static_cast<float>(left);
    return ((1 - f) * share_[left] + f * share_[left + 1]) / kOne;
  }

 private:
  friend void fields(Archive& archive, DiffuseShare& share) { archive(share.share_); }

  static constexpr int kNodes = 16;
  static constexpr std::uint16_t kOne = 0xffff;
  std::array<std::uint16_t, kNodes> share_;
};

}  // namespace oriel
