// GLFW and its window.
#pragma once

#include <epoxy/gl.h>  // before GLFW, which would include a GL header of its own

#include <GLFW/glfw3.h>

#include <memory>

#include "formats/core/result.h"

namespace oriel {

// Closed in the right order on every way out.
class GlfwWindow {
 public:
  // With OpenGL 3.3 core, which is then this thread's. Error kRuntime says why there is none.
  static Result<std::unique_ptr<GlfwWindow>> open(int width, int height);
  ~GlfwWindow();
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;
  GLFWwindow* get() const { return window_; }
  // All of the monitor that most of it is on, or as it was before.
  void fill_screen(bool on);

 private:
  GlfwWindow() = default;
  bool initialized_ = false;
  GLFWwindow* window_ = nullptr;
  int x_ = 0, y_ = 0, width_ = 0, height_ = 0;  // before it filled the screen
};

}  // namespace oriel
