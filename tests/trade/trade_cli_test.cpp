// oriel-bake trade as a user meets it.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <regex>
#include <set>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "tests/support/temporary_folder.h"

namespace oriel::trade {
namespace {
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class TradeCli : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(run("oriel-scenes cornell -o cornell.glb"), 0) << text("log"); }
  int run(const std::string& command) const { return shell(fmt::format("'{}'/{}", ORIEL_BIN_DIR, command)); }
  int shell(const std::string& command) const {
    const int status = std::system(fmt::format("cd '{}' && ({}) >log 2>&1", folder_.path().string(), command).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  std::string text(const std::string& name) const {
    const auto bytes = read_file(folder_.path() / name);
    return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
  }
  oriel::testing::TemporaryFolder folder_;
};

TEST_F(TradeCli, StopsGoesOnAndRunsNothingTwice) {
  const std::string sweep = "oriel-bake trade cornell.glb -o out --quick --texel 10cm";
  // Stopped by a signal once a part is finished: what is finished stays, and is told of.
  const std::string until_second =
      "until grep -q '^2 of ' log || ! kill -0 $!; do sleep 0.1; done; kill -TERM $!; ! wait $!";
  ASSERT_EQ(shell(fmt::format("'{}'/{} & {}", ORIEL_BIN_DIR, sweep, until_second)), 0) << text("log");
  EXPECT_THAT(text("log"), HasSubstr("the same command goes on"));
  ASSERT_EQ(run(sweep), 0) << text("log");
  EXPECT_THAT(text("log"), HasSubstr(" 0 left"));
  EXPECT_THAT(text("log"), ::testing::Not(HasSubstr(" 0 found finished")));
  const std::string log = text("log");
  std::smatch last;
  EXPECT_TRUE(std::regex_search(log, last, std::regex("\n([0-9]+) of \\1: [^\n]*\n(?![0-9]+ of )")))
      << "all were counted";
  const auto json = Json::parse(text("out/trade.json")).value();
  EXPECT_EQ(json["unfinished"], 0);
  std::set<std::string> knobs;
  for (const auto& row : json["configurations"]) {
    knobs.insert(row["knob"].get<std::string>());
    EXPECT_FALSE(row.contains("failure")) << row.dump();
    if (row["knob"] == "no bake") {
      EXPECT_LT(row["bake"]["seconds"].get<double>(), 60) << row.dump();
      EXPECT_LT(row["all_frames"]["sum"].get<double>(), 1) << row.dump();
      EXPECT_FALSE(row["all_frames"].contains("D")) << row.dump();
    } else if (row["paths"] == 0) {
      EXPECT_LT(row["texels"]["relRMSE"].get<double>(), 0.3) << row.dump();
    }
  }
  EXPECT_THAT(knobs,
              ::testing::ElementsAre("default", "error", "no bake", "reference estimator", "reference paths", "texel"))
      << "no reflector, no knobs of reflections";
  EXPECT_FALSE(json["fronts"]["texels_by_bake"]["configurations"].empty());
  EXPECT_THAT(text("out/trade.html"), HasSubstr("</html>"));
  ASSERT_EQ(run(sweep), 0) << text("log");
  EXPECT_THAT(text("log"), HasSubstr(" 0 parts run"));
}

TEST_F(TradeCli, RefusesWhatItCannotDo) {
  EXPECT_EQ(run("oriel-bake trade none.glb -o out"), 2) << text("log");
  EXPECT_EQ(run("oriel-bake trade cornell.glb"), 1);
  EXPECT_EQ(run("oriel-bake trade cornell.glb -o cornell.glb"), 2) << "a file is in the way";
  EXPECT_EQ(run("oriel-bake trade cornell.glb -o out --time 5"), 1) << "no unit";
  EXPECT_NE(run("oriel-bake trade cornell.glb -o out --quick --texel 10cm --camera nobody"), 0);
  EXPECT_THAT(text("log"), HasSubstr("nobody"));
}

}  // namespace
}  // namespace oriel::trade
