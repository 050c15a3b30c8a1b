// What the window shows, for scripts that drive it: they see that their input was taken, and when all stands still.
#pragma once

#include <string>

#include "player/session/session.h"
#include "player/window/window_input.h"

namespace oriel {

class FrameLog {
 public:
  // on: else it is silent.
  explicit FrameLog(bool on) : on_(on) {}

  struct Seen {
    IVec2 window{0};
    DVec3 origin{0};  // of pack space, world
    bool focused = false, grabbed = false;
    bool loading = false;  // images are on their way
    bool rests = false;    // the whole frame is there, and nothing was drawn again
  };
  // A frame is on the screen, with all that the input asked for. A line on stderr where it tells something else than
  // the last one.
  void shown(const Session& session, const InputFrame& input, const Seen& seen);
  // There is nothing to draw on.
  void hidden();

 private:
  void tell(std::string text);

  bool on_;
  int frames_ = 0;
  std::string state_, told_;  // of the last frame; the last line
};

}  // namespace oriel
