#include "bake/atlas/chart_turn.h"

#include "bake/atlas/surface_mesh.h"

namespace oriel {

DVec2 turn_of(const Scene& scene, const ChartSet& set, const Chart& chart) {
  double area = 0;
  DVec2 middle(0);
  DVec3 mean(0);
  std::vector<TriangleFrame> frames;
  const auto centre = [&](std::uint32_t i) { return (set.points[i][0] + set.points[i][1] + set.points[i][2]) / 3.0; };
  for (std::uint32_t i = chart.first; i < chart.first + chart.count; ++i) {
    const TriangleFrame f = frames.emplace_back(triangle_frame(scene, set.triangles[i]));
    area += f.area;
    middle += f.area * centre(i);
    mean += f.area * f.normal;
  }
  if (!(area > 0)) return DVec2(0);
  middle /= area;
  mean /= area;
  double xx = 0, xy = 0, yy = 0;
  DVec3 nx(0), ny(0);
  for (std::uint32_t k = 0; k < chart.count; ++k) {
    const DVec2 p = centre(chart.first + k) - middle;
    const DVec3 n = frames[k].area * (frames[k].normal - mean);
    xx += frames[k].area * p.x * p.x, xy += frames[k].area * p.x * p.y, yy += frames[k].area * p.y * p.y;
    nx += n * p.x, ny += n * p.y;
  }
  // Triangles in a row tell of one axis only, and of the other nothing but rounding.
  constexpr double kSpread = 1e-3;
  const bool along_x = xx > kSpread * area * chart.size.x * chart.size.x,
             along_y = yy > kSpread * area * chart.size.y * chart.size.y;
  const double determinant = xx * yy - xy * xy;
  if (!along_x || !along_y || !(determinant > kSpread * xx * yy))
    return {along_x ? glm::length(nx) / xx * chart.size.x : 0, along_y ? glm::length(ny) / yy * chart.size.y : 0};
  return {glm::length(nx * yy - ny * xy) / determinant * chart.size.x,
          glm::length(ny * xx - nx * xy) / determinant * chart.size.y};
}

}  // namespace oriel
