// What the user sees of two packs, or of a pack and a picture, beside each other. No window, no drawing.
#pragma once

#include <string>

#include "formats/core/vec.h"

namespace oriel {

// Both, parted by a divider; or one of them.
enum class Beside { kSplit, kFirst, kSecond };

struct ComparisonView {
  std::string first, second;  // their names; without a second one there is nothing to compare
  Beside beside = Beside::kSplit;
  float divider = 0.5f;  // share of the window's width that shows the first
  bool dragged = false;
  bool elsewhere = false;  // the second is a picture that was taken from another place than the camera's

  bool on() const { return !second.empty(); }
};

// The divider follows the left button where that went down on it. True where the click was its. pointer: [0,1]² of the
// window; reach: how near is on it, a share of the width.
bool drag_divider(const Vec2& pointer, bool clicked, bool holding, float reach, ComparisonView& comparison);

}  // namespace oriel
