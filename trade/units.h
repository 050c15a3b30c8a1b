// The units of a sweep's work, run one after the other: counted first, reused where they are finished, told of.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <set>

#include "bake/jobs/context.h"
#include "trade/store.h"

namespace oriel::trade {

class Units {
 public:
  using Note = std::function<void(const std::string&)>;
  // time_s: no unit starts after so long; 0: no limit.
  Units(const Store& store, const Context& context, Note note, double time_s)
      : store_(store), context_(context), note_(std::move(note)), time_s_(time_s) {}

  // What the unit measured, from its file, or by running `work` and keeping its result. Nothing (empty()) where the
  // user has stopped the sweep or its time is over. While counting(), nothing is run, and what is missing is counted.
  // Units of a kind take about as long as one another. Errors are those of `work`; a failed unit is not kept.
  Result<Measures> once(const std::string& kind, const std::string& label, const std::string& key,
                        const std::function<Result<Measures>()>& work);

  void count(bool on) { counting_ = on; }
  bool counting() const { return counting_; }
  std::size_t total() const { return all_.size(); }
  std::size_t started() const { return started_; }  // by this run
  std::size_t reused() const { return reused_; }
  std::size_t left() const { return all_.size() - finished_; }  // not finished, failed ones among them

 private:
  using Clock = std::chrono::steady_clock;
  struct Kind {
    std::set<std::string> missing;  // keys
    double seconds = 0;             // that those already run took,
    double count = 0;               // and how many that were
  };
  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }
  bool over() const { return context_.stopped() || (time_s_ > 0 && seconds_since(begun_) > time_s_); }
  std::string time_left() const;

  const Store& store_;
  const Context& context_;
  const Note note_;
  const double time_s_;
  const Clock::time_point begun_ = Clock::now();
  bool counting_ = false;
  std::set<std::string> all_;
  std::map<std::string, Kind> kinds_;
  std::map<std::string, Measures> done_;  // by key
  std::size_t started_ = 0, reused_ = 0, finished_ = 0;
};

}  // namespace oriel::trade
