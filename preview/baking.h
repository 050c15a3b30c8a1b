// From the preview to a bake: the copy with what the panel changed, the bake of it, and the player with its pack.
#pragma once

#include "formats/query/camera.h"
#include "preview/arguments.h"
#include "preview/frame/background_bake.h"
#include "preview/frame/scene_edits.h"

namespace oriel {

// Beside the scene, NAME-edited.glb; its path. Errors kIo, and those of edited_file().
Result<std::filesystem::path> save_copy(const std::filesystem::path& scene, const SceneEdits& edits);

// By the oriel-bake that lies beside this program, with the light and scene that the preview was given; what was
// edited is saved as a copy first. Errors also kRuntime.
Status begin_bake(const PreviewArguments& arguments, const SceneEdits& edits, BackgroundBake& bake);

// Becomes the oriel-play that lies beside this program; eye: world. Returns with kRuntime where it cannot.
Status show_pack(const std::filesystem::path& pack, const Camera& eye);

}  // namespace oriel
