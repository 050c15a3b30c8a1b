#include "bake/cli/progress.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace oriel {
namespace {

std::string duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  return fmt::format("{:.0f} min {:02d} s", std::floor(seconds / 60), static_cast<int>(seconds) % 60);
}

}  // namespace

void ProgressPrinter::operator()(const Progress& progress) {
  if (style_ == Style::kQuiet) return;
  const auto now = Clock::now();
  const bool fresh = stage_ != progress.stage;
  if (fresh) {
    finish();
    stage_ = progress.stage;
    started_ = now;
  }
  const bool ended = progress.fraction >= 1;
  const auto interval = style_ == Style::kBar ? std::chrono::milliseconds(100) : std::chrono::milliseconds(2000);
  if (!fresh && !ended && now - drawn_ < interval) return;
  if (fresh && style_ != Style::kBar && !ended) {
    drawn_ = now;  // plain lines begin once there is something to tell
    return;
  }
  drawn_ = now;
  const double seconds = std::chrono::duration<double>(now - started_).count();
  // Refinement runs a stage again and again: short rounds have no line of their own.
  const bool again = ended && style_ == Style::kPlain && stage_ == told_ && seconds < kShort;
  if (!again) draw(progress, seconds);
  if (ended) {
    told_ = stage_;
    finish();
    stage_.clear();
  }
}

void ProgressPrinter::draw(const Progress& progress, double seconds) {
  const double rays_per_s = seconds > 0 ? static_cast<double>(progress.rays) / seconds : 0;
  const double left = progress.fraction > 0 ? seconds * (1 - progress.fraction) / progress.fraction : 0;
  if (style_ == Style::kJson) {
    const nlohmann::ordered_json json = {{"event", "progress"},           {"stage", std::string(progress.stage)},
                                         {"fraction", progress.fraction}, {"seconds", seconds},
                                         {"rays", progress.rays},         {"rays_per_s", rays_per_s},
                                         {"seconds_left", left}};
    std::fprintf(stderr, "%s\n", json.dump().c_str());
    return;
  }
  std::string text = fmt::format("{:<10} {:3.0f} %", progress.stage, 100 * progress.fraction);
  if (progress.rays > 0) text += fmt::format("  {:5.2f} Mray/s", rays_per_s * 1e-6);
  text += progress.fraction < 1 ? fmt::format("  {} left", duration(left)) : fmt::format("  {:.1f} s", seconds);
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

void ProgressPrinter::line(const char* event, const std::string& message) {
  if (style_ == Style::kJson) {
    const nlohmann::ordered_json json = {{"event", event}, {"message", message}};
    std::fprintf(stderr, "%s\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    return;
  }
  if (open_line_) std::fprintf(stderr, "\r\x1b[K");
  open_line_ = false;
  std::fprintf(stderr, "%s%s\n", std::string(event) == "warning" ? "warning: " : "", message.c_str());
}

void ProgressPrinter::warning(const std::string& message) {
  line("warning", message);
}

void ProgressPrinter::note(const std::string& message) {
  if (style_ != Style::kQuiet) line("note", message);
}

void ProgressPrinter::finish() {
  if (open_line_) std::fprintf(stderr, "\n");
  open_line_ = false;
}

}  // namespace oriel
