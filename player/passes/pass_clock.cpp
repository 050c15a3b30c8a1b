#include "player/passes/pass_clock.h"

namespace oriel {

void PassClock::start(bool on) {
  on_ = on;
  timed_.clear();
  times_ = {};
}

void PassClock::begin(Pass pass) {
  if (!on_) return;
  timed_.push_back(pass);
  if (queries_) {
    if (pool_.size() < timed_.size()) pool_.push_back(gpu::make_query());
    glBeginQuery(GL_TIME_ELAPSED, pool_[timed_.size() - 1].name());
  } else {
    glFinish();
    began_ = std::chrono::steady_clock::now();
  }
}

void PassClock::end() {
  if (!on_) return;
  if (queries_) {
    glEndQuery(GL_TIME_ELAPSED);
  } else {
    glFinish();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - began_;
    times_[static_cast<std::size_t>(timed_.back())] += took.count();
  }
}

PassTimes PassClock::read() {
  if (!on_ || !queries_) return times_;
  for (std::size_t i = 0; i < timed_.size(); ++i) {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(pool_[i].name(), GL_QUERY_RESULT, &nanoseconds);
    times_[static_cast<std::size_t>(timed_[i])] += static_cast<double>(nanoseconds) * 1e-6;
  }
  return times_;
}

}  // namespace oriel
