// Random materials: black, white, mirror, glass and all between.
#pragma once

#include "tests/fuzz/scenes/glb.h"
#include "tests/fuzz/scenes/random.h"

namespace oriel::fuzz {

int plain(Glb& glb, float albedo);    // without a specular lobe
int white(Glb& glb, Random& random);  // albedo 0.9 to 1, glossy or not
int metal(Glb& glb, Random& random);
int glass(Glb& glb, Random& random);
// radiance: cd/m²; textured: the first texture, which is added.
int lamp(Glb& glb, Random& random, float radiance, bool textured = false);
int any_material(Glb& glb, Random& random);

}  // namespace oriel::fuzz
