// Cells of the scene for movers' shade: they divide space, and hold what they say.
#include "player/movers/shade_cells.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/player/passes/random_boxes.h"

namespace oriel {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool lies_in(const Bounds& box, const Vec3& p) {
  return glm::all(glm::lessThanEqual(box.lower, p)) && glm::all(glm::lessThanEqual(p, box.upper));
}
bool belongs_to(const Bounds& cell, const Vec3& p) {
  return glm::all(glm::lessThanEqual(cell.lower, p)) && glm::all(glm::lessThan(p, cell.upper));
}
std::size_t leaves_of(const std::vector<ShadeCell>& cells) {
  return static_cast<std::size_t>(std::ranges::count(cells, 0u, &ShadeCell::child));
}

TEST(ShadeCells, DivideSpace) {
  RandomBoxes scene(1);
  scene.furnish({6, 2, 4}, 20);
  const auto cells = make_shade_cells(scene.triangles, {0.3f, 300});
  EXPECT_EQ(leaves_of(cells), 300u);
  EXPECT_EQ(cells.size(), 599u);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = scene.in({Vec3(-20), Vec3(20)});
    const std::uint32_t leaf = leaf_at(cells, p);
    for (std::uint32_t c = 0; c < cells.size(); ++c)
      ASSERT_EQ(cells[c].child == 0 && belongs_to(cells[c].cell, p), c == leaf);
  }
  // A point in a plane between two cells is the upper one's.
  const std::uint32_t child = cells[0].child;
  Vec3 p = cells[0].content.center();
  const Bounds& second = cells[child + 1].cell;
  for (int axis = 0; axis < 3; ++axis)
    if (std::isfinite(second.lower[axis])) p[axis] = second.lower[axis];
  EXPECT_TRUE(belongs_to(second, p));
  EXPECT_TRUE(belongs_to(cells[leaf_at(cells, p)].cell, p));
}

TEST(ShadeCells, HoldSurfacesAndTheirNormals) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    RandomBoxes scene(seed);
    scene.furnish(Vec3(8, 2, 5) * (seed % 2 == 0 ? 1.0f : 1000.0f), 15);
    if (seed >= 2) scene.add_loose(200, 0.2f * scene.room.upper.y);
    if (seed >= 4)
      for (ShadeTriangle& t : scene.triangles)
        for (Vec3& corner : t.corners) corner += Vec3(3000, -200, 1000);
    const auto cells = make_shade_cells(scene.triangles, {0.4f * scene.room.upper.y, 400});
    for (int i = 0; i < 20000; ++i) {
      const RandomBoxes::Place place = scene.place();
      const ShadeCell& leaf = cells[leaf_at(cells, place.position)];
      ASSERT_TRUE(lies_in(leaf.content, place.position));
      ASSERT_GE(glm::dot(leaf.axis, place.normal), leaf.cos_spread);
      ASSERT_GE(glm::dot(leaf.axis, place.shading), leaf.cos_spread);
      ASSERT_TRUE(!place.two_sided || leaf.cos_spread == -1);
    }
  }
}

TEST(ShadeCells, HoldWhatRoundingMovesAcrossTheirPlanes) {
  // Nothing but walls across x: one, which both halves have, beside the plane where the root is split.
  for (const float x : {-1e-5f, 0.0f, 1e-5f}) {
    RandomBoxes scene(3);
    scene.add_box({{-4, 0, -1}, {4, 1, 1}}, true);
    scene.triangles.resize(4);
    scene.add_box({{x, 0, -1}, {1, 1, 1}}, false);
    scene.triangles.resize(6);
    const auto cells = make_shade_cells(scene.triangles, {0.5f, 500});
    EXPECT_EQ(cells[cells[0].child].cell.upper.x, 0);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 p(x + scene.uniform(-2e-5f, 2e-5f), scene.uniform(0, 1), scene.uniform(-1, 1));
      const Bounds& content = cells[leaf_at(cells, p)].content;
      ASSERT_TRUE(lies_in(content, p)) << x;
      EXPECT_LT(content.upper.x - content.lower.x, 0.01f);
    }
  }
}

TEST(ShadeCells, AreClippedAndStopWhereTheyAreSmall) {
  RandomBoxes scene(4);
  scene.add_box({{0, 0, 0}, {8, 0.5f, 8}}, false);
  const auto cells = make_shade_cells(scene.triangles, {1.1f, 100000});
  EXPECT_EQ(leaves_of(cells), 64u);
  for (const ShadeCell& cell : cells) {
    if (cell.child != 0) continue;
    const Vec3 size = cell.content.upper - cell.content.lower;
    EXPECT_LT(size.x, 1.01f);
    EXPECT_LT(size.z, 1.01f);
  }
  RandomBoxes wall(5);
  wall.furnish({3, 3, 3}, 0);
  const std::vector<ShadeTriangle> floor(wall.triangles.begin() + 4, wall.triangles.begin() + 6);
  for (const ShadeCell& cell : make_shade_cells(floor, {0.5f, 50})) {
    EXPECT_NEAR(cell.axis.y, 1, 1e-5f);
    EXPECT_GT(cell.cos_spread, 0.999f);
    EXPECT_LT(cell.content.upper.y - cell.content.lower.y, 0.01f);
  }
}

TEST(ShadeCells, LeaveOutWhatIsNoTriangle) {
  const auto none = make_shade_cells({}, {});
  ASSERT_EQ(none.size(), 1u);
  EXPECT_TRUE(none[0].content.empty());
  EXPECT_EQ(leaf_at(none, Vec3(1)), 0u);

  const std::array<Vec3, 3> up{Vec3(0, 1, 0), Vec3(0, 1, 0), Vec3(0, 1, 0)};
  std::vector<ShadeTriangle> bad = {{{Vec3(0), Vec3(0), Vec3(0)}, up, false},
                                    {{Vec3(0), Vec3(1), Vec3(2)}, up, true},
                                    {{Vec3(0), Vec3(kNaN), Vec3(2, 0, 0)}, up, false},
                                    {{Vec3(0), Vec3(kInfinity, 0, 0), Vec3(2, 0, 0)}, up, false}};
  EXPECT_TRUE(make_shade_cells(bad, {})[0].content.empty());
  bad.push_back({{Vec3(0), Vec3(0, 0, 1), Vec3(1, 0, 0)}, {Vec3(kNaN), Vec3(0), Vec3(0, 2, 0)}, false});
  const auto cells = make_shade_cells(bad, {0, 16});
  EXPECT_EQ(leaves_of(cells), 16u);
  EXPECT_NEAR(cells[0].content.upper.x, 1, 1e-3f);
  EXPECT_NEAR(cells[0].axis.y, 1, 1e-5f);
  EXPECT_GT(cells[0].cos_spread, 0.999f);
  EXPECT_LT(leaf_at(cells, Vec3(kNaN)), cells.size());
  EXPECT_LT(leaf_at(cells, Vec3(kInfinity)), cells.size());
  EXPECT_EQ(make_shade_cells(bad, {0, 0}).size(), 1u);
  // However many leaves may be: none below the margin.
  bad.back().corners[1].z = 1e-5f;
  EXPECT_LT(make_shade_cells(bad, {0, ~std::size_t{0}}).size(), 5000u);
}

}  // namespace
}  // namespace oriel
