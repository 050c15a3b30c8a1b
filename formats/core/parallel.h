// Work on several cores for what links no TBB: reading packs, in the player too. (Stages of a bake have parallel_for.)
#pragma once

#include <cstddef>
#include <functional>

namespace oriel {

// Threads that this process may run at once, 1 to 16: what reads packs gains nothing from more.
std::size_t core_count();

// body(0) … body(count - 1), each once, on at most `threads` threads, begun in this order; returns when all are done.
// Where one throws, no further ones begin and one of the exceptions is thrown on.
void for_each_parallel(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& body);
// The same of runs [first, end) that a thread takes at once and that are all of [0, count): for what takes little each.
void for_each_run(std::size_t count, std::size_t threads,
                  const std::function<void(std::size_t first, std::size_t end)>& body);

}  // namespace oriel
