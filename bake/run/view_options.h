// From where a frame is seen, and how large it is: of the commands that draw one.
#pragma once

#include "bake/scene/scene.h"
#include "formats/cli/command.h"

namespace oriel {

inline constexpr const char* kFrameGroup = "Frame";

Option camera_option(std::string& camera);
Option size_option(int& width, int& height);  // pixels
// text: as the option takes it; empty: the scene's first view. Errors as parse_camera().
Result<Camera> choose_camera(const Scene& scene, const std::string& text);

}  // namespace oriel
