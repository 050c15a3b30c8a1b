#include "player/window/comparison_panel.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "player/window/widgets.h"

namespace oriel {
namespace {

constexpr std::array<std::pair<const char*, Beside>, 3> kWays{
    {{"both", Beside::kSplit}, {"first", Beside::kFirst}, {"second", Beside::kSecond}}};

std::string file_name(const std::string& path) {
  return path.substr(path.find_last_of('/') + 1);
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
