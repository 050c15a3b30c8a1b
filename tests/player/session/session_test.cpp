// Keys, their sheet, and what they change.
#include "player/session/session.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

class SessionTest : public ::testing::Test {
 protected:
  void press(Action action, std::size_t camera = 0) { perform({action, camera}, pack_, session_); }
  const Pack pack_ = testing::tiny_pack();
  Session session_;
};

TEST(Keys, EachActionHasOneLineAndNoKeyTwo) {
  std::set<Action> actions;
  std::set<std::string> keys;
  for (const Binding& binding : key_bindings()) {
    EXPECT_TRUE(keys.insert(binding.keys).second) << binding.keys;
    if (binding.action == Action::kHeld) continue;
    EXPECT_TRUE(actions.insert(binding.action).second) << binding.keys;
    EXPECT_NE(key_help().find(binding.does), std::string::npos);
  }
  EXPECT_EQ(actions.size(), static_cast<std::size_t>(Action::kCamera)) << "all but kHeld";
}

// docs/oriel-play.md has a row for each line of the sheet, in its order, and none more.
TEST(Keys, TheDocsHaveTheSameTable) {
  std::ifstream in(std::filesystem::path(ORIEL_SOURCE_DIR) / "docs/oriel-play.md");
  ASSERT_TRUE(in);
  std::vector<std::string> rows;
  std::string line;
  while (std::getline(in, line) && line != "| keys | |") {
  }
  while (std::getline(in, line) && line != "## Options")
    if (line.starts_with("| ")) rows.push_back(line.substr(2, line.find(" | ") - 2));
  std::vector<std::string> expected;
  for (const Binding& binding : key_bindings()) expected.emplace_back(binding.keys);
  expected.emplace_back("gamepad");
  for (const PadBinding& binding : pad_bindings()) expected.emplace_back(binding.name);
  EXPECT_EQ(rows, expected);
}

TEST_F(SessionTest, CamerasAndHome) {
  session_.home.eye = {1, 2, 3};
  press(Action::kCamera, 1);
  EXPECT_EQ(session_.camera.eye, pack_.cameras.at(1).eye);
  press(Action::kCamera, 99);
  EXPECT_EQ(session_.camera.eye, pack_.cameras.at(1).eye) << "there is no such camera";
  press(Action::kHome);
  EXPECT_EQ(session_.camera.eye, Vec3(1, 2, 3));
}

TEST_F(SessionTest, StagesComeRound) {
  std::set<Show> shown;
  for (int i = 0; i < kShows; ++i) {
    shown.insert(session_.frame.show);
    press(Action::kStage);
  }
  EXPECT_EQ(shown.size(), static_cast<std::size_t>(kShows));
  EXPECT_EQ(session_.frame.show, Show::kAll);
}

TEST_F(SessionTest, ThePathEndsAndACameraStopsIt) {
  press(Action::kPlayPath);
  EXPECT_LT(session_.path_time_s, 0) << "there is none yet";
  take_path(pack_, session_);
  press(Action::kPlayPath);
  EXPECT_GE(session_.path_time_s, 0);
  move_on({}, Floors({}), 1e6f, session_);
  EXPECT_LT(session_.path_time_s, 0);
  press(Action::kPlayPath);
  press(Action::kCamera);
  EXPECT_LT(session_.path_time_s, 0);
}

TEST_F(SessionTest, ARecordedWalkPlays) {
  session_.camera.eye = {0, 1, 0};
  press(Action::kRecord);
  session_.move.fly = true;
  MoveInput ahead;
  ahead.forward = true;
  for (int i = 0; i < 4; ++i) move_on(ahead, Floors({}), 0.25f, session_);
  const Vec3 end = session_.camera.eye;
  ASSERT_NE(end, Vec3(0, 1, 0));
  press(Action::kRecord);
  ASSERT_TRUE(session_.recorded);
  EXPECT_FALSE(session_.recording);
  EXPECT_EQ(session_.recorded->keys.back().eye, end);
  press(Action::kHome);
  press(Action::kPlayPath);
  move_on({}, Floors({}), 0.5f, session_);
  EXPECT_LT(glm::length(session_.camera.eye - 0.5f * (Vec3(0, 1, 0) + end)), 1e-3f);
}

// At once on the first frame, then e-fold in 0.3 s, and in 0.7 s where it gets dark; a slow frame counts 0.1 s. Steps
// of a third from where it stands; X gives it back.
TEST_F(SessionTest, ExposureAdaptsUntilItIsSet) {
  adapt_exposure(6.0f, 0.1f, session_);
  EXPECT_EQ(session_.shown_ev100, 6);
  for (int i = 0; i < 3; ++i) adapt_exposure(8.0f, 0.1f, session_);
  EXPECT_NEAR(session_.shown_ev100, 8 - 2 * std::exp(-1.0f), 1e-5f);
  adapt_exposure(std::nullopt, 0.3f, session_);
  EXPECT_NEAR(session_.shown_ev100, 8 - 2 * std::exp(-1.0f), 1e-5f);
  const float before = session_.shown_ev100;
  press(Action::kBrighter);
  adapt_exposure(12.0f, 1, session_);
  EXPECT_NEAR(session_.shown_ev100, before - 1 / 3.0f, 1e-5f);
  press(Action::kAutoExposure);
  adapt_exposure(12.0f, 0.1f, session_);
  EXPECT_EQ(session_.shown_ev100, 12);
  for (int i = 0; i < 7; ++i) adapt_exposure(9.0f, 1, session_);
  EXPECT_NEAR(session_.shown_ev100, 9 + 3 * std::exp(-1.0f), 1e-4f);
  session_.metered = false;
  adapt_exposure(-12.0f, 0.1f, session_);
  EXPECT_EQ(session_.shown_ev100, -4) << "the night stays dark";
}

}  // namespace
}  // namespace oriel
