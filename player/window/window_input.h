// Keys, mouse and gamepad of a GLFW window.
#pragma once

#include <epoxy/gl.h>  // before GLFW, which would include a GL header of its own

#include <GLFW/glfw3.h>

#include <vector>

#include "player/session/gamepad.h"

namespace oriel {

// What happened since the last poll.
struct InputFrame {
  MoveInput move;
  std::vector<Command> commands;  // in order
  bool quit = false;
  bool escape = false;   // Esc, but where it released the mouse
  bool gamepad = false;  // there is one
  // The pointer in the window, [0,1]² from the top left corner, while it is free; the left button: pressed since the
  // last poll, still down.
  Vec2 pointer{0};
  bool clicked = false, holding = false;
  bool turning = false;  // R is down
  bool lamps = false;    // L is
  std::optional<Vec2>
      go_to;  // a double click or the middle button: where, as the pointer; the middle while it is grabbed
};

class WindowInput {
 public:
  // Takes over the window's callbacks and user pointer; lives at one address as long as the window.
  explicit WindowInput(GLFWwindow* window);
  WindowInput(const WindowInput&) = delete;
  WindowInput& operator=(const WindowInput&) = delete;

  // Handles events and returns them. dt_s: of the last frame, for keys that turn. Esc releases the mouse.
  InputFrame poll(float dt_s);
  // Looking around with the mouse; another button than the left one grabs it too.
  void grab(bool on);
  bool grabbed() const { return grabbed_; }
  // Esc ends a presentation even where it releases the mouse.
  void set_presenting(bool on) { presenting_ = on; }

 private:
  void key(int code, int action, int mods);
  void press(int button);
  Vec2 pointer() const;
  void add_pad(float dt_s, InputFrame& to);
  bool down(int code) const { return glfwGetKey(window_, code) == GLFW_PRESS; }

  GLFWwindow* window_;
  std::vector<Command> commands_;
  bool quit_ = false, escape_ = false, presenting_ = false, grabbed_ = false, clicked_ = false;
  double last_x_ = 0, last_y_ = 0, moved_x_ = 0, moved_y_ = 0, wheel_ = 0;
  bool has_last_ = false;
  double pressed_s_ = -1;  // the left button, the last time
  Vec2 pressed_at_{0};
  bool grabbed_before_ = false;  // that
  std::optional<Vec2> go_to_;
  PadState pad_;
};

}  // namespace oriel
