// What the user has set and where the user is: all that keys and the panel change. No window, no drawing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/pack/pack.h"
#include "formats/query/mover_pose.h"
#include "player/navigation/controller.h"
#include "player/navigation/drag.h"
#include "player/navigation/floors.h"
#include "player/navigation/way.h"
#include "player/passes/display_pass.h"
#include "player/scene/frame_options.h"
#include "player/session/comparison.h"
#include "player/session/keys.h"
#include "player/session/light_settings.h"
#include "player/session/pace.h"

namespace oriel {

struct Session {
  Camera camera, home;
  MoveState move;
  bool walking = false;          // on the floors; not before the first step from a camera, whose height is its own
  Walker walker;                 // to where the user wants to go
  std::size_t shown_camera = 0;  // of the pack's, that the next one follows
  FrameOptions frame;
  Quality quality = Quality::kAutomatic;
  ToneCurve curve = ToneCurve::kAces;
  std::optional<float> manual_ev100;  // nothing: automatic
  float shown_ev100 = 0;
  bool metered = false;
  CameraPath path;          // that plays when asked for; none without keys
  double path_time_s = -1;  // into it; negative: not playing
  std::optional<CameraPath> recording;
  std::optional<CameraPath> recorded;  // a whole one, until somebody keeps it
  // Asked for, until somebody does it.
  bool screenshot = false, light_screenshot = false, reload = false;
  std::optional<Vec2> go_to;  // what is seen at that place of the window, [0,1]² from the top left corner
  bool panel = false, key_sheet = false;
  bool advanced = false;             // the panel shows what the method is made of
  bool presenting = false;           // the whole screen, and no words
  std::string said;                  // by the panel, for the window to say
  std::vector<LightSetting> lights;  // by group: what frame.lights follow from
  std::vector<MoverMove> moves, moves_at_start;
  std::optional<Grip> grip;  // of a mover that is dragged
  ComparisonView comparison;
};

struct Command {
  Action action = Action::kHeld;
  std::size_t camera = 0;  // of kCamera
};

// What a pack offers becomes the session's: its first path.
void take_path(const Pack& pack, Session& session);

void perform(const Command& command, const Pack& pack, Session& session);

// Along the path while it plays, else as the user flies, or walks on the floors.
// Records that, if asked to.
void move_on(const MoveInput& input, const Floors& floors, float dt_s, Session& session);

// Keeps an eye that orbits on this side of walls: before one that it would pass on its way from `before`, and where it
// was where there is hardly room for that.
void stay_in_sight(const Camera& before, const Pack& pack, Session& session);

// Starts to walk to what is seen there, in `view`: to the floor, or to the floor before it; where nobody can come
// there, to the nearest place that can be walked to; from where nobody stands it flies to the nearest floor. Says so
// where it is not quite what was asked for, and why where it is nothing; else empty.
std::string go(const Vec2& place, const Pack& pack, const View& view, const Floors& floors, Session& session);

// Towards the exposure that was metered (none: nothing was seen), within what eyes bear, over a third of a second, and
// over more where it gets dark; at once on the first frame. A manual one holds.
void adapt_exposure(const std::optional<float>& metered_ev100, float dt_s, Session& session);

// What the pointer does to movers: the left button takes what moves under it, and it follows, on its level or turning
// about itself. view: of the frame that the user sees.
struct DragInput {
  Vec2 pointer{0}, last_pointer{0};  // in the window, [0,1]² from the top left corner
  bool clicked = false, holding = false, turning = false;
  bool lamps = false;  // L is down: the button takes lamps instead
};
struct Dragged {
  bool missed = false;  // a click met no mover
  std::string dropped;  // one was let go: where it stands now, as --move takes it
};
Dragged drag_movers(const DragInput& input, const Pack& pack, const View& view, float farthest_m, Session& session);

}  // namespace oriel
