// Radiance maps' depth as triangles.
#pragma once

#include "bake/jobs/units.h"
#include "bake/radiance/pixel_planes.h"
#include "formats/assets/map_mesh.h"

namespace oriel {

struct MeshOptions {
  // Pixels of the map by which what is drawn may be off, seen from an eye that is as far from the map's as the element
  // is wide: of edges, and of depth.
  float error = 0.35f;
};

// The mesh of pixels with these planes. Neighbours are connected where they lie on one plane, or their planes meet
// between them; elsewhere it is cut. Planar parts are squares of a quadtree, and edges of steps are straightened by up
// to half a pixel, before all is simplified (Garland and Heckbert 1997, by meshoptimizer) within the error.
MapMesh mesh_of(std::span<const PixelPlane> planes, const IVec2& size, const MeshOptions& options);

// Of each captured map. The same for any number of threads. Error kStopped.
Result<std::vector<MapMesh>> mesh_maps(const ReflectedSurroundings& surroundings, std::span<const RadianceMap> maps,
                                       const MeshOptions& options, Context& context);

}  // namespace oriel
