// A pack's geometry as Wavefront OBJ, for other programs to look at.
#pragma once

#include <string>

#include "formats/assets/mesh.h"

namespace oriel {

// Positions in pack space (metres, relative to the mesh's origin), normals, and the *lightmap* coordinates with v
// flipped to OBJ's convention, so that lightmap_000.exr fits as a texture; one group a part, and the page in the
// material's name.
std::string obj_text(const Mesh& mesh);

}  // namespace oriel
