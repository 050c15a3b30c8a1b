// Whether a bake is all that was asked for.
#pragma once

#include <functional>

#include <string>
#include <vector>

#include "bake/run/pipeline.h"
#include "bake/run/time_budget.h"

namespace oriel {

inline constexpr double kSlowPaths = 1.5;  // a ray of verification takes longer than a gathered one

// Each warns, and adds why to the shortfalls.

// An error that was named, alone or with a time, is missed; the default one is a wish, and a warning only.
void judge_error(const BakeOptions& options, const RadiosityReport& report, const TimeBudget& budget, Context& context,
                 std::vector<Warning>& shortfalls);
void judge_time(const BakeOptions& options, const TimeBudget& budget, const std::vector<StageTime>& times,
                Context& context, std::vector<Warning>& shortfalls);
// Stages that are not there for want of time, or since the user had enough: omissions and warnings of the kind
// kTimeOver.
void judge_stages(const BakeResult& result, Context& context, std::vector<Warning>& shortfalls);

// Whether refinement of the lightmap is to end: the user asks for it, or what is left is what later stages need.
// later: seconds of these. Holds budget and context.
std::function<bool()> refined_enough(const BakeOptions& options, const TimeBudget& budget, double later,
                                     const Context& context);

}  // namespace oriel
