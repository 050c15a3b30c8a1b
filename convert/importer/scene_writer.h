// A scene that assimp has read, as a glTF.
#pragma once

#include "convert/importer/textures.h"

namespace oriel {

// The bytes of a .glb: metres where the file says its unit, +Y up, names and hierarchy as they are. `up`: 'y' or 'z'
// whatever the file says; 0: as it says. Errors: kInvalid without a triangle, or beyond 4 GiB.
Result<Bytes> write_scene(const SourceScene& source, char up);

}  // namespace oriel
