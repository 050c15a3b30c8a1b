#include "player/session/session.h"

#include <cmath>
#include <utility>

#include "formats/camera/path.h"
#include "player/paths/recorder.h"

namespace oriel {
namespace {

constexpr float kTurnPerWidth = 2 * kPi;  // of a mover, across the window
constexpr float kAdaptation_s = 0.3f;
constexpr float kExposureStep = 1 / 3.0f;

void look_from(const Camera& camera, Session& session) {
  session.camera = camera;
  session.path_time_s = -1;
  session.walking = false;
}

// The walk that ends is the one that plays next.
void record_or_end(Session& session) {
  if (!session.recording) {
    session.recording = start_recording(session.camera);
    return;
  }
  session.path = *session.recording;
  session.recorded = std::exchange(session.recording, std::nullopt);
}

// Along the path while it plays, else by hand.
void move_camera_on(const MoveInput& input, const Floors& floors, float dt_s, Session& session) {
  if (session.path_time_s < 0) {
    const Vec3 from = session.camera.eye;
    session.camera = move_camera(session.camera, session.move, input, dt_s);
    if (session.move.fly) return;
    if (session.camera.eye != from) session.walking = true;
    if (session.walking) session.camera.eye = floors.walk(from, session.camera.eye, dt_s, session.move.fall_m_s);
    return;
  }
  session.path_time_s += dt_s;
  session.camera = camera_on_path(session.path, static_cast<float>(session.path_time_s));
  if (session.path_time_s > path_duration_s(session.path)) session.path_time_s = -1;
}

}  // namespace

void take_path(const Pack& pack, Session& session) {
  session.path = pack.paths.empty() ? CameraPath() : pack.paths.front();
  session.path_time_s = -1;
}

void perform(const Command& command, const Pack& pack, Session& session) {
  switch (command.action) {
    case Action::kHeld:
      break;
    case Action::kKeySheet:
      session.key_sheet = !session.key_sheet;
      break;
    case Action::kPanel:
      session.panel = !session.panel;
      break;
    case Action::kStage:
      session.frame.show = static_cast<Show>((static_cast<int>(session.frame.show) + 1) % kShows);
      break;
    case Action::kFly:
      session.move.fly = !session.move.fly;
      session.walking = !session.move.fly;
      break;
    case Action::kHome:
      look_from(session.home, session);
      break;
    case Action::kPlayPath:
      session.path_time_s = session.path_time_s >= 0 || session.path.keys.empty() ? -1 : 0;
      break;
    case Action::kRecord:
      record_or_end(session);
      break;
    case Action::kBrighter:
      session.manual_ev100 = session.shown_ev100 - kExposureStep;
      break;
    case Action::kDarker:
      session.manual_ev100 = session.shown_ev100 + kExposureStep;
      break;
    case Action::kAutoExposure:
      session.manual_ev100.reset();
      break;
    case Action::kMoversBack:
      session.moves = session.moves_at_start;
      break;
    case Action::kScreenshot:
      session.screenshot = true;
      break;
    case Action::kLightScreenshot:
      session.light_screenshot = true;
      break;
    case Action::kReload:
      session.reload = true;
      break;
    case Action::kCamera:
      if (command.camera < pack.cameras.size()) look_from(pack.cameras[command.camera], session);
      break;
  }
}

void move_on(const MoveInput& input, const Floors& floors, float dt_s, Session& session) {
  move_camera_on(input, floors, dt_s, session);
  if (session.recording) record(session.camera, dt_s, *session.recording);
}

void adapt_exposure(const std::optional<float>& metered_ev100, float dt_s, Session& session) {
  if (session.manual_ev100) {
    session.shown_ev100 = *session.manual_ev100;
    session.metered = false;
    return;
  }
  if (!metered_ev100) return;
  const float share = session.metered ? 1 - std::exp(-dt_s / kAdaptation_s) : 1.0f;
  session.shown_ev100 += (*metered_ev100 - session.shown_ev100) * share;
  session.metered = true;
}

Dragged drag_movers(const DragInput& input, const Pack& pack, const View& view, float farthest_m, Session& session) {
  const PickRay ray = ray_through(view, input.pointer);
  if (input.clicked) {
    session.grip = grip_mover(pack, session.frame.poses, ray);
    return {!session.grip, {}};
  }
  if (!session.grip) return {};
  Grip& grip = *session.grip;
  const MoverPose& pose = session.frame.poses[grip.mover];
  MoverMove& move = move_of(session.moves, pack.movers[grip.mover], pose, pack.mesh.origin);
  const auto to = on_level(ray, grip.at.y, farthest_m);
  if (input.turning) {
    move.yaw_rad += static_cast<double>(kTurnPerWidth * (input.pointer.x - input.last_pointer.x));
  } else if (to) {
    move.position += DVec3(*to - grip.at);
  }
  if (to) grip.at = *to;
  if (input.holding) return {};
  session.grip.reset();
  return {false, text_of(move)};
}

}  // namespace oriel
