// How the tool tells of its work: a bar on a terminal, plain lines otherwise, JSON lines on request. All on stderr.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "bake/cli/countdown.h"
#include "bake/jobs/context.h"

namespace oriel {

class ProgressPrinter {
 public:
  enum class Style { kBar, kPlain, kJson, kQuiet };

  // Where nothing else is told for kSilence seconds (on paper for longer, the longer the work takes), a line says what
  // is going on: some stages tell nothing of themselves for long.
  explicit ProgressPrinter(Style style);
  ~ProgressPrinter();
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  void operator()(const Progress& progress);
  // Once, however many nodes of one name it is about.
  void warning(const Warning& warning);
  void note(const std::string& message);
  // Ends a bar's line.
  void finish();
  static constexpr double kSilence = 1.5;

 private:
  using Clock = std::chrono::steady_clock;
  void draw(const Progress& progress, double seconds);
  void end_line();
  double silence() const;  // after which a line is due, s
  void watch();
  void tell_alive();
  void line(const char* event, const std::string& message, std::string_view id = {});

  Style style_;
  static constexpr double kShort = 0.5;  // seconds
  std::string stage_;
  std::string told_;  // the stage that ended last
  std::set<std::string> warned_;
  Clock::time_point begun_ = Clock::now(), started_ = begun_, drawn_ = begun_;
  double fraction_ = 0;
  // Of the whole work, as it was foretold last, then; < 0: it was not. And what is told of it.
  double left_s_ = -1, foretold_s_ = 0;
  Countdown countdown_;
  bool open_line_ = false;
  std::mutex mutex_;  // of all above
  std::condition_variable ended_;
  bool ends_ = false;
  std::thread watcher_;
};

}  // namespace oriel
