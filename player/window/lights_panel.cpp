#include "player/window/lights_panel.h"

#include <cmath>

#include "formats/core/file.h"
#include "formats/query/day_hours.h"
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

bool draw_hour(const Pack& pack, std::vector<LightSetting>& lights) {
  const auto hour = shown_hour(pack, lights);
  if (!hour) return false;
  float chosen = *hour;
  const Day& day = pack.day;
  const std::string text = clock_text(chosen) + " " + clock_name(day);
  if (!ImGui::SliderFloat("hour", &chosen, day.hours.front().hour, day.hours.back().hour, text.c_str())) return false;
  // Between two hours both suns show: one that was baked is easily met.
  constexpr float kNear = 0.1f;  // of the hours beside it
  for (std::size_t k = 0; k < day.hours.size(); ++k) {
    const float hour_at = day.hours[k].hour;
    const float beside = day.hours[k > 0 ? k - 1 : std::min<std::size_t>(1, day.hours.size() - 1)].hour;
    if (std::fabs(chosen - hour_at) < kNear * std::fabs(hour_at - beside)) chosen = hour_at;
  }
  return set_hour(pack, chosen, lights).has_value();
}

void keep(const Pack& pack, Session& session) {
  const std::string json = lights_json(pack, session.lights) + "\n";
  const auto* bytes = reinterpret_cast<const std::byte*>(json.data());
  const Status kept = write_file_atomically(kFile, {bytes, json.size()});
  session.said = kept ? fmt::format("{}: what lamps are set to; --lights reads it", kFile) : kept.error().text();
}

std::vector<LightSetting> as_baked(const std::vector<LightSetting>& lights) {
  std::vector<LightSetting> baked(lights.size());
  for (std::size_t g = 0; g < lights.size(); ++g) baked[g].hour = lights[g].hour;
  return baked;
}

}  // namespace

void draw_lights(const Pack& pack, Session& session) {
  std::vector<LightSetting>& lights = session.lights;
  if (lights.size() != pack.light_groups.size()) lights = settings_of(pack);
  bool changed = draw_hour(pack, lights);
  if (ImGui::Button("all as baked")) lights = as_baked(lights), changed = true;
  ImGui::SameLine();
  if (ImGui::Button("all off")) {
    for (LightSetting& setting : lights) setting.on = false;
    changed = true;
  }
  ImGui::SameLine();
  if (ImGui::Button("keep")) keep(pack, session);
  for (std::size_t g = 0; g < lights.size(); ++g) {
    if (lights[g].hour) continue;  // the hour tells
    ImGui::PushID(static_cast<int>(g));
    changed |= draw_setting(pack.light_groups[g].name, lights[g]);
    ImGui::PopID();
  }
  ImGui::TextDisabled("hold L and drag a lamp to move it");
  if (changed) session.frame.lights = factors_of(pack, lights);
}

}  // namespace oriel
