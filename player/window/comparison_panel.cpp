#include "player/window/comparison_panel.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "formats/image/heat.h"
#include "player/window/widgets.h"

namespace oriel {
namespace {

constexpr std::array<std::pair<const char*, Beside>, 4> kWays{
    {{"both", Beside::kSplit}, {"first", Beside::kFirst}, {"second", Beside::kSecond}, {"FLIP", Beside::kDifference}}};

std::string file_name(const std::string& path) {
  return path.substr(path.find_last_of('/') + 1);
}

void draw_flip(const ComparisonView& comparison) {
  if (!comparison.flip) return draw_line("flip", "FLIP is found once nothing moves", 1, 0.5f);
  draw_line("flip", fmt::format("FLIP: mean {:.3f}, at most {:.2f}", comparison.flip->x, comparison.flip->y), 1, 0.5f);
  ImDrawList* list = ImGui::GetForegroundDrawList();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float width = scaled(160), height = scaled(8), left = 0.5f * (size.x - width), top = size.y - scaled(60);
  constexpr int kSteps = 64;
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 c = heat(static_cast<float>(i) / (kSteps - 1));
    const float at = left + width * static_cast<float>(i) / kSteps;
    list->AddRectFilled(ImVec2(at, top), ImVec2(at + width / kSteps + 1, top + height),
                        ImGui::GetColorU32(ImVec4(c.r, c.g, c.b, 1)));
  }
  list->AddText(ImVec2(left - scaled(12), top - scaled(3)), IM_COL32_WHITE, "0");
  list->AddText(ImVec2(left + width + scaled(6), top - scaled(3)), IM_COL32_WHITE, "1");
}

}  // namespace

void draw_comparison(ComparisonView& comparison) {
  for (const auto& [name, beside] : kWays) {
    if (beside != kWays[0].second) ImGui::SameLine();
    if (ImGui::RadioButton(name, comparison.beside == beside)) comparison.beside = beside;
  }
  if (comparison.beside == Beside::kSplit) ImGui::SliderFloat("divider", &comparison.divider, 0, 1, "%.2f");
}

void draw_names(const ComparisonView& comparison) {
  const std::string second =
      file_name(comparison.second) + (comparison.elsewhere ? ", which was taken from elsewhere" : "");
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  switch (comparison.beside) {
    case Beside::kFirst:
      return draw_line("beside", file_name(comparison.first), 0);
    case Beside::kSecond:
      return draw_line("beside", second, 0);
    case Beside::kDifference:
      return draw_flip(comparison);
    case Beside::kSplit:
      break;
  }
  const float at = comparison.divider * size.x, half = scaled(1);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->AddRectFilled(ImVec2(at - half, 0), ImVec2(at + half, size.y), IM_COL32(255, 255, 255, 200));
  // Beside the divider, at the bottom: the panel and messages are at the top.
  const auto name = [&](const std::string& shown, float side) {
    const ImVec2 extent = ImGui::CalcTextSize(shown.c_str());
    const float left = side < 0 ? at - extent.x - scaled(kMargin) : at + scaled(kMargin);
    const ImVec2 corner(left, size.y - extent.y - scaled(kMargin));
    list->AddText(ImVec2(corner.x + 1, corner.y + 1), IM_COL32_BLACK, shown.c_str());
    list->AddText(corner, IM_COL32_WHITE, shown.c_str());
  };
  name(file_name(comparison.first), -1);
  name(second, 1);
}

}  // namespace oriel
