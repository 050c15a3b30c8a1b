// Each line of the sheet of keys, pressed in a window: what it does is what it says.
#include <map>

#include "formats/image/png.h"
#include "formats/query/camera.h"
#include "formats/query/camera_notes.h"
#include "player/navigation/controller.h"
#include "player/navigation/path_file.h"
#include "player/session/keys.h"
#include "tests/support/play_program.h"

namespace oriel {
namespace {
using namespace testing;

class Keys : public PlayWindow {
 protected:
  // The tiny pack with a floor to walk on, from the wall at z = -2 to z = 2.
  void SetUp() override {
    PlayWindow::SetUp();
    Pack walked = tiny_pack();
    WalkGrid grid;
    grid.lower = {-2, -2};
    grid.cell_m = 0.25f;
    grid.width = grid.height = 16;
    grid.floor_y.assign(256, 0.0f);
    walked.walk_grids = {grid};
    // Its path ends when no test looks any more.
    CameraKey last = walked.paths[0].keys.back();
    last.time_s = 1000;
    walked.paths[0].keys.push_back(last);
    origin_ = walked.mesh.origin;
    ASSERT_TRUE(write_pack(pack(), walked));
    for (LightmapPage& page : walked.lightmaps)
      for (Vec3& e : page.irradiance) e *= 0.5f;
    ASSERT_TRUE(write_pack(folder() / "dark.oriel", walked));
  }
  // Of a screenshot that the script has taken by `shot NAME`.
  Camera camera_of(const std::string& name) const {
    const auto notes = read_png_texts(folder() / (name + ".png"));
    const auto camera = notes ? camera_of_notes(*notes, origin_) : std::nullopt;
    EXPECT_TRUE(camera) << name;
    return camera.value_or(Camera());
  }
  // m/s, the fastest of the steps of a walk that the script has `recorded NAME`: a key may be held for any time.
  float speed_of(const std::string& name) const {
    const auto walk = read_path(folder() / (name + ".json"), origin_);
    EXPECT_TRUE(walk) << name;
    float fastest = 0;
    for (std::size_t k = 1; walk && k < walk->keys.size(); ++k) {
      const CameraKey &from = walk->keys[k - 1], &to = walk->keys[k];
      const float step_s = std::min(to.time_s - from.time_s, MoveOptions().max_step_s);
      if (step_s > 0) fastest = std::max(fastest, glm::distance(from.eye, to.eye) / step_s);
    }
    return fastest;
  }
  Vec3 moved(const std::string& from, const std::string& to) const { return camera_of(to).eye - camera_of(from).eye; }

  DVec3 origin_{0};
};

// What a line of the sheet is tried by: shell commands, and what is said then.
struct Try {
  const char* script;
  const char* says = "";
};

const std::map<std::string, Try> kTries{
    {"W A S D", {"shot start; hold w; shot w; hold s; shot s; hold a; shot a; hold d; shot d"}},
    {"Q E", {"key f; shot flying; hold e; shot e; hold q; shot q", "flying"}},
    {"mouse, arrows",
     {"key Home; hold Right; shot right; hold Up; shot up; key Home; point 40 20; click 1; wait_for shows grabbed; "
      "mark; "
      "for i in 1 2 3 4; do xdotool mousemove_relative -- -15 8; done; wait_for away 0.06; key Escape; shot looked; "
      "point 30 30; shot released"}},
    {"Backspace", {"key BackSpace", "nothing moves here"}},
    {"double click",
     {"key Home; point 60 70; mark; send 4 0 xdotool click --repeat 2 --delay 10 1; arrive; shot went; "
      "key Home; mark; click 2; arrive; shot middle"}},
    {"G", {"key Home; hold Down 0.6; mark; key g; arrive; shot g"}},
    {"F", {"key f; key f", "walking"}},
    {"O", {"key Home; key o; hold Left; shot orbit; key o; key f; key f", "around a point"}},
    {"1 to 9", {"key 2; shot camera; key 9", "there is no camera 9"}},
    {"C", {"key 1; key c; shot next", "camera 2: "}},
    {"Home", {"key Home; shot home", "where it began"}},
    {"P", {"key p; mark; wait_for away 0.1; shot path; key p", "the path is stopped"}},
    // After P, which plays the walk recorded last.
    {"F9",
     {"key Home; recorded usual hold w; key Home; press shift; recorded fast hold w; release shift; "
      "key Home; point 40 20; send 8 0 xdotool click --repeat 8 --delay 5 5; "
      "recorded slow hold w; send 8 0 xdotool click --repeat 8 --delay 5 4",
      "oriel-000.json: a walk of"}},
    {"Shift", {"true"}},
    {"wheel", {"true"}},
    {"+", {"key 1; key x; key minus; key minus; key plus", "EV "}},
    {"-", {"key minus", "EV "}},
    {"X", {"key x", "automatic exposure"}},
    {"M", {"key m; key m; key m; key m; key m; key m; key m; key m; key m", "stage charts"}},
    {"B", {"key b", "tiny.oriel beside dark.oriel"}},
    {"V", {"key v; key v", "oriel-play: dark.oriel"}},
    {"Tab", {"key Tab; key Tab", "panel closed"}},
    // Its Escape ends the presentation and not the player.
    {"F11",
     {"key F11; wait_for shows size=640x480; shot presenting; key Escape; wait_for shows size=160x90; shot presented"}},
    {"F1", {"key F1; key F1", "keys closed"}},
    {"F12", {"shot picture", "picture"}},
    {"Shift-F12", {"key shift+F12", "oriel-000.exr"}},
    {"F5", {"key F5", "tiny.oriel: loaded again"}},
    {"Esc, Ctrl-Q", {"xdotool key --window $window ctrl+q; wait $pid; echo \"ended $?\"", "ended 0"}},
    // In tests of their own.
    {"drag a mover", {"true"}},
    {"L, drag a lamp", {"true"}},
};

constexpr const char* kShell = R"(
try() { echo "== $1"; line=$(wc -l < log); }
# Until it is said since then.
told() { tail -n +$line log | grep -qF -- "$1"; }
said() { wait_for told "$1"; }
# On a walk that has begun.
arrive() { wait_for away 0.3; wait_for shows still; }
# What is done meanwhile, as the window records it.
recorded() { key F9; "${@:2}"; key F9; mv oriel-000.json $1.json; }
shot() { key F12; mv oriel-000.png $1.png; echo "$1"; }
)";

TEST_F(Keys, DoWhatTheirSheetSays) {
  std::string script = kStart;
  script.replace(script.find("tiny.oriel"), 10, "tiny.oriel dark.oriel --camera 0");
  script += kShell;
  for (const Binding& binding : key_bindings()) {
    ASSERT_TRUE(kTries.contains(binding.keys)) << binding.keys << " is never pressed";
    const Try& tried = kTries.at(binding.keys);
    script += "try '" + std::string(binding.keys) + "'\n" + tried.script + "\nsaid '" + tried.says + "'\n";
  }
  EXPECT_EQ(kTries.size(), key_bindings().size());
  const Outcome r = in_display(script);
  std::string said = r.out;
  for (const auto& [keys, tried] : kTries) {
    const std::size_t from = said.find("== " + keys + "\n");
    ASSERT_NE(from, std::string::npos) << keys << " in " << r.out;
    const std::string part = said.substr(from, said.find("\n== ", from) - from);
    EXPECT_NE(part.find(tried.says), std::string::npos) << tried.says << " in " << part;
  }
  ASSERT_EQ(r.out.find("No such file"), std::string::npos) << r.out;

  // Camera 0 looks along -z.
  EXPECT_LT(moved("start", "w").z, -0.1f);
  EXPECT_GT(moved("w", "s").z, 0.1f);
  EXPECT_LT(moved("s", "a").x, -0.1f);
  EXPECT_GT(moved("a", "d").x, 0.1f);
  EXPECT_GT(moved("flying", "e").y, 0.1f);
  EXPECT_LT(moved("e", "q").y, -0.1f);
  const float usual = speed_of("usual");
  EXPECT_GT(usual, 0);
  EXPECT_NEAR(speed_of("fast"), MoveOptions().fast_factor * usual, 0.02f * usual);
  EXPECT_NEAR(speed_of("slow"), std::pow(MoveOptions().wheel_factor, -8) * usual, 0.02f * usual)
      << "eight notches slower";
  EXPECT_GT(camera_of("right").forward.x, 0.1f);
  EXPECT_GT(camera_of("up").forward.y, 0.1f);
  EXPECT_LT(camera_of("looked").forward.x, -0.05f) << "to the left";
  EXPECT_LT(camera_of("looked").forward.y, -0.02f) << "and down";
  EXPECT_EQ(camera_of("released").forward, camera_of("looked").forward);
  for (const char* walked : {"went", "middle", "g"}) EXPECT_LT(moved("home", walked).z, -0.3f) << walked;
  EXPECT_NEAR(camera_of("went").eye.y, 1.6f, 0.05f);
  const Camera orbit = camera_of("orbit");
  EXPECT_GT(glm::distance(orbit.eye, camera_of("home").eye), 0.1f);
  EXPECT_GT(glm::dot(orbit.forward, camera_of("home").forward), 0.5f);
  // The point on the wall, z = -2, stays in the middle of the view.
  const Vec3 centre = camera_of("home").eye + (camera_of("home").eye.z + 2) * Vec3(0, 0, -1);
  EXPECT_LT(glm::distance(glm::normalize(centre - orbit.eye), orbit.forward), 0.01f);
  EXPECT_GT(moved("home", "camera").x + moved("home", "camera").y, 0.0f) << "the second camera";
  EXPECT_EQ(camera_of("next").eye, camera_of("camera").eye);
  EXPECT_EQ(camera_of("home").eye, camera_of("start").eye);
  EXPECT_LT(moved("home", "path").z, -0.05f);
  EXPECT_EQ(read_png(folder() / "presenting.png")->width, 640u) << "the screen's";
  EXPECT_EQ(read_png(folder() / "presented.png")->width, 160u) << "the window's";
}

// Taken off the screen and put back: it waits and goes on. A window of one pixel, and one larger than the screen.
TEST_F(Keys, TheWindowMayGoAwayAndComeBack) {
  const Outcome r = in_display(kStart + kShell + R"(
key plus; wait_for shows still  # exposure by hand: an eye adapts for long
shot before
ticks() { awk '{print $14 + $15}' /proc/$pid/stat; }
slept() { awk '/^voluntary/ {print $2}' /proc/$pid/status; }
woke() { (($(slept) >= $1)); }
xdotool windowunmap "$window"; wait_for shows hidden
before=$(ticks); wait_for woke $(($(slept) + 20)); after=$(ticks)
xdotool windowmap --sync "$window"; xdotool windowfocus "$window"; wait_for ready; wait_for shows still
frames=$(grep -A1 ' hidden$' log | awk '{print $3}' | tr '\n' ' ')
echo "hidden $((after - before)) ticks, frames $frames"
shot back
for size in "1 1" "1 300" "5000 2" "700 500"; do resize $size; done
point 100 50
xdotool windowmove -- "$window" -500 -400; wait_for shows pointer=600,450
xdotool windowmove "$window" 0 0; wait_for shows pointer=100,50
shot large
quit
)");
  ASSERT_TRUE(ends(r, 0, "large"));
  const std::size_t at = r.out.find("hidden ");
  ASSERT_NE(at, std::string::npos) << r.out;
  int ticks = 100, last = 0, next = 0;
  ASSERT_EQ(std::sscanf(r.out.c_str() + at, "hidden %d ticks, frames %d %d", &ticks, &last, &next), 3);
  EXPECT_LE(ticks, 10) << "of CPU time, while it woke twenty times: it has nothing to do while nobody sees it";
  EXPECT_EQ(next, last + 1) << "and draws nothing";
  EXPECT_EQ(read_png(folder() / "before.png")->pixels, read_png(folder() / "back.png")->pixels);
  EXPECT_EQ(read_png(folder() / "large.png")->width, 700u);
}

}  // namespace
}  // namespace oriel
