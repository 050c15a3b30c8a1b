#include "formats/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace oriel {

std::size_t core_count() {
  return std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 16);
}

void for_each_parallel(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr thrown;
  std::mutex of_thrown;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < count;) try {
        body(i);
      } catch (...) {
        const std::lock_guard lock(of_thrown);
        thrown = std::current_exception();
        next = count;
      }
  };
  {
    std::vector<std::jthread> others;
    // A system that has no thread to give leaves more work to this one.
    try {
      while (others.size() + 1 < std::min(threads, count)) others.emplace_back(work);
    } catch (const std::system_error&) {
    }
    work();
  }
  if (thrown) std::rethrow_exception(thrown);
}

void for_each_run(std::size_t count, std::size_t threads,
                  const std::function<void(std::size_t first, std::size_t end)>& body) {
  constexpr std::size_t kRun = 512;
  for_each_parallel((count + kRun - 1) / kRun, threads,
                    [&](std::size_t run) { body(run * kRun, std::min(count, (run + 1) * kRun)); });
}

}  // namespace oriel
