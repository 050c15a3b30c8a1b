// Which way each reflector is drawn: by the cost of its frames, or as asked.
#include "bake/radiance/ways.h"

#include <gtest/gtest.h>

namespace oriel {
namespace {

ReflectorWay way_of(WaysWanted wanted, DrawnOn target, std::uint64_t triangles, float shown_sr) {
  std::vector<FoundReflector> reflectors(1);
  reflectors[0].shown_sr = shown_sr;
  choose_ways(wanted, target, std::span(&triangles, 1), reflectors);
  EXPECT_FALSE(reflectors[0].why.empty());
  return reflectors[0].way;
}

TEST(Ways, WhatIsAskedForHolds) {
  for (const std::uint64_t triangles : {0ull, 1ull << 40}) {
    EXPECT_EQ(way_of(WaysWanted::kGeometry, DrawnOn::kCpu, triangles, 1), ReflectorWay::kGeometry);
    EXPECT_EQ(way_of(WaysWanted::kMaps, DrawnOn::kCpu, triangles, 1), ReflectorWay::kMaps);
  }
}

// Few triangles are drawn, endless ones are not; there is one crossover, at more triangles where more pixels are seen,
// as maps cost by the pixel.
TEST(Ways, TheCheaperFramesWin) {
  for (const DrawnOn target : {DrawnOn::kCpu, DrawnOn::kGpu}) {
    std::uint64_t before = 0;
    for (const float shown_sr : {0.01f, 0.05f, 0.5f, 2.0f}) {
      EXPECT_EQ(way_of(WaysWanted::kAuto, target, 1000, shown_sr), ReflectorWay::kGeometry);
      std::uint64_t crossover = 1000;
      while (way_of(WaysWanted::kAuto, target, crossover, shown_sr) == ReflectorWay::kGeometry) {
        crossover += crossover / 4;
        ASSERT_LT(crossover, 1ull << 50);
      }
      EXPECT_EQ(way_of(WaysWanted::kAuto, target, 2 * crossover, shown_sr), ReflectorWay::kMaps);
      EXPECT_GE(crossover, before);
      before = crossover;
    }
  }
}

}  // namespace
}  // namespace oriel
