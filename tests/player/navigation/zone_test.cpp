// Where a pack's reflections were planned for, however the baker was told.
#include "player/navigation/zone.h"

#include <gtest/gtest.h>

#include <limits>

namespace oriel {
namespace {

// 10 m of room; cells of 1 m of which one can be stood on, at (2.5, 2.5); a camera at (8, 1.2, 8).
Pack room(const std::string& options) {
  Pack pack;
  pack.mesh.origin = {100, 0, 0};
  pack.mesh.positions = {{0, 0, 0}, {10, 3, 10}};
  pack.provenance = "{\"options\": " + options + "}";
  Camera camera;
  camera.eye = {8, 1.2f, 8};
  pack.cameras = {camera};
  return pack;
}

WalkGrid one_cell() {
  WalkGrid grid;
  grid.cell_m = 1;
  grid.width = grid.height = 3;
  grid.floor_y.assign(9, std::numeric_limits<float>::quiet_NaN());
  grid.floor_y[8] = 0;
  return grid;
}

TEST(Zone, OfPeopleIsTheirFloorsAndTheCameras) {
  Pack pack = room(R"({"eyes": "walk", "eye_points": []})");
  pack.walk_grids = {one_cell()};
  const Zone zone = planned_zone(pack);
  EXPECT_TRUE(zone.holds({2.5f, 1.6f, 2.5f}));
  EXPECT_TRUE(zone.holds({1.5f, 1.2f, 2.5f})) << "a cell aside";
  EXPECT_FALSE(zone.holds({0.5f, 1.6f, 2.5f}));
  EXPECT_FALSE(zone.holds({2.5f, 2.2f, 2.5f}));
  EXPECT_TRUE(zone.holds({8, 1.2f, 8})) << "a camera that maps are planned for";
  EXPECT_FALSE(zone.holds({7, 1.2f, 8}));
}

TEST(Zone, OfAFileIsItsEyes) {
  Pack pack = room(R"({"eyes": "file", "eye_points": [[101, 2, 3], [104, 2, 3]]})");  // world space
  const Zone zone = planned_zone(pack);
  EXPECT_TRUE(zone.holds({1, 2, 3}));
  EXPECT_TRUE(zone.holds({4.2f, 2.2f, 3.2f}));
  EXPECT_FALSE(zone.holds({2.5f, 2, 3}));
  EXPECT_FALSE(zone.holds({8, 1.2f, 8})) << "a camera that maps are not planned for";
}

TEST(Zone, OfABoxIsTheScene) {
  const Zone zone = planned_zone(room(R"({"eyes": "box"})"));
  EXPECT_TRUE(zone.holds({0.1f, 2.9f, 9.9f}));
  EXPECT_FALSE(zone.holds({0.1f, 3.1f, 9.9f}));
  Pack bare = room(R"({"eyes": "walk"})");  // no floor: the cameras; without these any place
  EXPECT_FALSE(planned_zone(bare).holds({2, 1, 2}));
  bare.cameras.clear();
  EXPECT_TRUE(planned_zone(bare).holds({2, 1, 2}));
  EXPECT_FALSE(planned_zone(bare).holds({-2, 1, 2}));
}

TEST(Zone, OfAPackThatDoesNotSay) {
  for (const char* text : {"", "{", "[]", "null", "{\"options\": 3}", "{\"options\": {\"eyes\": 7}}"}) {
    Pack pack = room("{}");
    pack.provenance = text;
    EXPECT_TRUE(planned_zone(pack).holds({-50, 0, 0})) << text;
    pack.walk_grids = {one_cell()};
    EXPECT_TRUE(planned_zone(pack).holds({2.5f, 1.6f, 2.5f})) << text;
    EXPECT_FALSE(planned_zone(pack).holds({8, 1.2f, 8})) << text;
  }
  const Pack odd = room(R"({"eyes": "file", "eye_points": [1, [2], ["a", 1, 2], [101, 2, 3]]})");
  EXPECT_EQ(planned_zone(odd).eyes.size(), 1u);
  Pack empty = room(R"({"eyes": "box"})");
  empty.mesh.positions.clear();
  EXPECT_TRUE(planned_zone(empty).holds({1, 2, 3}));
}

}  // namespace
}  // namespace oriel
