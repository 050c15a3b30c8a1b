// What is drawn over the frame: the panel, the sheet of keys, a word where reflections were not planned for.
#pragma once

#include <deque>
#include <optional>

#include "player/images/loading_state.h"
#include "player/session/pick.h"
#include "player/session/session.h"

namespace oriel {

// How the last frames went.
struct FrameMeter {
  std::deque<float> ms;  // of the last frames, the newest last
  FrameStats stats;      // of the newest; with passes' times of the last one that was timed
  bool in_zone = true;
  bool gamepad = false;  // there is one
  std::string device;    // its name
  std::string message;   // for the user, while it is news
  std::string pace;      // how finely frames are drawn
  float hint = 0;        // how much of the first keys is shown: 1 all, 0 nothing
  LoadingState loading;
  std::string failure;  // the first image that could not be loaded; empty: none

  static constexpr std::size_t kKept = 120;
  void add(float frame_ms);
  float mean_ms() const;
};

// Between Gui::begin and Gui::end. Changes the session as the user does. picked: what lies under the pointer.
void draw_overlay(const Pack& pack, const FrameMeter& meter, const std::optional<PickedSurface>& picked,
                  Session& session);

// The same for a window with nothing but a reason and a button; true once that is pressed.
bool draw_refusal(const std::string& reason);

}  // namespace oriel
