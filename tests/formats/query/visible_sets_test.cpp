// What a place may see is looked up, and what is not known is not guessed.
#include "formats/query/visible_sets.h"

#include <gtest/gtest.h>

#include <limits>

namespace oriel {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

// A row of six cells of 1 m from x = 0 at z = 0 to 1, the fourth of which is no floor; eyes at 1.5 m.
WalkGrid row() {
  return {{0, 0}, 1, 6, 1, {0, 0, 0, kNone, 0, 0}, 1.5f};
}

// Eye cells of two walk cells: x from 0 to 2, 2 to 4 and 4 to 6 m. Each sees the group of its own number.
VisibleSets own_groups() {
  VisibleSets sets;
  sets.groups = 3;
  sets.runs = {{3, 0}, {3, 1}, {3, 2}};
  sets.side = 2;
  sets.below_m = 0.4f;
  sets.above_m = 0.2f;
  sets.seen = {1, 2, 4};
  return sets;
}

using Seen = std::vector<std::uint8_t>;

TEST(VisibleSets, EyeCellsAreNumberedWherePeopleStand) {
  const std::vector<WalkGrid> grids{row(), {{0, 0}, 1, 2, 3, {kNone, kNone, kNone, kNone, kNone, 7}, 1.5f}};
  const EyeCells cells = number_eye_cells(grids, 2);
  EXPECT_EQ(cells.count, 4u);
  EXPECT_EQ(cells.of_walk_cell[0], (std::vector<std::int32_t>{0, 0, 1, -1, 2, 2}));
  EXPECT_EQ(cells.of_walk_cell[1], (std::vector<std::int32_t>{-1, -1, -1, -1, -1, 3}));
  EXPECT_EQ(number_eye_cells(grids, 1).count, 6u);
  EXPECT_EQ(number_eye_cells(grids, 32768).count, 2u);
}

TEST(VisibleSets, AnEyeHasTheSetsOfAllCellsAroundIt) {
  const std::vector<WalkGrid> grids{row()};
  const VisibleSets sets = own_groups();
  const SeenGroups groups(sets, grids);
  EXPECT_EQ(groups.from({0.5f, 1.5f, 0.5f}), (Seen{1, 0, 0}));
  EXPECT_EQ(groups.from({1.5f, 1.5f, 0.5f}), (Seen{1, 1, 0})) << "a cell beside the next eye cell";
  EXPECT_EQ(groups.from({3.5f, 1.5f, 0.5f}), (Seen{0, 1, 1})) << "on no floor, beside two";
  EXPECT_EQ(groups.from({5.5f, 1.5f, 1.9f}), (Seen{0, 0, 1})) << "beside the grid";
}

TEST(VisibleSets, ElsewhereAllMayBeSeen) {
  const std::vector<WalkGrid> grids{row()};
  const VisibleSets sets = own_groups();
  const SeenGroups groups(sets, grids);
  EXPECT_FALSE(groups.from({0.5f, 1.75f, 0.5f})) << "too high";
  EXPECT_FALSE(groups.from({0.5f, 1.05f, 0.5f})) << "too low";
  EXPECT_TRUE(groups.from({0.5f, 1.15f, 0.5f}));
  EXPECT_FALSE(groups.from({0.5f, 1.5f, 2.1f})) << "more than a cell beside the grid";
  EXPECT_FALSE(groups.from({-1.1f, 1.5f, 0.5f}));
  EXPECT_FALSE(groups.from({kNone, 1.5f, 0.5f}));
  EXPECT_FALSE(groups.from({std::numeric_limits<float>::infinity(), 1.5f, 0.5f}));
  EXPECT_FALSE(SeenGroups().from({0.5f, 1.5f, 0.5f}));
}

TEST(VisibleSets, KnowWhatTheyWereMadeFor) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2};
  mesh.parts = {{"wall", 0, 3, 0}};
  const std::vector<Material> materials(1);
  const std::vector<WalkGrid> grids{row()};
  VisibleSets sets = own_groups();
  EXPECT_FALSE(made_for(sets, mesh, materials, grids));
  sets.made_for = visibility_hash(mesh, materials, grids);
  EXPECT_TRUE(made_for(sets, mesh, materials, grids));
  auto glass = materials;
  glass[0].transmission = 0.5f;
  EXPECT_FALSE(made_for(sets, mesh, glass, grids));
  Mesh split = mesh;
  split.parts[0].index_count = 0;
  EXPECT_FALSE(made_for(sets, split, materials, grids));
  Mesh turned = mesh;
  turned.indices = {1, 2, 0};
  EXPECT_FALSE(made_for(sets, turned, materials, grids));
  auto lower = grids;
  lower[0].floor_y[3] = 0;
  EXPECT_FALSE(made_for(sets, mesh, materials, lower));
}

}  // namespace
}  // namespace oriel
