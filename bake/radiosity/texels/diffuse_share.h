// What the specular layers over a texel leave to its diffuse reflection.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "bake/scene/shade.h"
#include "formats/core/archive.h"

namespace oriel {

// Mean over some points of 1 - max R(θ) (trace/albedo.h), by the cosine of the direction of sight. Tabulated over
// (1 - cosθ)², for R rises where sight grazes. Off by 0.003 at most for the steepest dielectrics; by 0.01 where cosθ is
// below 0.2, by 0.05 below 0.03.
class DiffuseShare {
 public:
  DiffuseShare() { share_.fill(kOne); }  // nothing is specular
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
