#include "bake/jobs/parallel.h"

#include <immintrin.h>
#include <sched.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace oriel {
namespace {

// TBB's workers do not inherit the caller's floating-point modes, so every body sets them (and restores the caller's).
class FlushDenormals {
 public:
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }  // FTZ | DAZ
  ~FlushDenormals() { _mm_setcsr(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned saved_;
};

}  // namespace

int thread_count(const Context& context) {
  if (context.threads > 0) return context.threads;
  cpu_set_t cpus;
  if (::sched_getaffinity(0, sizeof(cpus), &cpus) == 0) return std::max(1, CPU_COUNT(&cpus));
  return 1;
}

Status parallel_for(const Stage& stage, std::string_view name, std::size_t count,
                    const std::function<void(std::size_t)>& body) {
  Context& context = stage.context;
  const auto threads = static_cast<std::size_t>(thread_count(context));
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  std::atomic<std::size_t> done{0};
  const std::size_t step = std::max<std::size_t>(1, count / 200);
  const std::uint64_t rays_before = stage.traced();
  const auto report = [&](std::size_t finished) {
    if (!name.empty())
      context.report(name, count == 0 ? 1.0 : static_cast<double>(finished) / static_cast<double>(count),
                     stage.traced() - rays_before);
  };
  if (count > 0) report(0);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    if (context.stopped()) return;
    const FlushDenormals modes;
    body(i);
    const std::size_t finished = done.fetch_add(1) + 1;
    if (finished % step == 0 && finished != count) report(finished);
  });
  if (done.load() != count) return fail(ErrorCode::kStopped, std::string(name), "stopped");
  report(count);
  return {};
}

}  // namespace oriel
