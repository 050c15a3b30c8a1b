// parallel_for: the only door to TBB.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "bake/jobs/context.h"

namespace oriel {

// Calls body(i) for i in [0, count) on at most context.threads threads, in no particular order. Results must not
// depend on that order: write to slot i only. Reports progress under `name` where that is not empty, with what the
// stage's count of rays grew by. Denormals are flushed to zero alike in every
// thread. Error kStopped when context.stop was set before all bodies ran.
Status parallel_for(const Stage& stage, std::string_view name, std::size_t count,
                    const std::function<void(std::size_t)>& body);

// Threads that parallel_for would use: context.threads, or the CPUs this process may run on.
int thread_count(const Context& context);

}  // namespace oriel
