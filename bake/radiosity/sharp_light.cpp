#include "bake/radiosity/sharp_light.h"

#include <fmt/format.h>

#include <algorithm>

namespace oriel {
namespace {

constexpr double kSharpTime = 0.2;  // of what is left: lists of what stands between texels and lamps

}  // namespace

Status find_sharp_light(const RadiosityTask& task, SharpCharts& charts, ShadowLists& shadows) {
  const double most = task.options.left ? (1 - kSharpTime) * task.options.left() : 0;
  const auto late = [&] { return task.options.left() < most; };
  ORIEL_TRY(shadows, list_shadows(task, charts, task.options.left ? late : std::function<bool()>(), task.quick));
  for (const std::uint32_t chart : shadows.left_out) charts.charts[chart].flat = false;
  if (!shadows.left_out.empty())
    task.context.warning(
        "time-over",
        fmt::format("shadows of points, spots and suns are as coarse as texels on {} of {} flat charts: "
                    "--time left none for finer ones, or they took too much room",
                    shadows.left_out.size(),
                    std::ranges::count_if(charts.charts, &ChartGrid::flat) + std::ssize(shadows.left_out)));
  return {};
}

void leave_out_sharp_ends(const RadiosityTask& task, Seams& seams) {
  if (task.sharp == nullptr) return;
  const auto charts = charts_of_texels(task.atlas, task.map);
  const auto lamps_at = [&](const SeamPoint& point, std::size_t side) {
    const TexelMapPage& page = task.map[point.page[side]];
    const UVec2 at = glm::min(UVec2(glm::max(point.place[side], DVec2(0))), UVec2(page.width - 1, page.height - 1));
    const std::size_t texel = std::size_t{at.y} * page.width + at.x;
    const std::uint32_t chart = charts[point.page[side]][texel];
    const bool flat = chart != ~0u && task.sharp->charts[chart].flat;
    return flat ? task.sharp->charts[chart].sharp : std::vector<bool>();
  };
  std::erase_if(seams.points, [&](const SeamPoint& point) { return lamps_at(point, 0) != lamps_at(point, 1); });
}

void add_sharp_light(const ShadowLists& shadows, Radiosity& light) {
  for (std::size_t p = 0; p < light.sharp.size(); ++p) {
    if (shadows.at[p].empty()) continue;
    LightmapPage& page = light.pages[p];
    page.sharp = std::move(light.sharp[p].irradiance), page.sharp_at = shadows.at[p];
    for (std::size_t i = 0; i < page.sharp.size(); ++i) page.irradiance[i] += page.sharp[i];
  }
  light.sharp.clear();
}

}  // namespace oriel
