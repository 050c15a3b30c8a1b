// Illuminance at points of a scene file: `oriel-bake lux`.
#pragma once

#include <filesystem>

#include "bake/import/import.h"
#include "bake/reference/illuminance.h"

namespace oriel {

struct MeasureJob {
  std::filesystem::path scene;   // .glb or .gltf
  std::filesystem::path points;  // a table for parse_points; empty: the grid
  GridSpec grid;
  ImportOptions import;
  LuxOptions lux;
  bool reproducible = false;  // the same numbers on every CPU type
};

struct Measurement {
  std::vector<MeasurePoint> points;
  std::vector<PointIlluminance> results;
};

// Points of the table that are buried are measured all the same and named in a warning; those of a grid are left out.
// Errors as the stages give them; kUsage where no point of the grid lies in the open.
Result<Measurement> measure(const MeasureJob& job, Context& context);

// "floor,50cm,85cm": node, spacing and height above it (a height may be 0). Node names may hold commas. Error kUsage.
Result<GridSpec> parse_grid(const std::string& text);

}  // namespace oriel
