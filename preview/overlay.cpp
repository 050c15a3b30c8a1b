#include "preview/overlay.h"

#include <imgui.h>

#include <algorithm>

namespace oriel {
namespace {

constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                    ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
constexpr float kMargin = 12;

void draw_lines(const PreviewStatus& s) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({kMargin, size.y - kMargin}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowBgAlpha(0.5f);
  ImGui::Begin("state", nullptr, kPlain);
  ImGui::PushTextWrapPos(std::max(size.x - 3 * kMargin, 100.0f));
  if (!s.error.empty()) ImGui::TextColored({1, 0.5f, 0.4f, 1}, "%s", s.error.c_str());
  if (!s.message.empty()) ImGui::TextUnformatted(s.message.c_str());
  if (s.loading) {
    ImGui::TextUnformatted("reading the scene");
  } else if (s.paths > 0) {
    ImGui::Text("%u of %u paths a pixel, noise %.1f %%", s.paths, s.most_paths, 100 * s.noise);
  } else {
    ImGui::Text("pass %u of %u, %.0f ms", s.passes, s.most_passes, 1000 * s.pass_s);
  }
  ImGui::PopTextWrapPos();
  if (!s.loading) {
    const double all = s.most_passes + double{1} * s.most_paths;
    ImGui::ProgressBar(static_cast<float>((s.passes + s.paths) / std::max(all, 1.0)), {240, 4}, "");
  }
  ImGui::End();
}

bool draw_panel(const PreviewStatus& s, PreviewOptions& o) {
  bool changed = false;
  ImGui::SetNextWindowPos({kMargin, kMargin}, ImGuiCond_FirstUseEver);
  ImGui::Begin("Preview", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::Text("%zu triangles, %zu lamps", s.triangles, s.lamps);
  changed |= ImGui::Checkbox("direct light", &o.direct);
  int samples = static_cast<int>(o.samples);
  if (ImGui::SliderInt("points on lamps", &samples, 1, 64)) {
    o.samples = static_cast<std::uint32_t>(std::max(samples, 1));
    changed = true;
  }
  changed |= ImGui::Checkbox("reflected light", &o.bounce);
  changed |= ImGui::Checkbox("emission", &o.emission);
  changed |= ImGui::Checkbox("traced reflections", &o.traced);
  changed |= ImGui::SliderFloat("up to roughness", &o.glossy, 0, 1);
  ImGui::End();
  return changed;
}

}  // namespace

bool draw_preview_overlay(const PreviewStatus& status, PreviewOptions& options) {
  draw_lines(status);
  return status.panel && draw_panel(status, options);
}

}  // namespace oriel
