// Radiosity as vertex colours: the other of the two forms that diffuse light is kept in, beside the lightmap.
#pragma once

#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// Of a mesh that is divided where light bends. Light between vertices is interpolated linearly over each triangle.
// Empty: the lightmap alone holds the light.
struct VertexLight {
  std::vector<Vec3> irradiance;  // by vertex of Pack::mesh: lux, linear Rec. 709, finite and >= 0; 0 without a lightmap
};

}  // namespace oriel
