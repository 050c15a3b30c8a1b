#include "player/window/frame_log.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace oriel {
namespace {

// By itself: along the path, or to where the user has pointed.
bool moves_on(const Session& session) {
  return session.path_time_s >= 0 || session.walker.on();
}

std::string text_of(const Session& session, const InputFrame& input, const FrameLog::Seen& seen) {
  const DVec3 eye = DVec3(session.camera.eye) + seen.origin;
  const Vec3 forward = session.camera.forward;
  const Vec2 pointer = input.pointer.back().at * Vec2(seen.window);
  std::string out = fmt::format(
      "size={}x{} inputs={} held={} pointer={:.0f},{:.0f} eye={:.3f},{:.3f},{:.3f} forward={:.3f},{:.3f},{:.3f} "
      "ev={:.2f}",
      seen.window.x, seen.window.y, input.inputs, input.held, pointer.x, pointer.y, eye.x, eye.y, eye.z, forward.x,
      forward.y, forward.z, session.shown_ev100);
  if (seen.loading) out += " loading";
  if (seen.focused) out += " focused";
  if (seen.grabbed) out += " grabbed";
  if (moves_on(session)) out += " moving";
  return out;
}

}  // namespace

void FrameLog::shown(const Session& session, const InputFrame& input, const Seen& seen) {
  ++frames_;
  if (!on_) return;
  std::string state = text_of(session, input, seen);
  const bool still = seen.rests && !seen.loading && !moves_on(session) && state == state_;
  tell(still ? state + " still" : state);
  state_ = std::move(state);
}

void FrameLog::hidden() {
  if (on_) tell("hidden");
}

void FrameLog::tell(std::string text) {
  if (text == told_) return;
  told_ = std::move(text);
  fmt::print(stderr, "oriel-play: frame {} {}\n", frames_, told_);
}

}  // namespace oriel
