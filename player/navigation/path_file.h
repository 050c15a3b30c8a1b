// Walks as JSON files. Poses are in world metres, so that a walk fits every pack of its scene.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "formats/assets/camera.h"
#include "formats/core/result.h"

namespace oriel {

// {"oriel_path": 1, "name": …, "vertical_fov_deg": …, "keys": [{"t": s, "eye": [x, y, z], "forward": [x, y, z]}, …]}.
// origin: Mesh::origin of the pack in whose space the path is. The file holds the old text or the whole new one.
// Errors: kIo.
Status write_path(const std::filesystem::path& file, const CameraPath& path, const DVec3& origin);

// Times must not go back, directions have a length, the field of view is in (0°, 180°) and there is a key at least.
// Errors: kIo; kInvalid with the key that is wrong.
Result<CameraPath> read_path(const std::filesystem::path& file, const DVec3& origin);

// The path that a user means: a file where the text ends in ".json", else the one of that name. Errors also: kUsage.
Result<CameraPath> choose_path(const std::string& text, std::span<const CameraPath> paths, const DVec3& origin);

}  // namespace oriel
