#include "player/window/glfw_window.h"

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

GlfwWindow::~GlfwWindow() {
  if (window_ != nullptr) glfwDestroyWindow(window_);
  if (initialized_) glfwTerminate();
}

}  // namespace oriel
