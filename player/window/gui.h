// Dear ImGui over a GLFW window.
#pragma once

struct GLFWwindow;

namespace oriel {

class Gui {
 public:
  // For the window whose OpenGL context is current. Takes its callbacks over and passes on to those that it had.
  explicit Gui(GLFWwindow* window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  // Around what is drawn in a frame. pointer_free: the mouse is not grabbed for looking around.
  void begin(bool pointer_free);
  void end();  // into the bound framebuffer
  // Of the last frame: the pointer is on the panel, or holds something of it.
  bool has_pointer() const;

 private:
  GLFWwindow* window_;
};

}  // namespace oriel
