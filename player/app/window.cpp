#include "player/app/window.h"

#include <chrono>
#include <filesystem>

#include "formats/camera/camera_spec.h"
#include "formats/camera/path.h"
#include "player/app/frame_record.h"
#include "player/app/offscreen.h"
#include "player/app/stop.h"
#include "player/app/window_input.h"
#include "player/passes/frame.h"
#include "player/poses/drag.h"
#include "player/poses/poses.h"
#include "player/walk/zone.h"

namespace oriel {
namespace {
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// GLFW and its window, closed in the right order on every way out.
class GlfwWindow {
 public:
  static Result<std::unique_ptr<GlfwWindow>> open(int width, int height) {
    std::unique_ptr<GlfwWindow> out(new GlfwWindow);
    if (!glfwInit()) return refused("opening a display");
    out->initialized_ = true;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    out->window_ = glfwCreateWindow(width, height, "Oriel", nullptr, nullptr);
    if (out->window_ == nullptr) return refused("making a window with OpenGL 3.3 core");
    glfwMakeContextCurrent(out->window_);
    glfwSwapInterval(1);
    return out;
  }
  ~GlfwWindow() {
    if (window_ != nullptr) glfwDestroyWindow(window_);
    if (initialized_) glfwTerminate();
  }
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;
  GLFWwindow* get() const { return window_; }

 private:
  GlfwWindow() = default;
  static tl::unexpected<Error> refused(const char* what) {
    const char* why = nullptr;
    glfwGetError(&why);
    return fail(ErrorCode::kRuntime, "window", "{} failed: {}. Without a display, use --offscreen -o FILE.png", what,
                why != nullptr ? why : "no reason given");
  }
  bool initialized_ = false;
  GLFWwindow* window_ = nullptr;
};

// What the keys change.
struct Session {
  Camera camera;
  MoveState move;
  FrameOptions frame;
  std::optional<float> manual_ev100;
  float shown_ev100 = 0;
  bool metered = false;
  double path_time = -1;  // seconds into the path; negative: not playing
  int screenshot = 0;     // asked for, if not 0
  std::vector<MoverMove> moves, moves_at_start;
  std::optional<Grip> grip;  // of a mover that is dragged
};

std::string next_screenshot() {
  for (int i = 0;; ++i) {
    const std::string name = fmt::format("oriel-{:03}.png", i);
    if (!std::filesystem::exists(name)) return name;
  }
}

constexpr float kTurnPerWidth = 2 * kPi;  // of a mover, across the window
constexpr float kFarthest = 4;            // that one is dragged, in radii of the scene

// The left button takes what moves there, and it follows the pointer, on its level or, with R, about itself; elsewhere
// it grabs the mouse. view: of the last frame.
void drag(const InputFrame& input, const GpuScene& scene, const View& view, const Vec2& last_pointer,
          WindowInput& window, Session& session) {
  const Pack& pack = scene.pack();
  const PickRay ray = ray_through(view, input.pointer);
  if (input.clicked) {
    session.grip = grip_mover(pack, session.frame.poses, ray);
    if (!session.grip) window.grab(true);
  } else if (session.grip) {
    Grip& grip = *session.grip;
    const MoverPose& pose = session.frame.poses[grip.mover];
    MoverMove& move = move_of(session.moves, pack.movers[grip.mover], pose, pack.mesh.origin);
    const auto to = on_level(ray, grip.at.y, kFarthest * scene.bounds().radius());
    if (input.turning) {
      move.yaw_rad += static_cast<double>(kTurnPerWidth * (input.pointer.x - last_pointer.x));
    } else if (to) {
      move.position += DVec3(*to - grip.at);
    }
    if (to) grip.at = *to;
    if (input.holding) return;
    fmt::print(stderr, "oriel-play: --move \"{}\"\n", text_of(move));
    session.grip.reset();
  }
}

void handle_key(int key, const Pack& pack, Session& session) {
  const auto brighter = [&](float by) { session.manual_ev100 = session.shown_ev100 - by; };
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) {
    const std::size_t index = key == GLFW_KEY_0 ? 9 : static_cast<std::size_t>(key - GLFW_KEY_1);
    if (index < pack.cameras.size()) {
      session.camera = pack.cameras[index];
      session.path_time = -1;
    }
    return;
  }
  switch (key) {
    case GLFW_KEY_F:
      session.move.fly = !session.move.fly;
      break;
    case GLFW_KEY_P:
      session.path_time = session.path_time >= 0 || pack.paths.empty() ? -1 : 0;
      break;
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
      brighter(1 / 3.0f);
      break;
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
      brighter(-1 / 3.0f);
      break;
    case GLFW_KEY_X:
      session.manual_ev100.reset();
      break;
    case GLFW_KEY_M:
      session.frame.show = static_cast<Show>((static_cast<int>(session.frame.show) + 1) % 5);
      break;
    case GLFW_KEY_BACKSPACE:
      session.moves = session.moves_at_start;
      break;
    case GLFW_KEY_F12:
      session.screenshot = 1;
      break;
    default:
      break;
  }
}

void advance(const InputFrame& input, const Pack& pack, float dt_s, Session& session) {
  for (const int key : input.pressed) handle_key(key, pack, session);
  if (session.path_time >= 0) {
    session.path_time += dt_s;
    session.camera = camera_on_path(pack.paths[0], static_cast<float>(session.path_time));
    if (session.path_time > path_duration_s(pack.paths[0])) session.path_time = -1;
    return;
  }
  session.camera = move_camera(session.camera, session.move, input.move, dt_s);
}

// Follows the meter over a third of a second, as eyes do; at once on the first frame.
Status update_exposure(Renderer& renderer, float dt_s, Session& session) {
  if (session.manual_ev100) {
    session.shown_ev100 = *session.manual_ev100;
    session.metered = false;
    return {};
  }
  ORIEL_TRY(const std::optional<float> metered, renderer.meter());
  if (!metered) return {};
  const float share = session.metered ? 1 - std::exp(-dt_s / 0.3f) : 1.0f;
  session.shown_ev100 += (*metered - session.shown_ev100) * share;
  session.metered = true;
  return {};
}

class Loop {
 public:
  Loop(GlfwWindow& window, GpuScene& scene, Renderer& renderer, const PlayArguments& arguments, const Camera& camera)
      : window_(window), scene_(scene), renderer_(renderer), arguments_(arguments), input_(window.get()) {
    session_.camera = camera;
    session_.frame = arguments.frame;
    session_.moves = session_.moves_at_start = arguments.moves;
    session_.manual_ev100 = arguments.ev100;
    session_.move.speed_m_s = 1.4f;
  }

  Status run() {
    Clock::time_point last = Clock::now();
    int frames = 0;
    while (true) {
      const auto dt_s = static_cast<float>(seconds_since(last));
      last = Clock::now();
      const InputFrame input = input_.poll(dt_s);
      if (stop_requested()) return fail(ErrorCode::kStopped, "", "stopped by the user");
      if (input.quit) return {};
      advance(input, scene_.pack(), dt_s, session_);
      drag(input, scene_, view_, pointer_, input_, session_);
      pointer_ = input.pointer;
      int width = 0, height = 0;
      glfwGetFramebufferSize(window_.get(), &width, &height);
      if (width < 1 || height < 1) {  // minimised: nothing to draw, and nothing to hurry for
        glfwWaitEventsTimeout(0.1);
        continue;
      }
      ORIEL_TRY_VOID(draw(width, height, dt_s));
      if (++frames == arguments_.frames) return {};
    }
  }

 private:
  Status draw(int width, int height, float dt_s) {
    session_.frame.timed = title_is_due();  // only that one: timing waits for the device
    session_.frame.white = white_of_exposure(session_.shown_ev100);
    ORIEL_TRY(session_.frame.poses, poses_at(scene_.pack(), session_.moves, arguments_.time_s + seconds_since(start_)));
    view_ = make_view(session_.camera, width, height, bounds_with_movers(scene_, session_.frame.poses));
    ORIEL_TRY(const FrameStats stats, renderer_.render(scene_, view_, session_.frame));
    ORIEL_TRY_VOID(update_exposure(renderer_, dt_s, session_));
    if (session_.screenshot != 0) {
      session_.screenshot = 0;
      const std::string name = next_screenshot();
      const Status written =
          write_picture(renderer_, name, width, height, session_.shown_ev100, arguments_.curve, session_.camera.name);
      fmt::print(stderr, "oriel-play: {}\n", written ? name : written.error().text());
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    renderer_.display(session_.shown_ev100, arguments_.curve);
    glfwSwapBuffers(window_.get());
    show_rate(stats);
    return {};
  }

  bool title_is_due() const { return seconds_since(rate_start_) >= 0.5; }

  void show_rate(const FrameStats& stats) {
    ++rate_frames_;
    if (!session_.frame.timed) return;
    const bool in_zone = zone_.holds(session_.camera.eye);
    const std::string title =
        fmt::format("{} – {:.1f} fps, EV {:.1f}, {} – Oriel", arguments_.pack,
                    rate_frames_ / seconds_since(rate_start_), session_.shown_ev100, describe(stats, in_zone));
    glfwSetWindowTitle(window_.get(), title.c_str());
    rate_start_ = Clock::now();
    rate_frames_ = 0;
  }

  GlfwWindow& window_;
  GpuScene& scene_;
  Renderer& renderer_;
  const PlayArguments& arguments_;
  WindowInput input_;
  Session session_;
  const Zone zone_ = planned_zone(scene_.pack());
  View view_;        // of the last frame
  Vec2 pointer_{0};  // then
  const Clock::time_point start_ = Clock::now();
  Clock::time_point rate_start_ = Clock::now();
  int rate_frames_ = 0;
};

}  // namespace

Status play_in_window(Pack pack, const PlayArguments& arguments) {
  ORIEL_TRY(const auto window, GlfwWindow::open(arguments.width, arguments.height));
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  if (arguments.gl_debug) gpu::enable_debug_output(device);
  ORIEL_TRY(const auto scene, GpuScene::create(std::move(pack), device));
  const Pack& shown = scene->pack();
  const CameraChoices choices{shown.cameras, shown.paths, shown.mesh.origin};
  Camera camera = initial_camera(choices, scene->bounds().lower, scene->bounds().upper);
  if (!arguments.cameras.empty()) {
    ORIEL_TRY(camera, parse_camera(arguments.cameras[0], choices));
  }
  ORIEL_TRY(const auto renderer, Renderer::create(device));
  return Loop(*window, *scene, *renderer, arguments, camera).run();
}

}  // namespace oriel
