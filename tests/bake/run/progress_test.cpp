// Nobody looks at a silent program: whatever it does, a line comes.
#include "bake/cli/progress.h"
#include "formats/core/json.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace oriel {
namespace {

using Style = ProgressPrinter::Style;

// What is printed by `work`, and then while nothing is told for a while.
template <class Work>
std::string printed(Style style, const Work& work) {
  testing::internal::CaptureStderr();
  {
    ProgressPrinter printer(style);
    work(printer);
    std::this_thread::sleep_for(std::chrono::duration<double>(1.5 * ProgressPrinter::kSilence));
  }
  return testing::internal::GetCapturedStderr();
}

TEST(ProgressPrinter, SaysThatItReadsBeforeAnythingIsTold) {
  for (const Style style : {Style::kPlain, Style::kBar, Style::kJson})
    EXPECT_NE(printed(style, [](auto&) {}).find("reading the scene"), std::string::npos);
}

TEST(ProgressPrinter, ATaskThatTellsNothingIsNamed) {
  const std::string text = printed(Style::kPlain, [](ProgressPrinter& p) { p({"charts", 0, 0}); });
  EXPECT_NE(text.find("charts"), std::string::npos) << text;
  EXPECT_NE(text.find("so far"), std::string::npos) << text;
}

TEST(ProgressPrinter, BetweenTasksTheLastOneIsNamed) {
  const std::string text = printed(Style::kPlain, [](ProgressPrinter& p) { p({"charts", 1, 0}); });
  EXPECT_NE(text.find("after charts"), std::string::npos) << text;
}

TEST(ProgressPrinter, WhatEndsSoonHasOneLine) {
  testing::internal::CaptureStderr();
  {
    ProgressPrinter printer(Style::kPlain);
    for (const double f : {0.0, 0.3, 0.6, 1.0}) printer({"paths", f, 0});
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST(ProgressPrinter, AWarningIsToldOnce) {
  testing::internal::CaptureStderr();
  {
    ProgressPrinter printer(Style::kQuiet);
    for (const char* text : {"a", "b", "a", "a"}) printer.warning(text);
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

// One number for the whole work, which does not jump; none where nobody knows.
TEST(ProgressPrinter, TimeLeftIsThatOfTheWhole) {
  testing::internal::CaptureStderr();
  {
    ProgressPrinter printer(Style::kJson);
    printer({"charts", 1, 0});
    for (const double left : {100.0, 300.0, 95.0}) {  // an estimate that jumps is not passed on as it is
      printer({"gather", 0, 0, left});
      printer({"gather", 1, 0, left});
    }
  }
  std::istringstream in(testing::internal::GetCapturedStderr());
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

TEST(ProgressPrinter, QuietIsQuiet) {
  EXPECT_EQ(printed(Style::kQuiet, [](ProgressPrinter& p) { p({"charts", 0, 0}); }), "");
}

}  // namespace
}  // namespace oriel
