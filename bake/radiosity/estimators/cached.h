// The `cached` estimator: bounces live in the lightmap, and one final gather refines them.
#pragma once

#include <memory>

#include "bake/radiosity/estimators/estimator.h"

namespace oriel {

// Effort goes where the task's pixels look. Fills of the report what is of the cached estimator. Error kStopped;
// refine() also kInvalid where light does not die away.
Result<std::unique_ptr<LightEstimator>> make_cached_estimator(const RadiosityTask& task);

}  // namespace oriel
