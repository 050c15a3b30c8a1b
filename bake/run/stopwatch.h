// Wall clock of stages, by name.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bake/jobs/context.h"

namespace oriel {

struct StageTime {
  std::string stage;
  double seconds = 0;
  std::uint64_t rays = 0;
};

// Runs one stage, stage(rays) with rays to add to, and notes its wall clock.
class Stopwatch {
 public:
  // begins: told of each stage's name, may be empty.
  explicit Stopwatch(std::vector<StageTime>& times, std::function<void(const char*)> begins = {})
      : times_(times), begins_(std::move(begins)) {}
  template <class Stage>
  auto operator()(const char* name, const Stage& stage) {
    if (begins_) begins_(name);
    const ElapsedTime elapsed;
    std::uint64_t rays = 0;
    auto result = stage(rays);
    times_.push_back({name, elapsed.spent(), rays});
    return result;
  }

 private:
  std::vector<StageTime>& times_;
  std::function<void(const char*)> begins_;
};

}  // namespace oriel
