// Two packs beside each other: what is drawn over them, and the panel's part.
#pragma once

#include "player/session/comparison.h"

namespace oriel {

// The panel's choices. Changes the comparison as the user does.
void draw_comparison(ComparisonView& comparison);

// Over the frame: whose it is, the divider.
void draw_names(const ComparisonView& comparison);

}  // namespace oriel
