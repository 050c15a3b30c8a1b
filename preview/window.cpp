#include "preview/window.h"

#include "bake/run/view_options.h"
#include "player/window/glfw_window.h"
#include "player/window/gui.h"
#include "player/window/window_input.h"
#include "preview/baking.h"
#include "preview/edit_panel.h"
#include "preview/frame/blend_paths.h"
#include "preview/frame/live_scene.h"
#include "preview/overlay.h"

namespace oriel {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kSlow_s = 0.25;  // a pass that takes longer is drawn smaller while one moves
constexpr double kMessage_s = 4;
constexpr double kResting_s = 0.05;  // between looks at what threads do

double seconds_from(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// What draws.
struct PreviewDevice {
  gpu::Device device;
  PreviewRenderer renderer;
  DisplayPass display;
};

class PreviewWindow {
 public:
  PreviewWindow(GlfwWindow& window, PreviewDevice by, const PreviewArguments& arguments, Context& context)
      : window_(window),
        device_(by.device),
        renderer_(std::move(by.renderer)),
        display_(std::move(by.display)),
        arguments_(arguments),
        context_(context),
        options_(arguments.frame),
        input_(window.get()),
        gui_(window.get()),
        live_(arguments.scene, arguments.threads, arguments.seed, [] { glfwPostEmptyEvent(); }),
        paths_(arguments.threads),
        ev100_(arguments.ev100) {
    status_.most_passes = arguments.passes;
    status_.most_paths = arguments.paths.value_or(kPaths);
  }

  // Once a bake has ended: where the eye is, world.
  const std::optional<Camera>& hands_over() const { return hands_over_; }

  Status run(Clock::time_point started) {
    Clock::time_point last = Clock::now();
    for (int frames = 0; frames != arguments_.frames;) {
      const auto dt_s = static_cast<float>(seconds_from(std::exchange(last, Clock::now())));
      InputFrame input = input_.poll(dt_s);
      if (context_.stopped()) return fail(ErrorCode::kStopped, "", "stopped by the user");
      if (input.escape || input.quit) return {};
      ORIEL_TRY_VOID(take_news());
      if (gui_.has_pointer() && !input_.grabbed()) input.ignore_pointer();
      act(input, dt_s);
      int width = 0, height = 0;
      glfwGetFramebufferSize(window_.get(), &width, &height);
      if (width < 1 || height < 1) {
        glfwWaitEventsTimeout(0.1);
        continue;
      }
      ORIEL_TRY_VOID(draw({std::min(width, device_.texture_size), std::min(height, device_.texture_size)}));
      tell(started);
      if (scene_) ++frames;
      if (bake_.ended_well()) {
        hands_over_ = camera_;
        hands_over_->eye = Vec3(DVec3(camera_.eye) + scene_->scene().origin);
        return {};
      }
    }
    return {};
  }

 private:
  static constexpr std::uint32_t kPaths = 4096;

  // A scene's first frame was one of shared points, for it to come soon. --stats: how soon it was seen, after the
  // program's start and after the file was saved.
  void tell(Clock::time_point started) {
    if (!fresh_ || renderer_.passes() == 0) return;
    fresh_ = false;
    restart_ = true;
    if (!arguments_.stats) return;
    if (std::exchange(first_, false)) {
      fmt::print("{{\"first_lit_s\":{:.3f}}}\n", seconds_from(started));
    } else {
      std::error_code ec;
      const auto saved = std::filesystem::last_write_time(arguments_.scene.file, ec);
      const std::chrono::duration<double> since = std::filesystem::file_time_type::clock::now() - saved;
      if (!ec) fmt::print("{{\"seen_after_saving_s\":{:.3f}}}\n", since.count());
    }
    std::fflush(stdout);
  }

  // Eye and exposure stay. Where the file cannot be shown the scene stays too.
  Status take_news() {
    auto news = live_.news();
    if (!news) return {};
    for (const std::string& warning : live_.warnings()) fmt::print(stderr, "oriel-preview: {}\n", warning);
    if (!news->scene) {
      if (!scene_ && arguments_.frames > 0) return tl::unexpected<Error>(news->error);  // main tells of it
      status_.error = news->error.text();
      fmt::print(stderr, "oriel-preview: {}\n", status_.error);
      return {};
    }
    const bool again = scene_ != nullptr;
    paths_.stop();
    const auto fresh = std::const_pointer_cast<PreviewScene>(news->scene);  // nobody else looks at it
    const SceneEdits originals = edits_of(fresh->scene());
    const DVec3 shift = again ? scene_->scene().origin - fresh->scene().origin : DVec3(0);
    SceneEdits edits = edits_;
    follow_places(originals, Vec3(shift), edits);
    if (!edits.empty()) edit_scene(*fresh, edits);
    if (const Status taken = renderer_.take(fresh); !taken) {
      status_.error = taken.error().text();
      fmt::print(stderr, "oriel-preview: {}\n", status_.error);
      return {};
    }
    status_.error.clear();
    originals_ = originals, edits_ = std::move(edits);
    if (again) {
      for (Camera* camera : {&camera_, &home_}) camera->eye = Vec3(DVec3(camera->eye) + shift);
      say(edits_.empty() ? "read again" : "read again; what the panel changed stays");
    } else {
      ORIEL_TRY(camera_, choose_camera(news->scene->scene(), arguments_.camera));
      home_ = camera_;
    }
    scene_ = fresh;
    fresh_ = true;
    status_.loading = false;
    status_.triangles = scene_->scene().triangles.size();
    status_.lamps = scene_->lamps.count();
    restart_ = true;
    return {};
  }

  void act(const InputFrame& input, float dt_s) {
    for (const Command& command : input.commands) perform(command);
    if (input.clicked()) input_.grab(true);
    if (!scene_) return;
    const Camera before = camera_;
    camera_ = move_camera(camera_, move_, input.move, dt_s);
    moving_ = before.eye != camera_.eye || before.forward != camera_.forward;
    restart_ |= moving_;
  }

  void perform(const Command& command) {
    const float step = 1.0f / 3;
    const std::size_t cameras = scene_ ? scene_->scene().cameras.size() : 0;
    switch (command.action) {
      case Action::kPanel:
        status_.panel = !status_.panel;
        break;
      case Action::kFly:
        move_.fly = !move_.fly;
        say(move_.fly ? "flying" : "walking");
        break;
      case Action::kBrighter:
      case Action::kDarker:
        ev100_ = shown_ev100_ + (command.action == Action::kBrighter ? -step : step);
        say(fmt::format("EV {:.2f}", *ev100_));
        break;
      case Action::kAutoExposure:
        ev100_.reset();
        metered_ = false;
        break;
      case Action::kHome:
        camera_ = home_;
        restart_ = true;
        break;
      case Action::kCamera:
      case Action::kNextCamera:
        if (cameras == 0) return say("there are no cameras");
        shown_camera_ = command.action == Action::kCamera ? command.camera : shown_camera_ + 1;
        camera_ = scene_->scene().cameras[shown_camera_ % cameras];
        restart_ = true;
        break;
      default:
        break;
    }
  }

  void say(const std::string& text) {
    status_.message = text;
    said_ = Clock::now();
  }

  Status draw(const IVec2& window) {
    if (seconds_from(said_) > kMessage_s) status_.message.clear();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, window.x, window.y);
    if (!scene_) {
      glClearColor(0, 0, 0, 0);
      glClear(GL_COLOR_BUFFER_BIT);
    } else {
      ORIEL_TRY_VOID(draw_scene(window));
    }
    gui_.begin(!input_.grabbed());
    restart_ |= draw_preview_overlay(status_, options_);
    PanelWishes wishes;
    if (status_.panel && scene_) wishes = draw_edit_panel(scene_->scene(), bake_, edits_, selection_);
    gui_.end();
    ORIEL_TRY_VOID(fulfil(wishes));
    glfwSwapBuffers(window_.get());
    if (!worked_) glfwWaitEventsTimeout(kResting_s);
    return {};
  }

  Status fulfil(const PanelWishes& wishes) {
    if (wishes.undoes) edits_ = {};
    if (wishes.edited || wishes.undoes) {
      paths_.stop();  // who reads the scene
      edit_scene(*scene_, wishes.undoes ? originals_ : edits_);
      renderer_.take_edits();
      restart_ = true;
    }
    if (wishes.saves) {
      if (const auto copy = save_copy(arguments_.scene.file, edits_))
        say("saved " + copy->string());
      else
        say(copy.error().text());
    }
    if (wishes.stops) bake_.stop();
    if (wishes.bakes) {
      if (const Status begun = begin_bake(arguments_, edits_, bake_); !begun) say(begun.error().text());
    }
    return {};
  }

  // A pass, or what paths there are; whatever is there is shown.
  Status draw_scene(const IVec2& window) {
    const IVec2 size = hurries() && status_.pass_s * share(window) > kSlow_s ? glm::max(window / 2, IVec2(1)) : window;
    if (std::exchange(restart_, false) || size != size_) {
      paths_.stop();
      blended_.reset();
      status_.paths = 0;
      size_ = size;
      ORIEL_TRY_VOID(renderer_.look(camera_, size.x, size.y));
    }
    worked_ = false;
    paths_.hold(gives_way());
    if (renderer_.passes() < arguments_.passes) {
      ORIEL_TRY(worked_, draw_pass());
      if (worked_ && renderer_.passes() == arguments_.passes) begin_paths();
    } else if (auto mean = paths_.newer(status_.paths)) {
      status_.paths = mean->samples;
      status_.noise = mean->relative_noise;
      ORIEL_TRY(blended_, blend_paths(*mean, passes_mean_, context_));
      worked_ = true;
    }
    ORIEL_TRY(const FrameTarget* frame, renderer_.frame(blended_ ? &*blended_ : nullptr));
    ORIEL_TRY_VOID(expose(*frame));
    return display_.draw_in_window(*frame, shown_ev100_, arguments_.curve, window, false);
  }

  // The next frame is better soon than good.
  bool hurries() const { return moving_ || fresh_; }

  // A scene that is being read may have the processors, unless one moves or sees nothing yet.
  bool gives_way() const { return live_.reading() && !moving_ && !fresh_ && renderer_.passes() > 0; }

  // False where it was left for a scene that is being read.
  Result<bool> draw_pass() {
    if (gives_way()) return false;
    const Interruptible leaves(context_, [this] { return gives_way(); });
    PreviewOptions options = options_;
    options.shared |= hurries();
    const auto stats = renderer_.pass(options, context_);
    if (!stats && stats.error().code == ErrorCode::kStopped && !context_.stop) return false;
    if (!stats) return tl::unexpected<Error>(stats.error());
    status_.pass_s = stats->total_s;
    status_.passes = renderer_.passes();
    return true;
  }

  // Of the last pass, how much larger the window is than what it drew.
  double share(const IVec2& window) const {
    const double drawn = std::max(1.0, double{1} * size_.x * size_.y);
    return double{1} * window.x * window.y / drawn;
  }

  void begin_paths() {
    if (status_.most_paths == 0) return;
    passes_mean_ = renderer_.read_mean();
    ReferenceOptions frame{
        .width = size_.x, .height = size_.y, .samples = status_.most_paths, .antialias = options_.antialias};
    paths_.start({scene_, camera_, frame, arguments_.seed});
  }

  Status expose(const FrameTarget& frame) {
    if (ev100_) {
      shown_ev100_ = *ev100_;
      return {};
    }
    ORIEL_TRY(const std::optional<float> metered, display_.meter(frame));
    if (!metered) return {};
    shown_ev100_ = std::exchange(metered_, true) ? glm::mix(shown_ev100_, *metered, 0.2f) : *metered;
    return {};
  }

  GlfwWindow& window_;
  gpu::Device device_;
  PreviewRenderer renderer_;
  DisplayPass display_;
  const PreviewArguments& arguments_;
  Context& context_;
  PreviewOptions options_;
  WindowInput input_;
  Gui gui_;
  LiveScene live_;
  PathFrame paths_;
  std::shared_ptr<PreviewScene> scene_;
  SceneEdits edits_, originals_;
  EditSelection selection_;
  BackgroundBake bake_;
  std::optional<Camera> hands_over_;
  Camera camera_, home_;
  MoveState move_;
  PreviewStatus status_;
  std::optional<float> ev100_;  // nothing: automatic
  float shown_ev100_ = 0;
  bool metered_ = false, moving_ = false, restart_ = false, worked_ = false, first_ = true;
  bool fresh_ = false;  // a scene that was not seen yet
  IVec2 size_{0};
  std::size_t shown_camera_ = 0;
  FloatImage passes_mean_;
  std::optional<FloatImage> blended_;
  Clock::time_point said_;
};

}  // namespace

Status preview_in_window(const PreviewArguments& arguments, Context& context, Clock::time_point started) {
  std::optional<Camera> hands_over;
  {
    ORIEL_TRY(const auto window, GlfwWindow::open(arguments.width, arguments.height));
    glfwSetWindowTitle(window->get(), (arguments.scene.file.filename().string() + " – Oriel preview").c_str());
    ORIEL_TRY(const gpu::Device device, gpu::open_device());
    ORIEL_TRY(PreviewRenderer renderer, PreviewRenderer::create(device));
    ORIEL_TRY(DisplayPass display, DisplayPass::create(device.dialect));
    PreviewWindow preview(*window, {device, std::move(renderer), std::move(display)}, arguments, context);
    ORIEL_TRY_VOID(preview.run(started));
    hands_over = preview.hands_over();
  }
  return hands_over ? show_pack(arguments.pack, *hands_over) : Status{};
}

}  // namespace oriel
