// Which light leaves the texels: that of points, spots and suns on flat charts, which is computed by pixel
// (formats/assets/sharp_light.h).
#pragma once

#include <array>
#include <vector>

#include "bake/atlas/texel_map.h"

namespace oriel {

// Points, spots and suns that are sampled one by one; of more, DirectGroup::kPicks are chosen randomly.
inline constexpr std::size_t kMaxPunctual = 256;

// A chart in one plane whose texels are parallelograms: (x, y) in texels lies at origin + x along_x + y along_y.
struct ChartGrid {
  bool flat = false;  // else nothing is known
  std::uint32_t page = 0;
  DVec3 origin{0}, along_x{0}, along_y{0};
  DVec3 normal{0};           // unit, of the fronts
  double off = 0;            // how far its surface may be from there, m
  UVec2 lower{0}, upper{0};  // texels that it touches: [lower, upper)
  std::vector<bool> sharp;   // by Scene::lights: whether its light here is computed by pixel

  DVec3 at(const DVec2& texel) const { return origin + texel.x * along_x + texel.y * along_y; }
};

struct SharpCharts {
  std::vector<ChartGrid> charts;  // by Atlas::chart
  std::vector<std::uint32_t>
      lights;  // Scene::lights, in the order of SharpLight::lamps; none: all light is the texels'

  bool apart(std::uint32_t light, std::uint32_t chart) const {
    return charts[chart].flat && charts[chart].sharp[light];
  }
};

// The even steps in which a profile is stored, downwards and around: the fewest that have each measured angle. 0: no so
// few have.
std::array<std::uint32_t, 2> profile_steps(const LightProfile& profile);

// Why a lamp's light stays in texels on all charts, whatever other lamps there are; null: it need not.
const char* why_in_texels(const Scene& scene, const Light& light);

// A chart has its brightest few: each costs the time of a frame.
SharpCharts find_sharp_charts(const Scene& scene, const Atlas& atlas);

// By page and texel: the chart of the texel's first triangle, ~0u: none.
std::vector<std::vector<std::uint32_t>> charts_of_texels(const Atlas& atlas, std::span<const TexelMapPage> map);

}  // namespace oriel
