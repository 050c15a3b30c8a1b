// Radiance maps within the time of a bake: how long their capture is likely to take, and which are left out or made
// smaller for it.
#pragma once

#include "bake/run/reflections.h"
#include "bake/run/time_budget.h"

namespace oriel {

// Nothing is captured, and the reason is among the omissions.
void leave_out_maps(const Warning& why, PlannedReflections& planned);

// Halves the sides of all maps until capture is likely to take no more than `seconds`, or the maps are tiny.
void shrink_maps(double seconds, PlannedReflections& planned);

// Sets capture_s: a 64th of the maps' pixels is captured in the dark, which takes as long as in the light; judging goes
// by what planning took. `dark` gets a lightmap for it. Error kStopped.
Status time_reflections(const BakeTask& bake, Pack& dark, PlannedReflections& planned);

// Of a pack: its mesh, lightmaps and planned maps.
double bytes_of(const PreparedScene& prepared, const PlannedReflections& planned);

// Maps as large as the time allows; the seconds that all stages behind the lightmap are likely to take. Error kStopped.
Result<double> fit_reflections(const BakeTask& bake, const TimeBudget& budget, PlannedReflections& planned);

}  // namespace oriel
