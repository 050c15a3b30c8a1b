// What a bake's options add to the lights of the file.
#pragma once

#include "bake/import/buffers.h"
#include "bake/import/import.h"

namespace oriel {

// Fills sky, sky_image and profiles of `out.scene`, whose lights are placed already, and sets what belongs to them; the
// hashes of files read are appended to out.inputs. Texels of the sky that are no radiance (negative, not a number,
// infinite) are replaced, with a warning that counts them. Errors: kUsage for values out of range and for nodes that
// have no point or spot light, kIo and kInvalid for files.
Status apply_lighting(const ImportOptions& options, gltf::MemoryBudget& budget, ImportedScene& out, Context& context);

}  // namespace oriel
