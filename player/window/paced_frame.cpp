#include "player/window/paced_frame.h"

#include <algorithm>

#include "player/passes/image_budget.h"

namespace oriel {
namespace {

constexpr std::uint32_t kShadeMaps = 48;  // of movers, drawn anew in a coarse frame
constexpr int kLeastSide = 16;            // pixels of a coarse frame

bool same_view(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.forward == b.forward && a.up == b.up && a.vertical_fov_rad == b.vertical_fov_rad &&
         a.half_height == b.half_height;
}

// What is the same of frames that look the same.
FrameOptions looks_of(const Session& session) {
  FrameOptions out = session.frame;
  out.timed = false;
  return out;
}

}  // namespace

FrameOptions coarse_options(FrameOptions options) {
  options.coarse = true;
  options.shade.maps_a_frame = kShadeMaps;
  options.samples = 1;
  options.maps_per_element = std::min(options.maps_per_element, 1);
  return options;
}

PacedFrame::PacedFrame(const gpu::Device& device) : pace_(is_software(device.renderer)) {}

Pace::Draw PacedFrame::choose(const Seen& seen) {
  begun_ = Clock::now();
  const Session& session = seen.session;
  FrameOptions asked = looks_of(session);
  const bool loaded = images_ != seen.images;
  const bool moved = !same_view(session.camera, camera_) || asked.poses != asked_.poses ||
                     asked.lamps != asked_.lamps || window_ != seen.window || (loaded && seen.loading);
  const bool altered = asked != asked_ || loaded;
  quality_ = seen.whole ? Quality::kFull : session.quality;
  const double now_s = std::chrono::duration<double>(begun_ - start_).count();
  if (moved) moved_s_ = now_s;
  choice_ = pace_.next(moved, altered, quality_, now_s);
  if (choice_ == Pace::Draw::kKeep) return choice_;
  camera_ = session.camera;
  asked_ = std::move(asked);
  window_ = seen.window;
  images_ = seen.images;
  const bool coarse = choice_ == Pace::Draw::kCoarse;
  options_ = coarse ? coarse_options(session.frame) : session.frame;
  size_ = coarse ? glm::min(glm::max(IVec2(glm::round(Vec2(window_) * pace_.scale())), IVec2(kLeastSide)), window_)
                 : window_;
  drawn_ = choice_;
  return choice_;
}

void PacedFrame::shown() {
  const Clock::time_point now = Clock::now();
  const float ms = std::chrono::duration<float, std::milli>(now - begun_).count();
  const double now_s = std::chrono::duration<double>(now - start_).count();
  record_.add(choice_, pace_.scale(), 1e-3 * double{ms}, now_s - moved_s_, now_s);
  pace_.took(choice_, ms);
  if (choice_ == Pace::Draw::kCoarse) coarse_ms_ = coarse_ms_ == 0 ? ms : coarse_ms_ + (ms - coarse_ms_) / 4;
  choice_ = Pace::Draw::kKeep;
}

std::string PacedFrame::text() const {
  if (quality_ == Quality::kFull || (quality_ == Quality::kAutomatic && !pace_.coarsens())) return "full quality";
  std::string line = fmt::format("{:.0f} % of the pixels' width{}", 100 * pace_.scale(),
                                 quality_ == Quality::kFast ? "" : " while moving");
  if (coarse_ms_ > 0) line += fmt::format(", {:.0f} frames/s", 1000 / coarse_ms_);
  return quality_ == Quality::kFast ? line : line + (is_whole() ? "; now full quality" : "; full once it stands still");
}

}  // namespace oriel
