#include "player/window/window_input.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace oriel {
namespace {

constexpr double kDoubleClick_s = 0.35;
constexpr float kTurnPixelsPerSecond = 500;  // of arrow keys, as if the mouse had moved

WindowInput* self(GLFWwindow* window) {
  return static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

// What a key of the table is called, for those that letters and signs do not name by themselves.
int code_of(std::string_view name) {
  if (name == "Backspace") return GLFW_KEY_BACKSPACE;
  if (name == "Home") return GLFW_KEY_HOME;
  if (name == "Tab") return GLFW_KEY_TAB;
  if (name == "F1") return GLFW_KEY_F1;
  if (name == "F5") return GLFW_KEY_F5;
  if (name == "F9") return GLFW_KEY_F9;
  if (name == "F11") return GLFW_KEY_F11;
  if (name == "F12") return GLFW_KEY_F12;
  if (name == "+") return GLFW_KEY_EQUAL;
  return name.size() == 1 ? name[0] : GLFW_KEY_UNKNOWN;
}

// On any keyboard: of the number pad too.
int plain(int code) {
  if (code == GLFW_KEY_KP_ADD) return GLFW_KEY_EQUAL;
  if (code == GLFW_KEY_KP_SUBTRACT) return GLFW_KEY_MINUS;
  return code;
}

// shifted: Shift is down, which changes those keys alone that have a line of their own for it.
Command command_of(int code, bool shifted) {
  constexpr std::string_view kShift = "Shift-";
  if (shifted)
    for (const Binding& b : key_bindings())
      if (const std::string_view keys = b.keys; keys.starts_with(kShift) && code_of(keys.substr(kShift.size())) == code)
        return {b.action, 0};
  if (code >= GLFW_KEY_1 && code <= GLFW_KEY_9) return {Action::kCamera, static_cast<std::size_t>(code - GLFW_KEY_1)};
  if (code == GLFW_KEY_0) return {Action::kCamera, 9};
  for (const Binding& b : key_bindings())
    if (b.action != Action::kHeld && code_of(b.keys) == code) return {b.action, 0};
  return {};
}

}  // namespace

WindowInput::WindowInput(GLFWwindow* window) : window_(window) {
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window,
                     [](GLFWwindow* w, int code, int, int action, int mods) { self(w)->key(code, action, mods); });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    if (action == GLFW_PRESS) self(w)->press(button);
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    WindowInput& input = *self(w);
    if (input.grabbed_ && input.has_last_) {
      input.moved_x_ += x - input.last_x_;
      input.moved_y_ += y - input.last_y_;
    }
    input.last_x_ = x;
    input.last_y_ = y;
    input.has_last_ = input.grabbed_;
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { self(w)->wheel_ += y; });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
    if (!focused) self(w)->grab(false);
  });
}

void WindowInput::grab(bool on) {
  if (grabbed_ == on) return;
  grabbed_ = on;
  has_last_ = false;
  glfwSetInputMode(window_, GLFW_CURSOR, on ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

Vec2 WindowInput::pointer() const {
  double x = 0, y = 0;
  int width = 0, height = 0;
  glfwGetCursorPos(window_, &x, &y);
  glfwGetWindowSize(window_, &width, &height);
  return Vec2(DVec2(x, y) / DVec2(std::max(width, 1), std::max(height, 1)));
}

void WindowInput::press(int button) {
  if (button == GLFW_MOUSE_BUTTON_RIGHT) return grab(true);
  if (button == GLFW_MOUSE_BUTTON_MIDDLE) go_to_ = grabbed_ ? Vec2(0.5f) : pointer();
  if (button != GLFW_MOUSE_BUTTON_LEFT) return;
  const double now = glfwGetTime();
  if (pressed_s_ >= 0 && now - pressed_s_ < kDoubleClick_s) {
    // The first of the two has grabbed the mouse.
    go_to_ = pressed_at_;
    if (!grabbed_before_) grab(false);
    pressed_s_ = -1;
    return;
  }
  pressed_s_ = now;
  grabbed_before_ = grabbed_;
  pressed_at_ = grabbed_ ? Vec2(0.5f) : pointer();
  clicked_ = !grabbed_;
}

// The first gamepad that there is.
void WindowInput::add_pad(float dt_s, InputFrame& to) {
  static_assert(static_cast<int>(PadButton::kLeft) == GLFW_GAMEPAD_BUTTON_DPAD_LEFT);
  static_assert(static_cast<int>(PadButton::kStart) == GLFW_GAMEPAD_BUTTON_START);
  static_assert(static_cast<int>(PadAxis::kRightTrigger) == GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER);
  PadState now;
  GLFWgamepadstate state;
  for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
    if (glfwJoystickIsGamepad(id) != GLFW_TRUE || glfwGetGamepadState(id, &state) != GLFW_TRUE) continue;
    to.gamepad = true;
    std::copy_n(state.axes, kPadAxes, now.axes.begin());
    std::transform(state.buttons, state.buttons + kPadButtons, now.down.begin(),
                   [](unsigned char button) { return button == GLFW_PRESS; });
    break;
  }
  if (glfwGetWindowAttrib(window_, GLFW_FOCUSED) != GLFW_TRUE) now = {};  // it plays with somebody else
  const PadMotion motion = pad_motion(now, pad_, dt_s);
  pad_ = now;
  to.move.stick = motion.move.stick;
  to.move.mouse_x_px += motion.move.mouse_x_px;
  to.move.mouse_y_px += motion.move.mouse_y_px;
  to.move.fast = to.move.fast || motion.move.fast;
  to.commands.insert(to.commands.end(), motion.commands.begin(), motion.commands.end());
}

void WindowInput::key(int code, int action, int mods) {
  if (action == GLFW_RELEASE) return;
  if (code == GLFW_KEY_ESCAPE && action == GLFW_PRESS) {
    escape_ = !grabbed_ || presenting_;
    grab(false);
    return;
  }
  if (code == GLFW_KEY_Q && (mods & GLFW_MOD_CONTROL) != 0) quit_ = true;
  const Command command = command_of(plain(code), (mods & GLFW_MOD_SHIFT) != 0);
  // Exposure keys repeat while held; others count once.
  const bool repeats = command.action == Action::kBrighter || command.action == Action::kDarker;
  if (action == GLFW_PRESS || repeats) commands_.push_back(command);
}

InputFrame WindowInput::poll(float dt_s) {
  glfwPollEvents();
  InputFrame out;
  const bool control = down(GLFW_KEY_LEFT_CONTROL) || down(GLFW_KEY_RIGHT_CONTROL);
  out.move.forward = !control && down(GLFW_KEY_W);
  out.move.back = !control && down(GLFW_KEY_S);
  out.move.left = !control && down(GLFW_KEY_A);
  out.move.right = !control && down(GLFW_KEY_D);
  out.move.up = !control && down(GLFW_KEY_E);
  out.move.down = !control && down(GLFW_KEY_Q);
  out.move.fast = down(GLFW_KEY_LEFT_SHIFT) || down(GLFW_KEY_RIGHT_SHIFT);
  const float turn = kTurnPixelsPerSecond * std::clamp(dt_s, 0.0f, 0.1f);
  const auto axis = [&](int positive, int negative) {
    return turn * (static_cast<float>(down(positive)) - static_cast<float>(down(negative)));
  };
  out.move.mouse_x_px = static_cast<float>(std::exchange(moved_x_, 0.0)) + axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT);
  out.move.mouse_y_px = static_cast<float>(std::exchange(moved_y_, 0.0)) + axis(GLFW_KEY_DOWN, GLFW_KEY_UP);
  out.move.wheel = static_cast<float>(std::exchange(wheel_, 0.0));
  out.commands = std::exchange(commands_, {});
  add_pad(dt_s, out);
  out.pointer = pointer();
  out.go_to = std::exchange(go_to_, std::nullopt);
  out.clicked = std::exchange(clicked_, false);
  out.holding = !grabbed_ && glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  out.turning = down(GLFW_KEY_R);
  out.lamps = down(GLFW_KEY_L);
  out.escape = std::exchange(escape_, false);
  out.quit = std::exchange(quit_, false) || glfwWindowShouldClose(window_);
  return out;
}

}  // namespace oriel
