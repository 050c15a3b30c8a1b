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
     {"key Home; hold Right; shot right; hold Up; shot up; key Home; xdotool mousemove --window $window 40 20 click 1; "
      "pause; for i in 1 2 3 4; do xdotool mousemove_relative -- -15 8; sleep 0.05; done; key Escape; shot looked; "
      "xdotool mousemove --window $window 30 30; pause; shot released"}},
    {"Backspace", {"key BackSpace", "nothing moves here"}},
    {"double click",
     {"key Home; xdotool mousemove --window $window 60 70; pause; xdotool click --repeat 2 --delay 60 1; sleep 1; shot "
      "went; "
      "key Home; xdotool click 2; sleep 1; shot middle"}},
    {"G", {"key Home; hold Down; hold Down; key g; sleep 1; shot g"}},
    {"F", {"key f; key f", "walking"}},
    {"O", {"key Home; key o; hold Left; shot orbit; key o; key f; key f", "around a point"}},
    {"1 to 9", {"key 2; shot camera; key 9", "there is no camera 9"}},
    {"C", {"key 1; key c; shot next", "camera 2: "}},
    {"Home", {"key Home; shot home", "where it began"}},
    {"P", {"key p; sleep 0.4; shot path; key p", "the path is stopped"}},
    // After P, which plays the walk recorded last.
    {"F9",
     {"key Home; recorded usual hold w; key Home; xdotool keydown shift; recorded fast hold w; xdotool keyup shift; "
      "key Home; xdotool mousemove --window $window 40 20; xdotool click --repeat 8 --delay 5 5; pause; "
      "recorded slow hold w; xdotool click --repeat 8 --delay 5 4",
      "oriel-000.json: a walk of"}},
    {"Shift", {"true"}},
    {"wheel", {"true"}},
    {"+", {"key 1; key x; sleep 0.5; key minus; key minus; key plus", "EV "}},
    {"-", {"key minus", "EV "}},
    {"X", {"key x", "automatic exposure"}},
    {"M", {"key m; key m; key m; key m; key m; key m; key m; key m; key m; key m; key m", "stage zones"}},
    {"B", {"key b", "tiny.oriel beside dark.oriel"}},
    {"V", {"key v; key v", "oriel-play: dark.oriel"}},
    {"N", {"key n; key b", "FLIP between tiny.oriel and dark.oriel"}},
    {"Tab", {"key Tab; key Tab", "panel closed"}},
    // Its Escape ends the presentation and not the player.
    {"F11", {"key F11; sleep 0.5; shot presenting; key Escape; sleep 0.5; shot presented"}},
    {"F1", {"key F1; key F1", "keys closed"}},
    {"F12", {"shot picture", "picture"}},
    {"Shift-F12", {"key shift+F12; pause", "oriel-000.exr"}},
    {"F5", {"key F5; pause", "tiny.oriel: loaded again"}},
    {"Esc, Ctrl-Q", {"xdotool key --window $window ctrl+q; wait $pid; echo \"ended $?\"", "ended 0"}},
    // In tests of their own.
    {"drag a mover", {"true"}},
    {"L, drag a lamp", {"true"}},
};

constexpr const char* kShell = R"(
try() { echo "== $1"; line=$(wc -l < log); }
# Until it is said since then, on a machine however slow.
said() { for i in $(seq 100); do tail -n +$line log | grep -qF -- "$1" && break; sleep 0.1; done; }
pause() { sleep 0.15; }
key() { xdotool key --window "$window" "$@"; pause; }
hold() { xdotool keydown --window "$window" "$1"; sleep 0.2; xdotool keyup --window "$window" "$1"; pause; }
# What is done meanwhile, as the window records it.
recorded() {
  key F9; "${@:2}"; key F9
  for i in $(seq 100); do [ -s oriel-000.json ] && break; sleep 0.03; done
  mv oriel-000.json $1.json
}
shot() {
  xdotool key --window "$window" F12
  for i in $(seq 100); do [ -s oriel-000.png ] && break; sleep 0.03; done
  sleep 0.05; mv oriel-000.png $1.png; echo "$1"
}
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
  const Outcome r = in_display(std::string(kStart) + kShell + R"(
key plus; sleep 0.5  # exposure by hand: an eye still adapts after the first frame
shot before
xdotool windowunmap --sync "$window"; sleep 0.5
before=$(awk '{print $14 + $15}' /proc/$pid/stat); sleep 0.5; after=$(awk '{print $14 + $15}' /proc/$pid/stat)
echo "hidden $((after - before)) ticks"
xdotool windowmap --sync "$window"; xdotool windowfocus "$window"; sleep 0.3
shot back
for size in "1 1" "1 300" "5000 2" "700 500"; do xdotool windowsize "$window" $size; sleep 0.2; done
xdotool windowmove "$window" -- -500 -400; sleep 0.2; xdotool windowmove "$window" 0 0; sleep 0.2
shot large
key Escape
wait $pid
)");
  ASSERT_TRUE(ends(r, 0, "large"));
  const std::size_t at = r.out.find("hidden ");
  ASSERT_NE(at, std::string::npos) << r.out;
  int ticks = 100;
  ASSERT_EQ(std::sscanf(r.out.c_str() + at, "hidden %d ticks", &ticks), 1);
  EXPECT_LE(ticks, 10) << "of some 50: it draws nothing while nobody sees it";
  EXPECT_EQ(read_png(folder() / "before.png")->pixels, read_png(folder() / "back.png")->pixels);
  EXPECT_EQ(read_png(folder() / "large.png")->width, 700u);
}

}  // namespace
}  // namespace oriel
