// Ways over floors that are drawn as text: '#' nobody stands there, '.' the floor, digits steps of 20 cm.
#include "player/navigation/way.h"

#include <gtest/gtest.h>

namespace oriel {
namespace {

constexpr float kCell = 0.25f;

WalkGrid grid_of(const std::vector<std::string>& rows) {
  WalkGrid grid;
  grid.cell_m = kCell;
  grid.width = static_cast<std::uint32_t>(rows[0].size());
  grid.height = static_cast<std::uint32_t>(rows.size());
  for (const std::string& row : rows)
    for (const char c : row)
      grid.floor_y.push_back(c == '#' ? std::nanf("") : c == '.' ? 0.0f : 0.2f * static_cast<float>(c - '0'));
  return grid;
}

Vec3 at(int x, int z, float y = 0) {
  return {(static_cast<float>(x) + 0.5f) * kCell, y, (static_cast<float>(z) + 0.5f) * kCell};
}
Vec3 eye_at(int x, int z, float y = 0) {
  return at(x, z, y + 1.6f);
}

// Where the walker ends, by the floors' own rules; seconds that it took.
std::pair<Vec3, float> follow(const Floors& floors, Vec3 eye, const std::vector<Vec3>& way, float speed_m_s = 1.4f) {
  Walker walker = start_walking(eye, way, speed_m_s);
  float fall = 0, seconds = 0;
  for (; walker.on() && seconds < 60; seconds += 1 / 60.0f)
    eye = floors.walk(eye, walk_on(walker, eye, 1 / 60.0f), 1 / 60.0f, fall);
  return {eye, seconds};
}

TEST(Ways, StraightWhereNothingStandsInTheWay) {
  const Floors floors({grid_of(std::vector<std::string>(12, std::string(12, '.')))});
  const auto way = find_way(floors, eye_at(1, 1), at(9, 5));
  ASSERT_EQ(way.size(), 1u);
  EXPECT_LT(glm::distance(way[0], eye_at(9, 5)), 1e-5f);
  const auto [end, seconds] = follow(floors, eye_at(1, 1), way);
  EXPECT_LT(glm::distance(end, eye_at(9, 5)), 0.01f);
  EXPECT_NEAR(seconds, glm::distance(at(1, 1), at(9, 5)) / 1.4f, 0.1f);
}

const std::vector<std::string> kMaze{
    "............", "...######...", "........#...", ".######.#...", ".#....#.#...",
    ".#.##.#.#...", ".#.#..#.#...", ".#.####.#...", ".#......#...", ".########...",
};

// Into the middle of the maze and back: every step is one that the floors let through.
TEST(Ways, FindTheWayThroughAMaze) {
  const Floors floors({grid_of(kMaze)});
  const auto way = find_way(floors, eye_at(11, 9), at(4, 6));
  ASSERT_FALSE(way.empty());
  EXPECT_GT(way.size(), 4u);
  const auto [end, seconds] = follow(floors, eye_at(11, 9), way);
  EXPECT_LT(glm::distance(end, eye_at(4, 6)), 0.01f) << "after " << seconds;
  EXPECT_LT(seconds, 7) << "long ways go faster";
  const auto back = find_way(floors, end, at(11, 9));
  EXPECT_LT(glm::distance(follow(floors, end, back).first, eye_at(11, 9)), 0.01f);
}

TEST(Ways, ThereIsNoneThroughWalls) {
  const Floors floors(
      {grid_of({"....#....", "....#....", "....#....", "....#....", "....#....", "....#....", "....#...."})});
  EXPECT_TRUE(find_way(floors, eye_at(0, 0), at(8, 3)).empty());
  EXPECT_FALSE(find_way(floors, eye_at(0, 0), at(4, 3)).empty()) << "the wall's foot: beside it";
  EXPECT_TRUE(find_way(floors, eye_at(0, 0), at(2, 3, 2.5f)).empty()) << "no floor at that height";
  EXPECT_TRUE(find_way(floors, eye_at(0, 0), at(60, 3)).empty());
  EXPECT_TRUE(find_way(Floors({}), eye_at(0, 0), at(1, 1)).empty());
  // Diagonally between two pillars that touch nobody passes.
  const Floors pillars({grid_of({"..#", "..#", "##.", "##."})});
  EXPECT_TRUE(find_way(pillars, eye_at(0, 0), at(2, 3), {0.1f, {}}).empty());
}

TEST(Ways, ClimbStairsAndNotLedges) {
  const Floors stairs({grid_of({"....12345555", "############"})});
  const auto up = find_way(stairs, eye_at(0, 0), at(11, 0, 1));
  ASSERT_FALSE(up.empty());
  EXPECT_NEAR(follow(stairs, eye_at(0, 0), up).first.y, 2.6f, 0.02f);
  const auto down = find_way(stairs, eye_at(11, 0, 1), at(0, 0));
  EXPECT_NEAR(follow(stairs, eye_at(11, 0, 1), down).first.y, 1.6f, 0.02f);
  const Floors ledge({grid_of({"......555555"})});
  EXPECT_TRUE(find_way(ledge, eye_at(0, 0), at(11, 0, 1)).empty());
  EXPECT_TRUE(find_way(ledge, eye_at(11, 0, 1), at(0, 0)).empty()) << "it would be a fall";
}

// A landing in a grid of its own, as storeys have.
TEST(Ways, GoOnInAnotherGrid) {
  const WalkGrid first = grid_of({"....1234"});
  WalkGrid second = grid_of({"5555"});
  second.lower = {8 * kCell, 0};
  const Floors floors({first, second});
  const auto way = find_way(floors, eye_at(0, 0), at(11, 0, 1));
  ASSERT_FALSE(way.empty());
  EXPECT_NEAR(follow(floors, eye_at(0, 0), way).first.x, at(11, 0).x, 0.01f);
}

TEST(Walkers, GiveUpWhereTheyComeNoFurther) {
  Walker walker = start_walking({0, 0, 0}, {{3, 0, 0}}, 1);
  for (int i = 0; i < 100 && walker.on(); ++i) walk_on(walker, {1, 0, 0}, 1 / 60.0f);
  EXPECT_FALSE(walker.on());
}

}  // namespace
}  // namespace oriel
