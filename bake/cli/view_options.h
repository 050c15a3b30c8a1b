// From where a frame is seen, and how large it is: of render and replay (render_command.cpp).
#pragma once

#include "bake/reference/reference.h"
#include "formats/cli/command.h"

namespace oriel {

Option camera_option(std::string& camera);
Option size_option(ReferenceOptions& frame);
// text: as the option takes it; empty: the scene's first view. Errors as parse_camera().
Result<Camera> choose_camera(const Scene& scene, const std::string& text);

}  // namespace oriel
