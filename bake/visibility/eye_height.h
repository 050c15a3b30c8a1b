// How tall the people are that a scene was modelled for.
#pragma once

#include <optional>
#include <span>

#include "bake/trace/accel.h"

namespace oriel {

struct EyeHeight {
  float eye_height_m = 1.6f;
  float room_height_m = 0;  // typical of the scene's rooms; 0: not looked at
  std::size_t cameras = 0;  // that tell it; 0: the rooms do
};

// The scene's cameras over the floors under them, where these tell of people of another size: their median is well over
// or under a person's eyes, and stands in the typical room as eyes do (at 0.35 to 0.8 of its height). Without a camera
// the rooms tell, where the file's unit had to be guessed (`unit_guessed`): they are as many times too large as their
// height is over 2.7 m. Nothing where people of usual size fit, or nobody can tell.
std::optional<EyeHeight> guess_eye_height(const Accel& accel, bool unit_guessed);

}  // namespace oriel
