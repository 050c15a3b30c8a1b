#include "bake/radiosity/texels/sharp_charts.h"

#include <algorithm>
#include <cmath>

#include "formats/assets/sharp_light.h"

namespace oriel {
namespace {

// A sun's radius up to which its light is sharp: a blocker a metre away then has a penumbra of a texel of 10 cm.
constexpr float kWidestSun_rad = 0.05f;
constexpr std::size_t kMostSharp = 256;  // lights, as DirectLight visits one by one
// How far corners may lie off the chart's plane and grid, in texels, and normals off the plane's: a degree, as charts
// are called flat.
constexpr double kOffGrid = 0.02, kFlatCosine = 0.9998;

bool may_be_sharp(const Light& light) {
  return light.profile < 0 && light.hour < 0 && light.angular_radius_rad <= kWidestSun_rad &&
         max_component(light.intensity) > 0;
}

std::array<DVec2, 3> texel_corners(const Atlas& atlas, std::uint32_t triangle) {
  const AtlasPage& page = atlas.pages[static_cast<std::size_t>(atlas.page[triangle])];
  std::array<DVec2, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = DVec2(atlas.uv[triangle][k]) * DVec2(page.width, page.height);
  return corners;
}

// The grid that a triangle spans; not flat where it has no area on the page.
FlatChart grid_of(const Scene& scene, const Atlas& atlas, std::uint32_t triangle) {
  FlatChart chart;
  chart.page = static_cast<std::uint32_t>(atlas.page[triangle]);
  const auto [a, b, c] = texel_corners(atlas, triangle);
  const UVec3& v = scene.triangles[triangle];
  const DVec3 p(scene.positions[v.x]), pb = DVec3(scene.positions[v.y]) - p, pc = DVec3(scene.positions[v.z]) - p;
  const DVec2 ab = b - a, ac = c - a;
  const double area = ab.x * ac.y - ab.y * ac.x;
  chart.flat = std::abs(area) > 1e-12;
  if (!chart.flat) return chart;
  chart.along_x = (ac.y * pb - ab.y * pc) / area;
  chart.along_y = (ab.x * pc - ac.x * pb) / area;
  chart.origin = p - a.x * chart.along_x - a.y * chart.along_y;
  chart.normal = DVec3(geometric_normal(scene, triangle));
  chart.lower = UVec2(~0u);
  return chart;
}

double texel_area2(const Atlas& atlas, std::uint32_t triangle) {
  const auto [a, b, c] = texel_corners(atlas, triangle);
  return std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

void add_to_chart(const Scene& scene, const Atlas& atlas, std::uint32_t triangle, FlatChart& chart) {
  const double off = kOffGrid * std::max(glm::length(chart.along_x), glm::length(chart.along_y));
  const auto corners = texel_corners(atlas, triangle);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t vertex = scene.triangles[triangle][static_cast<int>(k)];
    const DVec3 away = chart.at(corners[k]) - DVec3(scene.positions[vertex]);
    if (!(glm::dot(away, away) <= off * off)) chart.flat = false;
    if (!(glm::dot(DVec3(scene.normals[vertex]), chart.normal) >= kFlatCosine)) chart.flat = false;
    const AtlasPage& page = atlas.pages[chart.page];
    const DVec2 at = glm::clamp(corners[k], DVec2(0), DVec2(page.width, page.height));
    chart.lower = glm::min(chart.lower, glm::min(UVec2(at), UVec2(page.width - 1, page.height - 1)));
    chart.upper = glm::max(chart.upper, UVec2(glm::ceil(at)));
  }
}

}  // namespace

SharpCharts find_sharp_charts(const Scene& scene, const Atlas& atlas) {
  SharpCharts out;
  out.charts.resize(atlas.chart_count);
  out.is_sharp.resize(scene.lights.size());
  if (scene.lights.size() > kMostSharp) return out;
  for (std::uint32_t l = 0; l < scene.lights.size(); ++l)
    if (may_be_sharp(scene.lights[l])) out.is_sharp[l] = true, out.lights.push_back(l);
  if (out.lights.empty()) return out;
  // The grid is that of the chart's largest triangle, by which slivers are judged.
  std::vector<std::uint32_t> largest(atlas.chart_count, ~0u);
  for (std::uint32_t t = 0; t < atlas.chart.size(); ++t) {
    if (atlas.chart[t] == ~0u || atlas.page[t] < 0) continue;
    std::uint32_t& best = largest[atlas.chart[t]];
    if (best == ~0u || texel_area2(atlas, t) > texel_area2(atlas, best)) best = t;
  }
  for (std::uint32_t c = 0; c < atlas.chart_count; ++c)
    if (largest[c] != ~0u) out.charts[c] = grid_of(scene, atlas, largest[c]);
  for (std::uint32_t t = 0; t < atlas.chart.size(); ++t)
    if (atlas.chart[t] != ~0u && atlas.page[t] >= 0 && out.charts[atlas.chart[t]].flat)
      add_to_chart(scene, atlas, t, out.charts[atlas.chart[t]]);
  return out;
}

}  // namespace oriel
