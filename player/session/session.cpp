#include "player/session/session.h"

#include <cmath>
#include <utility>

#include "formats/camera/path.h"
#include "player/paths/recorder.h"

namespace oriel {
namespace {

constexpr float kTurnPerWidth = 2 * kPi;  // of a mover, across the window
constexpr float kOrbit_m = 3;             // where nothing is seen
constexpr float kAdaptation_s = 0.3f;
constexpr float kExposureStep = 1 / 3.0f;

void look_from(const Camera& camera, Session& session) {
  session.camera = camera;
  session.path_time_s = -1;
  session.walking = false;
  session.walker = {};
  session.move.orbit.reset();
}

// Around what is in the middle of the view; else flies on from there.
void orbit_or_end(const Pack& pack, Session& session) {
  session.walker = {};
  session.walking = false;
  if (session.move.orbit) {
    session.move.orbit.reset();
    session.move.fly = true;
    return;
  }
  const Camera& camera = session.camera;
  const auto hit = first_triangle(pack.mesh, camera.eye, camera.forward);
  session.move.orbit = camera.eye + (hit ? hit->distance : kOrbit_m) * camera.forward;
}

bool moves(const MoveInput& input) {
  return input.forward || input.back || input.left || input.right || input.up || input.down || input.stick != Vec3(0);
}

void show_camera(std::size_t camera, const Pack& pack, Session& session) {
  if (camera >= pack.cameras.size()) return;
  look_from(pack.cameras[camera], session);
  session.shown_camera = camera;
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
    if (moves(input)) session.walker = {};
    if (session.walker.on()) session.camera.eye = walk_on(session.walker, from, dt_s);
    if (session.move.fly || session.move.orbit) return;
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
      session.move.fly = !session.move.fly && !session.move.orbit;
      session.walking = !session.move.fly;
      session.move.orbit.reset();
      session.walker = {};
      break;
    case Action::kOrbit:
      orbit_or_end(pack, session);
      break;
    case Action::kGo:
      session.go_to = Vec2(0.5f);
      break;
    case Action::kHome:
      look_from(session.home, session);
      break;
    case Action::kPlayPath:
      session.walker = {};
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
    case Action::kFlip:
      session.comparison.beside = session.comparison.beside == Beside::kFirst ? Beside::kSecond : Beside::kFirst;
      break;
    case Action::kSplit:
      session.comparison.beside = Beside::kSplit;
      break;
    case Action::kDifference:
      session.comparison.beside = Beside::kDifference;
      break;
    case Action::kCamera:
      show_camera(command.camera, pack, session);
      break;
    case Action::kNextCamera:
      if (!pack.cameras.empty()) show_camera((session.shown_camera + 1) % pack.cameras.size(), pack, session);
      break;
  }
}

void move_on(const MoveInput& input, const Floors& floors, float dt_s, Session& session) {
  move_camera_on(input, floors, dt_s, session);
  if (session.recording) record(session.camera, dt_s, *session.recording);
}

std::string go(const Vec2& place, const Pack& pack, const View& view, const Floors& floors, Session& session) {
  constexpr float kBefore_m = 0.4f;  // a wall or what stands in the way
  if (floors.empty()) return "the pack knows no floor to walk on";
  const PickRay ray = ray_through(view, place);
  const auto hit = first_triangle(pack.mesh, ray.from, ray.direction);
  if (!hit) return "there is nothing to walk to";
  const Vec3 at = ray.from + hit->distance * ray.direction;
  std::vector<Vec3> way = find_way(floors, session.camera.eye, at);
  if (way.empty()) {
    const Vec3 before = at - kBefore_m * normalize_or(Vec3(ray.direction.x, 0, ray.direction.z), Vec3(0));
    if (const auto floor = floors.floor_below(before)) way = find_way(floors, session.camera.eye, *floor);
  }
  if (way.empty()) return "nobody can walk there from here";
  session.walker = start_walking(session.camera.eye, std::move(way), session.move.speed_m_s);
  session.walking = true;
  session.move.fly = false;
  session.move.orbit.reset();
  session.path_time_s = -1;
  return {};
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
