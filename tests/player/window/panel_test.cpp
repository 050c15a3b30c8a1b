// The panel under a mouse, without a window: every place of it is clicked, and what that changes is what is offered.
#include "player/window/panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <map>
#include <set>

#include "player/session/option_names.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

constexpr float kWidth = 360, kHeight = 1300;

// What the panel may change, as text.
std::map<std::string, std::string> state_of(const Session& s) {
  return {{"panel", s.panel ? "open" : "closed"},
          {"exposure", s.manual_ev100 ? "manual" : "auto"},
          {"quality", name_of(kQualities, s.quality)},
          {"curve", name_of(kToneCurves, s.curve)},
          {"stage", name_of(kStages, s.frame.show)},
          {"reflections", name_of(kReflections, s.frame.reflections)},
          {"maps", std::to_string(s.frame.maps_per_element)},
          {"blur", name_of(kBlurs, s.frame.blur)},
          {"their light", name_of(kMoverLights, s.frame.mover_lights)},
          {"moves", std::to_string(s.moves.size())},
          {"visible sets", s.frame.visible_sets ? "on" : "off"},
          {"fly", s.move.fly ? "on" : "off"},
          {"path", s.path_time_s >= 0 ? "plays" : "stands"},
          {"recording", s.recording ? "on" : "off"},
          {"eye", fmt::format("{:.2f} {:.2f} {:.2f}", s.camera.eye.x, s.camera.eye.y, s.camera.eye.z)},
          {"beside", std::to_string(static_cast<int>(s.comparison.beside))},
          {"divider", fmt::format("{:.1f}", s.comparison.divider)}};
}

// A panel of its own for each row of clicks.
class Panel {
 public:
  explicit Panel(const Pack& pack, ImFontAtlas& fonts) : pack_(pack), context_(ImGui::CreateContext(&fonts)) {
    ImGui::SetCurrentContext(context_);
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().DisplaySize = ImVec2(kWidth, kHeight);
    ImGui::GetIO().DeltaTime = 1.0f;  // no double clicks
    session_.panel = session_.advanced = true;
    session_.home.eye = {7, 7, 7};
    session_.path = pack.paths.at(0);
    session_.moves.resize(1);
    session_.comparison.second = "b.oriel";
    FrameOptions& frame = session_.frame;
    frame.poses.resize(pack.movers.size());
    for (int i = 0; i < 3; ++i) draw();
    before_ = state_of(session_);
  }
  ~Panel() { ImGui::DestroyContext(context_); }
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  void click(const Vec2& at) {
    ImGui::GetIO().MousePos = ImVec2(at.x, at.y);
    draw();
    ImGui::GetIO().MouseDown[0] = true;
    draw();
    ImGui::GetIO().MouseDown[0] = false;
    draw();
    draw();
  }
  bool offers_a_list() const {
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  }
  // "name: value" of what has changed since it was opened.
  std::set<std::string> changes() const {
    std::set<std::string> out;
    for (const auto& [name, value] : state_of(session_))
      if (before_.at(name) != value) out.insert(name + ": " + value);
    return out;
  }

 private:
  void draw() {
    ImGui::NewFrame();
    draw_overlay(pack_, meter_, std::nullopt, session_);
    ImGui::Render();
  }

  const Pack& pack_;
  ImGuiContext* context_;
  Session session_;
  FrameMeter meter_;
  std::map<std::string, std::string> before_;
};

TEST(Panels, EveryPlaceIsClicked) {
  const testing::TemporaryFolder folder;  // "keep" writes where the program runs
  std::filesystem::current_path(folder.path());
  const Pack pack = testing::tiny_mapped_pack();
  ImFontAtlas fonts;
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  fonts.GetTexDataAsRGBA32(&pixels, &width, &height);
  std::set<std::string> reached;
  std::size_t most_at_once = 0;
  const auto take = [&](const Panel& panel) {
    const auto changes = panel.changes();
    most_at_once = std::max(most_at_once, changes.size());
    reached.insert(changes.begin(), changes.end());
    return !changes.empty();
  };
  for (float y = 4; y < kHeight; y += 9)
    for (const float x : {25.0f, 60.0f, 100.0f, 140.0f, 180.0f, 220.0f, 260.0f, 300.0f, 338.0f}) {
      bool list = false;
      {
        Panel panel(pack, fonts);
        panel.click({x, y});
        list = !take(panel) && panel.offers_a_list();
      }
      if (!list || x != 60) continue;
      for (float down = -250; down < 250; down += 11) {
        Panel panel(pack, fonts);
        panel.click({x, y});
        panel.click({x, y + down});
        take(panel);
      }
    }

  std::set<std::string> expected{"panel: closed", "exposure: manual", "visible sets: off",   "fly: on",
                                 "path: plays",   "recording: on",    "eye: 7.00 7.00 7.00", "moves: 0",
                                 "beside: 1",     "beside: 2"};
  const auto add = [&](const std::string& name, const auto& names, const std::string& initial) {
    for (const auto& [value, each] : names)
      if (value != initial) expected.insert(name + ": " + value);
  };
  add("quality", kQualities, "auto");
  add("curve", kToneCurves, "aces");
  add("stage", kStages, "all");
  add("reflections", kReflections, "chosen");
  add("blur", kBlurs, "distance");
  add("their light", kMoverLights, "shadowed");
  for (const Camera& camera : pack.cameras)
    expected.insert(fmt::format("eye: {:.2f} {:.2f} {:.2f}", camera.eye.x, camera.eye.y, camera.eye.z));
  for (const std::string& change : expected) EXPECT_TRUE(reached.contains(change)) << change;
  for (const char* slider : {"maps: ", "divider: "})
    EXPECT_TRUE(std::any_of(reached.begin(), reached.end(), [&](const auto& c) { return c.starts_with(slider); }))
        << slider;
  EXPECT_EQ(most_at_once, 1u) << "nothing changes two things";
}

}  // namespace
}  // namespace oriel
