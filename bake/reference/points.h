// Where to measure: points from a table, or a workplane over a floor.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bake/scene/scene.h"
#include "formats/core/result.h"

namespace oriel {

struct MeasurePoint {
  DVec3 position{0};       // world, metres
  DVec3 normal{0, 1, 0};   // world, not zero, of any length: the direction that the meter faces
  std::uint32_t line = 0;  // of the table it came from, from 1; 0: none
};

// Lines of x,y,z,nx,ny,nz. Blank lines and lines that begin with # are skipped, the first line may be a header. Error
// kInvalid, with `name` and the line, for anything but six finite numbers, for a zero normal, and for no point at all.
Result<std::vector<MeasurePoint>> parse_points(std::string_view table, const std::string& name);

// A level grid: the middles of the cells of spacing × spacing that fit the bounding rectangle of the node's upward
// faces (normals within 60° of up), centred on it; `height` above the node's highest upward face there, facing up.
// Points without such a face below are left out. Metres; spacing > 0, height >= 0.
// Errors kUsage: no mesh node has that name, it has no upward face, or there would be more than 10 million points.
struct GridSpec {
  std::string node;
  double spacing_m = 0.5, height_m = 0.85;
};
Result<std::vector<MeasurePoint>> grid_points(const Scene& scene, const GridSpec& grid);

}  // namespace oriel
