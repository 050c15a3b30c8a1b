// parallel_for: the only door to TBB.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "bake/jobs/context.h"

namespace oriel {

// Calls body(i) for i in [0, count) on at most context.threads threads, in no particular order. Results must not
// depend on that order: write to slot i only. Reports progress under `stage` where that is not empty; `rays` (may be
// null) is a counter that bodies add to; progress tells what it grew by. Denormals are flushed to zero alike in every
// thread. Error kStopped when context.stop was set before all bodies ran.
Status parallel_for(Context& context, std::string_view stage, std::size_t count,
                    const std::function<void(std::size_t)>& body, const std::atomic<std::uint64_t>* rays = nullptr);

// Threads that parallel_for would use: context.threads, or the CPUs this process may run on.
int thread_count(const Context& context);

}  // namespace oriel
