// Nobody looks at a silent program: whatever it does, a line comes.
#include "bake/cli/progress.h"
#include "formats/core/json.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/support/temporary_folder.h"
#include "tests/support/waiting.h"

namespace oriel {
namespace {

using Style = ProgressPrinter::Style;

// stderr goes into a file, which can be read meanwhile.
class Captured {
 public:
  Captured() {
    std::fflush(stderr);
    const int file = ::open(path().c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, STDERR_FILENO);
    ::close(file);
  }
  ~Captured() {
    std::fflush(stderr);
    ::dup2(before_, STDERR_FILENO);
    ::close(before_);
  }
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;
  std::string text() const {
    std::fflush(stderr);
    std::ifstream in(path());
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  std::string path() const { return folder_.path() / "stderr"; }
  testing::TemporaryFolder folder_;
  int before_ = ::dup(STDERR_FILENO);
};

// What is printed by `work`, and then, while nothing is told, until `due` is said.
template <class Work>
std::string printed(Style style, const std::string& due, const Work& work) {
  const Captured captured;
  ProgressPrinter printer(style);
  work(printer);
  testing::wait_until([&] { return captured.text().find(due) != std::string::npos; });
  return captured.text();
}

TEST(ProgressPrinter, SaysThatItReadsBeforeAnythingIsTold) {
  for (const Style style : {Style::kPlain, Style::kBar, Style::kJson})
    EXPECT_NE(printed(style, "reading the scene", [](auto&) {}).find("reading the scene"), std::string::npos);
}

TEST(ProgressPrinter, ATaskThatTellsNothingIsNamed) {
  const std::string text = printed(Style::kPlain, "so far", [](ProgressPrinter& p) { p({"charts", 0, 0}); });
  EXPECT_NE(text.find("charts"), std::string::npos) << text;
  EXPECT_NE(text.find("so far"), std::string::npos) << text;
}

TEST(ProgressPrinter, BetweenTasksTheLastOneIsNamed) {
  const std::string text = printed(Style::kPlain, "after charts", [](ProgressPrinter& p) { p({"charts", 1, 0}); });
  EXPECT_NE(text.find("after charts"), std::string::npos) << text;
}

TEST(ProgressPrinter, WhatEndsSoonHasOneLine) {
  ::testing::internal::CaptureStderr();
  {
    ProgressPrinter printer(Style::kPlain);
    for (const double f : {0.0, 0.3, 0.6, 1.0}) printer({"paths", f, 0});
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST(ProgressPrinter, AWarningIsToldOnce) {
  ::testing::internal::CaptureStderr();
  {
    ProgressPrinter printer(Style::kQuiet);
    for (const char* text : {"a", "b", "a", "a"}) printer.warning(text);
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

// One number for the whole work, which does not jump; none where nobody knows.
TEST(ProgressPrinter, TimeLeftIsThatOfTheWhole) {
  ::testing::internal::CaptureStderr();
  {
    ProgressPrinter printer(Style::kJson);
    printer({"charts", 1, 0});
    for (const double left : {100.0, 300.0, 95.0}) {  // an estimate that jumps is not passed on as it is
      printer({"gather", 0, 0, left});
      printer({"gather", 1, 0, left});
    }
  }
  std::istringstream in(::testing::internal::GetCapturedStderr());
  std::string line;
  ASSERT_TRUE(std::getline(in, line));
  EXPECT_TRUE(Json::parse(line).value()["seconds_left"].is_null()) << line;
  double left = 100;
  int lines = 0;
  for (; std::getline(in, line); ++lines) {
    const double now = Json::parse(line).value()["seconds_left"].get<double>();
    EXPECT_LE(now, left) << line;
    left = now;
  }
  EXPECT_GE(lines, 3);
  EXPECT_GT(left, 90);
}

// Until another one beside it, which knows of nothing, has become impatient.
TEST(ProgressPrinter, QuietIsQuiet) {
  const Captured captured;
  ProgressPrinter quiet(Style::kQuiet), other(Style::kPlain);
  quiet({"charts", 0, 0});
  EXPECT_TRUE(testing::wait_until([&] { return !captured.text().empty(); }));
  EXPECT_EQ(captured.text().find("charts"), std::string::npos);
  EXPECT_TRUE(captured.text().starts_with("reading the scene")) << captured.text();
}

}  // namespace
}  // namespace oriel
