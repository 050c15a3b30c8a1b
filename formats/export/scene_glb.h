// A pack as a glTF file, for other programs.
#pragma once

#include <string>
#include <vector>

#include "formats/core/result.h"
#include "formats/pack/pack.h"

namespace oriel {

// kEmissive: the light as emissive textures, which any viewer shows as it is. kLightmap: the materials, and the
// lightmap coordinates with `extras` that name the EXR and KTX2 files.
enum class LightAs { kEmissive, kLightmap };

struct GlbOptions {
  LightAs light = LightAs::kEmissive;
  std::string lightmap_stem;             // of the lightmaps' names: see lightmap_file
  std::uint32_t longest_texture = 4096;  // pixels a side, where the page itself is not longer
};

struct GlbScene {
  Bytes file;
  float white_cd_m2 = 0;              // kEmissive: the radiance shown as white
  std::vector<std::string> left_out;  // what of the pack is not in it
};

// "stem_000.exr"; extension: "exr" or "ktx2".
std::string lightmap_file(const std::string& stem, std::size_t page, const char* extension);

// TEXCOORD_0 is that of base colour textures, TEXCOORD_1 that of lightmaps. Cameras are nodes. pack: one that
// validate() finds no error in. Errors: kInvalid for a scene of 4 GiB or more, kRuntime.
Result<GlbScene> scene_glb(const Pack& pack, const GlbOptions& options);

}  // namespace oriel
