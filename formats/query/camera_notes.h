// A camera as texts, as pictures keep it beside their pixels.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "formats/assets/camera.h"
#include "formats/core/vec.h"

namespace oriel {

// "oriel.camera": its name; "oriel.eye" in world metres, "oriel.forward", "oriel.up": three numbers with commas
// between; "oriel.vertical_fov_deg", 0 of an orthographic camera, which has "oriel.half_height" in metres. origin:
// Mesh::origin.
std::map<std::string, std::string> camera_notes(const Camera& camera, const DVec3& origin);

// The camera that the notes tell, in the space of another origin; nothing where one of them is missing or means
// nothing.
std::optional<Camera> camera_of_notes(const std::map<std::string, std::string>& notes, const DVec3& origin);

}  // namespace oriel
