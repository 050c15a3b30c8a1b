// Light that leaves the texels: before, between and after their estimate (docs/notes/sharp-light.md).
#pragma once

#include "bake/radiosity/estimators/estimator.h"
#include "bake/radiosity/radiosity.h"
#include "bake/radiosity/seams.h"
#include "bake/radiosity/shadow_lists.h"

namespace oriel {

// What stands in the way of charts' light. Charts for which there is no time are flat no more.
Status find_sharp_light(const RadiosityTask& task, SharpCharts& charts, ShadowLists& shadows);

// Where one side's light is partly computed by pixel and the other's is not, texels must differ.
void leave_out_sharp_ends(const RadiosityTask& task, Seams& seams);

// From here on pages have all light.
void add_sharp_light(const ShadowLists& shadows, Radiosity& light);

}  // namespace oriel
