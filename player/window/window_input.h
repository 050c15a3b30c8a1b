// Keys, mouse and gamepad of a GLFW window.
#pragma once

#include <epoxy/gl.h>  // before GLFW, which would include a GL header of its own

#include <GLFW/glfw3.h>

#include <vector>

#include "player/session/gamepad.h"

namespace oriel {

// The pointer at one moment, in the window, [0,1]² from the top left corner. A frame may take long, and a hand is fast:
// each change of a button is told with the place where it was.
struct PointerStep {
  Vec2 at{0};
  bool clicked = false, holding = false;  // the left button went down here; it is down, and the pointer free
  bool turning = false, lamps = false;    // R, L was down on the way here
};

// What happened since the last poll.
struct InputFrame {
  MoveInput move;
  std::vector<Command> commands;  // in order
  bool quit = false;
  bool escape = false;               // Esc, but where it released the mouse
  bool gamepad = false;              // there is one
  std::vector<PointerStep> pointer;  // in order; the last is where it is now
  int inputs = 0, held = 0;          // keys and buttons that went down or up and turns of the wheel, ever; down now
  std::optional<Vec2>
      go_to;  // a double click or the middle button: where, as the pointer; the middle while it is grabbed

  bool clicked() const;
  // Clicks and the wheel were for somebody else.
  void ignore_pointer();
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
  void button(int button, int action);
  void press(int button);
  void press_left();
  void move(double x, double y);
  void count(bool down);
  void step(bool clicked, bool turning);
  void step(bool clicked) { step(clicked, down(GLFW_KEY_R)); }
  void locate();  // the pointer, where no event tells it
  Vec2 pointer() const;
  void add_pad(float dt_s, InputFrame& to);
  bool down(int code) const { return glfwGetKey(window_, code) == GLFW_PRESS; }

  GLFWwindow* window_;
  std::vector<Command> commands_;
  std::vector<PointerStep> steps_;
  int inputs_ = 0, held_ = 0;
  bool quit_ = false, escape_ = false, presenting_ = false, grabbed_ = false,
       left_ = false;  // left_: that button is down
  double last_x_ = 0, last_y_ = 0, moved_x_ = 0, moved_y_ = 0, wheel_ = 0;
  bool has_last_ = false;
  bool has_moved_ = false;  // the pointer, as events tell, since the last poll
  double looked_s_ = 0;     // for events, the last time: what comes now happened since
  double pressed_s_ = -1;   // the left button, the last time; no later than that
  Vec2 pressed_at_{0};
  DVec2 pressed_px_{0};
  bool grabbed_before_ = false;  // that
  std::optional<Vec2> go_to_;
  PadState pad_;
};

}  // namespace oriel
