#include "player/app/window_input.h"

#include <algorithm>
#include <utility>

namespace oriel {
namespace {

constexpr float kTurnPixelsPerSecond = 500;  // of arrow keys, as if the mouse had moved

WindowInput* self(GLFWwindow* window) {
  return static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

}  // namespace

WindowInput::WindowInput(GLFWwindow* window) : window_(window) {
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window,
                     [](GLFWwindow* w, int code, int, int action, int mods) { self(w)->key(code, action, mods); });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    if (action != GLFW_PRESS) return;
    if (button == GLFW_MOUSE_BUTTON_LEFT)
      self(w)->clicked_ = !self(w)->grabbed_;
    else
      self(w)->grab(true);
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

void WindowInput::key(int code, int action, int mods) {
  if (action == GLFW_RELEASE) return;
  if (code == GLFW_KEY_ESCAPE && action == GLFW_PRESS) {
    if (grabbed_) {
      grab(false);
    } else {
      quit_ = true;
    }
    return;
  }
  control_ = (mods & GLFW_MOD_CONTROL) != 0;
  if (code == GLFW_KEY_Q && control_) quit_ = true;
  // Exposure keys repeat while held; others count once.
  const bool repeats =
      code == GLFW_KEY_EQUAL || code == GLFW_KEY_MINUS || code == GLFW_KEY_KP_ADD || code == GLFW_KEY_KP_SUBTRACT;
  if (action == GLFW_PRESS || repeats) pressed_.push_back(code);
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
  out.pressed = std::exchange(pressed_, {});
  out.control = control_;
  double x = 0, y = 0;
  int width = 0, height = 0;
  glfwGetCursorPos(window_, &x, &y);
  glfwGetWindowSize(window_, &width, &height);
  out.pointer = Vec2(DVec2(x, y) / DVec2(std::max(width, 1), std::max(height, 1)));
  out.clicked = std::exchange(clicked_, false);
  out.holding = !grabbed_ && glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  out.turning = down(GLFW_KEY_R);
  out.quit = std::exchange(quit_, false) || glfwWindowShouldClose(window_);
  return out;
}

}  // namespace oriel
