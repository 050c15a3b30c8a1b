#include "player/window/window_input.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace oriel {
namespace {

constexpr double kDoubleClick_s = 0.35, kDoubleClick_px = 5;
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

bool InputFrame::clicked() const {
  return std::ranges::any_of(pointer, [](const PointerStep& step) { return step.clicked; });
}

void InputFrame::ignore_pointer() {
  for (PointerStep& step : pointer) step.clicked = false;
  move.wheel = 0;
  go_to.reset();
}

WindowInput::WindowInput(GLFWwindow* window) : window_(window) {
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window,
                     [](GLFWwindow* w, int code, int, int action, int mods) { self(w)->key(code, action, mods); });
  glfwSetMouseButtonCallback(window,
                             [](GLFWwindow* w, int button, int action, int) { self(w)->button(button, action); });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { self(w)->move(x, y); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) {
    self(w)->wheel_ += y;
    ++self(w)->inputs_;
  });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
    if (!focused) self(w)->grab(false);
  });
  locate();
}

void WindowInput::grab(bool on) {
  if (grabbed_ == on) return;
  grabbed_ = on;
  has_last_ = false;
  glfwSetInputMode(window_, GLFW_CURSOR, on ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  locate();
}

void WindowInput::locate() {
  if (!grabbed_) glfwGetCursorPos(window_, &last_x_, &last_y_);
}

void WindowInput::move(double x, double y) {
  has_moved_ = true;
  if (grabbed_ && has_last_) {
    moved_x_ += x - last_x_;
    moved_y_ += y - last_y_;
  }
  last_x_ = x;
  last_y_ = y;
  has_last_ = grabbed_;
}

// Of the last event: where the pointer is by now may be elsewhere.
Vec2 WindowInput::pointer() const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return Vec2(DVec2(last_x_, last_y_) / DVec2(std::max(width, 1), std::max(height, 1)));
}

void WindowInput::step(bool clicked, bool turning) {
  steps_.push_back({pointer(), clicked, left_ && !grabbed_, turning, down(GLFW_KEY_L)});
}

void WindowInput::count(bool down) {
  ++inputs_;
  held_ += down ? 1 : -1;
}

void WindowInput::button(int button, int action) {
  count(action == GLFW_PRESS);
  if (action == GLFW_PRESS) return press(button);
  if (button != GLFW_MOUSE_BUTTON_LEFT) return;
  step(false);  // still held up to here
  left_ = false;
  step(false);
}

void WindowInput::press(int button) {
  if (button == GLFW_MOUSE_BUTTON_RIGHT) return grab(true);
  if (button == GLFW_MOUSE_BUTTON_MIDDLE) go_to_ = grabbed_ ? Vec2(0.5f) : pointer();
  if (button == GLFW_MOUSE_BUTTON_LEFT) press_left();
}

void WindowInput::press_left() {
  left_ = true;
  const DVec2 place(last_x_, last_y_);
  // The time between two presses is at least that from when the first was seen to when the second had not come yet.
  // Two that are apart are two drags.
  if (pressed_s_ >= 0 && looked_s_ - pressed_s_ < kDoubleClick_s &&
      glm::distance(place, pressed_px_) <= kDoubleClick_px) {
    // The first of the two has grabbed the mouse, or would.
    for (PointerStep& step : steps_) step.clicked = false;
    go_to_ = pressed_at_;
    if (!grabbed_before_) grab(false);
    pressed_s_ = -1;
    return;
  }
  pressed_s_ = glfwGetTime();
  pressed_px_ = place;
  grabbed_before_ = grabbed_;
  pressed_at_ = grabbed_ ? Vec2(0.5f) : pointer();
  step(!grabbed_);
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
  if (code != GLFW_KEY_UNKNOWN && action != GLFW_REPEAT) count(action == GLFW_PRESS);
  if (code == GLFW_KEY_R && action != GLFW_REPEAT) step(false, action == GLFW_RELEASE);  // up to here it was not so
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
  looked_s_ = glfwGetTime();
  if (!std::exchange(has_moved_, false))
    locate();  // it may have left, and GLFW is silent of the place it has put it to
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
  step(false);
  out.pointer = std::exchange(steps_, {});
  out.inputs = inputs_;
  out.held = held_;
  out.go_to = std::exchange(go_to_, std::nullopt);
  out.escape = std::exchange(escape_, false);
  out.quit = std::exchange(quit_, false) || glfwWindowShouldClose(window_);
  return out;
}

}  // namespace oriel
