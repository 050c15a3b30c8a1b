// What the colours of a stage mean.
#pragma once

#include "player/scene/frame_options.h"

namespace oriel {

// In the panel. show: a survey's.
void draw_legend(Show show);

}  // namespace oriel
