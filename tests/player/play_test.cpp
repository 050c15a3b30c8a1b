// The program itself: exit codes, files, and the window under a virtual display.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "formats/core/file.h"
#include "formats/image/png.h"
#include "tests/support/exr.h"
#include "tests/support/play_program.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;
using namespace testing;

TEST_F(Play, UsageErrors) {
  EXPECT_TRUE(ends(run("--help"), 0, "Exit codes"));
  EXPECT_TRUE(ends(run("--version"), 0, "oriel-play"));
  EXPECT_TRUE(ends(run(""), 1, "found no PACK"));
  EXPECT_TRUE(ends(run("tiny.oriel --no-such-option"), 1, "--no-such-option"));
  EXPECT_TRUE(ends(run("tiny.oriel --offscreen"), 1, "-o"));
  EXPECT_TRUE(ends(run("tiny.oriel -o a.png"), 1, "--offscreen"));
  EXPECT_TRUE(ends(run("tiny.oriel --offscreen -o a.jpg"), 1, ".jpg"));
  for (const char* bad : {"--size 0x5", "--size 12", "--size 10x10x10", "--exposure bright", "--exposure nan",
                          "--show X", "--maps -1", "--maps many", "--reflections all", "--blur none", "--path",
                          "--stats", "--tonemap filmic", "--size 100000x2", "--frames 0"}) {
    EXPECT_EQ(run(std::string("tiny.oriel --offscreen -o a.png ") + bad).code, 1) << bad;
  }
  for (const char* ignored : {"--frames 2", "--format exr", "--tonemap none", "--show M", "--stats s.json"}) {
    EXPECT_TRUE(ends(run(std::string("tiny.oriel --offscreen --compare a.exr ") + ignored), 1, "--compare")) << ignored;
  }
  const Outcome unknown = run("tiny.oriel --offscreen -o a.png --camera nowhere");
  EXPECT_TRUE(ends(unknown, 1, "nowhere"));
  EXPECT_FALSE(fs::exists(folder() / "a.png"));
}

TEST_F(Play, MoversAreMoved) {
  ASSERT_TRUE(write_pack(folder() / "moving.oriel", tiny_mapped_pack()));
  EXPECT_TRUE(ends(run("moving.oriel --list"), 0, "mover door at"));
  EXPECT_TRUE(ends(run("moving.oriel --offscreen -o a.png --move dor=0,0,0"), 1, "\"door\""));
  EXPECT_TRUE(ends(run("moving.oriel --offscreen -o a.png --move door=0,0"), 1, "NODE=x,y,z"));
  EXPECT_FALSE(fs::exists(folder() / "a.png"));
  for (const char* options : {"--time 0.7", "--move door=1,0,1,45 --time -3", "--mover-lights harmonics"})
    EXPECT_TRUE(ends(run(std::string("moving.oriel --offscreen --size 32x18 -o a.png ") + options), 0, "a.png"));
}

TEST_F(Play, FilesThatAreMissingOrBroken) {
  EXPECT_TRUE(ends(run("absent.oriel --list"), 2, "absent.oriel"));
  EXPECT_TRUE(ends(run("tiny.oriel --offscreen -o no/such/folder/a.png"), 2, "no/such/folder"));
  auto bytes = *read_file(pack());
  const Bytes truncated(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2));
  ASSERT_TRUE(write_file_atomically(folder() / "half.oriel", truncated));
  EXPECT_EQ(run("half.oriel --offscreen -o a.png").code, 3);
  bytes[bytes.size() / 2] ^= std::byte{1};
  ASSERT_TRUE(write_file_atomically(folder() / "flipped.oriel", bytes));
  EXPECT_TRUE(ends(run("flipped.oriel --list"), 3, "section"));
}

TEST_F(Play, Lists) {
  const Outcome r = run("tiny.oriel --list");
  EXPECT_TRUE(ends(r, 0, "camera 0 "));
  EXPECT_NE(r.out.find("path "), std::string::npos) << r.out;
}

TEST_F(Play, OffscreenWritesPicturesOfTheSizeAsked) {
  ASSERT_TRUE(ends(run("tiny.oriel --offscreen --size 33x17 --camera 0 -o a.png"), 0, "33x17"));
  const auto png = read_png(folder() / "a.png");
  ASSERT_TRUE(png) << png.error().text();
  EXPECT_EQ(png->width, 33u);
  EXPECT_EQ(png->height, 17u);
  ASSERT_TRUE(ends(run("tiny.oriel --offscreen --size 33x17 --camera 0 --exposure 5 -o a.exr"), 0, "EV 5.00"));
  const auto exr = read_exr(folder() / "a.exr");
  ASSERT_TRUE(exr) << exr.error().text();
  EXPECT_EQ(exr->width, 33u);
  float brightest = 0;
  for (const float v : exr->pixels) brightest = std::max(brightest, v);
  EXPECT_GT(brightest, 1) << "lit by a hundred lux";
  EXPECT_LT(brightest, 1e4f);
  // The same bytes again.
  const auto first = *read_file(folder() / "a.exr");
  ASSERT_EQ(run("tiny.oriel --offscreen --size 33x17 --camera 0 --exposure 5 -o a.exr").code, 0);
  EXPECT_EQ(first, *read_file(folder() / "a.exr"));
}

TEST_F(Play, SeveralCamerasGoIntoAFolder) {
  ASSERT_TRUE(
      ends(run("tiny.oriel --offscreen --size 16x9 --camera all --camera 0 --format exr -o shots"), 0, "shots/"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder() / "shots"), fs::directory_iterator()), 3);
  EXPECT_TRUE(ends(run("tiny.oriel --offscreen --camera all -o shots.png"), 1, "folder"));
}

TEST_F(Play, EveryStageAndOption) {
  for (const char* options :
       {"--show M", "--show MK", "--show MKR", "--show D", "--show charts", "--tonemap none", "--maps 1", "--blur off",
        "--reflections geometry", "--reflections off", "--exposure -3.5", "--exposure auto"}) {
    EXPECT_TRUE(ends(run(std::string("tiny.oriel --offscreen --size 32x18 -o a.png ") + options), 0, "a.png"))
        << options;
  }
}

// Names that are no UTF-8 come from the file; options are there, so that two files can be told apart.
TEST_F(Play, StatsTellHowTheFramesWereDrawn) {
  Pack named = tiny_pack();
  named.cameras[0].name = "caf\xe9";
  named.provenance = R"({"options": {"eyes": "file", "eye_points": [[1e4, 0, 0]]}})";  // far from any camera
  ASSERT_TRUE(write_pack(folder() / "named.oriel", named));
  ASSERT_EQ(
      run("named.oriel --offscreen --size 32x18 --camera 0 --reflections geometry --blur off --stats s.json").code, 0);
  std::ifstream in(folder() / "s.json");
  std::stringstream text;
  text << in.rdbuf();
  for (const char* found :
       {"\"reflections\": \"geometry\"", "\"blur\": \"off\"", "\"holes\":", "\"in_zone\": false", "caf"})
    EXPECT_NE(text.str().find(found), std::string::npos) << found << " in " << text.str();
}

TEST_F(Play, WithoutADisplayTheWindowSaysWhatToDo) {
  EXPECT_TRUE(ends(run("tiny.oriel"), 4, "--offscreen"));
}

constexpr const char* kWalk = R"({"oriel_path": 1, "name": "walk", "vertical_fov_deg": 60, "keys": [
  {"t": 0, "eye": [1000000, 4.5, -249997], "forward": [0, -0.3, -1]},
  {"t": 0.25, "eye": [1000001, 4.5, -249997], "forward": [0, -0.3, -1]}]})";

TEST_F(Play, AWalkDrawsTheSameFramesAgain) {
  std::ofstream(folder() / "walk.json") << kWalk;
  const std::string along = "tiny.oriel --offscreen --size 33x17 --path walk.json --fps 8 --smooth 0.1 ";
  ASSERT_TRUE(ends(run(along + "-o once"), 0, "3/3"));
  ASSERT_TRUE(ends(run(along + "-o twice"), 0, "3 frames"));
  for (const char* name : {"0000.png", "0001.png", "0002.png"})
    EXPECT_EQ(*read_file(folder() / "once" / name), *read_file(folder() / "twice" / name)) << name;
  EXPECT_NE(*read_file(folder() / "once/0000.png"), *read_file(folder() / "once/0002.png"));
  EXPECT_TRUE(ends(run("tiny.oriel --offscreen --path absent.json -o out"), 2, "absent.json"));
  EXPECT_TRUE(ends(run("tiny.oriel --offscreen --path nowhere -o out"), 1, "nowhere"));
  EXPECT_EQ(run("tiny.oriel --offscreen --path walk.json --video a.mp4 -o out").code, 1);
  EXPECT_EQ(run("tiny.oriel --path walk.json --video a.mp4").code, 1) << "not in a window";
}

TEST_F(Play, WithoutFfmpegAFilmIsPictures) {
  std::ofstream(folder() / "walk.json") << kWalk;
  fs::create_directory(folder() / "empty");
  const Outcome r = run("tiny.oriel --offscreen --size 32x18 --path walk.json --fps 8 --video walk.mp4",
                        "env -u DISPLAY PATH='" + (folder() / "empty").string() + "'");
  EXPECT_TRUE(ends(r, 0, "ffmpeg is not installed"));
  EXPECT_TRUE(fs::exists(folder() / "walk-frames/0002.png"));
  EXPECT_FALSE(fs::exists(folder() / "walk.mp4"));
}

// A stand-in that keeps what it is given; and one that fails.
TEST_F(Play, AFilmGetsEveryFrameOrIsNotThere) {
  std::ofstream(folder() / "walk.json") << kWalk;
  fs::create_directory(folder() / "bin");
  const fs::path ffmpeg = folder() / "bin/ffmpeg";
  const std::string film = "tiny.oriel --offscreen --size 33x17 --path walk.json --fps 8 --video walk.mp4";
  const std::string environment = "env -u DISPLAY PATH='" + (folder() / "bin").string() + "':\"$PATH\"";
  std::ofstream(ffmpeg) << "#!/bin/sh\nfor last; do :; done\nexec cat > \"${last#file:}\"\n";
  fs::permissions(ffmpeg, fs::perms::owner_all);
  ASSERT_TRUE(ends(run(film, environment), 0, "3 frames"));
  EXPECT_EQ(fs::file_size(folder() / "walk.mp4"), 3u * 33 * 17 * 3);
  fs::remove(folder() / "walk.mp4");
  std::ofstream(ffmpeg) << "#!/bin/sh\ncat > /dev/null\nexit 1\n";
  EXPECT_TRUE(ends(run(film, environment), 4, "ffmpeg: failed"));
  for (const auto& entry : fs::directory_iterator(folder())) EXPECT_NE(entry.path().extension(), ".mp4");
}

TEST_F(Play, CompareSeesOneChangedPixel) {
  for (const std::string file : {"a.png", "a.exr"}) {
    ASSERT_EQ(run("tiny.oriel --offscreen --size 33x17 --camera 0 -o " + file).code, 0);
    const std::string compare = "tiny.oriel --offscreen --camera 0 --max-flip 0 --json a.json --compare " + file;
    EXPECT_TRUE(ends(run(compare), 0, " 0 pixels changed")) << file;
    EXPECT_TRUE(ends(shell("cat a.json"), 0, "\"passed\": true"));
    EXPECT_EQ(run(compare + " --size 66x34").code, 1);
    if (file == "a.png") {
      auto picture = *read_png(folder() / file);
      picture.pixels[3 * 100] ^= 128;
      ASSERT_TRUE(write_png(folder() / file, picture));
    } else {
      auto picture = *read_exr(folder() / file);
      picture.pixels[3 * 100] += 100;
      ASSERT_TRUE(write_exr(folder() / file, picture));
    }
    EXPECT_TRUE(ends(run(compare), 5, " 1 pixels changed")) << file;
    EXPECT_TRUE(ends(shell("cat a.json"), 0, "\"passed\": false"));
  }
}

TEST_F(Play, PicturesTellTheirCamera) {
  ASSERT_EQ(run("tiny.oriel --offscreen --size 16x9 --camera 1000000,4.5,-249996,1000000,4.5,-250000 -o a.png").code,
            0);
  const Bytes bytes = *read_file(folder() / "a.png");
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const char* found : {"iTXtoriel.eye", "1000000,4.5,-249996", "oriel.ev100", "oriel.tonemap"})
    EXPECT_NE(text.find(found), std::string::npos) << found;
}

TEST_F(Play, Panoramas) {
  ASSERT_TRUE(ends(run("tiny.oriel --offscreen --size 64x32 --camera all --panorama -o around"), 0, "64x32"));
  ASSERT_EQ(run("tiny.oriel --offscreen --size 64x32 --camera 0 --panorama -o a.exr").code, 0);
  EXPECT_EQ(read_exr(folder() / "a.exr")->width, 64u);
  EXPECT_TRUE(ends(run("tiny.oriel --offscreen --size 64x33 --panorama -o a.exr"), 1, "twice"));
}

TEST_F(PlayWindow, ClosesAfterTheFramesAsked) {
  EXPECT_TRUE(ends(in_display("\"$PLAY\" tiny.oriel --size 160x90 --frames 3\n"), 0, ""));
}

TEST_F(PlayWindow, AnswersKeysAndQuits) {
  const Outcome r = in_display(kStart + R"(
key 2; key F12
hold w
key f; key m; key m; key m; key m; key m; key plus; key x; key p; key p; key F12
resize 200 120; key F12
quit
)");
  EXPECT_TRUE(ends(r, 0, "oriel-002.png"));
  const auto first = read_png(folder() / "oriel-000.png"), second = read_png(folder() / "oriel-001.png"),
             resized = read_png(folder() / "oriel-002.png");
  ASSERT_TRUE(first && second && resized) << r.out;
  EXPECT_EQ(first->width, 160u);
  EXPECT_NE(first->pixels, second->pixels) << "W has moved the camera";
  EXPECT_EQ(resized->width, 200u);
  EXPECT_EQ(resized->height, 120u);
}

// A click on the panel is the panel's; elsewhere it grabs the mouse, which Esc releases before it quits.
TEST_F(PlayWindow, ThePanelKeepsItsClicks) {
  const char* click_and_escape = R"(
key Tab; point "$1" 60; click 1
key F1; key F1
key Escape  # until it is taken, or has ended the player
kill -0 $pid && echo "still there"
kill $pid; wait $pid
)";
  const auto clicked_at = [&](const std::string& x) {
    std::string script = kStart + "set -- " + x + click_and_escape;
    script.replace(script.find("--size 160x90"), 13, "--size 480x300");
    return in_display(script).out;
  };
  EXPECT_EQ(clicked_at("400").find("still there"), std::string::npos);
  EXPECT_NE(clicked_at("60").find("still there"), std::string::npos);
}

// A door that stands, where the sample's turns: its edge may be before the pointer.
Pack pack_with_a_door() {
  Pack pack = tiny_mapped_pack();
  for (Mover& mover : pack.movers) mover.keys.clear();
  return pack;
}

// In the middle of the view there is that.
const std::string kBeforeADoor = [] {
  std::string start = kStart;
  return start.replace(start.find("--size"), 6,
                       "--camera 1000000.15,4.5,-249996,1000000.15,4,-250000 --move door=1000000,3,-250000 --size");
}();

// To the right along its level; then, with R, about itself.
TEST_F(PlayWindow, MoversAreDragged) {
  ASSERT_TRUE(write_pack(folder() / "tiny.oriel", pack_with_a_door()));
  const Outcome r = in_display(kBeforeADoor + R"(
drag 80 45 100 45
press r; drag 100 45 110 45; release r
quit
)");
  EXPECT_EQ(r.code, 0) << r.out;
  double x = 0, y = 1, z = 0, yaw = 1;
  const std::size_t first = r.out.find("--move \"door="), second = r.out.find("--move \"door=", first + 1);
  ASSERT_NE(second, std::string::npos) << r.out;
  ASSERT_EQ(std::sscanf(r.out.c_str() + first, "--move \"door=%lf,%lf,%lf,%lf\"", &x, &y, &z, &yaw), 4);
  EXPECT_GT(x, 1e6 + 0.1);
  EXPECT_EQ(y, 3);
  EXPECT_EQ(yaw, 0);
  double turned_x = 0;
  ASSERT_EQ(std::sscanf(r.out.c_str() + second, "--move \"door=%lf,%lf,%lf,%lf\"", &turned_x, &y, &z, &yaw), 4);
  EXPECT_EQ(turned_x, x);
  EXPECT_NEAR(yaw, 22.5, 1) << "10 of 160 pixels of a full turn";
}

// While a frame takes long all that a hand does waits, and is then done where and in the order in which it was done.
TEST_F(PlayWindow, AHandMayBeFasterThanAFrame) {
  ASSERT_TRUE(write_pack(folder() / "tiny.oriel", pack_with_a_door()));
  const Outcome r = in_display(kBeforeADoor + R"(
during_a_frame() { kill -STOP $pid; "$@"; kill -CONT $pid; }
point 30 20
send 2 0 during_a_frame xdotool mousemove --window "$window" 80 45 mousedown 1 \
  mousemove --window "$window" 100 45 mouseup 1 mousemove --window "$window" 10 10
wait_for shows pointer=10,10; mark
send 4 0 during_a_frame xdotool click --repeat 2 --delay 0 1
wait_for away 0.05; shows grabbed && echo "it has kept the mouse"
quit
)");
  EXPECT_EQ(r.code, 0) << r.out;
  double x = 0, yaw = 1;
  const std::size_t dropped = r.out.find("--move \"door=");
  ASSERT_NE(dropped, std::string::npos) << r.out;
  ASSERT_EQ(std::sscanf(r.out.c_str() + dropped, "--move \"door=%lf,3.000,-250000.000,%lf\"", &x, &yaw), 2);
  EXPECT_NEAR(x, 1000001.07, 0.1) << "as by a slow hand, by the height at which the turning door was taken";
  EXPECT_EQ(r.out.find("it has kept the mouse"), std::string::npos) << "a double click walks there";
}

// A walk into a file; the pack replaced by a broken one, then by a whole one, while it is open.
TEST_F(PlayWindow, RecordsAndLoadsAgain) {
  const Outcome r = in_display(kStart + R"(
key F9; hold w; key F9; key shift+F12
cp tiny.oriel whole; head -c 100 whole > half; mv half tiny.oriel; key F5
mv whole tiny.oriel; key F5
resize 1 1
quit
)");
  EXPECT_TRUE(ends(r, 0, "oriel-000.json: a walk of"));
  EXPECT_TRUE(ends(r, 0, "not loaded again: tiny.oriel"));
  EXPECT_TRUE(ends(r, 0, "tiny.oriel: loaded again"));
  EXPECT_TRUE(fs::exists(folder() / "oriel-000.exr")) << r.out;
  EXPECT_TRUE(ends(run("tiny.oriel --offscreen --size 16x9 --path oriel-000.json --frames 2"), 0, "2 frames"));
}

TEST_F(PlayWindow, ABrokenPackSaysWhyInAWindow) {
  ASSERT_TRUE(write_file_atomically(pack(), Bytes(100)));
  const Outcome r = in_display(std::string(kOpen) + "xdotool key --window \"$window\" space\nwait $pid\n");
  EXPECT_TRUE(ends(r, 3, "tiny.oriel")) << r.out;
}

TEST_F(PlayWindow, TheTitleIsTheScenesName) {
  Pack named = tiny_pack();
  named.provenance = R"({"inputs": [{"name": "villa rotonda.glb", "xxh3_128": ""}]})";
  ASSERT_TRUE(write_pack(pack(), named));
  const Outcome r = in_display(kStart + "xdotool getwindowname \"$window\"; kill -TERM $pid; wait $pid\n");
  EXPECT_TRUE(ends(r, 130, "villa rotonda – Oriel\n")) << r.out;
}

TEST_F(PlayWindow, ControlQQuits) {
  EXPECT_TRUE(ends(in_display(kStart + "xdotool key --window \"$window\" ctrl+q\nwait $pid\n"), 0, ""));
}

TEST_F(PlayWindow, AnInterruptEndsItCleanly) {
  EXPECT_TRUE(ends(in_display(kStart + "kill -TERM $pid\nwait $pid\n"), 130, "stopped by the user"));
}

}  // namespace
}  // namespace oriel
