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

class PlayWindow : public Play {
 protected:
  void SetUp() override {
    Play::SetUp();
    if (std::system("command -v xvfb-run >/dev/null && command -v xdotool >/dev/null") != 0) {
      GTEST_SKIP() << "xvfb-run or xdotool is not installed";
    }
  }
  // Runs a script with $PLAY and $PACK under a virtual display.
  Outcome in_display(const std::string& script) {
    std::ofstream(folder() / "script.sh")
        << "PLAY='" << (std::filesystem::path(ORIEL_BIN_DIR) / "oriel-play").string() << "'\n"
        << script;
    // Without -noreset the server signals xvfb-run anew when the last window closes, while that cleans up.
    return shell("xvfb-run -a -s '-screen 0 640x480x24 -noreset' bash script.sh");
  }
};

// Opens the window, and waits until all is loaded: input of half a second may fall into one frame before that.
inline constexpr const char* kStart = R"(
"$PLAY" tiny.oriel --size 160x90 & pid=$!
window=$(timeout 30 xdotool search --sync --onlyvisible --pid $pid --name Oriel | head -1)
[ -n "$window" ] || { echo "no window"; kill $pid; exit 99; }
xdotool windowfocus "$window"
for i in $(seq 100); do grep -q "all images" log && break; sleep 0.1; done
sleep 0.5
)";

}  // namespace oriel::testing
