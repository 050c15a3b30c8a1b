#include "player/window/lights_panel.h"

#include "formats/core/file.h"
#include "player/window/widgets.h"

namespace oriel {
namespace {

constexpr float kMostDimmed = 2;  // times what was baked
constexpr const char* kFile = "oriel-lights.json";

bool draw_setting(const std::string& name, LightSetting& setting) {
  bool changed = ImGui::Checkbox(name.c_str(), &setting.on);
  if (!setting.on) return changed;
  changed |= ImGui::SliderFloat("light", &setting.value, 0, kMostDimmed, "%.2f");
  bool coloured = setting.color.has_value();
  if (ImGui::Checkbox("colour", &coloured)) {
    changed = true;
    setting.color.reset(), setting.kelvin.reset();
    if (coloured) setting.kelvin = 2700.0f, setting.color = color_of_kelvin(*setting.kelvin);
  }
  if (!setting.kelvin) return changed;
  ImGui::SameLine();
  float kelvin = *setting.kelvin;
  if (ImGui::SliderFloat("##kelvin", &kelvin, 1800, 10000, "%.0f K", ImGuiSliderFlags_Logarithmic)) {
    setting.kelvin = kelvin, setting.color = color_of_kelvin(kelvin);
    changed = true;
  }
  return changed;
}

void keep(const Pack& pack, Session& session) {
  const std::string json = lights_json(pack, session.lights) + "\n";
  const auto* bytes = reinterpret_cast<const std::byte*>(json.data());
  const Status kept = write_file_atomically(kFile, {bytes, json.size()});
  session.said = kept ? fmt::format("{}: what lamps are set to; --lights reads it", kFile) : kept.error().text();
}

}  // namespace

void draw_lights(const Pack& pack, Session& session) {
  std::vector<LightSetting>& lights = session.lights;
  if (lights.size() != pack.light_groups.size()) lights = settings_of(pack);
  bool changed = false;
  if (ImGui::Button("all as baked")) lights.assign(lights.size(), {}), changed = true;
  ImGui::SameLine();
  if (ImGui::Button("all off")) {
    for (LightSetting& setting : lights) setting.on = false;
    changed = true;
  }
  ImGui::SameLine();
  if (ImGui::Button("keep")) keep(pack, session);
  for (std::size_t g = 0; g < lights.size(); ++g) {
    ImGui::PushID(static_cast<int>(g));
    changed |= draw_setting(pack.light_groups[g].name, lights[g]);
    ImGui::PopID();
  }
  ImGui::TextDisabled("hold L and drag a lamp to move it");
  if (changed) session.frame.lights = factors_of(pack, lights);
}

}  // namespace oriel
