// Materials of other formats as glTF's: the rule stands in docs/scenes.md.
#pragma once

#include "convert/importer/textures.h"

namespace oriel {

// Lumens a watt of white light (Ward 1994, Radiance's WHTEFFICACY). It makes cd/m² of the radiance of Blender's files,
// and of other formats' 1, which is what a screen shows as white: screens have 100 to 300 cd/m².
constexpr float kLumensPerWatt = 179;

Json gltf_material(const SourceScene& source, const aiMaterial& material, Textures& textures, Glb& glb);

}  // namespace oriel
