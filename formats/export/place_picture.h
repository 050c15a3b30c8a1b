// A place of the scene as somebody sees it who stands before it: its baked light, ray by ray.
#pragma once

#include "formats/export/picture.h"
#include "formats/pack/pack.h"
#include "formats/query/mesh_rays.h"

namespace oriel::report {

// kPlaceWidth x kPlaceHeight pixels: irradiance times base colour over pi, emission, nothing of reflections; a ring
// around the place. at: pack space; normal: of the surface there, unit.
inline constexpr std::uint32_t kPlaceWidth = 320, kPlaceHeight = 200;
Raster place_picture(const Pack& pack, const MeshRays& rays, const Vec3& at, const Vec3& normal);

}  // namespace oriel::report
