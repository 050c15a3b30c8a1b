#include "bake/radiosity/texels/sharp_charts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bake/trace/punctual.h"
#include "formats/assets/sharp_light.h"
#include "formats/core/color.h"
#include "formats/core/convex_hull.h"

namespace oriel {
namespace {

// A sun's radius up to which its light is sharp: a blocker a metre away then has a penumbra of a texel of 10 cm.
constexpr float kWidestSun_rad = 0.05f;
// How far corners may lie off the chart's plane and grid, in texels, and normals off the plane's: a degree, as charts
// are called flat.
constexpr double kOffGrid = 0.02, kFlatCosine = 0.9998;
constexpr double kRounding = 1e-3;  // of places on a page of 16384 texels in floats, texels

// The fewest even steps, the first at 0, that have each angle on one of them; 0 where so many would not do.
std::uint32_t even_steps(std::span<const float> angles, float range) {
  for (std::uint32_t n = 1; n <= kMostProfileSteps; ++n) {
    const auto is_on_step = [&](float angle) {
      const float at = angle * static_cast<float>(n) / range;
      return std::abs(at - std::round(at)) < 1e-3f;
    };
    if (std::ranges::all_of(angles, is_on_step)) return n;
  }
  return 0;
}

// The grid that a triangle spans; not flat where it has no area on the page.
ChartGrid grid_of(const Scene& scene, const Atlas& atlas, std::uint32_t triangle) {
  ChartGrid chart;
  chart.page = static_cast<std::uint32_t>(atlas.page[triangle]);
  const auto [a, b, c] = texel_triangle(atlas, triangle);
  const UVec3& v = scene.triangles[triangle];
  const DVec3 p(scene.positions[v.x]), pb = DVec3(scene.positions[v.y]) - p, pc = DVec3(scene.positions[v.z]) - p;
  const DVec2 ab = b - a, ac = c - a;
  const double area = cross2(ab, ac);
  chart.flat = std::abs(area) > 1e-12;
  if (!chart.flat) return chart;
  chart.along_x = (ac.y * pb - ab.y * pc) / area;
  chart.along_y = (ab.x * pc - ac.x * pb) / area;
  chart.origin = p - a.x * chart.along_x - a.y * chart.along_y;
  chart.normal = DVec3(geometric_normal(scene, triangle));
  chart.lower = UVec2(~0u);
  chart.off = kRounding * std::max(glm::length(chart.along_x), glm::length(chart.along_y));
  return chart;
}

double texel_area2(const Atlas& atlas, std::uint32_t triangle) {
  const auto [a, b, c] = texel_triangle(atlas, triangle);
  return std::abs(cross2(b - a, c - a));
}

void add_to_chart(const Scene& scene, const Atlas& atlas, std::uint32_t triangle, ChartGrid& chart) {
  const double off = kOffGrid * std::max(glm::length(chart.along_x), glm::length(chart.along_y));
  const auto corners = texel_triangle(atlas, triangle);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t vertex = scene.triangles[triangle][static_cast<int>(k)];
    const DVec3 away = chart.at(corners[k]) - DVec3(scene.positions[vertex]);
    if (!(glm::dot(away, away) <= off * off)) chart.flat = false;
    chart.off = std::max(chart.off, glm::length(away));
    if (!(glm::dot(DVec3(scene.normals[vertex]), chart.normal) >= kFlatCosine)) chart.flat = false;
    const AtlasPage& page = atlas.pages[chart.page];
    const DVec2 at = glm::clamp(corners[k], DVec2(0), DVec2(page.width, page.height));
    chart.lower = glm::min(chart.lower, glm::min(UVec2(at), UVec2(page.width - 1, page.height - 1)));
    chart.upper = glm::max(chart.upper, UVec2(glm::ceil(at)));
  }
}

// The most that a lamp may bring to a chart, lux: at its corners and middle, and at the foot of the lamp.
double most_light(const Scene& scene, const Light& light, const ChartGrid& chart) {
  if (light.type == LightType::kDirectional)
    return luminance(light.intensity) * std::max(0.0, -glm::dot(DVec3(light.direction), chart.normal));
  const DVec3 to = DVec3(light.position) - chart.origin;
  if (!(glm::dot(to, chart.normal) > 0)) return 0;
  const DVec2 lower(chart.lower), upper(chart.upper);
  const DVec2 foot(glm::dot(to, chart.along_x) / glm::dot(chart.along_x, chart.along_x),
                   glm::dot(to, chart.along_y) / glm::dot(chart.along_y, chart.along_y));
  double most = 0;
  for (const DVec2& at : {lower, upper, DVec2(lower.x, upper.y), DVec2(upper.x, lower.y), 0.5 * (lower + upper),
                          glm::clamp(foot, lower, upper)}) {
    const DVec3 way = DVec3(light.position) - chart.at(at);
    const double d2 = std::max(glm::dot(way, way), 1e-12);
    const Vec3 leaves = punctual_intensity(scene, light, Vec3(-way / std::sqrt(d2)));
    most = std::max(most, double{luminance(leaves)} * glm::dot(way, chart.normal) / (d2 * std::sqrt(d2)));
  }
  return most;
}

void choose_lamps(const Scene& scene, std::span<const std::uint32_t> lights, ChartGrid& chart) {
  // Suns of a day's hours come last: they never shine together.
  std::vector<std::tuple<bool, double, std::uint32_t>> by_light;
  for (const std::uint32_t l : lights)
    if (const double most = most_light(scene, scene.lights[l], chart); most > 0)
      by_light.emplace_back(scene.lights[l].hour >= 0, -most, l);
  std::ranges::sort(by_light);
  if (by_light.size() > kMostShines) by_light.resize(kMostShines);
  chart.sharp.resize(scene.lights.size());
  for (const auto& [hour, most, l] : by_light) chart.sharp[l] = true;
  chart.flat = !by_light.empty();
}

}  // namespace

std::array<std::uint32_t, 2> profile_steps(const LightProfile& profile) {
  std::vector<float> down, turn = profile.horizontal_deg;
  for (const float angle : profile.vertical_deg) down.push_back(angle - profile.vertical_deg.front());
  turn.push_back(180);  // what is measured on one side alone is mirrored there
  return {even_steps(down, down.back()), profile.horizontal_deg.size() > 1 ? even_steps(turn, 360) : 1};
}

const char* why_in_texels(const Scene& scene, const Light& light) {
  if (scene.lights.size() > kMaxPunctual) return "one of more than 256";
  if (light.profile >= 0 &&
      std::ranges::min(profile_steps(scene.profiles[static_cast<std::size_t>(light.profile)])) == 0)
    return "its angles are no even steps";
  if (light.angular_radius_rad > kWidestSun_rad) return "so wide that its shadows have no edges";
  return max_component(light.profile < 0 ? light.intensity : light.color) > 0 ? nullptr : "dark";
}

SharpCharts find_sharp_charts(const Scene& scene, const Atlas& atlas) {
  SharpCharts out;
  out.charts.resize(atlas.chart_count);
  for (std::uint32_t l = 0; l < scene.lights.size(); ++l)
    if (why_in_texels(scene, scene.lights[l]) == nullptr) out.lights.push_back(l);
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
  for (ChartGrid& chart : out.charts)
    if (chart.flat) choose_lamps(scene, out.lights, chart);
  return out;
}

std::vector<std::vector<std::uint32_t>> charts_of_texels(const Atlas& atlas, std::span<const TexelMapPage> map) {
  std::vector<std::vector<std::uint32_t>> charts;
  for (const TexelMapPage& page : map) {
    charts.emplace_back(std::size_t{page.width} * page.height, ~0u);
    for (std::size_t i = 0; i < page.texel.size(); ++i)
      charts.back()[page.texel[i]] = atlas.chart[page.fragments[page.first[i]].triangle];
  }
  return charts;
}

}  // namespace oriel
