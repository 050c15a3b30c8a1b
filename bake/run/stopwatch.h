// Wall clock of stages, by name.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace oriel {

struct StageTime {
  std::string stage;
  double seconds = 0;
  std::uint64_t rays = 0;
};

// Runs one stage, stage(rays) with rays to add to, and notes its wall clock.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<StageTime>& times) : times_(times) {}
  template <class Stage>
  auto operator()(const char* name, const Stage& stage) {
    const auto start = std::chrono::steady_clock::now();
    std::uint64_t rays = 0;
    auto result = stage(rays);
    times_.push_back({name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), rays});
    return result;
  }

 private:
  std::vector<StageTime>& times_;
};

}  // namespace oriel
