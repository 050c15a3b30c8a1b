// oriel-play as a program: in a folder of its own with a small pack, and in a window under a virtual display.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "formats/pack/writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_pack.h"

namespace oriel::testing {

struct Outcome {
  int code = -1;
  std::string out;  // stdout and stderr together
};

class Play : public ::testing::Test {
 protected:
  void SetUp() override {
    const Status written = write_pack(pack(), tiny_pack());
    ASSERT_TRUE(written) << written.error().text();
  }
  std::filesystem::path folder() const { return folder_.path(); }
  std::filesystem::path pack() const { return folder_.path() / "tiny.oriel"; }

  // Shell words after the program's path, in the temporary folder, with DISPLAY unset unless `environment` sets it.
  Outcome run(const std::string& arguments, const std::string& environment = "env -u DISPLAY -u WAYLAND_DISPLAY") {
    const std::string program = (std::filesystem::path(ORIEL_BIN_DIR) / "oriel-play").string();
    return shell(environment + " '" + program + "' " + arguments);
  }
  Outcome shell(const std::string& command) {
    const std::filesystem::path log = folder() / "log";
    const int status = std::system(("cd '" + folder().string() + "' && " + command + " > log 2>&1").c_str());
    std::ifstream in(log);
    std::stringstream text;
    text << in.rdbuf();
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text.str()};
  }
  ::testing::AssertionResult ends(const Outcome& r, int code, const std::string& says) {
    if (r.code == code && r.out.find(says) != std::string::npos) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "exit " << r.code << ", expected " << code << " and '" << says
                                         << "' in: " << r.out;
  }

 private:
  TemporaryFolder folder_;
};

// What a script can do with the window. Each waits until the player says, by --log-frames, that a frame shows it: never
// for a time, for a busy machine may take any. $shown is the last such line.
inline constexpr const char* kHands = R"(
look() { shown=$(grep -a '^oriel-play: frame ' log | tail -n 1); }
# Until a command succeeds, which may ask $shown; or until the player has ended.
wait_for() {
  local end=$((SECONDS + 60))
  while ((SECONDS < end)); do
    look; "$@" && return
    kill -0 $pid 2>/dev/null || return 1
    sleep 0.02
  done
  echo "waited in vain for: $*, while there was: $shown"; kill $pid; exit 98
}
# A word of the line, as a pattern of the shell.
shows() { [[ "$shown " == *" "$1" "* ]]; }
ready() { shows focused && ! shows loading; }
counts() { [[ $shown =~ inputs=([0-9]+)\ held=(-?[0-9]+) ]]; }
taken() { counts && ((BASH_REMATCH[1] >= $1 && BASH_REMATCH[2] == $2)); }
# Of a command: so many ups and downs of keys and buttons and turns of the wheel at least, and so many more of them down then.
send() {
  wait_for counts
  local inputs=$((BASH_REMATCH[1] + $1)) held=$((BASH_REMATCH[2] + $2))
  "${@:3}"; wait_for taken $inputs $held
}
key() { send 2 0 xdotool key --window "$window" "$1"; }
press() { send 1 1 xdotool keydown --window "$window" "$1"; }
release() { send 1 -1 xdotool keyup --window "$window" "$1"; }
click() { send 2 0 xdotool click "$1"; }
point() { xdotool mousemove --window "$window" "$1" "$2"; wait_for shows "pointer=$1,$2"; }
resize() { xdotool windowsize "$window" "$1" "$2"; wait_for shows "size=$1x$2"; }
# From one place to another of the window.
drag() { point "$1" "$2"; send 1 1 xdotool mousedown 1; point "$3" "$4"; send 1 -1 xdotool mouseup 1; }
quit() { xdotool key --window "$window" Escape; wait_for false; wait $pid; }
# How far eye and direction together have come since the mark: metres, and the length between unit vectors.
mark() { look; from=$shown; }
view() { [[ $1 =~ eye=([^ ]*)\ forward=([^ ]*) ]] && echo "${BASH_REMATCH[1]},${BASH_REMATCH[2]}"; }
away() {
  { view "$from"; view "$shown"; } | awk -F, -v far="$1" '
    NR == 1 { split($0, was) } NR == 2 { for (i = 1; i <= 6; ++i) sum += ($i - was[i])^2; exit sum < far^2 }'
}
hold() { mark; press "$1"; wait_for away "${2:-0.15}"; release "$1"; }
)";

class PlayWindow : public Play {
 protected:
  void SetUp() override {
    Play::SetUp();
    if (!has_display()) GTEST_SKIP() << "xvfb-run or xdotool is not installed";
  }
  static bool has_display() {
    return std::system("command -v xvfb-run >/dev/null && command -v xdotool >/dev/null") == 0;
  }
  // Runs a script with $PLAY and those hands under a virtual display.
  Outcome in_display(const std::string& script) {
    std::ofstream(folder() / "script.sh")
        << "PLAY='" << (std::filesystem::path(ORIEL_BIN_DIR) / "oriel-play").string() << "'\n"
        << kHands << script;
    // Without -noreset the server signals xvfb-run anew when the last window closes, while that cleans up.
    // Tests beside this one look for a free display at the same time: each begins elsewhere.
    return shell("xvfb-run -a -n $((100 + $$ % 30000)) -s '-screen 0 640x480x24 -noreset' bash script.sh");
  }
};

// Opens the window.
inline constexpr const char* kOpen = R"(
"$PLAY" tiny.oriel --size 160x90 --log-frames & pid=$!
window=$(timeout 60 xdotool search --sync --onlyvisible --pid $pid --name Oriel | head -1)
[ -n "$window" ] || { echo "no window"; kill $pid; exit 99; }
)";
// And waits until it has the keyboard, all is loaded.
inline const std::string kStart = std::string(kOpen) + R"(
xdotool windowfocus "$window"
wait_for ready
)";

}  // namespace oriel::testing
