// How fine a lightmap is wanted where: what people see of each surface, and from how far.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace oriel {

struct TriangleDemand {
  float pixels = 0;          // of what eyes see; their unit cancels out
  float inverse_square = 0;  // Σ 1/d² of these, d the distance from the eye in metres
  float eye_distance_m = 0;  // to the nearest place where an eye can be, seen or not
};

struct TexelDemand {
  std::vector<TriangleDemand> triangles;  // by triangle of the scene; empty: every surface is wanted alike
  // A chart's texels are as large as this angle from where it is seen: (mean of 1/d²)^-1/2 over its pixels.
  double angle_rad = 0;
  // So many times larger are the texels of what nobody sees: fine enough to carry light.
  double unseen = 4;
  // Places further from eyes than this are divided by distance, so that a chart's texels are right for all of it:
  // charts end where the distance doubles.
  double even_m = 16;

  bool empty() const { return triangles.empty(); }
  // Which triangles may share a chart: 0 up to even_m, one more for each doubling of the distance.
  std::uint8_t ring(std::uint32_t triangle) const;
};

// What one chart gets.
struct ChartTexel {
  double texel_m = 0;
  double pixels = 0;   // of what eyes see
  double area_m2 = 0;  // of its surface
};

// The texel that eyes want of a chart of these triangles, the finest one at least.
ChartTexel texel_for(const TexelDemand& demand, std::span<const std::uint32_t> triangles, double area_m2,
                     double finest_m);

// Makes texels of charts that are seen little larger, up to three times: until each of theirs shows a sixteenth as much
// as texels do on average. A lawn that is seen through one window is not worth the texels of the room.
void even_out(std::span<ChartTexel*> charts);

// Makes texels larger until too_many() says no: no texel of a chart shall show less than q pixels, with the least q
// that does it. So what nobody sees gives way first, then what is far or small, and last what people look at. Returns
// how many charts gave way.
std::size_t coarsen(std::span<ChartTexel*> charts, const std::function<bool()>& too_many);

}  // namespace oriel
