// How finely frames are drawn, by made-up times.
#include "player/session/pace.h"

#include <gtest/gtest.h>

namespace oriel {
namespace {

using Draw = Pace::Draw;

// A device that takes `whole_ms` for a whole frame, and by the pixels for others; motion until `stands_s`.
struct Walk {
  Pace pace;
  float whole_ms = 400;
  double now_s = 0;

  Draw step(bool moves, Quality quality = Quality::kAutomatic, bool altered = false) {
    const Draw draw = pace.next(moves, altered, quality, now_s);
    const float ms = draw == Draw::kKeep    ? 5
                     : draw == Draw::kWhole ? whole_ms
                                            : 0.6f * whole_ms * pace.scale() * pace.scale();
    last_ms = ms;
    pace.took(draw, ms);
    now_s += 1e-3 * ms;
    return draw;
  }
  float last_ms = 0;
};

TEST(PaceTest, AFastDeviceDrawsWholeFramesAndNoneTwice) {
  Walk walk{Pace(), 8};
  for (int i = 0; i < 50; ++i) EXPECT_EQ(walk.step(true), Draw::kWhole);
  EXPECT_EQ(walk.step(false), Draw::kKeep);
  EXPECT_EQ(walk.step(false, Quality::kAutomatic, true), Draw::kWhole) << "an option has changed";
  EXPECT_EQ(walk.step(false), Draw::kKeep);
}

TEST(PaceTest, ASlowOneKeepsFifteenFramesAndIsWholeOnceItStands) {
  for (const bool known : {true, false}) {
    Walk walk{Pace(known), 400};
    for (int i = 0; i < 12; ++i) walk.step(true);
    for (int i = 0; i < 100; ++i) {
      EXPECT_EQ(walk.step(true), Draw::kCoarse);
      EXPECT_LE(walk.last_ms, 1000 / 15.0f);
    }
    const double stopped_s = walk.now_s;
    Draw draw = Draw::kKeep;
    while (walk.now_s < stopped_s + 2 && draw != Draw::kWhole) draw = walk.step(false);
    EXPECT_EQ(draw, Draw::kWhole);
    EXPECT_LE(walk.now_s - stopped_s - 0.4, 0.12) << "before it is drawn";
    EXPECT_EQ(walk.step(false), Draw::kKeep);
    EXPECT_EQ(walk.step(true), Draw::kCoarse);
  }
}

TEST(PaceTest, ItBecomesFinerWhereThereIsRoom) {
  Walk walk{Pace(true), 2000};
  for (int i = 0; i < 60; ++i) walk.step(true);
  const float coarse = walk.pace.scale();
  walk.whole_ms = 150;
  for (int i = 0; i < 200; ++i) walk.step(true);
  EXPECT_GT(walk.pace.scale(), coarse);
  EXPECT_LE(walk.last_ms, 1000 / 15.0f);
}

// Where a finer level shows what takes long, tries of it become rare, instead of one slow frame in ten.
TEST(PaceTest, FinerFramesThatWereTooSlowAreTriedLessOften) {
  Pace pace(true);
  double now_s = 0;
  int slow = 0, frames = 0;
  for (; frames < 2000; ++frames) {
    const Draw draw = pace.next(true, false, Quality::kAutomatic, now_s);
    const float ms = pace.scale() < 0.4f ? 20.0f : 120.0f;
    slow += ms > 1000 / 15.0f ? 1 : 0;
    pace.took(draw, ms);
    now_s += 1e-3 * ms;
  }
  EXPECT_LE(slow, frames / 50);
}

TEST(PaceTest, AsTheUserAsks) {
  Walk walk{Pace(true), 400};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(walk.step(true, Quality::kFull), Draw::kWhole);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(walk.step(true, Quality::kFast), Draw::kCoarse);
  for (int i = 0; i < 200; ++i) EXPECT_NE(walk.step(false, Quality::kFast), Draw::kWhole);
}

}  // namespace
}  // namespace oriel
