#include "player/window/glfw_window.h"

#include <algorithm>

namespace oriel {
namespace {

tl::unexpected<Error> refused(const char* what) {
  const char* why = nullptr;
  glfwGetError(&why);
  return fail(ErrorCode::kRuntime, "window", "{} failed: {}. Without a display, use --offscreen -o FILE.png", what,
              why != nullptr ? why : "no reason given");
}

}  // namespace

Result<std::unique_ptr<GlfwWindow>> GlfwWindow::open(int width, int height) {
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

namespace {

// The monitor on which most of a window lies; null: none is known.
GLFWmonitor* monitor_of(int x, int y, int width, int height) {
  int count = 0, most = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  GLFWmonitor* best = glfwGetPrimaryMonitor();
  for (int i = 0; i < count; ++i) {
    int left = 0, top = 0;
    glfwGetMonitorPos(monitors[i], &left, &top);
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    if (mode == nullptr) continue;
    const int across = std::min(x + width, left + mode->width) - std::max(x, left);
    const int down = std::min(y + height, top + mode->height) - std::max(y, top);
    if (const int area = std::max(across, 0) * std::max(down, 0); area > most) most = area, best = monitors[i];
  }
  return best;
}

}  // namespace

void GlfwWindow::fill_screen(bool on) {
  const bool is_on = glfwGetWindowMonitor(window_) != nullptr;
  if (is_on == on) return;
  if (!on) {
    glfwSetWindowMonitor(window_, nullptr, x_, y_, width_, height_, GLFW_DONT_CARE);
    return;
  }
  glfwGetWindowPos(window_, &x_, &y_);
  glfwGetWindowSize(window_, &width_, &height_);
  GLFWmonitor* monitor = monitor_of(x_, y_, width_, height_);
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return;  // no monitor: it stays a window, without words
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

GlfwWindow::~GlfwWindow() {
  if (window_ != nullptr) glfwDestroyWindow(window_);
  if (initialized_) glfwTerminate();
}

}  // namespace oriel
