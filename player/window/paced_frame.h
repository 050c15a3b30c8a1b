// Which frames of the window are drawn, and how finely: nothing is drawn again that has not changed.
#pragma once

#include <chrono>
#include <string>

#include "player/gpu/device.h"
#include "player/session/pace_record.h"
#include "player/session/session.h"

namespace oriel {

// What a frame is drawn with while something moves.
FrameOptions coarse_options(FrameOptions options);

class PacedFrame {
 public:
  explicit PacedFrame(const gpu::Device& device);

  struct Seen {
    const Session& session;
    IVec2 window{0};
    std::uint64_t images = 0;  // bytes of them that are there: what is loaded is shown
    bool loading = false;      // more of them come
    bool whole = false;        // no coarser frame will do: two are shown beside each other
  };
  // What becomes of the next frame.
  Pace::Draw choose(const Seen& seen);
  // What it is drawn with: by the last choice.
  IVec2 size() const { return size_; }
  const FrameOptions& options() const { return options_; }
  // It is on the screen, with all that it took since choose().
  void shown();
  // The last frame that was drawn is what the options ask for.
  bool is_whole() const { return drawn_ == Pace::Draw::kWhole; }
  void redraw() { images_ = ~std::uint64_t{0}; }  // another scene, say

  const PaceRecord& record() const { return record_; }
  // For the panel: how finely frames are drawn now, and when.
  std::string text() const;

 private:
  using Clock = std::chrono::steady_clock;
  Pace pace_;
  PaceRecord record_;
  Clock::time_point start_ = Clock::now(), begun_ = start_;
  Pace::Draw choice_ = Pace::Draw::kKeep, drawn_ = Pace::Draw::kKeep;
  Quality quality_ = Quality::kAutomatic;
  // Of the last frame that was drawn.
  Camera camera_;
  FrameOptions options_, asked_;
  IVec2 size_{0}, window_{0};
  std::uint64_t images_ = ~std::uint64_t{0};
  float coarse_ms_ = 0;
  double moved_s_ = 0;  // when something moved last, since start_
};

}  // namespace oriel
