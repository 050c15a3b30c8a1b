// What programs say of their options: pages, completion, values and where they come from.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include <fmt/format.h>

#include "bake/run/option_table.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

namespace fs = std::filesystem;

std::string page_text(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Options : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("oriel-options-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  // Runs a line of bash; its output, and its exit code in code_.
  std::string run(const std::string& line) {
    std::ofstream(folder_ / "script") << line;
    const std::string command =
        "cd '" + folder_.string() + "' && PATH='" ORIEL_BIN_DIR "':\"$PATH\" bash script >log 2>&1";
    code_ = WEXITSTATUS(std::system(command.c_str()));
    return page_text(folder_ / "log");
  }

  fs::path folder_;
  int code_ = 0;
};

// With ORIEL_UPDATE_DOCS set the page is written instead.
TEST_F(Options, PagesHoldTheTablesOfTheirPrograms) {
  for (const std::string program : {"oriel-bake", "oriel-preview"}) {
    const fs::path file = fs::path(ORIEL_SOURCE_DIR) / "docs" / (program + ".md");
    const std::string page = page_text(file), made = fmt::format("\n{}", run(program + " --options-page"));
    const std::string begin = fmt::format("<!-- Made by {} --options-page; a test compares. -->\n", program),
                      end = "<!-- end -->";
    const std::size_t from = page.find(begin) + begin.size(), to = page.find(end);
    ASSERT_LE(from, to);
    ASSERT_NE(to, std::string::npos);
    if (std::getenv("ORIEL_UPDATE_DOCS") != nullptr)
      std::ofstream(file) << page.substr(0, from) << made << page.substr(to);
    else
      EXPECT_EQ(page.substr(from, to - from), made)
          << "ORIEL_UPDATE_DOCS=1 build/release/bin/run_test --gtest_filter=Options.* writes the page";
  }
}

TEST_F(Options, ThePageOfThePlayerNamesThem) {
  const std::string page = page_text(fs::path(ORIEL_SOURCE_DIR) / "docs/oriel-play.md");
  std::istringstream rows(run("oriel-play --options-page"));
  const std::regex name("^\\| `(--[a-z-]+|[A-Z]+).*");
  int seen = 0;
  std::smatch match;
  for (std::string row; std::getline(rows, row);)
    if (std::regex_match(row, match, name)) {
      ++seen;
      EXPECT_NE(page.find(match[1]), std::string::npos) << match[1] << " is not told of";
    }
  EXPECT_GT(seen, 30);
}

TEST_F(Options, BashCompletesNamesAndValues) {
  const auto complete = [&](const std::string& words, int at) {
    return run("source <(oriel-bake --completion bash); COMP_WORDS=(" + words + "); COMP_CWORD=" + std::to_string(at) +
               "; _oriel_bake; echo \"${COMPREPLY[@]}\"");
  };
  EXPECT_EQ(complete("oriel-bake --at", 1), "--atlas\n");
  EXPECT_EQ(complete("oriel-bake --atlas u", 2), "uv1\n");
  EXPECT_EQ(complete("oriel-bake lux --gr", 2), "--grid\n");
  EXPECT_EQ(complete("oriel-bake lux --at", 2), "\n") << "an option of the bake alone";
  EXPECT_EQ(complete("oriel-bake ren", 1), "render\n");
}

TEST_F(Options, ValuesAreListedWithTheirSource) {
  std::ofstream(folder_ / "draft") << "# for a first look\n--texel 20cm\n--error=10%\n--hidden-black\n";
  const std::string list = run("oriel-bake --preset draft --error 5% --print-options | tr -s ' '");
  EXPECT_NE(list.find("--texel 0.2m preset\n"), std::string::npos) << list;
  EXPECT_NE(list.find("--error 5% command line\n"), std::string::npos) << list;
  EXPECT_NE(list.find("--hidden-black on preset\n"), std::string::npos) << list;
  EXPECT_NE(list.find("--views 8 default\n"), std::string::npos) << list;
  std::ofstream(folder_ / "draft") << "--texel 20cm\n--eror 10%\n";
  EXPECT_NE(run("oriel-bake a.glb -o b --preset draft").find("draft:2: found '--eror 10%'"), std::string::npos);
  EXPECT_EQ(code_, 1);
  run("oriel-bake a.glb -o b --preset nowhere");
  EXPECT_EQ(code_, 2);
}

TEST_F(Options, TheNearestIsNamedAndRareOnesAreInHelpAll) {
  EXPECT_NE(run("oriel-bake a.glb -o b --texl 5cm").find("the nearest are \"--texel\""), std::string::npos);
  EXPECT_EQ(code_, 1);
  const std::string help = run("oriel-bake --help"), all = run("oriel-bake --help-all");
  EXPECT_NE(help.find("--texel "), std::string::npos);
  EXPECT_EQ(help.find("--bounces "), std::string::npos);
  EXPECT_NE(all.find("--bounces "), std::string::npos);
  EXPECT_NE(all.find("Exit codes"), std::string::npos);
}

TEST_F(Options, ThePreviewTellsOfThoseThatDoNothing) {
  const std::string said =
      run("oriel-preview none.glb --offscreen -o a.exr --frames 3 --pack b.oriel --ev 5 "
          "--tonemap none --sky-scale 2 --sky-rotation 90 --passes 2");
  for (const char* idle : {"--frames", "--pack", "--ev", "--tonemap", "--sky-scale", "--sky-rotation"})
    EXPECT_NE(said.find(std::string(idle) + " has no effect: "), std::string::npos) << idle;
  EXPECT_EQ(said.find("--passes has no effect"), std::string::npos);
}

// What get() tells, set() takes: else --print-options lists what cannot be asked for.
TEST_F(Options, ValuesCanBeGivenAsTheyAreListed) {
  BakeOptions options = command_line_defaults();
  options.memory_given = true;
  options.memory_bytes = 3u << 20;
  options.time_s = 90;
  options.radiosity.samples = 16;
  for (const Option& option : bake_options(options)) {
    const std::string value = option.value.get();
    if (value.empty() || option.value.type.empty() || long_name(option) == "--resolution") continue;
    EXPECT_TRUE(option.value.set(value)) << option.name << " " << value;
    EXPECT_EQ(option.value.get(), value) << option.name;
  }
  EXPECT_EQ(options.memory_bytes, 3u << 20);
}

TEST_F(Options, TheRecordHoldsEveryOption) {
  const auto record = Json::parse(options_json(command_line_defaults(), 7)).value();
  EXPECT_EQ(record["seed"], 7);
  EXPECT_EQ(record["texel_m"], "auto");
  EXPECT_EQ(record["views_per_element"], 8);
  EXPECT_EQ(record["map_memory"], 128 << 20);
  BakeOptions options = command_line_defaults();
  for (const Option& option : bake_options(options)) {
    Json one = Json::object();
    oriel::record(option, one);
    EXPECT_FALSE(one.empty()) << option.name << " can change a pack and is not recorded";
  }
}

}  // namespace
}  // namespace oriel
