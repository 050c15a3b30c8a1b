// Where in its square a texel's light was sampled.
#pragma once

#include "formats/core/archive.h"
#include "formats/core/vec.h"

namespace oriel {

inline constexpr float kWholeTexel = 0.999f;  // of its square, apart from rounding

// How far the sampled part of a texel reaches from its middle along both axes of the page, in texels: the means of
// max(0, -d) and max(0, d) over the part's offsets d. A whole square has 1/8 each.
struct Reach {
  Vec2 before{0.125f}, after{0.125f};

  bool whole() const { return before == Vec2(0.125f) && after == Vec2(0.125f); }
};

inline void fields(Archive& archive, Reach& reach) {
  archive(reach.before, reach.after);
}

class ReachSum {
 public:
  void add(const Vec2& offset) {
    const Vec2 inside = glm::clamp(offset, -0.5f, 0.5f);
    before_ += glm::max(-inside, 0.0f), after_ += glm::max(inside, 0.0f), ++count_;
  }
  Reach mean() const { return {before_ / count_, after_ / count_}; }

 private:
  Vec2 before_{0}, after_{0};
  float count_ = 0;
};

}  // namespace oriel
