#include "player/session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/query/path.h"
#include "player/navigation/lamps.h"
#include "player/navigation/recorder.h"

namespace oriel {
namespace {

constexpr float kTurnPerWidth = 2 * kPi;  // of a mover, across the window
constexpr float kOrbit_m = 3;             // where nothing is seen
// Eyes take longer to see in the dark than to bear the light.
constexpr float kAdaptation_s = 0.3f, kDarkAdaptation_s = 0.7f, kLongestAdaptation_s = 0.1f;
// Darker than moonlight and brighter than snow in the sun nothing is shown as middle grey.
constexpr float kLeastAutoEv100 = -4, kMostAutoEv100 = 17;
// Of an orbit: how far off the centre's surface sight begins, how near to a wall the eye comes, and the share of its
// radius below which it rather stands still; the first two of the distance.
constexpr float kOffCentre = 0.02f, kBeforeWall = 0.92f, kLeastOrbit = 0.25f;
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
  session.move.orbit_m = hit ? hit->distance : kOrbit_m;
  session.move.orbit = camera.eye + session.move.orbit_m * camera.forward;
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

void fly_or_walk(Session& session) {
  session.move.fly = !session.move.fly && !session.move.orbit;
  session.walking = !session.move.fly;
  session.move.orbit.reset();
  session.walker = {};
}

void play_or_stop(Session& session) {
  session.walker = {};
  session.path_time_s = session.path_time_s >= 0 || session.path.keys.empty() ? -1 : 0;
}

void flip(Session& session) {
  Beside& beside = session.comparison.beside;
  beside = beside == Beside::kFirst ? Beside::kSecond : Beside::kFirst;
}

// What an action changes of the session alone.
struct Deed {
  Action action;
  void (*perform)(Session& session);
};
constexpr Deed kDeeds[] = {
    {Action::kKeySheet, [](Session& s) { s.key_sheet = !s.key_sheet; }},
    {Action::kPresent, [](Session& s) { s.presenting = !s.presenting; }},
    {Action::kPanel, [](Session& s) { s.panel = !s.panel; }},
    {Action::kStage,
     [](Session& s) { s.frame.show = static_cast<Show>((static_cast<int>(s.frame.show) + 1) % kShows); }},
    {Action::kFly, fly_or_walk},
    {Action::kGo, [](Session& s) { s.go_to = Vec2(0.5f); }},
    {Action::kHome, [](Session& s) { look_from(s.home, s); }},
    {Action::kPlayPath, play_or_stop},
    {Action::kRecord, record_or_end},
    {Action::kBrighter, [](Session& s) { s.manual_ev100 = s.shown_ev100 - kExposureStep; }},
    {Action::kDarker, [](Session& s) { s.manual_ev100 = s.shown_ev100 + kExposureStep; }},
    {Action::kAutoExposure, [](Session& s) { s.manual_ev100.reset(); }},
    {Action::kMoversBack, [](Session& s) { s.moves = s.moves_at_start; }},
    {Action::kScreenshot, [](Session& s) { s.screenshot = true; }},
    {Action::kLightScreenshot, [](Session& s) { s.light_screenshot = true; }},
    {Action::kReload, [](Session& s) { s.reload = true; }},
    {Action::kFlip, flip},
    {Action::kSplit, [](Session& s) { s.comparison.beside = Beside::kSplit; }},
};

// Along the path while it plays, else by hand.
void move_camera_on(const MoveInput& input, const Floors& floors, float dt_s, Session& session) {
  if (session.path_time_s < 0) {
    const Vec3 from = session.camera.eye;
    const float size = floors.size();
    MoveOptions options;
    options.nearest_orbit_m *= size;
    session.camera = move_camera(session.camera, session.move, input, dt_s, options);
    if (moves(input)) session.walker = {};
    const bool glides = session.walker.on() && session.walker.glides;
    if (session.walker.on()) session.camera.eye = walk_on(session.walker, from, dt_s);
    if (glides || session.move.fly || session.move.orbit) return;
    if (session.camera.eye != from) session.walking = true;
    if (session.walking)
      session.camera.eye =
          floors.walk(from, session.camera.eye, dt_s, session.move.fall_m_s, StepOptions().scaled(size));
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
  for (const Deed& deed : kDeeds)
    if (deed.action == command.action) deed.perform(session);
  if (command.action == Action::kOrbit) orbit_or_end(pack, session);
  if (command.action == Action::kCamera) show_camera(command.camera, pack, session);
  if (command.action == Action::kNextCamera && !pack.cameras.empty())
    show_camera((session.shown_camera + 1) % pack.cameras.size(), pack, session);
}

void move_on(const MoveInput& input, const Floors& floors, float dt_s, Session& session) {
  move_camera_on(input, floors, dt_s, session);
  if (session.recording) record(session.camera, dt_s, *session.recording);
}

std::string go(const Vec2& place, const Pack& pack, const View& view, const Floors& floors, Session& session) {
  constexpr float kBefore_m = 0.4f;  // a wall or what stands in the way
  constexpr float kAhead_m = 5;      // where nothing is seen
  constexpr float kThere_m = 0.5f;   // as good as where the user pointed
  if (floors.empty()) return "the pack knows no floor to walk on; F flies";
  const PickRay ray = ray_through(view, place);
  const float size = floors.size();
  const auto hit = first_triangle(pack.mesh, ray.from, ray.direction);
  const Vec3 at = ray.from + (hit ? hit->distance : kAhead_m * size) * ray.direction;
  const WayOptions options{.reach_m = size, .step = StepOptions().scaled(size)};
  NearestWay found;
  found.way = find_way(floors, session.camera.eye, at, options);
  if (found.way.empty()) {
    const Vec3 ahead = normalize_or(Vec3(ray.direction.x, 0, ray.direction.z), Vec3(0));
    const Vec3 before = at - kBefore_m * size * ahead;
    const auto floor = floors.floor_below(before);
    if (floor) found.way = find_way(floors, session.camera.eye, *floor, options);
    if (found.way.empty()) {
      const auto nearest = find_nearest_way(floors, session.camera.eye, floor.value_or(before), options);
      if (!nearest) return "no floor here is large enough to stand on; F flies";
      found = *nearest;
      const Vec3 feet = found.way.back() - Vec3(0, floors.eye_height_m(), 0);
      found.short_m = glm::distance(feet, floor ? Vec3(at.x, floor->y, at.z) : at);
    }
  }
  session.walker = start_walking(session.camera.eye, std::move(found.way), session.move.speed_m_s);
  session.walker.glides = found.glides;
  session.walking = true;
  session.move.fly = false;
  session.move.orbit.reset();
  session.path_time_s = -1;
  if (found.glides) return "nobody can walk from here: flying to the nearest floor";
  if (found.short_m <= kThere_m * size) return {};
  return fmt::format("nobody can walk there: walking to the nearest place, {:.1f} m from it", found.short_m);
}

void stay_in_sight(const Camera& before, const Pack& pack, Session& session) {
  if (!session.move.orbit || session.camera.eye == before.eye) return;
  const Vec3 centre = *session.move.orbit;
  const float distance = glm::distance(session.camera.eye, centre);
  const Vec3 away = normalize_or(session.camera.eye - centre, Vec3(0, 1, 0));
  // Around a thing in the open nothing is passed, though the thing may hide its front.
  const Vec3 step = session.camera.eye - before.eye;
  const auto passed = first_triangle(pack.mesh, before.eye, normalize_or(step, away));
  if (!passed || passed->distance > glm::length(step)) return;
  // Off the surface that the centre lies on: the eye began on its front.
  const Vec3 from = centre + normalize_or(before.eye - centre, away) * kOffCentre * distance;
  const auto wall = first_triangle(pack.mesh, from, away);
  if (!wall || wall->distance * kBeforeWall >= distance) return;
  const float clear = wall->distance * kBeforeWall;
  // Behind the thing itself, or into a corner: it turns no further.
  if (clear < std::min(kLeastOrbit * session.move.orbit_m, distance)) {
    session.camera = before;
    return;
  }
  session.camera.eye = centre + away * clear;
}

void adapt_exposure(const std::optional<float>& metered_ev100, float dt_s, Session& session) {
  if (session.manual_ev100) {
    session.shown_ev100 = *session.manual_ev100;
    session.metered = false;
    return;
  }
  if (!metered_ev100) return;
  const float towards = std::clamp(*metered_ev100, kLeastAutoEv100, kMostAutoEv100) - session.shown_ev100;
  const float dt = std::min(dt_s, kLongestAdaptation_s);  // after a slow frame it still glides
  const float share = session.metered ? 1 - std::exp(-dt / (towards > 0 ? kAdaptation_s : kDarkAdaptation_s)) : 1.0f;
  session.shown_ev100 += towards * share;
  session.metered = true;
}

Dragged drag_movers(const DragInput& input, const Pack& pack, const View& view, float farthest_m, Session& session) {
  const PickRay ray = ray_through(view, input.pointer);
  if (input.clicked) {
    session.grip = input.lamps ? grip_lamp(pack, session.frame.lamps, ray) : grip_mover(pack, session.frame.poses, ray);
    return {!session.grip, {}};
  }
  if (!session.grip) return {};
  Grip& grip = *session.grip;
  const Vec3 stands =
      grip.lamp ? shape_of_lamp(pack, pack.light_groups[grip.mover]).centre : session.frame.poses[grip.mover].position;
  MoverMove& move =
      move_of(session.moves, grip.lamp ? pack.light_groups[grip.mover].name : pack.movers[grip.mover].name,
              DVec3(stands) + pack.mesh.origin);
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
