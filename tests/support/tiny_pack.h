// A small valid pack with one of everything, for tests of whatever reads packs.
#pragma once

#include "formats/pack/pack.h"

namespace oriel::testing {

// A floor (a mirror, page 0) and a wall (diffuse, textured, page 0), 4 m wide, in a scene whose origin is far away.
// 2 materials, 1 texture, 1 lightmap page of 8 x 4 texels with every texel state, 1 reflector of 1 x 1 elements with 2
// radiance maps of 6 x 4 pixels, 2 kernels, 1 Fresnel map, 2 cameras, 1 path, 1 unknown optional section.
// validate() finds neither errors nor warnings in it. The same on every call; a few kilobytes as a file.
Pack tiny_pack();

// The same with what optional sections add: a directional lightmap, a normal texture of 2 x 2 texels on the wall's
// material, 2 incidences of kernel 1 with their cosine lobes, Fresnel factors, a split reflectance of 2 x 3 entries, a
// third radiance map, 2 emitters (both left out of the reflector's maps), 2 walk grids, a curved reflector with a
// surround map of 2 x 2 texels, visible sets of 2 groups and 3 eye cells, a mover of 2 triangles, a light field of 8
// probes with 2 bright lights, 2 light groups with their light.
Pack tiny_mapped_pack();

}  // namespace oriel::testing
