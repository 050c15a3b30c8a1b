#include "player/images/background.h"

#include <sys/resource.h>

#include <algorithm>
#include <system_error>

namespace oriel {
namespace {

// Of this thread alone, on Linux: the thread that draws comes first.
void give_way() {
  constexpr int kNice = 5;
  ::setpriority(PRIO_PROCESS, 0, kNice);
}

}  // namespace

Background::Background(std::size_t threads, bool gives_way)
    : most_(std::max<std::size_t>(threads, 1)), gives_way_(gives_way) {}

Background::~Background() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    jobs_.clear();
  }
  changed_.notify_all();
}

void Background::add(std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
    ++unfinished_;
    if (idle_ < jobs_.size() && threads_.size() < most_) start();
  }
  changed_.notify_all();
  if (!threads_.empty()) return;
  work();  // no thread is to be had
}

void Background::start() {
  try {
    threads_.emplace_back([this] {
      if (gives_way_) give_way();
      work();
    });
  } catch (const std::system_error&) {
  }
}

// With threads: until the end. Without: until nothing is left to do.
void Background::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    ++idle_;
    changed_.wait(lock, [&] { return ends_ || !jobs_.empty() || threads_.empty(); });
    --idle_;
    if (ends_ || jobs_.empty()) return;
    const std::function<void()> job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    job();
    lock.lock();
    --unfinished_;
    changed_.notify_all();
  }
}

std::size_t Background::unfinished() const {
  const std::lock_guard lock(mutex_);
  return unfinished_;
}

void Background::wait_below(std::size_t unfinished, std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, until, [&] { return unfinished_ < unfinished; });
}

}  // namespace oriel
