// Lamps that the player is to draw by itself, in passes of their own (Method::kDiefenbach1997).
#pragma once

#include <vector>

#include "bake/run/task.h"

namespace oriel {

// Error kUsage where there are more than kMaxBrightLights.
Status check_lamps(const BakeTask& bake);
// Adds to the pack's light field all lamps that a bright light can be; a pack without one gets a field of one cell
// without light, for them. What is none (measured profiles, textured or finely divided emitters, the sky) is in no
// pass, which is told in `omissions`.
Status list_lamps(const BakeTask& bake, std::vector<Warning>& omissions);

}  // namespace oriel
