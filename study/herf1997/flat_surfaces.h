// The planes of a scene that stands still, on which soft-shadow textures can lie (Herf 1997), and what of it is in none
// of them. No OpenGL.
#pragma once

#include <vector>

#include "formats/pack/pack.h"
#include "player/navigation/culling.h"

namespace oriel::study {

// What one part of the mesh has in a plane.
struct FlatPiece {
  DVec2 lower{0}, upper{0};  // box along the plane's axes, metres
};

struct FlatPlane {
  DVec3 origin{0}, x{1, 0, 0}, y{0, 1, 0}, normal{0, 0, 1};  // pack space; axes unit, normal the side that is seen
  std::vector<FlatPiece> pieces;
};

struct FlatSurfaces {
  std::vector<FlatPlane> planes;
  std::vector<Bounds> rest;  // boxes around triangles of the opaque scene that lie in no plane
  double touching = 0;       // metres: what is nearer to a plane lies in it
};

// Of opaque, lit triangles whose shading is flat. Those seen from both sides are among the rest.
FlatSurfaces find_flat_surfaces(const Pack& pack);

}  // namespace oriel::study
