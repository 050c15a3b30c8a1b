// From what people see to what is modelled: pieces of large surfaces, and the texels of the lightmap.
#pragma once

#include "bake/atlas/texel_demand.h"
#include "bake/run/options.h"
#include "bake/visibility/eye_region.h"

namespace oriel {

// An automatic texel is as large as this angle from where all that is seen is seen, and
// what is seen has at least so many texels. Rooms as people know them get texels of about 10 cm, the same room in any
// other unit as many of them, and a thing that stands alone some ten thousand.
inline constexpr double kTexelAngle = 1.0 / 16;
inline constexpr double kLeastSeenTexels = 1e4;

// Cuts triangles that are near eyes at one end and far at the other, the ground around a house say, so that each piece
// can have texels for its own distance. Whether any was cut: an Accel of the scene must be built anew then.
bool divide_for_eyes(const EyeRegion& region, Scene& scene);

// What is wanted of each triangle, at kTexelAngle. Errors as find_view_importance().
Result<TexelDemand> find_demand(const Accel& accel, const EyeRegion& region, Context& context);

// The finest texel of a lightmap that asks for none, from all that is seen; sets the angle that goes with it.
// `otherwise` where nothing is seen.
float choose_texel(const Scene& scene, float otherwise, TexelDemand& demand);

}  // namespace oriel
