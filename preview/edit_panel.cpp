#include "preview/edit_panel.h"

#include <imgui.h>

#include <algorithm>

namespace oriel {
namespace {

constexpr float kBrightest = 1e6f;

// A colour of at most 1 and how strong it is: what people turn one by one.
bool edit_light(const char* color_name, const char* power_name, Vec3& color, float& power) {
  bool changed = ImGui::ColorEdit3(color_name, &color.x, ImGuiColorEditFlags_Float);
  changed |= ImGui::SliderFloat(power_name, &power, 0, kBrightest, "%.1f", ImGuiSliderFlags_Logarithmic);
  return changed;
}

// World metres.
bool move_light(const Scene& scene, LightEdit& edit) {
  constexpr float kStep_m = 0.01f;
  Vec3 place = Vec3(scene.origin + DVec3(edit.place));
  const Vec3 before = place;
  if (!ImGui::DragFloat3("place, m", &place.x, kStep_m, 0, 0, "%.2f")) return false;
  edit.place += place - before, edit.moved += place - before;
  return true;
}

template <typename Items>
void choose(const char* label, const Items& items, int& chosen) {
  chosen = std::clamp(chosen, 0, static_cast<int>(items.size()) - 1);
  const auto name = [&](int i) { return items[static_cast<std::size_t>(i)].name.c_str(); };
  if (!ImGui::BeginCombo(label, name(chosen))) return;
  for (int i = 0; i < static_cast<int>(items.size()); ++i) {
    ImGui::PushID(i);
    if (ImGui::Selectable(name(i), i == chosen)) chosen = i;
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

bool draw_light(const Scene& scene, SceneEdits& edits, int& chosen) {
  if (scene.lights.empty()) return false;
  choose("light", scene.lights, chosen);
  const Light& light = scene.lights[static_cast<std::size_t>(chosen)];
  LightEdit edit = edit_of(light);
  const char* power = light.type == LightType::kDirectional ? "lux" : "candela";
  if (const auto known = edits.lights.find(light.name); known != edits.lights.end()) edit.moved = known->second.moved;
  bool changed = edit_light("light's colour", power, edit.color, edit.intensity);
  if (light.type != LightType::kDirectional && is_alone(scene, light.name)) changed |= move_light(scene, edit);
  if (!changed) return false;
  edits.lights[light.name] = edit;
  return true;
}

bool draw_material(const Scene& scene, SceneEdits& edits, int& chosen) {
  if (scene.materials.empty()) return false;
  choose("material", scene.materials, chosen);
  MaterialEdit edit = edit_of(scene.materials[static_cast<std::size_t>(chosen)]);
  bool changed = ImGui::ColorEdit3("colour", &edit.base_color.x, ImGuiColorEditFlags_Float);
  changed |= ImGui::SliderFloat("roughness", &edit.roughness, 0, 1);
  float power = max_component(edit.emission);
  Vec3 color = power > 0 ? edit.emission / power : Vec3(1);
  if (edit_light("glow", "cd/m2", color, power)) {
    edit.emission = power * color;
    changed = true;
  }
  if (changed) edits.materials[static_cast<std::uint32_t>(chosen)] = edit;
  return changed;
}

void draw_bake(const BackgroundBake& bake, PanelWishes& wishes) {
  if (!bake.runs()) {
    wishes.bakes = ImGui::Button("bake this view");
    if (!bake.failure().empty()) ImGui::TextWrapped("%s", bake.failure().c_str());
    return;
  }
  wishes.stops = ImGui::Button("stop the bake");
  ImGui::SameLine();
  if (bake.left_s() >= 0)
    ImGui::Text("%s, %.0f s left", bake.stage().c_str(), bake.left_s());
  else
    ImGui::TextUnformatted(bake.stage().empty() ? "starting" : bake.stage().c_str());
  ImGui::ProgressBar(static_cast<float>(bake.fraction()), {240, 4}, "");
}

}  // namespace

PanelWishes draw_edit_panel(const Scene& scene, const BackgroundBake& bake, SceneEdits& edits,
                            EditSelection& selection) {
  PanelWishes wishes;
  ImGui::Begin("Preview", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::Separator();
  wishes.edited |= draw_light(scene, edits, selection.light);
  wishes.edited |= draw_material(scene, edits, selection.material);
  ImGui::BeginDisabled(edits.empty());
  wishes.saves = ImGui::Button("save a copy");
  ImGui::SameLine();
  wishes.undoes = ImGui::Button("undo all");
  ImGui::EndDisabled();
  ImGui::Separator();
  draw_bake(bake, wishes);
  ImGui::End();
  return wishes;
}

}  // namespace oriel
