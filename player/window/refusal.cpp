#include "player/window/glfw_window.h"
#include "player/window/gui.h"
#include "player/window/panel.h"
#include "player/window/window.h"

namespace oriel {
namespace {

constexpr IVec2 kRefusalSize{640, 200};

}  // namespace

void show_refusal(const std::string& reason, const std::function<bool()>& stopped) {
  const auto window = GlfwWindow::open(kRefusalSize.x, kRefusalSize.y);
  if (!window) return;
  GLFWwindow* shown = (*window)->get();
  glfwSetKeyCallback(shown, [](GLFWwindow* w, int, int, int action, int) {
    if (action == GLFW_PRESS) glfwSetWindowShouldClose(w, GLFW_TRUE);
  });
  Gui gui(shown);
  while (!stopped() && !glfwWindowShouldClose(shown)) {
    glClear(GL_COLOR_BUFFER_BIT);
    gui.begin(true);
    if (draw_refusal(reason)) glfwSetWindowShouldClose(shown, GLFW_TRUE);
    gui.end();
    glfwSwapBuffers(shown);
    glfwWaitEventsTimeout(0.1);
  }
}

}  // namespace oriel
