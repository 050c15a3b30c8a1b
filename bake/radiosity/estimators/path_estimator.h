// The `reference` estimator: unbiased paths from every texel.
#pragma once

#include <memory>

#include "bake/radiosity/estimators/estimator.h"

namespace oriel {

// Creates it for a task, which must outlive it.
std::unique_ptr<LightEstimator> make_path_estimator(const RadiosityTask& task);

}  // namespace oriel
