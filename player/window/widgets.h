// What parts of the panel are made of.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <string>

#include "player/session/option_names.h"

namespace oriel {

inline constexpr float kMargin = 10;  // pixels at a scale of 1

inline float scaled(float pixels) {
  return pixels * ImGui::GetIO().FontGlobalScale;
}

inline void text(const std::string& line) {
  ImGui::TextUnformatted(line.c_str(), line.c_str() + line.size());
}

// A choice by the names that the command line has for it.
template <class T, std::size_t N>
void choose(const char* label, const Named<T> (&names)[N], T& value) {
  if (!ImGui::BeginCombo(label, name_of(names, value), ImGuiComboFlags_HeightLargest)) return;
  for (const auto& [name, one] : names)
    if (ImGui::Selectable(name, one == value)) value = one;
  ImGui::EndCombo();
}

// A line of text over the frame, `across` and `down` of it: (0, 0) the top left corner. opacity: 1 to be read, 0 gone.
inline void draw_line(const char* id, const std::string& line, float down, float across = 0, float opacity = 1) {
  const float margin = scaled(kMargin);
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(margin + across * (size.x - 2 * margin), margin + down * (size.y - 2 * margin)),
                          ImGuiCond_Always, ImVec2(across, down));
  ImGui::SetNextWindowBgAlpha(0.6f * opacity);
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, std::max(opacity, 0.01f));
  ImGui::Begin(id, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  text(line);
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace oriel
