#include "player/window/legend.h"

#include <cmath>

#include "player/passes/survey_colors.h"
#include "player/window/widgets.h"

namespace oriel {
namespace {

// Readable on the panel's dark ground.
void draw_colored(const Vec3& c, const std::string& text) {
  ImGui::TextColored(ImVec4(std::max(c.r, 0.2f), std::max(c.g, 0.2f), c.b, 1), "%s", text.c_str());
}

void draw_heat(const HeatScale& scale) {
  const float decades = std::log10(scale.highest / scale.lowest);
  for (float d = 0; d < decades + 0.5f; d += 1) {
    if (d > 0) ImGui::SameLine();
    draw_colored(heat(d / decades), fmt::format("{:g}", scale.lowest * std::pow(10.0f, d)));
  }
  ImGui::SameLine();
  ImGui::TextUnformatted(scale.unit);
}

}  // namespace

void draw_legend(Show show) {
  switch (show) {
    case Show::kTexels:
      return ImGui::TextUnformatted("grey: baked; blue: filled from neighbours;\nred: inside other geometry");
    case Show::kCharts:
      return ImGui::TextUnformatted("a colour for each chart of the lightmap;\ndark grey: no lightmap");
    default:
      return draw_heat(heat_scale(show));
  }
}

}  // namespace oriel
