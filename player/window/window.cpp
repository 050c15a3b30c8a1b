#include "player/window/window.h"

#include <thread>

#include "formats/core/file.h"
#include "formats/query/camera_spec.h"
#include "formats/query/path.h"
#include "player/images/loading_watch.h"
#include "player/navigation/lamps.h"
#include "player/navigation/path_file.h"
#include "player/navigation/poses.h"
#include "player/navigation/zone.h"
#include "player/output/frame_record.h"
#include "player/output/picture.h"
#include "player/scene/live_lamps.h"
#include "player/session/scene_name.h"
#include "player/window/announce.h"
#include "player/window/beside_view.h"
#include "player/window/frame_log.h"
#include "player/window/glfw_window.h"
#include "player/window/gui.h"
#include "player/window/paced_frame.h"
#include "player/window/panel.h"
#include "player/window/pointed.h"
#include "player/window/window_input.h"

namespace oriel {
namespace {
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr double kMessage_s = 6, kHint_s = 9, kFade_s = 2;
constexpr double kStandingFrame_s = 1 / 20.0;  // where nothing moves
constexpr float kDividerReach_px = 6;
constexpr double kAim_s = 0.2;  // what images matter is asked that often
// For images to come to the device: of each frame, and before the first one of a pack.
constexpr std::chrono::milliseconds kUpload{8}, kBeforeFirst{150};
// Frames do not come faster while images do: a rasteriser on the CPU would leave nothing to those that make them ready.
constexpr std::chrono::milliseconds kLoadingFrame{33};
constexpr float kFarthest = 4;  // that a mover is dragged, in radii of the scene

// What is shown, and from where.
struct Opened {
  std::unique_ptr<GpuScene> scene;
  std::unique_ptr<Other> other;  // beside it; may be null
  Camera camera;
  CameraPath path;
};

class Loop {
 public:
  Loop(GlfwWindow& window, const gpu::Device& device, Renderer& renderer, const PlayArguments& arguments, Opened opened)
      : window_(window),
        scene_(std::move(opened.scene)),
        renderer_(renderer),
        device_(device),
        arguments_(arguments),
        input_(window.get()),
        gui_(window.get()) {
    session_.camera = session_.home = opened.camera;
    session_.frame = arguments.frame;
    session_.frame.live.in_background = true;
    session_.lights = arguments.light_settings;
    session_.curve = arguments.curve;
    session_.moves = session_.moves_at_start = arguments.moves;
    session_.manual_ev100 = arguments.ev100;
    session_.path = std::move(opened.path);
    session_.comparison.divider = arguments.divider;
    session_.comparison.first = arguments.pack;
    session_.comparison.second = arguments.other;
    if (opened.other) beside_.emplace(std::move(opened.other));
    session_.quality = arguments.quality;
    session_.move.speed_m_s *= floors_.size();
    meter_.device = device.renderer;
    glfwSetWindowTitle(window.get(), (scene_name(scene_->pack(), arguments.pack) + " – Oriel").c_str());
  }

  const PaceRecord& pace() const { return paced_.record(); }

  Status run(const std::function<bool()>& stopped, LoadingWatch watch) {
    Clock::time_point last = Clock::now();
    int frames = 0;
    while (true) {
      const auto dt_s = static_cast<float>(seconds_since(last));
      last = Clock::now();
      InputFrame input = input_.poll(dt_s);
      if (stopped()) return fail(ErrorCode::kStopped, "", "stopped by the user");
      if (input.escape && !std::exchange(session_.presenting, false)) return {};
      if (input.quit) return {};
      act(input, dt_s);
      present(session_.presenting);
      int width = 0, height = 0;
      glfwGetFramebufferSize(window_.get(), &width, &height);
      if (width < 1 || height < 1 || is_hidden()) {  // nothing to draw, and nothing to hurry for
        log_.hidden();
        glfwWaitEventsTimeout(0.1);
        continue;
      }
      // A window over monitors that are larger than the device's largest frame shows that in its corner.
      ORIEL_TRY_VOID(draw(std::min(width, device_.texture_size), std::min(height, device_.texture_size), dt_s));
      log_.shown(session_, input, seen_of(width, height));
      watch.frame(Clock::now(), meter_.loading.busy);
      if (const auto news = watch.news()) fmt::print(stderr, "oriel-play: {}\n", *news);
      if (drawn_ != Pace::Draw::kKeep) meter_.add(static_cast<float>(1000 * seconds_since(last)));
      rest(last);
      if (is_loading()) std::this_thread::sleep_until(last + kLoadingFrame);
      if (++frames == arguments_.frames) return {};
    }
  }

 private:
  FrameLog::Seen seen_of(int width, int height) const {
    const bool rests = drawn_ == Pace::Draw::kKeep && paced_.is_whole();
    return {{width, height}, scene_->pack().mesh.origin, is(GLFW_FOCUSED), input_.grabbed(), is_loading(), rests};
  }
  bool is_loading() const { return meter_.loading.busy || meter_.loading.following; }
  bool is(int attribute) const { return glfwGetWindowAttrib(window_.get(), attribute) == GLFW_TRUE; }
  bool is_hidden() const { return is(GLFW_ICONIFIED) || !is(GLFW_VISIBLE); }

  void act(InputFrame& input, float dt_s) {
    if (gui_.has_pointer() && !input_.grabbed()) input.ignore_pointer();
    for (const Command& command : input.commands) {
      perform(command, scene_->pack(), session_);
      if (const std::string line = announce(command, scene_->pack(), session_); !line.empty()) say(line);
    }
    if (input.go_to) session_.go_to = input.go_to;
    if (const auto place = std::exchange(session_.go_to, std::nullopt))
      if (const std::string why = go(*place, scene_->pack(), view_, floors_, session_); !why.empty()) say(why);
    if (std::exchange(session_.reload, false)) reload();
    const Camera before = session_.camera;
    move_on(input.move, floors_, dt_s, session_);
    stay_in_sight(before, scene_->pack(), session_);
    if (const std::string line = std::exchange(session_.said, {}); !line.empty()) say(line);
    if (const auto walk = std::exchange(session_.recorded, std::nullopt)) keep(*walk);
    drag(input);
    meter_.gamepad = input.gamepad;
  }

  // The divider of two frames, else movers; a click beside both grabs the mouse.
  void drag(const InputFrame& input) {
    int width = 1;
    glfwGetWindowSize(window_.get(), &width, nullptr);
    const float reach = kDividerReach_px / static_cast<float>(std::max(width, 1));
    for (const PointerStep& step : input.pointer) {
      const Vec2 last = std::exchange(pointer_, step.at);
      if (drag_divider(step.at, step.clicked, step.holding, reach, session_.comparison)) continue;
      const Dragged dragged = drag_movers({step.at, last, step.clicked, step.holding, step.turning, step.lamps},
                                          scene_->pack(), view_, kFarthest * scene_->bounds().radius(), session_);
      if (!dragged.dropped.empty()) fmt::print(stderr, "oriel-play: --move \"{}\"\n", dragged.dropped);
      if (dragged.missed) return input_.grab(true);
    }
  }

  Status draw(int width, int height, float dt_s) {
    session_.frame.timed = numbers_are_due();  // only that one: timing waits for the device
    const double now_s = arguments_.time_s + seconds_since(start_);
    ORIEL_TRY(session_.frame.poses, poses_at(scene_->pack(), session_.moves, now_s));
    ORIEL_TRY(session_.frame.lamps, lamps_at(scene_->pack(), session_.moves, now_s));
    view_ = view_of(width, height);
    load_images();
    if (scene_->has_live_news() || renderer_.has_news()) paced_.redraw();
    const IVec2 window(width, height);
    drawn_ = paced_.choose({session_, window, scene_->images().state().used, meter_.loading.busy, beside_.has_value()});
    if (drawn_ != Pace::Draw::kKeep) {
      const View view = view_of(paced_.size().x, paced_.size().y);
      ORIEL_TRY(meter_.stats, renderer_.render(*scene_, view, paced_.options()));
      ORIEL_TRY(metered_, renderer_.meter());
      for (const LiveReport& report : scene_->take_live_reports()) say(text_of(report));
    }
    meter_.loading = scene_->images().state();  // with what the frame wanted
    adapt_exposure(metered_, dt_s, session_);
    if (beside_) ORIEL_TRY_VOID(beside_->draw(seen(width, height), session_));
    if (std::exchange(session_.screenshot, false)) keep_screenshot(next_name(".png"), width, height);
    if (std::exchange(session_.light_screenshot, false)) keep_screenshot(next_name(".exr"), width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (beside_) {
      beside_->display(renderer_, session_);
    } else {
      ORIEL_TRY_VOID(renderer_.display_in_window(session_.shown_ev100, session_.curve, window));
    }
    note();
    gui_.begin(!input_.grabbed());
    if (seconds_since(said_) > kMessage_s) meter_.message.clear();
    meter_.hint = static_cast<float>(std::clamp((kHint_s - seconds_since(start_)) / kFade_s, 0.0, 1.0));
    draw_overlay(scene_->pack(), meter_, pointed_.surface(), session_);
    gui_.end();
    glfwSwapBuffers(window_.get());
    paced_.shown();
    return {};
  }

  View view_of(int width, int height) const {
    const Bounds bounds = bounds_with_movers(*scene_, session_.frame.poses);
    return make_view(session_.camera, width, height, bounds, kNearest_m * floors_.size());
  }

  // What the frame shows comes first. Some of it before the first frame: most packs are there then.
  void load_images() {
    if (seconds_since(aimed_) >= kAim_s) {
      if (const Status aimed = scene_->load_images(view_); !aimed) tell_failure(aimed.error());
      aimed_ = Clock::now();
    }
    const bool first = std::exchange(first_, false);
    const auto errors = first ? scene_->advance_all(Clock::now() + kBeforeFirst) : scene_->advance(kUpload);
    for (const Error& error : errors) tell_failure(error);
  }

  // It stays on the frame: something of the pack is missing there.
  void tell_failure(const Error& error) {
    fmt::print(stderr, "oriel-play: {}\n", error.text());
    if (meter_.failure.empty()) meter_.failure = error.text();
  }

  void keep_screenshot(const std::string& name, int width, int height) {
    const Status written = write_screenshot(name, width, height);
    say(written ? name : written.error().text());
  }

  // Supersampled, it is drawn anew, and the frame again after it.
  Status write_screenshot(const std::string& name, int width, int height) {
    const int n = arguments_.supersample;
    if (n == 1 && !paced_.is_whole()) ORIEL_TRY_VOID(redraw(width, height));
    const PictureNotes notes{session_.camera, scene_->pack().mesh.origin, session_.camera.name, session_.shown_ev100,
                             session_.curve};
    const auto times = static_cast<std::uint32_t>(n);
    const FrameOptions shown = session_.frame;
    if (n > 1) session_.frame.samples = samples_of_picture(arguments_);
    if (is_linear_file(name)) session_.frame.halves = false;
    const bool anew = n > 1 || session_.frame != shown;
    Status status = anew ? redraw(n * width, n * height) : Status();
    if (status)
      status = beside_ ? beside_->write(renderer_, session_, name, notes, times)
                       : write_picture(renderer_, name, notes, times);
    session_.frame = shown;
    if (anew) ORIEL_TRY_VOID(redraw(width, height));
    return status;
  }

  Status redraw(int width, int height) {
    ORIEL_TRY_VOID(renderer_.render(*scene_, view_of(width, height), session_.frame));
    return beside_ ? beside_->draw(seen(width, height), session_) : Status();
  }

  Other::Seen seen(int width, int height) const {
    const double time_s = arguments_.time_s + seconds_since(start_);
    return {session_.camera, scene_->pack().mesh.origin, width, height, session_.frame, session_.moves, time_s};
  }

  void keep(const CameraPath& walk) {
    const std::string name = next_name(".json");
    const Status written = write_path(name, walk, scene_->pack().mesh.origin);
    say(written ? fmt::format("{}: a walk of {:.1f} s; P plays it", name, path_duration_s(walk))
                : written.error().text());
  }

  // The pack's file as it is now, seen from where the user is. Where it cannot be shown the old one stays.
  void reload() {
    Result<DeferredPack> pack = open_pack(arguments_.pack);
    auto scene = pack ? GpuScene::create(std::move(*pack), device_, {true, arguments_.gpu_memory})
                      : Result<std::unique_ptr<GpuScene>>(tl::unexpect, pack.error());
    if (!scene) return say("not loaded again: " + scene.error().text());
    auto poses = poses_at((*scene)->pack(), session_.moves, 0);
    if (!poses) return say("not loaded again: " + poses.error().text());
    const auto lamps = lamps_at((*scene)->pack(), session_.moves, 0);
    if (!lamps) return say("not loaded again: " + lamps.error().text());
    if (beside_) {
      auto other = Other::open(arguments_.other, device_, {false, arguments_.gpu_memory});
      if (!other) return say("not loaded again: " + other.error().text());
      beside_->replace(std::move(*other));
    }
    session_.frame.poses = std::move(*poses);
    const DVec3 moved = scene_->pack().mesh.origin - (*scene)->pack().mesh.origin;
    for (Camera* camera : {&session_.camera, &session_.home}) camera->eye = Vec3(DVec3(camera->eye) + moved);
    session_.recording.reset();  // these are in the old pack's space
    session_.walker = {};
    session_.move.orbit.reset();
    scene_ = std::move(*scene);
    meter_.failure.clear();
    aimed_ = {};
    first_ = true;
    take_path(scene_->pack(), session_);
    session_.grip.reset();
    pointed_.forget();
    floors_ = Floors(scene_->pack().walk_grids, arguments_.eye_height_m);
    paced_.redraw();
    zone_ = planned_zone(scene_->pack());
    say(arguments_.pack + ": loaded again");
  }

  // On the terminal, and for some seconds over the frame.
  void say(const std::string& text) {
    fmt::print(stderr, "oriel-play: {}\n", text);
    meter_.message = text;
    said_ = Clock::now();
  }

  bool numbers_are_due() const { return seconds_since(numbers_start_) >= 0.5; }

  // The panel's numbers, twice a second.
  void note() {
    meter_.in_zone = zone_.holds(session_.camera.eye);
    meter_.pace = paced_.text();
    if (!session_.frame.timed) return;
    if (session_.panel && !input_.grabbed()) pointed_.look(*scene_, view_, pointer_, session_.camera.eye);
    numbers_start_ = Clock::now();
  }

  // Where nothing was drawn there is nothing to hurry for: events wake it.
  void rest(Clock::time_point begun) const {
    const double left = kStandingFrame_s - seconds_since(begun);
    if (drawn_ == Pace::Draw::kKeep && left > 0) glfwWaitEventsTimeout(left);
  }

  void present(bool on) {
    input_.set_presenting(on);
    window_.fill_screen(on);
    if (on) session_.panel = session_.key_sheet = false;
  }

  bool first_ = true;  // frame of the scene
  Clock::time_point aimed_{};
  GlfwWindow& window_;
  std::unique_ptr<GpuScene> scene_;
  Renderer& renderer_;
  const gpu::Device& device_;
  const PlayArguments& arguments_;
  WindowInput input_;
  Gui gui_;  // after the input, to whose callbacks it passes on
  Session session_;
  FrameMeter meter_;
  Pointed pointed_;
  std::optional<BesideView> beside_;
  Floors floors_{scene_->pack().walk_grids, arguments_.eye_height_m};
  Zone zone_ = planned_zone(scene_->pack());
  View view_;        // of the last frame
  Vec2 pointer_{0};  // then
  const Clock::time_point start_ = Clock::now();
  Clock::time_point numbers_start_ = start_, said_ = start_;
  PacedFrame paced_{device_};
  FrameLog log_{arguments_.log_frames};
  Pace::Draw drawn_ = Pace::Draw::kKeep;
  std::optional<float> metered_;  // of the last frame that was drawn
};

}  // namespace

Status play_in_window(DeferredPack pack, const PlayArguments& arguments, const std::function<bool()>& stopped,
                      Clock::time_point started) {
  ORIEL_TRY(const auto window, GlfwWindow::open(arguments.width, arguments.height));
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  Opened opened;
  ORIEL_TRY(opened.scene, GpuScene::create(std::move(pack), device, {true, arguments.gpu_memory}));
  const Pack& known = opened.scene->pack();
  const CameraChoices choices{known.cameras, known.paths, known.mesh.origin};
  opened.camera = initial_camera(choices, opened.scene->bounds().lower, opened.scene->bounds().upper);
  if (!arguments.cameras.empty()) {
    ORIEL_TRY(opened.camera, parse_camera(arguments.cameras[0], choices));
  }
  if (!arguments.other.empty()) {
    ORIEL_TRY(opened.other, Other::open(arguments.other, device, {false, arguments.gpu_memory}));
    // A picture is seen from where it was taken.
    const auto taken = opened.other->camera(known.mesh.origin);
    if (taken && arguments.cameras.empty()) opened.camera = *taken;
  }
  if (!known.paths.empty()) opened.path = known.paths.front();
  if (!arguments.path.empty()) {
    ORIEL_TRY(opened.path, choose_path(arguments.path, known.paths, known.mesh.origin));
  }
  ORIEL_TRY(const auto renderer, Renderer::create(device));
  Loop loop(*window, device, *renderer, arguments, std::move(opened));
  const Status ended = loop.run(stopped, LoadingWatch(started));
  if (arguments.stats.empty()) return ended;
  const std::string text = loop.pace().json();
  ORIEL_TRY_VOID(write_text_atomically(arguments.stats, text));
  return ended;
}

}  // namespace oriel
