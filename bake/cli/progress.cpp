#include "bake/cli/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "formats/core/json.h"

namespace oriel {
namespace {

constexpr const char* kTool = "oriel-bake";  // logs of several programs lie in one file

std::string duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  return fmt::format("{:.0f} min {:02d} s", std::floor(seconds / 60), static_cast<int>(seconds) % 60);
}

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

ProgressPrinter::ProgressPrinter(Style style) : style_(style) {
  if (style_ != Style::kQuiet) watcher_ = std::thread([this] { watch(); });
}

ProgressPrinter::~ProgressPrinter() {
  if (watcher_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    ended_.notify_all();
    watcher_.join();
  }
  end_line();
}

double ProgressPrinter::silence() const {
  constexpr double kShare = 0.1, kLongest = 10;  // of the time since the start, s
  if (style_ == Style::kBar) return kSilence;
  return std::clamp(kShare * seconds_between(begun_, Clock::now()), kSilence, kLongest);
}

void ProgressPrinter::watch() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    const double left = silence() - seconds_between(drawn_, Clock::now());
    if (left <= 0)
      tell_alive();
    else
      ended_.wait_for(lock, std::chrono::duration<double>(left));
  }
}

void ProgressPrinter::tell_alive() {
  drawn_ = Clock::now();
  if (!stage_.empty()) {
    draw({stage_, fraction_, 0}, seconds_between(started_, drawn_));
    return;
  }
  const std::string doing = told_.empty() ? "reading the scene" : "working, after " + told_;
  const double seconds = seconds_between(begun_, drawn_);
  if (style_ == Style::kJson)
    line("note", fmt::format("{} ({:.0f} s since the start)", doing, seconds));
  else
    std::fprintf(stderr, "%s%s, %.0f s since the start%s", open_line_ ? "\r\x1b[K" : "", doing.c_str(), seconds,
                 style_ == Style::kBar ? "" : "\n");
  open_line_ = style_ == Style::kBar;
}

void ProgressPrinter::operator()(const Progress& progress) {
  if (style_ == Style::kQuiet) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  fraction_ = progress.fraction;
  if (progress.left_s >= 0) left_s_ = progress.left_s, foretold_s_ = seconds_between(begun_, now);
  const bool fresh = stage_ != progress.stage;
  if (fresh) {
    end_line();
    stage_ = progress.stage;
    started_ = now;
  }
  const bool ended = progress.fraction >= 1;
  const double interval = style_ == Style::kBar ? 0.1 : silence();
  if (!ended && (!fresh || style_ != Style::kBar) && seconds_between(drawn_, now) < interval) return;
  drawn_ = now;
  const double seconds = seconds_between(started_, now);
  // Refinement runs a stage again and again: short rounds have no line of their own.
  const bool again = ended && style_ == Style::kPlain && stage_ == told_ && seconds < kShort;
  if (!again) draw(progress, seconds);
  if (ended) {
    told_ = stage_;
    end_line();
    stage_.clear();
  }
}

void ProgressPrinter::draw(const Progress& progress, double seconds) {
  const double rays_per_s = seconds > 0 ? static_cast<double>(progress.rays) / seconds : 0;
  const double whole = seconds_between(begun_, Clock::now());
  double left = -1;
  if (left_s_ >= 0) left = countdown_.tell(std::max(left_s_ - (whole - foretold_s_), 0.0), whole);
  if (style_ == Style::kJson) {
    const Json json = {{"event", "progress"},
                       {"tool", kTool},
                       {"stage", std::string(progress.stage)},
                       {"fraction", progress.fraction},
                       {"seconds", seconds},
                       {"rays", progress.rays},
                       {"rays_per_s", rays_per_s},
                       {"seconds_since_start", whole},
                       {"seconds_left", left >= 0 ? Json(left) : nullptr}};
    std::fprintf(stderr, "%s\n", json.dump().c_str());
    return;
  }
  std::string text = fmt::format("{:<10} {:3.0f} %", progress.stage, 100 * progress.fraction);
  if (progress.rays > 0) text += fmt::format("  {:5.2f} Mray/s", rays_per_s * 1e-6);
  text += progress.fraction < 1 ? fmt::format("  {} so far", duration(seconds)) : fmt::format("  {:.1f} s", seconds);
  if (left >= 0) text += fmt::format(", {} left of all", duration(left));
  if (style_ == Style::kPlain) {
    std::fprintf(stderr, "%s\n", text.c_str());
    return;
  }
  constexpr int kWidth = 24;
  const auto filled = static_cast<std::size_t>(progress.fraction * kWidth);
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  std::fprintf(stderr, "\r\x1b[K[%s] %s", bar.c_str(), text.c_str());
  open_line_ = true;
}

void ProgressPrinter::line(const char* event, const std::string& message, std::string_view id) {
  if (style_ == Style::kJson) {
    Json json = {{"event", event}, {"tool", kTool}, {"message", message}};
    if (!id.empty()) json["id"] = id;
    std::fprintf(stderr, "%s\n", json.dump().c_str());
    return;
  }
  if (open_line_) std::fprintf(stderr, "\r\x1b[K");
  open_line_ = false;
  std::fprintf(stderr, "%s\n", (id.empty() ? message : fmt::format("warning: {} [{}]", message, id)).c_str());
}

void ProgressPrinter::warning(const Warning& warning) {
  const std::lock_guard lock(mutex_);
  if (warned_.insert(warning.text).second) line("warning", warning.text, warning.code.name());
}

void ProgressPrinter::note(const std::string& message) {
  const std::lock_guard lock(mutex_);
  if (style_ != Style::kQuiet) line("note", message);
}

void ProgressPrinter::finish() {
  const std::lock_guard lock(mutex_);
  end_line();
}

void ProgressPrinter::end_line() {
  if (open_line_) std::fprintf(stderr, "\n");
  open_line_ = false;
}

}  // namespace oriel
