// How the tool tells of its work: a bar on a terminal, plain lines otherwise, JSON lines on request. All on stderr.
#pragma once

#include <chrono>
#include <string>

#include "bake/jobs/context.h"

namespace oriel {

class ProgressPrinter {
 public:
  enum class Style { kBar, kPlain, kJson, kQuiet };

  explicit ProgressPrinter(Style style) : style_(style) {}
  ~ProgressPrinter() { finish(); }
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  void operator()(const Progress& progress);
  void warning(const std::string& message);
  void note(const std::string& message);
  // Ends a bar's line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(const Progress& progress, double seconds);
  void line(const char* event, const std::string& message);

  Style style_;
  static constexpr double kShort = 0.5;  // seconds
  std::string stage_;
  std::string told_;  // the stage that ended last
  Clock::time_point started_{}, drawn_{};
  bool open_line_ = false;
};

}  // namespace oriel
