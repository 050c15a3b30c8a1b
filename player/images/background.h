// Work beside the thread that draws.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace oriel {

// Jobs in the order in which they were added. Ends with those that run; what has not begun is dropped.
class Background {
 public:
  // Starts no thread before there is a job. At least one; where the system has none to give, jobs run when they are
  // added. gives_way: to the threads that draw.
  Background(std::size_t threads, bool gives_way);
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  // The job must not throw.
  void add(std::function<void()> job);
  std::size_t unfinished() const;
  // Until fewer than that are unfinished, or the time has come.
  void wait_below(std::size_t unfinished, std::chrono::steady_clock::time_point until);

 private:
  void work();
  void start();
  const std::size_t most_;
  const bool gives_way_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  std::size_t unfinished_ = 0, idle_ = 0;
  bool ends_ = false;
  std::vector<std::jthread> threads_;
};

// What jobs made, for one who takes it.
template <class T>
class Mailbox {
 public:
  void put(T value) {
    const std::lock_guard lock(mutex_);
    values_.push_back(std::move(value));
  }
  std::vector<T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(values_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<T> values_;
};

}  // namespace oriel
