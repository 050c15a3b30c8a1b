// One estimate for a whole bake, by made-up times; and what of it is told.
#include "bake/run/forecast.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/cli/countdown.h"
#include "bake/radiosity/estimators/progress_estimate.h"

namespace oriel {
namespace {

TEST(ForecastTest, NobodyKnowsBeforeTheLightIsForetold) {
  Forecast forecast;
  forecast.at("views", 0, 1);
  EXPECT_FALSE(forecast.left(1));
  forecast.expect("first light", 10);
  EXPECT_FALSE(forecast.left(1)) << "views have not said how far they are";
  forecast.at("views", 0.5, 3);
  ASSERT_TRUE(forecast.left(3));
  // As long again for the views; light, refinement, detail and verification by the light.
  EXPECT_NEAR(*forecast.left(3), 2 + 10 + 18 + 11 + 0.12 * 28, 1e-9);
}

TEST(ForecastTest, WhatPartsTookTellsTheOthers) {
  Forecast forecast;
  forecast.expect("first light", 10);
  forecast.at("first light", 0, 0);
  forecast.at("refinement", 0, 40);  // four times as long as foretold
  forecast.expect("radiance", 7);
  EXPECT_NEAR(*forecast.left(40), 72 + 44 + 0.12 * 112 + 7, 1e-9);
  forecast.at("refinement", 0.5, 60);
  EXPECT_NEAR(*forecast.left(60), 20 + 44 + 0.12 * 112 + 7, 1e-9) << "half of it took 20 s";
  forecast.at("nobody's", 0.9, 70);
  EXPECT_NEAR(*forecast.left(70), 10 + 44 + 0.12 * 112 + 7, 1e-9) << "it goes on by the clock";
  forecast.at("writing", 1, 100);
  EXPECT_NEAR(*forecast.left(100), 0, 1e-9);
}

// Error falls as the inverse of the work: a goal of a quarter takes four times the work.
TEST(ProgressEstimateTest, IsExactForAPower) {
  ProgressEstimate progress(0.25, 100, HUGE_VAL);
  EXPECT_EQ(progress.fraction(0, 1), 0);
  EXPECT_NEAR(progress.fraction(100, 100.0 / 200), 100.0 / 300, 1e-9);
  EXPECT_NEAR(progress.fraction(200, 100.0 / 300), 200.0 / 300, 1e-9);
  EXPECT_EQ(progress.fraction(300, 0.25), 1);
}

TEST(ProgressEstimateTest, RaysMayEndBefore) {
  ProgressEstimate progress(1e-9, 100, 50);
  EXPECT_NEAR(progress.fraction(0, 1), 0, 1e-9);
  EXPECT_NEAR(progress.fraction(25, 1), 0.5, 1e-9) << "nothing fell";
  EXPECT_NEAR(progress.fraction(50, 1), 1, 1e-9);
}

// Whatever the estimate does, what is told only falls, and is right before half of the time is over once the estimate
// is.
TEST(CountdownTest, OnlyFallsAndMeetsTheTruth) {
  for (const double wrong : {0.5, 1.0, 2.0, 3.0}) {
    Countdown countdown;
    double last = 1e9;
    for (double now = 0; now < 100; now += 0.5) {
      const double estimate = (now < 20 ? wrong : 1.0) * (100 - now);
      const double told = countdown.tell(estimate, now);
      EXPECT_LE(told, last);
      EXPECT_LE(last - told, now > 0 ? 16 * 0.5 + 1e-9 : 1e9) << "no jumps";
      last = told;
      if (now >= (wrong < 1 ? 75 : 50) && now < 98) {
        EXPECT_NEAR(told / (100 - now), 1, 0.25) << wrong << " at " << now;
      }
    }
  }
}

// A minute's work that turns out to be ten is told so: not as a second that lasts for nine.
TEST(CountdownTest, RisesWhereItWasFarOff) {
  Countdown countdown;
  double told = 0;
  for (double now = 0; now < 100; now += 0.5) told = countdown.tell((now < 50 ? 60 : 600) - now, now);
  EXPECT_NEAR(told / 500, 1, 0.05);
}

}  // namespace
}  // namespace oriel
