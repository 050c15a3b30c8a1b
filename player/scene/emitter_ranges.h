// Which triangles are the emitters that a glossy reflector shows in closed form.
#pragma once

#include <vector>

#include "formats/pack/pack.h"

namespace oriel {

// Triangles of a shining part that lie in an emitter's polygon.
struct EmitterTriangles {
  std::uint32_t part = 0;              // into Mesh::parts
  std::vector<std::uint32_t> indices;  // into Mesh's vertices
};
// Within a thousandth of the polygon's size. corners: pack space, convex and planar.
std::vector<EmitterTriangles> triangles_of(const Emitter& emitter, const Pack& pack);

}  // namespace oriel
