// Least-squares conformal maps.
#pragma once

#include <vector>

#include "bake/atlas/patch.h"
#include "bake/atlas/stretch.h"

namespace oriel {

// Lays a connected patch flat with its angles kept as well as possible (Lévy, Petitjean, Ray and Maillot 2002, "Least
// Squares Conformal Maps", §3): an isometry, to rounding, where the patch can be unrolled. Two vertices far apart are
// pinned at their distance. The result may have turned-over triangles and overlap itself. corners and the result are by
// triangle of the patch. Empty where the system cannot be solved. One thread; the same bits in every run. Memory and
// time grow a little faster than the number of triangles.
std::vector<Triangle2> least_squares_conformal(const Patch& patch, std::span<const Triangle3> corners);

}  // namespace oriel
