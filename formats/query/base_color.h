// The colour of a surface where a ray meets it.
#pragma once

#include <span>

#include "formats/assets/material.h"
#include "formats/assets/mesh.h"

namespace oriel {

// Base colour times its texture's nearest texel (where texels are there) and the first corner's colour: linear, [0,1].
// corners: of the triangle, vertices of the mesh; uv: the shares of the second and third.
Vec3 base_color_at(const Mesh& mesh, const Material& material, std::span<const Texture> textures,
                   const std::uint32_t* corners, const Vec2& uv);

}  // namespace oriel
