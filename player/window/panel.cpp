#include "player/window/panel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "player/passes/survey_colors.h"
#include "player/window/comparison_panel.h"
#include "player/window/lights_panel.h"
#include "player/window/widgets.h"

namespace oriel {
namespace {

constexpr float kPanelWidth = 330;  // pixels at a scale of 1
constexpr const char* kHint = "W A S D walk    double click: go there    F1: all keys";
constexpr float kLeastEv100 = -6, kMostEv100 = 20;

// Brighter to the right: what a photographer's exposure value says the other way round.
void draw_light(Session& session) {
  float ev100 = session.shown_ev100;
  if (ImGui::SliderFloat("brightness", &ev100, kMostEv100, kLeastEv100, "EV %.1f")) session.manual_ev100 = ev100;
  bool automatic = !session.manual_ev100;
  if (ImGui::Checkbox("brightness follows the room", &automatic)) {
    session.manual_ev100.reset();
    if (!automatic) session.manual_ev100 = session.shown_ev100;
  }
}

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

// What the colours of a survey mean.
void draw_legend(Show show) {
  if (show == Show::kTexels)
    ImGui::TextUnformatted("grey: baked; blue: filled from neighbours;\nred: inside other geometry");
  else if (show == Show::kCharts)
    ImGui::TextUnformatted("a colour for each chart of the lightmap;\ndark grey: no lightmap");
  else
    draw_heat(heat_scale(show));
}

constexpr Named<Blur> kSharpness[] = {{"as the material", Blur::kDistance}, {"like a mirror", Blur::kOff}};

void draw_quality(const FrameMeter& meter, Session& session) {
  choose("quality", kQualities, session.quality);
  ImGui::TextWrapped("%s", meter.pace.c_str());
  bool reflects = session.frame.reflections != Reflections::kOff;
  if (ImGui::Checkbox("reflections", &reflects))
    session.frame.reflections = reflects ? Reflections::kChosen : Reflections::kOff;
  choose("their sharpness", kSharpness, session.frame.blur);
}

// In the words of Bastos et al. 1999.
void draw_advanced(Session& session) {
  FrameOptions& frame = session.frame;
  choose("stage", kStages, frame.show);
  if (is_survey(frame.show)) {
    draw_legend(frame.show);
    return;
  }
  choose("reflected by", kReflections, frame.reflections);
  ImGui::SliderInt("maps", &frame.maps_per_element, 0, 8);
  float white = white_of_exposure(session.shown_ev100);
  if (ImGui::SliderFloat("white, cd/m²", &white, white_of_exposure(kLeastEv100), white_of_exposure(kMostEv100), "%.4g",
                         ImGuiSliderFlags_Logarithmic))
    session.manual_ev100 = exposure_of_white(white);
  choose("tone curve", kToneCurves, session.curve);
}

void draw_places(const Pack& pack, Session& session) {
  if (ImGui::Button("home")) perform({Action::kHome, 0}, pack, session);
  if (!session.path.keys.empty()) {
    ImGui::SameLine();
    if (ImGui::Button(session.path_time_s >= 0 ? "stop the path" : "play the path"))
      perform({Action::kPlayPath, 0}, pack, session);
  }
  ImGui::SameLine();
  if (ImGui::Button(session.recording ? "end the walk" : "record")) perform({Action::kRecord, 0}, pack, session);
  ImGui::SameLine();
  ImGui::Checkbox("fly", &session.move.fly);
  for (std::size_t i = 0; i < pack.cameras.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    const std::string& name = pack.cameras[i].name;
    if (ImGui::Selectable(name.empty() ? "(camera)" : name.c_str(), false))
      perform({Action::kCamera, i}, pack, session);
    ImGui::PopID();
  }
  const DVec3 eye = DVec3(session.camera.eye) + pack.mesh.origin;
  text(fmt::format("eye {:.2f}, {:.2f}, {:.2f} m", eye.x, eye.y, eye.z));
}

void draw_movers(const Pack& pack, Session& session) {
  choose("their light", kMoverLights, session.frame.mover_lights);
  if (ImGui::Button("all back")) perform({Action::kMoversBack, 0}, pack, session);
  for (std::size_t i = 0; i < std::min(pack.movers.size(), session.frame.poses.size()); ++i) {
    const DVec3 at = DVec3(session.frame.poses[i].position) + pack.mesh.origin;
    text(fmt::format("{}: {:.2f}, {:.2f}, {:.2f} m", pack.movers[i].name, at.x, at.y, at.z));
  }
}

void draw_images(const LoadingState& images) {
  const auto megabytes = [](std::uint64_t bytes) { return static_cast<double>(bytes) * 1e-6; };
  std::string line = fmt::format("{:.0f} MB of images", megabytes(images.used));
  if (images.limit != kNoLimit) line += fmt::format(" of {:.0f}", megabytes(images.limit));
  if (images.coarser > 0) line += fmt::format(", {} coarser", images.coarser);
  if (images.left_out > 0) line += fmt::format(", {} left out", images.left_out);
  if (images.failed > 0) line += fmt::format(", {} broken", images.failed);
  text(line);
}

void draw_statistics(const FrameMeter& meter, const Pack& pack, FrameOptions& frame) {
  if (!pack.visible_sets.empty()) ImGui::Checkbox("only what may be seen", &frame.visible_sets);
  const std::vector<float> ms(meter.ms.begin(), meter.ms.end());
  const float most = ms.empty() ? 1 : *std::max_element(ms.begin(), ms.end());
  const float mean = meter.mean_ms();
  text(fmt::format("{:.1f} ms, {:.1f} frames/s; worst {:.1f} ms", mean, mean > 0 ? 1000 / mean : 0, most));
  ImGui::PlotLines("##frames", ms.data(), static_cast<int>(ms.size()), 0, nullptr, 0, 1.1f * most,
                   ImVec2(ImGui::GetContentRegionAvail().x, scaled(50)));
  const FrameStats& s = meter.stats;
  if (ImGui::BeginTable("passes", 2, ImGuiTableFlags_SizingStretchProp)) {
    for (std::size_t i = 0; i < kPassNames.size(); ++i) {
      if (s.ms[i] < 0.05) continue;
      ImGui::TableNextColumn();
      text(kPassNames[i]);
      ImGui::TableNextColumn();
      text(fmt::format("{:.1f} ms", s.ms[i]));
    }
    ImGui::EndTable();
  }
  text(fmt::format("{} draws, {} triangles", s.draws, s.triangles));
  if (s.groups > 0) text(fmt::format("{} of {} groups of triangles may be seen", s.groups_seen, s.groups));
  text(fmt::format("{} reflectors, {} maps, {:.1f} MB of them", s.reflectors, s.maps,
                   static_cast<double>(s.map_bytes) * 1e-6));
  draw_images(meter.loading);
  text(meter.device);
}

// What makes it so; the first of its lights.
void draw_why(const Why& why) {
  for (const Reason& reason : why.reasons) {
    ImGui::TextWrapped("%s: %s", name_of(reason.cause), reason.text.c_str());
    ImGui::TextWrapped("to do: %s", reason.fix.c_str());
  }
  constexpr std::size_t kShown = 3;
  for (std::size_t i = 0; i < std::min(kShown, why.lights.size()); ++i)
    ImGui::TextWrapped("%s", verdict_text(why.lights[i]).c_str());
}

void draw_picked(const std::optional<PickedSurface>& picked) {
  if (!picked) {
    ImGui::TextUnformatted("nothing");
    return;
  }
  text(fmt::format("{}, {:.2f} m away", picked->part, picked->distance_m));
  text(fmt::format("material {}", picked->material));
  text(fmt::format("base colour {:.2f} {:.2f} {:.2f}", picked->albedo.r, picked->albedo.g, picked->albedo.b));
  text(fmt::format("roughness {:.2f}, metallic {:.2f}", picked->roughness, picked->metallic));
  if (picked->page < 0) {
    ImGui::TextUnformatted("no lightmap: unlit");
    return;
  }
  if (!picked->known) {
    ImGui::TextUnformatted("its texels are not loaded yet");
    return;
  }
  text(fmt::format("{:.4g} ± {:.2g} lux", picked->lux, picked->lux_error));
  text(fmt::format("texel {}, {} of page {}: {}", picked->texel.x, picked->texel.y, picked->page,
                   name_of(picked->state)));
  if (picked->why) draw_why(*picked->why);
}

void draw_panel(const Pack& pack, const FrameMeter& meter, const std::optional<PickedSurface>& picked,
                Session& session) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float margin = scaled(kMargin), width = std::min(scaled(kPanelWidth), size.x - 2 * margin);
  ImGui::SetNextWindowPos(ImVec2(size.x - width - margin, margin), ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize(ImVec2(width, size.y - 2 * margin), ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Oriel", &session.panel)) {
    ImGui::PushItemWidth(0.6f * ImGui::GetWindowWidth());
    const auto opens = [](const char* name) { return ImGui::CollapsingHeader(name, ImGuiTreeNodeFlags_DefaultOpen); };
    if (opens("Picture")) {
      draw_light(session);
      draw_quality(meter, session);
    }
    if (!pack.light_groups.empty() && opens("Lights")) draw_lights(pack, session);
    if (opens("Places")) draw_places(pack, session);
    if (session.comparison.on() && opens("Beside each other")) draw_comparison(session.comparison);
    if (opens("Under the pointer")) draw_picked(picked);
    if (!pack.movers.empty() && opens("Movers")) draw_movers(pack, session);
    // Of colours the legend is there.
    ImGui::SetNextItemOpen(session.advanced || is_survey(session.frame.show));
    session.advanced = ImGui::CollapsingHeader("Advanced");
    if (session.advanced) {
      draw_advanced(session);
      draw_statistics(meter, pack, session.frame);
    }
    ImGui::PopItemWidth();
  }
  ImGui::End();
}

void draw_key_sheet(const FrameMeter& meter, Session& session) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, 0.5f * size.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  if (ImGui::Begin("Keys", &session.key_sheet, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse) &&
      ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    const auto row = [](const char* name, const char* does) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(name);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(does);
    };
    for (const Binding& binding : key_bindings()) row(binding.keys, binding.does);
    if (meter.gamepad)
      for (const PadBinding& binding : pad_bindings()) row(binding.name, binding.does);
    ImGui::EndTable();
  }
  ImGui::End();
}

// How much of what is wanted is there, in the middle of the lower edge.
void draw_loading_bar(float share) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, size.y - scaled(kMargin)), ImGuiCond_Always, ImVec2(0.5f, 1));
  ImGui::SetNextWindowBgAlpha(0.6f);
  ImGui::Begin("loading", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::ProgressBar(share, ImVec2(scaled(260), 0), fmt::format("loading, {:.0f} %", 100 * share).c_str());
  ImGui::End();
}

}  // namespace

void FrameMeter::add(float frame_ms) {
  ms.push_back(frame_ms);
  if (ms.size() > kKept) ms.pop_front();
}

float FrameMeter::mean_ms() const {
  return ms.empty() ? 0 : std::accumulate(ms.begin(), ms.end(), 0.0f) / static_cast<float>(ms.size());
}

void draw_overlay(const Pack& pack, const FrameMeter& meter, const std::optional<PickedSurface>& picked,
                  Session& session) {
  if (session.presenting) return;
  if (session.comparison.on()) draw_names(session.comparison);
  if (!meter.in_zone && meter.stats.reflectors > 0) draw_line("zone", "reflections were planned for other places", 1);
  if (!meter.message.empty()) draw_line("message", meter.message, 0);
  if (meter.hint > 0 && !session.key_sheet) draw_line("hint", kHint, 0.93f, 0.5f, meter.hint);
  if (meter.loading.busy) draw_loading_bar(meter.loading.share());
  if (!meter.failure.empty()) draw_line("failure", "not all of it can be shown: " + meter.failure, 0.25f);
  if (session.recording)
    draw_line("recording", fmt::format("recording, {:.0f} s; F9 ends it", session.recording->keys.back().time_s), 0.5f);
  if (session.panel) draw_panel(pack, meter, picked, session);
  if (session.key_sheet) draw_key_sheet(meter, session);
}

bool draw_refusal(const std::string& reason) {
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
  ImGui::Begin("refusal", nullptr, ImGuiWindowFlags_NoDecoration);
  ImGui::TextUnformatted("This cannot be shown:");
  ImGui::TextWrapped("%s", reason.c_str());
  const bool closed = ImGui::Button("Close");
  ImGui::End();
  return closed;
}

}  // namespace oriel
