#include "player/session/comparison.h"

#include <algorithm>
#include <cmath>

namespace oriel {

bool drag_divider(const Vec2& pointer, bool clicked, bool holding, float reach, ComparisonView& comparison) {
  const bool taken = clicked && comparison.on() && comparison.beside == Beside::kSplit &&
                     std::fabs(pointer.x - comparison.divider) <= reach;
  comparison.dragged = taken || (comparison.dragged && holding);
  if (comparison.dragged) comparison.divider = std::clamp(pointer.x, 0.0f, 1.0f);
  return taken;
}

}  // namespace oriel
