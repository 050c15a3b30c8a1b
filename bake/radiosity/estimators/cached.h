// The `cached` estimator: a radiosity solution in the lightmap, refined by one final gather.
#pragma once

#include <memory>

#include "bake/radiosity/estimators/estimator.h"

namespace oriel {

// Creates it for a task, which must outlive it. Samples go where the task's frame pixels need them. write() fills the
// report's fields marked `cached`. Error kStopped.
Result<std::unique_ptr<LightEstimator>> make_cached_estimator(const RadiosityTask& task);

}  // namespace oriel
