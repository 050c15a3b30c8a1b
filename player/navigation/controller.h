// Keys and mouse into motion. Knows no window: the player's app fills MoveInput each frame.
#pragma once

#include <optional>

#include "formats/query/camera.h"

namespace oriel {

struct MoveInput {
  bool forward = false, back = false, left = false, right = false;
  bool up = false, down = false;  // flying only
  bool fast = false;
  Vec3 stick{0};  // a gamepad's: right, up, ahead, each [-1,1]; adds to the keys, walks slower where it is less than 1
  float mouse_x_px = 0, mouse_y_px = 0;  // since the last frame, while looking around; right and down are positive
  float wheel = 0;                       // notches since the last frame; positive is faster
};

struct MoveOptions {
  float radians_per_pixel = 0.0025f;
  float fast_factor = 4;
  float wheel_factor = 1.2f;  // speed by notch
  float min_speed_m_s = 0.01f, max_speed_m_s = 500;
  float zoom_per_s = 1, orbit_rad_per_s = 1;  // in orbit: keys come e-fold nearer in a second, or go around
  float nearest_orbit_m = 0.15f;
  float max_pitch_rad = 1.5533f;  // 89°: so that the heading stays defined
  float max_step_s = 0.1f;        // a longer frame moves no farther than this
};

struct MoveState {
  bool fly = false;  // walking keeps the eye's height and moves in the horizontal plane
  float speed_m_s = 1.4f;
  float fall_m_s = 0;  // of one who walks off the ground
  // What the camera turns around, pack space: looking turns about it, ahead and the wheel come nearer.
  std::optional<Vec3> orbit;
  float orbit_m = 0;  // how far from it the eye wants to be; 0: as far as it is
};

// The camera after dt_s seconds, and the state with the wheel's speed. Times and inputs that are not finite, or
// negative times, count as 0. Turning gives the camera an upright up vector; without mouse motion it keeps the one it
// has.
Camera move_camera(const Camera& camera, MoveState& state, const MoveInput& input, float dt_s,
                   const MoveOptions& options = {});

}  // namespace oriel
